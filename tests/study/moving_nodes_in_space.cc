// Motions of scattered nodes in space: the same equations as on lattices.
#include "analysis/transient.h"
#include "method/box_discretisation.h"
#include "study/motion_data.h"
#include "study/transient.h"
#include "tests/report/fixture.h"
#include "tests/study/space_scene.h"

#include <array>
#include <cmath>
#include <fstream>
#include <functional>
#include <iomanip>
#include <map>
#include <random>

namespace
{
  using namespace plumbline;
  using namespace plumbline::study;
  using namespace plumbline::study::in_space;
  using report::fixture::Folder;

  const Settings moving = {{"Time/final time", "0.5"},
                           {"Methods/perturbation", "0.3"},
                           {"Study/m", "2"},
                           {"Study/h", "1/4"},
                           {"Study/norms", "nodal Linf, nodal L2"},
                           {"Study/decisive error", "nodal L2 | exact"}};
  const Settings tensor = {{"Kernel/type", "bond-tensor"}, {"Kernel/limit", "Navier"}};
  const Settings state_based = {{"Kernel/type", "1/r"},
                                {"Kernel/limit", "Navier"},
                                {"Material/model", "LPS"},
                                {"Material/E", "1"},
                                {"Material/nu", "0.35"}};

  /// As it begins, without load and constraint.
  const Settings free_motion = {{"Problem/solution", ""},
                                {"Problem/load", "0, 0, 0"},
                                {"Problem/constraint", "0, 0, 0"},
                                {"Problem/local solution", "none"},
                                {"Time/initial displacement", "sin(pi*x)*sin(pi*y)*z, 0, 0"}};

  StudyResults motions(const Settings &settings)
  {
    const scene::Scene scene = make_scene(with(moving, settings));
    const Methods methods = choose_methods(scene, available());
    check_transient(scene, methods, 0);
    StudyResults results = run_study(transient_analysis({}), scene, methods);
    for (const Record &record : results.records)
      EXPECT_EQ(record.failure, "") << record.key.label();
    return results;
  }

  std::string refusal_of(const Settings &settings)
  {
    try
    {
      (void)motions(settings);
    }
    catch (const InputError &error)
    {
      return error.what();
    }
    return "";
  }

  using Spot = std::array<double, 3>;

  /// u at the end of steps of .01, by where nodes are.
  std::map<Spot, std::vector<double>> end_of(const Settings &settings,
                                             const std::function<Spot(const Spot &)> &image = {})
  {
    const scene::Scene scene = make_scene(with(moving, settings));
    ProblemsInTime<3>::Loads loads;
    ProblemsInTime<3> problems(scene, 0, scene.study.series[0].levels[0], loads);
    const auto discretisation =
        choose_methods(scene, available())[0]->discretise_in_space(problems.at(0));
    const auto equation = discretisation->motion(false);
    const MotionData<3> data = motion_data<3>(scene, *equation, problems);
    const analysis::Transient transient(*equation, data.drive, scene.time.density,
                                        scene.time.damping);
    analysis::State state = data.start;
    analysis::integrate(transient.motion(), analysis::scheme("velocity Verlet"), {.01},
                        scene.time.final_time, state);
    const auto u = equation->nodal(state.u);
    const unsigned int n = equation->n_components();
    std::map<Spot, std::vector<double>> found;
    for (std::size_t i = 0; i < equation->nodes().size(); ++i)
    {
      Spot x;
      for (unsigned int d = 0; d < 3; ++d)
        x[d] = equation->nodes()[i][d];
      if (image)
        x = image(x);
      for (double &coordinate : x)
        coordinate = std::round(coordinate * 1e8);
      for (unsigned int c = 0; c < n; ++c)
        found[x].push_back(u[i * n + c]);
    }
    return found;
  }

  /// The largest difference, of the largest value.
  double difference(const std::map<Spot, std::vector<double>> &a,
                    const std::map<Spot, std::vector<double>> &b)
  {
    EXPECT_EQ(a.size(), b.size());
    double largest = 0, size = 0;
    for (const auto &[place, u] : a)
      for (std::size_t c = 0; c < u.size(); ++c)
      {
        largest = std::max(largest, std::abs(u[c] - b.at(place)[c]));
        size = std::max(size, std::abs(u[c]));
      }
    return largest / size;
  }
} // namespace

