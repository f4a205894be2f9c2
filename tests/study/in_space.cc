// Static problems in space, from the scene to verdicts: known errors, the limits that theory says,
// and references with estimates that are bounds.
#include "analysis/statics.h"
#include "io/record_journal.h"
#include "method/box_discretisation.h"
#include "report/view.h"
#include "scene/problem.h"
#include "tests/report/fixture.h"
#include "tests/study/space_scene.h"

#include <cmath>
#include <fstream>
#include <map>

namespace
{
  using namespace plumbline;
  using namespace plumbline::study;
  using namespace plumbline::study::in_space;
  using report::fixture::Folder;

  const Settings lps = {{"Kernel/type", "1/r"},
                        {"Kernel/limit", "Navier"},
                        {"Problem/solution", "x^3*y^2 + z^4, y^2*z^3 + x*z, x^2*y*z + y^3"},
                        {"Material/model", "LPS"},
                        {"Material/E", "1"},
                        {"Material/nu", "0.2"}};

  /// Of each method, by its errors at nodes.
  std::map<std::string, std::string> verdicts(const StudyResults &results)
  {
    std::map<std::string, std::string> found;
    for (const Trend &trend : results.trends)
      if (trend.error == "nodal Linf | exact")
        found[trend.method] = trend.verdict;
    return found;
  }
} // namespace

TEST(StaticsInSpace, have_the_errors_of_an_independent_program)
{
  // 8, 16 and 32 cells a side at m = 3, linear decay
  const std::map<std::string, std::vector<double>> known = {
      {"FA", {2.43e-2, 1.96e-2, 1.76e-2}},
      {"IPA-AC-R2", {1.26e-3, 2.67e-4, 6.14e-5}},
      {"Q1", {3.29e-3, 7.31e-4, 1.73e-4}}};
  const auto results = run(make_scene(
      {{"Methods/names", "FA, IPA-AC-R2, Q1, IPA-AC-R4"}, {"Study/h", "1/8, 1/16, 1/32"}}));
  ASSERT_EQ(results.records.size(), 12u);
  for (const Record &record : results.records)
  {
    ASSERT_EQ(record.failure, "");
    const double error = record["nodal Linf | exact"];
    if (const auto found = known.find(record.key.method); found != known.end())
      EXPECT_NEAR(error / found->second[record.key.level], 1, 5e-3) << record.key.method;
    else // its moments are those of the polynomial
      EXPECT_LT(error, 1e-11);
    EXPECT_EQ(record["area"], 1);
    EXPECT_LT(record["round-off"], 1e-9);
  }
}

TEST(StaticsInSpace, are_judged_by_moments_as_in_the_plane)
{
  const auto results = run(make_scene({{"Methods/names", "FA, IPA-AC, IPA-AC-R2, OPT, Q1, DGQ0"},
                                       {"Study/h", "1/4, 1/8, 1/16, 1/32"}}));
  EXPECT_EQ(verdicts(results), (std::map<std::string, std::string>{{"FA", "not AC"},
                                                                   {"IPA-AC", "not AC"},
                                                                   {"IPA-AC-R2", "AC"},
                                                                   {"OPT", "not AC"},
                                                                   {"Q1", "AC"},
                                                                   {"DGQ0", "not AC"}}));
  for (const Record &record : results.records)
    if (record.key.method == "FA")
    {
      EXPECT_NEAR(record["moment defect"], .0441, 1e-4); // C(3) - 1 of FA, linear decay
    }
}

TEST(StaticsInSpace, have_exact_averages_where_the_space_holds_the_field)
{
  const auto results =
      run(make_scene({{"Problem/solution", "3*x + 2*y - z"}, {"Methods/names", "Q1, IPA-AC-R2"}}));
  for (const Record &record : results.records)
    EXPECT_LT(record["averages L2 | exact"], 1e-12) << record.key.method;
}

TEST(StaticsInSpace, converge_at_a_fixed_horizon_where_weights_tend_to_the_ball)
{
  const auto results = run(make_scene({{"Study/regime", "m"},
                                       {"Study/horizon", "1/4"},
                                       {"Study/h", "1/8, 1/16, 1/32"},
                                       {"Methods/names", "IPA-AC-R2, DGQ0"}}));
  double before = 1;
  for (const Record &record : results.records)
    if (record.key.method == "IPA-AC-R2")
    {
      EXPECT_LT(record["ball defect"], before / 2);
      before = record["ball defect"];
    }
  EXPECT_LT(before, .02);
}

