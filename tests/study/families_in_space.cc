// Q2, DGQ1 and DGQ2 in space: what they hold exactly, their rates and estimates, and where they
// agree with Q1.
#include "algebra/symbol.h"
#include "analysis/statics.h"
#include "method/discretisation_in_space.h"
#include "physics/waves.h"
#include "scene/problem.h"
#include "study/transient.h"
#include "tests/study/space_scene.h"

#include <cmath>
#include <map>
#include <random>

namespace
{
  using namespace plumbline;
  using namespace plumbline::study;
  using namespace plumbline::study::in_space;
  using Point = dealii::Point<3>;

  const std::string l_shape = "0,0,0 : 1,1/2,1/2; 0,0,0 : 1/2,1,1/2", hole = "1/4,1/4,1/4 : "
                                                                             "1/2,1/2,1/2";
  const Settings tensor = {{"Kernel/type", "bond-tensor"},
                           {"Kernel/limit", "Navier"},
                           {"Problem/solution", "x^3*y^2*z, 2*z^4 - x*y^3, x^4 + y^3*z"}};
  const Settings solid = {{"Kernel/type", "1/r"},    {"Kernel/limit", "Navier"},
                          {"Material/model", "LPS"}, {"Material/E", "1"},
                          {"Material/nu", "0.4"},    {"Problem/solution", "0, 0, 0"}};
  const Settings fixed_horizon = {{"Study/regime", "m"}, {"Study/horizon", "1/4"}};

  std::shared_ptr<const Method> galerkin(const std::string &name)
  {
    return find_method(available(), name, "test");
  }

  problem::Problem<3> problem_of(const Settings &settings)
  {
    const auto scene = make_scene(settings);
    return make_problem_in_space(scene, 0, scene.study.series.front().levels.front());
  }

  /// Root mean square of the errors of the field itself at points in the cube, and at its nodes.
  struct Errors
  {
    double of_field = 0, at_nodes = 0;
  };
  Errors errors_of(const std::string &method, const std::string &h)
  {
    const auto problem = problem_of(with(fixed_horizon, {{"Study/h", h}}));
    const auto solution = analysis::solve(*galerkin(method), problem);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> uniform(0, 1);
    constexpr int n_points = 2000;
    Errors errors;
    for (int i = 0; i < n_points; ++i)
    {
      const Point x(uniform(random), uniform(random), uniform(random));
      errors.of_field +=
          std::pow(solution.value(x, 0) - problem.solution->value(x, 0), 2) / n_points;
    }
    errors.of_field = std::sqrt(errors.of_field);
    for (std::size_t i = 0; i < solution.nodes.size(); ++i)
      errors.at_nodes =
          std::max(errors.at_nodes,
                   std::abs(solution.nodal[i] - problem.solution->value(solution.nodes[i], 0)));
    return errors;
  }
} // namespace

TEST(FamiliesInSpace, are_exact_for_the_fields_they_hold)
{
  const std::string quadratic = "x^2*y^2*z^2 - 3*x^2 + y*z", trilinear = "x*y*z + 2*x - z",
                    quadratics = "x^2 + y*z, 2*x*z - y^2*x, z^2*x^2 + x*y",
                    trilinears = "x*y*z, y - 2*x*z, 3*z + x*y";
  const std::vector<Settings> models = {{}, tensor, solid};
  for (const std::string &boxes : {std::string("0,0,0 : 1,1,1"), l_shape})
    for (const auto &[name, of_scalar, of_vector] :
         {std::tuple("Q2", quadratic, quadratics), {"DGQ1", trilinear, trilinears}})
      for (const Settings &model : models)
      {
        const bool is_box = boxes != l_shape, is_solid = &model == &models.back();
        if (is_solid && !is_box)
          continue; // it takes long
        const Settings settings =
            with(model, {{"Problem/solution", model.empty() ? of_scalar : of_vector},
                         {"Domain/boxes", boxes},
                         {"Domain/holes", is_box ? hole : ""},
                         {"Study/m", "1.5"},
                         {"Study/h", "1/4"},
                         {"Methods/names", name}});
        const auto problem = problem_of(settings);
        const auto found = analysis::solve(*galerkin(name), problem);
        double worst = 0;
        for (std::size_t i = 0; i < found.nodal.size(); ++i)
          worst =
              std::max(worst, std::abs(found.nodal[i] -
                                       problem.solution->value(
                                           found.nodes[i / problem.n_components],
                                           static_cast<unsigned int>(i % problem.n_components))));
        EXPECT_LT(worst, 1e-10) << name << ", " << boxes << ", " << problem.n_components;
        const Point x = is_box ? Point(.13, .61, .87) : Point(.13, .61, .37);
        const double exact = problem.solution->value(x, 0);
        EXPECT_NEAR(found.value(x, 0), exact, 1e-10);
        EXPECT_THROW((void)found.value(is_box ? Point(.3, .3, .4) : Point(.7, .7, .2), 0),
                     NumericalError);
        EXPECT_EQ(static_cast<bool>(found.gradient), name == std::string("Q2"));
        if (found.gradient)
        {
          const double step = 1e-4, ahead = problem.solution->value({x[0] + step, x[1], x[2]}, 0),
                       behind = problem.solution->value({x[0] - step, x[1], x[2]}, 0);
          EXPECT_NEAR(found.gradient(x, 0)[0], (ahead - behind) / (2 * step), 1e-7);
        }
        // what the space holds has exact averages, too
        if (model.empty())
        {
          EXPECT_LT(run(make_scene(settings)).records.front()["averages L2 | exact"], 1e-10)
              << name;
        }
      }
}