TEST(MovingNodesInSpace, of_a_lattice_move_as_the_lattice_does)
{
  for (const std::string method : {"FA", "PA-AC", "IPA-AC-R2"})
    for (const Settings &model : {Settings{}, tensor, state_based})
    {
      const Settings settings =
          with({{"Methods/names", method},
                {"Problem/solution", model.empty() ? "sin(2*x + y - z - 3*t)"
                                                   : "x*y*sin(t), x*cos(t) + z, y*z*sin(2*t)"},
                {"Problem/load", model.empty() ? "x*t" : "z*t, x, y^2"},
                {"Time/density", "2"},
                {"Time/damping", "0.3"}},
               model);
      const auto lattice = end_of(with(settings, {{"Methods/perturbation", "0"}})),
                 nodes = end_of(with(settings, {{"Methods/perturbation", "1e-30"}}));
      EXPECT_LT(difference(lattice, nodes), 1e-12) << method << ' ' << model.size();
    }
}

TEST(MovingNodesInSpace, hold_manufactured_fields_that_their_rule_maps_exactly)
{
  // degree 2 on moved nodes: errors are those of time and of rounding
  for (const bool is_tensor : {false, true})
  {
    const auto results = motions(with(
        {{"Methods/names", "IPA-AC-R2, FA"},
         {"Problem/solution", is_tensor ? "x*y*sin(2*t) + z^2, y^2 - t*x*z, (1 + x)*(2 - z)*t^2"
                                        : "(1 + x)*(2 - y)*sin(2*t) + x^2 - z^2*t"},
         {"Study/m", "3"},
         {"Time/density", "1.7"},
         {"Time/damping", "0.6"},
         {"Time/schemes", "Runge-Kutta"}},
        is_tensor ? tensor : Settings{}));
    ASSERT_EQ(results.records.size(), 2u);
    EXPECT_LT(results.records[0]["nodal L2 | exact"], 1e-9);
    EXPECT_LT(results.records[0]["velocity nodal L2 | exact"], 1e-8);
    EXPECT_GT(results.records[1]["nodal L2 | exact"], 1e-4);
    EXPECT_EQ(results.records[0]["symmetric"], 0);
    EXPECT_EQ(results.records[1]["symmetric"], 1);
    ASSERT_EQ(results.warnings.size(), 1u);
    EXPECT_EQ(results.warnings[0].find("IPA-AC-R2: the operator is not symmetric"), 0u);
  }
}

TEST(MovingNodesInSpace, by_velocity_verlet_are_of_second_order_in_time)
{
  const auto results = motions({{"Methods/names", "FA, IPA-AC-R2"},
                                {"Problem/solution", "sin(2*x + y - 2*z - 3*t)"},
                                {"Problem/load", "0"},
                                {"Time/schemes", "velocity Verlet"},
                                {"Time/steps", "0.02, 0.01, 0.005"}});
  ASSERT_EQ(results.records.size(), 6u);
  for (const std::size_t i : {std::size_t{0}, std::size_t{3}})
    EXPECT_NEAR(std::log2(results.records[i + 1][time_error] / results.records[i + 2][time_error]),
                2, .05)
        << results.records[i].key.label();
}

TEST(MovingNodesInSpace, keep_energy_where_their_operator_is_symmetric)
{
  const Settings settings =
      with(with(tensor, free_motion), {{"Methods/names", "FA"},
                                       {"Study/h", "1/6"},
                                       {"Time/final time", "10"},
                                       {"Time/critical fractions", "0.5, 0.25"}});
  const auto results = motions(settings);
  ASSERT_EQ(results.records.size(), 2u);
  const auto swing = [](const Record &motion, double from, double to)
  {
    double largest = 0;
    const std::vector<analysis::Energies> energies = energies_of(motion);
    for (const analysis::Energies &now : energies)
      if (now.t >= from && now.t < to)
        largest = std::max(largest, std::abs(now.stored() / energies[0].stored() - 1));
    return largest;
  };
  const double coarse = swing(results.records[0], 0, 11), fine = swing(results.records[1], 0, 11);
  EXPECT_LT(coarse, .05);
  EXPECT_NEAR(coarse / fine, 4, 1); // second order
  // no drift
  EXPECT_LT(swing(results.records[1], 5, 11), 1.2 * swing(results.records[1], 0, 5) + 1e-6);
  EXPECT_NE(
      refusal_of(with(settings, {{"Methods/names", "IPA-AC-R2"}, {"Time/schemes", "trapezoidal"}}))
          .find("needs a symmetric tangent of forces, which IPA-AC-R2"),
      std::string::npos);
  EXPECT_NE(refusal_of(with(settings, {{"Time/critical fractions", "1.1"}}))
                .find("longer than the critical one"),
            std::string::npos);
}