TEST(StaticsInSpace, do_not_depend_on_the_order_of_the_axes_nor_on_the_place_of_the_box)
{
  const auto error = [](const Settings &settings)
  { return run(make_scene(settings)).records.front()["nodal Linf | exact"]; };
  const Settings tensor = {
      {"Kernel/type", "bond-tensor"}, {"Kernel/limit", "Navier"}, {"Study/h", "1/8"}};
  const auto with = [&](const Settings &more)
  {
    Settings all = tensor;
    all.insert(all.end(), more.begin(), more.end());
    return error(all);
  };
  const double given = with(
      {{"Domain/boxes", "0,0,0 : 1,1/2,3/4"}, {"Problem/solution", "x^3*y^2, z^3 + x*z, x*y*z"}});
  // x → y → z → x
  EXPECT_NEAR(with({{"Domain/boxes", "0,0,0 : 3/4,1,1/2"},
                    {"Problem/solution", "y*z*x, y^3*z^2, x^3 + y*x"}}) /
                  given,
              1, 1e-9);
  EXPECT_NEAR(
      with({{"Domain/boxes", "2,-1,5 : 3,-1/2,23/4"},
            {"Problem/solution", "(x-2)^3*(y+1)^2, (z-5)^3 + (x-2)*(z-5), (x-2)*(y+1)*(z-5)"}}) /
          given,
      1, 1e-9);
}

TEST(ReferencesInSpace, have_estimates_that_bound_their_errors)
{
  const Settings scalar = {{"Domain/boxes", "0,0,0 : 1,1,1/2"}};
  const Settings constant = {{"Kernel/type", "constant"},
                             {"Problem/solution", "x^4*y - 5*x*z^3 + y^3*z^2"}};
  const Settings tensor = {{"Kernel/type", "bond-tensor"},
                           {"Kernel/limit", "Navier"},
                           {"Problem/solution", "x^3*y^2*z, 2*z^4 - x*y^3, x^4 + y^3*z"}};
  struct Case
  {
    Settings of;
    std::string method, h;
    std::size_t n_levels;
  };
  std::vector<Case> cases = {
      // a load by quadrature, which takes long
      {{{"Kernel/type", "constant"}, {"Problem/solution", "sin(5*x + 3*y)*cos(4*z)"}},
       "Q1",
       "1/8",
       1}};
  for (const Settings &of : {scalar, constant, tensor})
    for (const std::string method : {"Q1", "DGQ0"})
      cases.push_back({of, method, "1/8, 1/12, 1/16", 3});
  for (const auto &[of, method, h, n_levels] : cases)
  {
    Settings posed = of;
    for (const auto &[key, value] : std::vector<std::pair<std::string, std::string>>{
             {"Study/regime", "m"},
             {"Study/horizon", "1/4"},
             {"Study/h", h},
             {"Methods/names", method},
             {"Reference/method", method},
             {"Study/decisive error", "averages L2 | reference"}})
      posed.push_back({key, value});
    const auto results = run(make_scene(posed));
    ASSERT_EQ(results.references.size(), n_levels);
    for (const Record &record : results.records)
    {
      const double error = record["averages L2 | exact"];
      const ErrorEstimate &estimate = results.references[record.key.level];
      EXPECT_EQ(estimate.h, record.key.h);
      EXPECT_LT(error, estimate.estimate) << method << posed.front().value;
      EXPECT_GT(error, estimate.estimate / 10) << method << posed.front().value;
      EXPECT_EQ(record["averages L2 | reference"], 0);
      EXPECT_TRUE(std::isnan(estimate.field_estimate)); // it is not estimated
      EXPECT_TRUE(std::isnan(estimate.p_change));
    }
  }
}