// as in the plane: rate p + 1 of the field; at nodes Q2 gains another order
TEST(FamiliesInSpace, have_the_rates_of_their_degree)
{
  struct Rates
  {
    double of_field, at_nodes;
  };
  for (const auto &[name, rates] : std::map<std::string, Rates>{
           {"Q1", {2, 2}}, {"Q2", {3, 4}}, {"DGQ1", {2, 2}}, {"DGQ2", {3, 3}}})
  {
    const Errors coarse = errors_of(name, "1/8"), fine = errors_of(name, "1/16");
    EXPECT_NEAR(std::log2(coarse.of_field / fine.of_field), rates.of_field, .25) << name;
    EXPECT_GT(std::log2(coarse.at_nodes / fine.at_nodes), rates.at_nodes - .25) << name;
  }
}

TEST(FamiliesInSpace, are_asymptotically_compatible)
{
  for (const Settings &model : {Settings(), tensor})
  {
    const auto results =
        run(make_scene(with(model, {{"Methods/names", "Q2, DGQ1"},
                                    {"Study/h", "1/4, 1/5, 1/6, 1/8"},
                                    {"Study/norms", "averages L2"},
                                    {"Study/decisive error", "averages L2 | exact"}})));
    ASSERT_EQ(results.trends.size(), 2u);
    for (const Trend &trend : results.trends)
      EXPECT_EQ(trend.verdict, "AC") << trend.method << ": " << trend.reason;
    for (const Record &record : results.records)
      EXPECT_LE(record.cost.n_iterations, model.empty() ? 16u : 22u) << record.key.label();
  }
}

TEST(FamiliesInSpace, have_estimates_that_bound_their_errors)
{
  for (const Settings &model : {Settings(), tensor})
    for (const std::string name : {"Q2", "DGQ1"})
    {
      const auto results = run(make_scene(
          with(with(model, fixed_horizon), {{"Study/h", "1/8"},
                                            {"Domain/boxes", "0,0,0 : 1,1/2,1/2"},
                                            {"Methods/names", name},
                                            {"Reference/method", name},
                                            {"Study/decisive error", "averages L2 | reference"}})));
      ASSERT_EQ(results.references.size(), 1u);
      for (const Record &record : results.records)
      {
        const double error = record["averages L2 | exact"],
                     estimate = results.references[record.key.level].estimate;
        EXPECT_LT(error, estimate) << name;
        EXPECT_GT(error, estimate / 10) << name;
        EXPECT_EQ(record["averages L2 | reference"], 0);
      }
    }
}

TEST(FamiliesInSpace, agree_with_Q1_within_the_estimates)
{
  for (const auto &[boxes, holes] : {std::pair(l_shape, std::string()), {"0,0,0 : 1,1,1", hole}})
  {
    const Settings settings = {{"Domain/boxes", boxes},
                               {"Domain/holes", holes},
                               {"Problem/solution", ""},
                               {"Problem/load", "sin(3*x)*y + z"},
                               {"Problem/constraint", "x*y"},
                               {"Problem/local solution", "0"}, // not used
                               {"Study/h", "1/8"},
                               {"Methods/names", "Q1"},
                               {"Study/norms", "averages L2"},
                               {"Study/decisive error", "averages L2 | reference"}};
    std::map<std::string, StudyResults> by_reference;
    for (const std::string name : {"Q1", "Q2", "DGQ1"})
      by_reference[name] = run(make_scene(with(settings, {{"Reference/method", name}})));
    const double of_Q1 = by_reference["Q1"].references.front().estimate;
    for (const std::string name : {"Q2", "DGQ1"})
    {
      const StudyResults &results = by_reference[name];
      const double difference = results.records.front()["averages L2 | reference"];
      EXPECT_GT(difference, 0);
      EXPECT_LT(difference, results.references.front().estimate + of_Q1) << name << ", " << boxes;
    }
  }
}