TEST(MovingNodesInSpace, move_alike_after_a_rotation_of_the_cube)
{
  const Folder folder;
  const auto turned = [](const Spot &x) { return Spot{1 - x[2], x[0], x[1]}; };
  const auto file = [&](const std::string &name, const std::function<Spot(const Spot &)> &image)
  {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(-.3, .3);
    std::ofstream out(folder.path() / name);
    out << std::setprecision(17) << "x,y,z\n";
    for (int k = -4; k < 9; ++k)
      for (int j = -4; j < 9; ++j)
        for (int i = -4; i < 9; ++i)
        {
          Spot x;
          for (unsigned int d = 0; d < 3; ++d)
            x[d] = (std::array<int, 3>{i, j, k}[d] + .5 + uniform(random)) / 5;
          x = image(x);
          out << x[0] << ',' << x[1] << ',' << x[2] << '\n';
        }
    return (folder.path() / name).string();
  };
  const Settings settings = with(tensor, {{"Methods/names", "IPA-AC-R2"},
                                          {"Methods/perturbation", "0"},
                                          {"Study/m", "2"},
                                          {"Study/h", "1/5"}});
  // U(X, T) = R u(x), X = R x: components u, v, w of x, y, z become -w, u, v
  const auto given =
      end_of(with(settings, {{"Methods/nodes", file("given.csv", [](const Spot &x) { return x; })},
                             {"Problem/solution", "x*y^2*sin(t), z + x^2*cos(t), x*y*z*t"}}),
             turned);
  const auto rotated = end_of(
      with(settings, {{"Methods/nodes", file("turned.csv", turned)}, // x = Y, y = Z, z = 1 - X
                      {"Problem/solution", "-y*z*(1 - x)*t, y*z^2*sin(t), 1 - x + y^2*cos(t)"}}));
  ASSERT_EQ(given.size(), rotated.size());
  auto expected = given;
  for (auto &[place, u] : expected)
    u = {-u[2], u[0], u[1]};
  EXPECT_LT(difference(expected, rotated), 1e-11);
}

TEST(MovingNodesInSpace, estimate_errors_of_galerkin_methods_on_the_lattice)
{
  // the same, whatever moves the nodes of meshfree rules
  const Settings settings =
      with(free_motion, {{"Methods/names", "Q1"},
                         {"Problem/constraint", "0"},
                         {"Problem/load", "0"},
                         {"Time/initial displacement", "sin(pi*x)*sin(pi*y)*sin(pi*z)"},
                         {"Study/h", "1/4"},
                         {"Study/m", "2"},
                         {"Time/final time", "0.2"}});
  const auto moved = motions(settings),
             fixed = motions(with(settings, {{"Methods/perturbation", "0"}}));
  EXPECT_GT(fixed.records[0]["estimated error"], 0);
  EXPECT_EQ(moved.records[0]["estimated error"], fixed.records[0]["estimated error"]);
}

TEST(MovingNodesInSpace, of_a_state_based_solid_hold_linear_fields)
{
  const auto results =
      motions(with({{"Methods/names", "IPA-AC-R2, FA"},
                    {"Problem/solution", "x*sin(2*t) + z, y*t - 2*x, z*cos(t) + x*t^2"},
                    {"Time/schemes", "Runge-Kutta"}},
                   state_based));
  ASSERT_EQ(results.records.size(), 2u);
  EXPECT_LT(results.records[0]["nodal L2 | exact"], 1e-9);
  EXPECT_LT(results.records[0]["velocity nodal L2 | exact"], 1e-8);
  EXPECT_GT(results.records[1]["nodal L2 | exact"], 1e-4);
  EXPECT_EQ(results.records[1]["symmetric"], 1); // forces are the adjoint of dilatations
}