TEST(ReferencesInSpace, that_are_too_inaccurate_for_a_verdict_are_to_be_refined)
{
  const auto results = run(make_scene({{"Methods/names", "IPA-AC-R2"},
                                       {"Reference/method", "Q1"},
                                       {"Study/h", "1/4, 1/8"},
                                       {"Study/norms", "averages L2"},
                                       {"Study/decisive error", "averages L2 | reference"}}));
  bool is_said = false;
  for (const Trend &trend : results.trends)
    if (trend.error == "averages L2 | reference")
    {
      is_said = true;
      EXPECT_EQ(trend.verdict, "undecided");
      EXPECT_NE(trend.reason.find("own estimate"), std::string::npos) << trend.reason;
      EXPECT_NE(trend.reason.find(": refine Study/h"), std::string::npos) << trend.reason;
    }
  EXPECT_TRUE(is_said);
}

TEST(ReferencesInSpace, end_the_run_if_they_are_less_accurate_than_asked_for)
{
  Settings posed = {{"Methods/names", "FA"},
                    {"Reference/method", "Q1"},
                    {"Study/h", "1/8"},
                    {"Study/m", "2"},
                    {"Study/decisive error", "averages L2 | reference"},
                    {"Reference/tolerance", ".1"}};
  EXPECT_NO_THROW(run(make_scene(posed)));
  posed.back().value = "1e-6";
  EXPECT_THROW(run(make_scene(posed)), NumericalError);
}

TEST(StaticsInSpace, are_drawn_and_written)
{
  const Folder folder;
  StaticsOptions options;
  std::size_t n_written = 0;
  options.on_finest = [&](const auto &write, const Record &)
  {
    write((folder.path() / "field").string());
    ++n_written;
  };
  const auto results = run(make_scene({{"Study/h", "1/4, 1/8"}}), options);
  EXPECT_EQ(n_written, 1u); // of the finest level alone
  ASSERT_EQ(results.maps.size(), 3u);
  EXPECT_EQ(results.maps[0].quantity, "averages at z = 0.5625");
  EXPECT_EQ(results.maps[2].quantity, "averages at x = 0.5625");
  EXPECT_EQ(results.maps[0].values.size(), 64u);
  EXPECT_EQ(results.maps[0].solution.size(), 64u);
  EXPECT_NE(report::fixture::read(folder.path() / "field.vti").find("WholeExtent=\"0 8 0 8 0 8 \""),
            std::string::npos);
  report::write_study(report::statics_view(results), results, folder.path());
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "report.html"));
  EXPECT_EQ(io::results_in(folder.path()).records.size(), 2u);
}

TEST(StaticsInSpace, have_the_memory_that_is_foretold)
{
  const auto scene = make_scene({{"Kernel/type", "bond-tensor"},
                                 {"Kernel/limit", "Navier"},
                                 {"Problem/solution", "x*z, y^2, x^2"},
                                 {"Study/h", "1/48"},
                                 {"Methods/names", "FA, Q1"}});
  for (const Record &record : run(scene).records)
  {
    method::ProblemSize size;
    size.level = scene.study.series.front().levels.front();
    size.extents = {48, 48};
    size.depth = 48;
    size.n_components = 3;
    const double expected =
        find_method(available(), record.key.method, "test")->expected_bytes(size);
    EXPECT_GT(expected, static_cast<double>(record.cost.peak_bytes) / 2) << record.key.method;
    EXPECT_LT(expected, static_cast<double>(record.cost.peak_bytes) * 2) << record.key.method;
  }
  const Methods all = available();
  try
  {
    const auto huge = make_scene({{"Study/h", "1/999"}});
    check_memory(huge, choose_methods(make_scene({}), all), all, 0);
    ADD_FAILURE() << "there is no such memory";
  }
  catch (const InputError &error)
  {
    EXPECT_NE(std::string(error.what()).find("(999 x 999 x 999 cells): needs"), std::string::npos)
        << error.what();
  }
}

TEST(StaticsInSpace, need_the_memory_of_a_slab_where_ranks_share_a_box)
{
  const Methods all = available();
  const auto check = [&](const Settings &settings, unsigned int n_ranks) -> std::string
  {
    try
    {
      check_memory(make_scene(with({{"Study/h", "1/1000"}}, settings)),
                   choose_methods(make_scene(settings), all), all, 0, 1, n_ranks);
    }
    catch (const InputError &error)
    {
      return error.what();
    }
    return "";
  };
  const Settings box = {{"Methods/names", "FA, Q1"}}, other = {{"Methods/names", "Q2"}};
  EXPECT_EQ(check(box, 500), "");
  EXPECT_NE(check(box, 2).find("(1000 x 1000 x 1000 cells) on each of 2 ranks: needs"),
            std::string::npos);
  EXPECT_NE(check(other, 500), "");
}