namespace
{
  algebra::Symbol symbol_of(const std::string &method, const problem::Problem<3> &problem)
  {
    return algebra::Symbol(*galerkin(method)->discretise_in_space(problem)->waves());
  }
} // namespace

TEST(FamiliesInSpace, have_the_speeds_of_long_waves)
{
  const algebra::Vector3 n = {1. / 3, 2. / 3, 2. / 3};
  for (const auto &[name, contraction] : {std::pair("Q2", 16.), {"DGQ1", 4.}})
    for (const Settings &model : {Settings(), tensor})
    {
      const auto problem = problem_of(with(model, {{"Study/h", "1/4"}}));
      const auto limit = problem.kernel.limit();
      const std::vector<double> exact = model.empty()
                                            ? std::vector<double>{limit.diffusion}
                                            : std::vector<double>{3 * limit.mu, limit.mu, limit.mu};
      const auto speeds = symbol_of(name, problem).long_waves(n);
      ASSERT_EQ(speeds.size(), exact.size());
      for (std::size_t i = 0; i < exact.size(); ++i)
        EXPECT_NEAR(speeds[i] / exact[i], 1, 1e-11) << name;

      // shorter ones by those of the operator itself
      const auto error = [&](const std::string &h)
      {
        const auto level = problem_of(with(model, {{"Study/h", h}}));
        const double k = M_PI / 4;
        return std::abs(symbol_of(name, level).waves(k, n).front().squared /
                            physics::exact_wave<3>(level.kernel, {},
                                                   model.empty()
                                                       ? physics::Polarisation::scalar
                                                       : physics::Polarisation::longitudinal,
                                                   k)
                                .squared -
                        1);
      };
      EXPECT_NEAR(std::log2(error("1/4") / error("1/8")), std::log2(contraction), .3) << name;
    }
}

TEST(FamiliesInSpace, move_exactly_where_they_hold_the_field)
{
  for (const auto &[name, solution] :
       {std::pair("Q2", "x^2*y*z*t^2 + (x^2 + y^2)*t"), {"DGQ1", "x*y*z*t^3 + (2*x - y)*t"}})
    for (const std::string &boxes : {std::string("0,0,0 : 1,1,1"), l_shape})
    {
      const auto scene = make_scene({{"Domain/boxes", boxes},
                                     {"Problem/solution", solution},
                                     {"Time/final time", "0.5"},
                                     {"Time/schemes", "Runge-Kutta"},
                                     {"Study/m", "2"},
                                     {"Study/h", "1/4"},
                                     {"Study/norms", "nodal Linf"},
                                     {"Methods/names", name}});
      const Methods all = available();
      const Methods chosen = choose_methods(scene, all);
      check_transient(scene, chosen, 0);
      for (const Record &record : run_study(transient_analysis({}), scene, chosen).records)
      {
        EXPECT_EQ(record.failure, "");
        EXPECT_LT(record["nodal Linf | exact"], 1e-9) << name << ", " << boxes;
        EXPECT_LT(record["velocity nodal Linf | exact"], 1e-8) << name << ", " << boxes;
      }
    }
}

TEST(FamiliesInSpace, have_the_memory_that_is_foretold)
{
  for (const auto &[name, model, n] :
       {std::tuple("Q2", Settings(), 24u), {"DGQ1", tensor, 16u}, {"DGQ2", Settings(), 16u}})
  {
    const std::string h = "1/" + std::to_string(n);
    const auto scene = make_scene(with(model, {{"Study/h", h}, {"Methods/names", name}}));
    method::ProblemSize size;
    size.level = scene.study.series.front().levels.front();
    size.extents = {static_cast<double>(n), static_cast<double>(n)};
    size.depth = n;
    size.n_components = model.empty() ? 1 : 3;
    const auto bytes = static_cast<double>(run(scene).records.front().cost.peak_bytes);
    const double expected = galerkin(name)->expected_bytes(size);
    EXPECT_GT(expected, bytes / 2) << name;
    EXPECT_LT(expected, bytes * 2) << name;
  }
}

TEST(FamiliesInSpace, of_higher_degree_are_refused_with_those_that_are_there)
{
  for (const std::string name : {"Q3", "DGQ3"})
    EXPECT_NE(message_of({{"Methods/names", name}}).find("take Q1, Q2, DGQ0"), std::string::npos)
        << message_of({{"Methods/names", name}});
}