TEST(StaticsInSpace, and_motions_are_refused_without_the_memory_they_need)
{
  const auto huge = make_scene({{"Study/h", "1/8, 1/700"},
                                {"Time/final time", "1"},
                                {"Problem/solution", "x*sin(t)"},
                                {"Study/norms", "nodal Linf"}});
  const Methods methods = choose_methods(make_scene({}), available());
  check_memory_of_motion(huge, methods, 1);
  EXPECT_THROW(check_memory_of_motion(huge, methods, 0), InputError);
  const Methods shared = choose_methods(make_scene({{"Methods/names", "FA, Q1"}}), available());
  EXPECT_THROW(check_memory_of_motion(huge, shared, 0), InputError);
  check_memory_of_motion(huge, shared, 0, 1, 700); // a plane on each rank
}

TEST(StateBasedInSpace, are_exact_where_the_moments_are_those_of_the_field)
{
  const std::string quadratic = "x^2 + y*z, 2*x*z - y^2, z^2 + x*y",
                    fifth = "x^5 + y^3*z^2, x^2*y*z^2 - y^4, z^5 + x^3*y";
  for (const std::string nu : {"0.2", "-0.3", "0.45"})
    for (const auto &[methods, solution] :
         {std::pair{"Q1, IPA-AC-R2, OPT", quadratic}, {"IPA-AC-R4", fifth}})
      for (const std::string holes : {"", "1/4,1/2,3/8 : 1/2,3/4,5/8"})
      {
        const auto results = run(make_scene(with(lps, {{"Material/nu", nu},
                                                       {"Methods/names", methods},
                                                       {"Problem/solution", solution},
                                                       {"Domain/holes", holes},
                                                       {"Study/h", "1/8"}})));
        for (const Record &record : results.records)
        {
          ASSERT_EQ(record.failure, "");
          EXPECT_LT(record["nodal Linf | exact"], 1e-10)
              << record.key.method << ", nu = " << nu << ", " << holes;
        }
      }
}

TEST(StateBasedInSpace, need_values_within_two_horizons)
{
  constexpr double horizon = .375;
  const auto influence = physics::influence_function<3>({{1, -1}}, horizon);
  problem::Problem<3> problem{geometry::CubeLattice({{{{0, 0, 0}, {1, 1, 1}}}, {}}, .125),
                              physics::deviatoric_kernel(influence, 1)};
  problem.load.value = [](const dealii::Point<3> &, unsigned int) { return 0; };
  problem.constraint.value = [](const dealii::Point<3> &x, unsigned int)
  { return std::sqrt(1.6 - x[0]); }; // not finite beyond 1.6
  problem.constraint.is_piecewise = true;
  EXPECT_NO_THROW(problem::complete(problem));
  problem.dilatation = {influence,
                        [](const dealii::Point<3> &) {
                          return physics::Lame{3, 1};
                        },
                        false, true};
  EXPECT_THROW(problem::complete(problem), InputError);
}

TEST(StateBasedInSpace, are_judged_by_the_moments_of_bonds_and_dilatation)
{
  const auto results =
      run(make_scene(with(lps, {{"Methods/names", "FA, PA-AC, IPA-AC-R2, OPT, Q1, DGQ0"},
                                {"Study/h", "1/4, 1/8, 1/16, 1/32"}})));
  EXPECT_EQ(verdicts(results), (std::map<std::string, std::string>{{"FA", "not AC"},
                                                                   {"PA-AC", "not AC"},
                                                                   {"IPA-AC-R2", "AC"},
                                                                   {"OPT", "AC"},
                                                                   {"Q1", "AC"},
                                                                   {"DGQ0", "not AC"}}));
  bool is_said = false;
  for (const auto &omission : results.omissions)
    if (omission.what == "the dilatation as an unknown")
    {
      is_said = true;
      EXPECT_EQ(omission.saving.find("a quarter of the unknowns"), 0u) << omission.saving;
    }
  EXPECT_TRUE(is_said);
}

TEST(StateBasedInSpace, of_equal_constants_are_bonds_alone)
{
  const Settings of_both = {{"Problem/solution", "x^3*y^2, y^2*z^3 + x*z, x^2*y*z"},
                            {"Kernel/limit", "Navier"},
                            {"Material/E", "3"},
                            {"Methods/names", "FA, IPA-AC-R2, Q1"},
                            {"Study/h", "1/8, 1/16"}};
  const auto bonds = run(make_scene(with({{"Kernel/type", "bond-tensor"}}, of_both)));
  const auto solid = run(make_scene(
      with({{"Kernel/type", "1/r"}, {"Material/model", "LPS"}, {"Material/nu", "1/4"}}, of_both)));
  // an excess of 1e-9 in nu brings the dilatation back
  const auto full = run(make_scene(
      with({{"Kernel/type", "1/r"}, {"Material/model", "LPS"}, {"Material/nu", "0.250000001"}},
           of_both)));
  ASSERT_EQ(bonds.records.size(), 6u);
  for (std::size_t i = 0; i < bonds.records.size(); ++i)
  {
    const double error = bonds.records[i]["nodal Linf | exact"];
    EXPECT_NEAR(solid.records[i]["nodal Linf | exact"] / error, 1, 1e-10);
    EXPECT_NEAR(full.records[i]["nodal Linf | exact"] / error, 1, 1e-6);
  }
}

TEST(StaticsInSpace, weigh_nodes_alike_wherever_they_are)
{
  const auto results = run(make_scene({{"Problem/solution", "x"},
                                       {"Problem/local solution", "x + 1"},
                                       {"Methods/names", "FA, Q1, DGQ0"},
                                       {"Study/norms", "nodal L2"},
                                       {"Study/decisive error", "nodal L2 | exact"}}));
  for (const Record &record : results.records)
    EXPECT_NEAR(record["nodal L2 | local"], 1, 1e-12) << record.key.method;
}

TEST(StaticsInSpace, are_estimated_where_nothing_else_is_known)
{
  const auto results = run(make_scene({{"Problem/solution", ""},
                                       {"Problem/load", "sin(3*x)*y + z"},
                                       {"Problem/constraint", "0"},
                                       {"Problem/local solution", "0"},
                                       {"Methods/names", "FA, Q1"},
                                       {"Study/norms", "averages L2"},
                                       {"Study/decisive error", "averages L2 | local"}}));
  ASSERT_EQ(results.estimates.size(), 2u); // of Q1 at both levels
  EXPECT_EQ(results.estimates[0].method, "Q1");
  EXPECT_LT(results.estimates[1].estimate, results.estimates[0].estimate);
  EXPECT_GT(results.estimates[1].estimate, 0);
}

TEST(StaticsInSpace, refuse_what_is_for_the_plane)
{
  const std::vector<std::pair<Settings, std::string>> refused = {
      {{{"Domain/boxes", "0,0 : 1,1"}}, "needs three coordinates per corner"},
      {{{"Domain/boxes", "0,0,0 : 1,1"}}, "a corner without three coordinates"},
      {{{"Domain/boxes", "0,0,0 : 1,1,0"}}, "is empty"},
      {{{"Domain/dimension", "2"}}, "write Domain/dimension = 3, or two coordinates"},
      {{{"Domain/boxes", "0,0,0 : 1,1,.1"}}, "0.8 along z"},
      {{{"Domain/mesh", "squares"}}, "Domain/mesh = squares yet; write lattice"},
      {{{"Domain/holes", "0,0 : .5,.5"}}, "needs three coordinates per corner"},
      {{{"Kernel/coefficient", "1 + x"}}, "clear it (Kernel/materials"},
      {{{"Methods/nodes", "vertices"}}, "write centres"},
      {{{"Material/model", "double well"}}, "write bond-based, LPS or variational"},
      {with(lps, {{"Material/plane", "stress"}}), "Material/plane = stress has no effect here"},
      {with(lps, {{"Material/E", "1 + x"}}), "constants that vary in space"},
      {{{"Kernel/type", "1/r"},
        {"Kernel/limit", "Navier"},
        {"Problem/solution", "x, y, z"},
        {"Material/model", "variational"},
        {"Material/k", "1"},
        {"Material/l", "2"}},
       "Material/k and Material/l are constants of the plane"},
      {with(lps, {{"Kernel/type", "bond-tensor"}}), "as its influence function"},
      {{{"Strip/length", "4"}, {"Strip/height", "1"}, {"Strip/crack", "2"}},
       "cracks and strips yet"},
      {{{"Study/decisive error", "field L2 | exact"}, {"Study/norms", "field L2"}},
       "write a nodal or averages norm"},
      {{{"Methods/names", "Q3"}}, "take Q1, Q2, DGQ0"},
      {{{"Problem/solution", "x*w"}}, "in x, y, z, pi, delta"},
      {{{"Quadrature/tolerance", "1e-3"}}, "has no effect here"},
      {{{"Geometry/checks", "5"}}, "has no effect here"},
      {{{"Solver/linear solver", "direct"}}, "has no effect here"},
      {{{"Time/final time", "1"}, {"Study/norms", "nodal Linf"}, {"Output/fields", "true"}},
       "Time/frames writes states"},
      {{{"Time/final time", "1"}, {"Study/norms", "nodal Linf"}, {"Solver/tolerance", "1e-9"}},
       "it needs a static problem"},
      {{{"Kernel/type", "bond-tensor"}, {"Kernel/limit", "Navier"}}, "needs 3"}};
  for (const auto &[settings, words] : refused)
    EXPECT_NE(message_of(settings).find(words), std::string::npos)
        << settings.back().key << ": " << message_of(settings);
  EXPECT_EQ(message_of({}), "");
}

namespace
{
  const Settings scattered = {{"Methods/perturbation", "0.3"},
                              {"Problem/solution", "sin(2*x + y)*cos(y - z)"},
                              {"Study/h", "1/4, 1/8"},
                              {"Study/norms", "nodal Linf, nodal L2, averages L2"}};

  /// A file of the centres of cubes of 1/8 in the unit cube and within a margin of it.
  std::string write_centres(const Folder &folder, double margin)
  {
    constexpr int n = 8, n_layers = 8;
    std::ofstream out((folder.path() / "nodes.csv").string());
    out.precision(17);
    out << "x,y,z\n";
    const auto at = [](int i) { return (i + .5) / n; };
    const auto is_near = [&](int i) { return at(i) > -margin && at(i) < 1 + margin; };
    for (int k = -n_layers; k < n + n_layers; ++k)
      for (int j = -n_layers; j < n + n_layers; ++j)
        for (int i = -n_layers; i < n + n_layers; ++i)
          if (is_near(i) && is_near(j) && is_near(k))
            out << at(i) << ',' << at(j) << ',' << at(k) << '\n';
    return (folder.path() / "nodes.csv").string();
  }
} // namespace

TEST(ScatteredNodesInSpace, at_the_centres_of_cubes_give_the_lattices_numbers)
{
  const Folder folder;
  for (const std::string kernel : {"linear-decay", "bond-tensor"})
  {
    const Settings settings = {
        {"Kernel/type", kernel},
        {"Kernel/limit", kernel == "bond-tensor" ? "Navier" : "-1/2 Laplace"},
        {"Problem/solution",
         kernel == "bond-tensor" ? "x^3*y^2 + z^4, y^2*z^3 + x*z, x^2*y*z + y^3" : polynomial},
        {"Methods/names", "FA, LAMMPS, QWJ, PA-AC, IPA-AC, IPA-AC-R2, OPT"},
        {"Study/norms", "nodal Linf, nodal L2, averages L2"},
        {"Study/m", "2.7"},
        {"Study/h", "1/8"}};
    const auto lattice = run(make_scene(settings));
    const auto nodes =
        run(make_scene(with(settings, {{"Methods/nodes", write_centres(folder, .6)}})));
    ASSERT_EQ(nodes.records.size(), lattice.records.size());
    for (std::size_t i = 0; i < nodes.records.size(); ++i)
    {
      ASSERT_EQ(nodes.records[i].failure, "") << nodes.records[i].key.method;
      for (const std::string error :
           {"nodal Linf | exact", "nodal L2 | exact", "averages L2 | exact"})
        EXPECT_NEAR(nodes.records[i][error] / lattice.records[i][error], 1, 1e-7)
            << nodes.records[i].key.method << " " << error;
    }
  }
}

TEST(ScatteredNodesInSpace, keep_the_local_limit_by_rules_with_exact_moments)
{
  const auto results = run(make_scene({{"Methods/perturbation", "0.3"},
                                       {"Methods/names", "FA, IPA-AC, IPA-AC-R2, Q1"},
                                       {"Study/h", "1/4, 1/6, 1/8, 1/12"},
                                       {"Study/norms", "nodal Linf, nodal L2, averages L2"},
                                       {"Study/decisive error", "nodal L2 | exact"}}));
  std::map<std::string, std::string> found;
  for (const Trend &trend : results.trends)
    if (trend.error == "nodal L2 | exact")
      found[trend.method] = trend.verdict;
  EXPECT_EQ(found["IPA-AC-R2"], "AC");
  EXPECT_EQ(found["Q1"], "AC");
  EXPECT_NE(found["IPA-AC"], "AC");
  EXPECT_NE(found["FA"], "AC");
  std::map<std::string, std::vector<Record>> records;
  for (const Record &record : results.records)
    records[record.key.method].push_back(record);
  for (const std::string error : {"nodal L2 | exact", "averages L2 | exact"})
  {
    const auto last = [&](const std::string &method)
    { return records[method].back()[error] / records[method][2][error]; };
    EXPECT_LT(last("IPA-AC-R2"), .5) << error; // of second order: .44
    EXPECT_GT(last("IPA-AC"), .6) << error;
    // averages of both have the error of values at centres
    const double factor = error == "nodal L2 | exact" ? 20 : 4;
    EXPECT_GT(records["IPA-AC"].back()[error], factor * records["IPA-AC-R2"].back()[error])
        << error;
  }
  EXPECT_LT(records["IPA-AC-R2"].back()["moment defect"], 1e-10);
  EXPECT_GT(records["FA"].back()["moment defect"], .1);
  // on average over random places they are nearly right
  EXPECT_LT(std::abs(records["FA"].back()["mean moment defect"]), .02);
  EXPECT_GT(std::abs(records["IPA-AC"].back()["mean moment defect"]), .1);
}

TEST(ScatteredNodesInSpace, leave_galerkin_methods_as_they_are)
{
  const Settings q1 = {{"Methods/names", "Q1"}};
  const auto moved = run(make_scene(with(scattered, q1)));
  const auto fixed = run(make_scene(with(with(scattered, q1), {{"Methods/perturbation", "0"}})));
  for (std::size_t i = 0; i < fixed.records.size(); ++i)
    EXPECT_EQ(moved.records[i]["averages L2 | exact"], fixed.records[i]["averages L2 | exact"]);
}

TEST(ScatteredNodesInSpace, of_recalibrated_weights_solve_quadratics_exactly)
{
  for (const std::string boxes : {"0,0,0 : 1,1,1", "0,0,0 : 1,1/2,1; 0,0,0 : 1/2,1,1/2"})
  {
    const auto results = run(
        make_scene(with(scattered, {{"Domain/boxes", boxes},
                                    {"Problem/solution", "x^2 - 2*y*z + z, x*y + z^2, y^2 - x*z"},
                                    {"Kernel/type", "bond-tensor"},
                                    {"Kernel/limit", "Navier"},
                                    {"Study/h", "1/8"},
                                    {"Methods/names", "IPA-AC-R2, OPT, FA"}})));
    for (const Record &record : results.records)
    {
      ASSERT_EQ(record.failure, "") << record.key.method;
      if (record.key.method == "FA")
        EXPECT_GT(record["nodal Linf | exact"], 1e-3);
      else
        EXPECT_LT(record["nodal Linf | exact"], 1e-10) << record.key.method << " " << boxes;
    }
  }
}

TEST(ScatteredNodesInSpace, that_cannot_be_used_are_refused)
{
  const Folder folder;
  const auto expect = [](const Settings &settings, const std::vector<std::string> &parts)
  {
    std::string message = message_of(settings);
    if (message.empty())
      try
      {
        check_data(make_scene(settings));
      }
      catch (const InputError &error)
      {
        message = error.what();
      }
    for (const std::string &part : parts)
      EXPECT_NE(message.find(part), std::string::npos) << part << " | " << message;
  };
  expect({{"Methods/nodes", "vertices"}}, {"Methods/nodes = vertices", "write centres"});
  expect({{"Methods/nodes", "cetres"}}, {"'cetres' is not known"});
  expect({{"Methods/perturbation", "0.5"}}, {"Methods/perturbation", "0.5"});
  expect({{"Methods/nodes", write_centres(folder, .2)}, {"Study/h", "1/8"}},
         {"nodes.csv", "nodes end at x = -0.1875", "the reach of the kernel (0.375)"});
  expect({{"Methods/nodes", (folder.path() / "none.csv").string()}}, {"none.csv"});
  std::ofstream((folder.path() / "flat.csv").string()) << "x,y\n0,0\n";
  expect({{"Methods/nodes", (folder.path() / "flat.csv").string()}, {"Study/h", "1/8"}},
         {"flat.csv", "column"});
  {
    std::ifstream in(write_centres(folder, .6));
    std::ofstream out((folder.path() / "twice.csv").string());
    out << in.rdbuf() << "0.0625,0.0625,0.0625\n";
  }
  expect({{"Methods/nodes", (folder.path() / "twice.csv").string()}, {"Study/h", "1/8"}},
         {"twice.csv", "take one of them out"});
}

TEST(ScatteredNodesInSpace, need_one_file_for_each_h_and_their_own_solver)
{
  const Folder folder;
  const auto expect = [](const Settings &settings, const std::string &part)
  {
    const std::string message = message_of(settings);
    EXPECT_NE(message.find(part), std::string::npos) << part << " | " << message;
  };
  const std::string file = write_centres(folder, .6);
  expect({{"Methods/nodes", file}}, "nodes_{h}.csv");
  expect(with(scattered, {{"Solver/iteration", "cg"}}), "a bond has two weights");
  expect(with(scattered, {{"Solver/operator", "fft"}}), "Solver/operator = fft is for lattices");
  expect({{"Methods/nodes", file}, {"Study/h", "1/8"}, {"Geometry/seed", "3"}}, "Geometry/seed");
}

// Beyond the reach of bonds nothing is known of u, and none is needed.
TEST(ScatteredNodesInSpace, take_u_where_bonds_reach_and_do_not_mind_its_size)
{
  const auto results =
      run(make_scene(with(scattered, {{"Problem/solution", "1e6 + x^2 - y*z + 0*sqrt(.52 + x)"},
                                      {"Problem/load", "-1"},
                                      {"Study/h", "1/8"},
                                      {"Methods/names", "IPA-AC-R2"}})));
  ASSERT_EQ(results.records.front().failure, "");
  EXPECT_LT(results.records.front()["nodal Linf | exact"], 1e-9);
}

TEST(ScatteredNodesInSpace, have_norms_over_the_volumes_of_their_cells)
{
  const auto scene = make_scene(with(scattered, {{"Methods/names", "FA"},
                                                 {"Methods/perturbation", "0.45"},
                                                 {"Study/h", "1/8"},
                                                 {"Study/decisive error", "nodal L2 | exact"}}));
  const auto problem =
      scene::make_problem_in_space(scene, 0, scene.study.series.front().levels.front());
  const auto solution = analysis::solve(*find_method(available(), "FA", "Methods/names"), problem);
  double weighted = 0, volume = 0, alike = 0;
  for (std::size_t i = 0; i < solution.nodes.size(); ++i)
  {
    const double error = solution.nodal[i] - problem.solution->value(solution.nodes[i], 0);
    weighted += solution.volumes[i] * error * error;
    alike += error * error / static_cast<double>(solution.nodes.size());
    volume += solution.volumes[i];
  }
  EXPECT_NEAR(volume, 1, 1e-12);
  const double found = run(scene).records.front()["nodal L2 | exact"];
  EXPECT_NEAR(found / std::sqrt(weighted), 1, 1e-9);
  EXPECT_GT(std::abs(std::sqrt(alike) / found - 1), 1e-3); // the cells differ
}
