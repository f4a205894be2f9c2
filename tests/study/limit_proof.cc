#include "method/limit_proof.h"

#include "base/error.h"
#include "meshfree/method.h"
#include "reference/method.h"
#include "study/conclusions.h"
#include "study/preflight.h"
#include "study/round_off.h"
#include "tests/text_folder.h"

#include "meshfree/rules/family_moments.h"
#include "scene/problem.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

using namespace plumbline;
using Answer = study::LimitProof::Answer;

namespace
{
  method::Methods all()
  {
    method::Methods methods = meshfree::methods();
    for (const auto &method : reference::methods())
      methods.push_back(method);
    return methods;
  }

  scene::Scene scene_of(const std::string &text, const std::vector<scene::Override> &changes = {})
  {
    return scene::parse_scene("test", "subsection Methods\n set names = FA\nend\n" + text, changes);
  }

  /// The proof of a method at the scene's first level, and the field solved for.
  study::LimitProof proof(const scene::Scene &scene, const std::string &name)
  {
    const problem::Problem<2> problem =
        make_problem(scene, 0, scene.study.series.front().levels.front());
    return analysis::solve(*study::find_method(all(), name, "test"), problem).diagnostics.limit;
  }

  const std::string harmonic = "subsection Problem\n set solution = exp(x)*cos(y)\nend\n";
  const std::string solid = "subsection Kernel\n set type = bond-tensor\n set limit = Navier\nend\n"
                            "subsection Problem\n set solution = exp(x)*cos(y), x*y\nend\n";
  const std::string lps = "subsection Kernel\n set type = 1/r\n set limit = Navier\nend\n"
                          "subsection Material\n set model = LPS\n set E = 1\n set nu = .3\nend\n"
                          "subsection Problem\n set solution = exp(x)*cos(y), x*y\nend\n";
} // namespace

// C(m) - 1 of Yang & Yin, "Analysis of convergence for the IPA-AC method", in closed form
TEST(LimitProof, knows_by_how_much_second_moments_are_off_though_the_field_hides_it)
{
  const std::vector<std::pair<std::string, double>> known = {
      {"2", .197213}, {"3", .091336}, {"4", .051250}, {"5", .032889}, {"2.5", .138128}};
  for (const auto &[m, defect] : known)
  {
    const auto found = proof(scene_of(harmonic, {{"Study/m", m}, {"Study/h", ".125"}}), "IPA-AC");
    EXPECT_EQ(found.answer, Answer::incompatible);
    EXPECT_NEAR(found.defect, defect, 1e-6) << m;
  }
}

TEST(LimitProof, tells_right_rules_from_wrong_ones_for_every_model)
{
  const auto scalar = scene_of(harmonic), tensor = scene_of(solid), state = scene_of(lps);
  for (const char *name : {"FA", "LAMMPS", "QWJ", "PA-AC", "IPA-AC", "DGQ0"})
    for (const auto *scene : {&scalar, &tensor, &state})
    {
      const auto found = proof(*scene, name);
      EXPECT_EQ(found.answer, Answer::incompatible) << name;
      EXPECT_GT(found.defect, 1e-4) << name;
    }
  for (const char *name : {"IPA-AC-R2", "IPA-AC-R4", "Q1", "Q2", "DGQ1"})
    for (const auto *scene : {&scalar, &tensor, &state})
      EXPECT_EQ(proof(*scene, name).answer, Answer::compatible) << name;
  EXPECT_EQ(proof(scalar, "OPT").answer, Answer::incompatible);
  EXPECT_EQ(proof(scalar, "GFD").answer, Answer::compatible);
  EXPECT_EQ(proof(tensor, "GFD").answer, Answer::compatible);
  EXPECT_EQ(proof(scalar, "GMLS").answer, Answer::compatible);
  EXPECT_THROW(proof(scalar, "PDDO"), NumericalError); // right moments, but no positive operator
  EXPECT_EQ(proof(tensor, "OPT").answer, Answer::compatible);
  EXPECT_EQ(proof(state, "OPT").answer, Answer::compatible);
}

TEST(LimitProof, an_error_of_one_part_in_a_million_is_an_error)
{
  const auto scene = scene_of(harmonic);
  const problem::Problem<2> problem =
      make_problem(scene, 0, scene.study.series.front().levels.front());
  // the five-point stencil of -1/2 Laplace, with reach 1
  algebra::Stencil stencil(1, 1);
  const double a = .5 / (problem.h * problem.h);
  stencil(0, 0, 0, 0) = 4 * a;
  for (const auto &[i, j] : {std::pair(1, 0), std::pair(-1, 0), std::pair(0, 1), std::pair(0, -1)})
    stencil(0, 0, i, j) = -a;
  EXPECT_EQ(method::prove_by_moments(problem, stencil, 1).answer, Answer::compatible);
  stencil(0, 0, 0, 1) *= 1 + 1e-6;
  EXPECT_EQ(method::prove_by_moments(problem, stencil, 1).answer, Answer::incompatible);
  stencil(0, 0, 0, 1) /= 1 + 1e-6;
  stencil(0, 0, 0, 0) *= 1 + 1e-6; // a constant is no longer mapped to 0
  EXPECT_EQ(method::prove_by_moments(problem, stencil, 1).answer, Answer::incompatible);
}

TEST(LimitProof, promises_nothing_where_no_theorem_applies)
{
  EXPECT_EQ(proof(scene_of(harmonic, {{"Study/regime", "m"}}), "IPA-AC-R2").answer,
            Answer::unknown);
  EXPECT_EQ(proof(scene_of(harmonic, {{"Study/regime", "m"}}), "Q1").answer, Answer::unknown);
  const auto rising = scene_of(harmonic, {{"Kernel/type", "polynomial"},
                                          {"Kernel/coefficients", "1, 1"},
                                          {"Kernel/limit", "-Laplace"}});
  EXPECT_EQ(proof(rising, "Q1").answer, Answer::unknown);
  EXPECT_EQ(proof(rising, "IPA-AC-R2").answer, Answer::compatible); // moments need no sign
  const auto layered = scene_of(harmonic, {{"Domain/mesh", "squares"},
                                           {"Study/h", ".25"},
                                           {"Study/m", "2"},
                                           {"Problem/load", "0"},
                                           {"Kernel/coefficient", "x < 0.5 ? 1 : 2"}});
  for (const char *name : {"Q1", "IPA-AC-R2"}) // fluxes across the jump are in no theorem
    EXPECT_EQ(proof(layered, name).answer, Answer::unknown) << name;
}

// Moments do not depend on the material: a(x, x + ξ) is a(x) + ∇a·ξ/2 but for O(ξ²).
TEST(LimitProof, of_a_material_that_varies_is_that_of_its_kernel)
{
  for (const char *a : {"2 + x", "1 + 0.5*sin(3*x)*cos(2*y)", "exp(x + y)", "x < 0.5 ? 1 : 2"})
  {
    const auto varying = scene_of(harmonic, {{"Domain/mesh", "squares"},
                                             {"Study/h", ".25"},
                                             {"Study/m", "3"},
                                             {"Problem/load", "0"},
                                             {"Kernel/coefficient", a}});
    const bool is_smooth = std::string(a).find('?') == std::string::npos;
    for (const char *name : {"FA", "LAMMPS", "IPA-AC"})
    {
      const auto found = proof(varying, name);
      EXPECT_EQ(found.answer, Answer::incompatible) << name << ' ' << a;
      EXPECT_GT(found.defect, .01) << name;
    }
    EXPECT_EQ(proof(varying, "IPA-AC-R2").answer, is_smooth ? Answer::compatible : Answer::unknown)
        << a;
    EXPECT_EQ(proof(varying, "Q1").answer, is_smooth ? Answer::compatible : Answer::unknown) << a;
  }
  const std::string varying_solid =
      "subsection Domain\n set mesh = squares\nend\n"
      "subsection Kernel\n set type = 1/r\n set limit = Navier\nend\n"
      "subsection Material\n set model = LPS\n set E = 3 + x\n set nu = .3\nend\n"
      "subsection Problem\n set solution = exp(x)*cos(y), x*y\n set load = 0, 0\nend\n";
  const auto solid = scene_of(varying_solid, {{"Study/h", ".25"}, {"Study/m", "2"}});
  EXPECT_EQ(proof(solid, "FA").answer, Answer::incompatible);
  EXPECT_FALSE(proof(solid, "OPT").has_wrong_moments());
}

TEST(LimitProof, at_a_fixed_horizon_weights_tend_to_areas_but_those_of_optimisation)
{
  const auto defect = [](const std::string &text, const char *name, const char *h)
  {
    const auto found = proof(
        scene_of(text, {{"Study/regime", "m"}, {"Study/horizon", "0.4"}, {"Study/h", h}}), name);
    EXPECT_EQ(found.answer, Answer::unknown);
    EXPECT_GT(found.ball_defect, 0);
    return found.area_defect;
  };
  for (const std::string &text : {harmonic, solid, lps})
  {
    for (const char *name : {"FA", "PA-AC", "IPA-AC"})
      EXPECT_LT(defect(text, name, "0.1"), 1e-12) << name;
    EXPECT_LT(defect(text, "IPA-AC-R2", "0.05"), .5 * defect(text, "IPA-AC-R2", "0.1"));
    EXPECT_GT(defect(text, "OPT", "0.05"), .05);
  }
  const auto moved = [](const char *name)
  {
    return proof(scene_of(harmonic, {{"Study/regime", "m"},
                                     {"Study/horizon", "0.4"},
                                     {"Study/h", "0.1"},
                                     {"Domain/mesh", "squares"},
                                     {"Methods/perturbation", ".2"}}),
                 name);
  };
  EXPECT_LT(moved("FA").area_defect, 1e-12);
  EXPECT_GT(moved("FA").ball_defect, 1e-3);
  EXPECT_GT(moved("OPT").area_defect, .05);
}

TEST(LimitProof, of_broken_bonds_proves_nothing_but_keeps_wrong_moments)
{
  const auto cracked = scene_of("subsection Problem\n set solution = x\n set load = 0\nend\n",
                                {{"Domain/mesh", "squares"},
                                 {"Domain/cracks", "0.3, 0.51 : 0.7, 0.51"},
                                 {"Study/h", ".125"},
                                 {"Study/m", "2"}});
  const auto wrong = proof(cracked, "FA");
  EXPECT_EQ(wrong.answer, Answer::unknown);
  EXPECT_TRUE(wrong.has_wrong_moments()); // so that it is never advised
  EXPECT_FALSE(proof(cracked, "IPA-AC-R2").has_wrong_moments());
}

namespace
{
  /// A bias that the trace of second moments does not see.
  meshfree::MomentBias<2>::Answer
  bias_of(const std::function<std::vector<double>(double x, double y)> &defects, unsigned int n,
          std::size_t n_bonds = 28)
  {
    meshfree::MomentBias<2> bias({0, 0}, {1, 1});
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        bias.add({(i + .5) / n, (j + .5) / n}, defects((i + .5) / n, (j + .5) / n), n_bonds);
    return bias.answer(base::Communicator::alone());
  }
} // namespace

TEST(LimitProof, finds_a_bias_of_any_component_in_any_part_of_the_domain)
{
  // first moments, then ξ_2², ξ_1 ξ_2, ξ_1²
  const auto stretched = bias_of(
      [](double, double) -> std::vector<double> {
        return {0, 0, .03, 0, -.03};
      },
      10);
  EXPECT_TRUE(stretched.is_biased);
  EXPECT_NEAR(std::abs(stretched.mean), .03, 1e-12);
  EXPECT_TRUE(bias_of(
                  [](double, double) -> std::vector<double> {
                    return {0, 0, 0, .02, 0};
                  },
                  10)
                  .is_biased); // shear
  EXPECT_TRUE(bias_of(
                  [](double, double) -> std::vector<double> {
                    return {0, .02, 0, 0, 0};
                  },
                  10)
                  .is_biased); // drift
  // stretched one way at the left and the other way at the right
  const auto graded = [](double x, double) -> std::vector<double> {
    return {0, 0, .03 * std::cos(M_PI * x), 0, 0};
  };
  const auto found = bias_of(graded, 64);
  EXPECT_TRUE(found.is_biased);
  EXPECT_LT(std::abs(found.mean), 1e-12);
  EXPECT_NEAR(std::abs(found.mean_of_part), .03, .005);
  // chance alone
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0, .03);
  for (const unsigned int n : {10u, 64u})
    EXPECT_FALSE(
        bias_of(
            [&](double, double) -> std::vector<double> {
              return {noise(random), noise(random), noise(random), noise(random), noise(random)};
            },
            n)
            .is_biased)
        << n;
  // a tensor has 15 moments
  for (unsigned int k = 0; k < 15; ++k)
  {
    std::vector<double> one(15, 0.);
    one[k] = -.01;
    EXPECT_TRUE(bias_of([&](double, double) { return one; }, 10).is_biased) << k;
  }
}

TEST(LimitProof, of_moved_nodes_rests_on_the_moments_of_all_families)
{
  const auto moved = scene_of(
      harmonic, {{"Domain/mesh", "squares"}, {"Study/h", ".1"}, {"Methods/perturbation", ".2"}});
  const auto wrong = proof(moved, "IPA-AC");
  EXPECT_EQ(wrong.answer, Answer::incompatible);
  EXPECT_NEAR(wrong.mean_defect, .0913, .02); // about that of the lattice
  EXPECT_GT(wrong.spread, 1e-3);
  EXPECT_GT(wrong.defect, std::abs(wrong.mean_defect) + wrong.spread);
  const auto right = proof(moved, "IPA-AC-R2");
  EXPECT_LT(right.defect, 1e-10);
  EXPECT_EQ(right.answer, Answer::compatible) << right.reason;
}

// The theorem needs a kernel that is nowhere negative and nowhere increases: the table is known.
TEST(LimitProof, of_galerkin_methods_sees_a_dip_between_any_two_places)
{
  const tests::TextFolder folder("dip");
  folder.write("s.prm", "subsection Kernel\n set type = table\n set table file = k.csv\nend\n" +
                            harmonic + "subsection Methods\n set names = Q1\nend\n");
  const auto answer = [&](const std::string &rows)
  {
    folder.write("k.csv", "t,rho\n0,1\n" + rows + "1,0\n");
    return proof(scene::read_scene((folder.path() / "s.prm").string()), "Q1").answer;
  };
  EXPECT_EQ(answer(""), Answer::compatible);
  EXPECT_EQ(answer("0.5011,1\n0.5019,0.9\n"), Answer::compatible);
  EXPECT_EQ(answer("0.5011,1\n0.5015,-3\n0.5019,0.9\n"), Answer::unknown);  // dips below 0
  EXPECT_EQ(answer("0.5011,1\n0.5015,0.5\n0.5019,0.9\n"), Answer::unknown); // rises again
}

TEST(RoundOff, grows_with_the_offset_and_size_does_not)
{
  const auto make = [](double offset, bool is_manufactured)
  {
    const std::string u = std::to_string(offset) + " + sin(3*x)*cos(2*y)";
    std::string fields = " set solution = " + u, error = "nodal Linf | exact";
    if (!is_manufactured)
    {
      fields = " set load = 6.5*sin(3*x)*cos(2*y)\n set constraint = " + u +
               "\n set local solution = " + u;
      error = "nodal Linf | local";
    }
    const auto scene =
        scene_of("subsection Problem\n" + fields + "\nend\n", {{"Study/decisive error", error}});
    const problem::Problem<2> problem =
        make_problem(scene, 0, scene.study.series.front().levels.front());
    const auto method = study::find_method(all(), "FA", "test");
    const analysis::Solution solution = analysis::solve(*method, problem);
    return std::pair(study::variation(problem.n_components, solution.averages),
                     study::round_off_error(problem, solution));
  };
  const auto [size, noise] = make(0, false);
  const auto [size_far, noise_far] = make(1e6, false);
  const auto [size_made, noise_made] = make(1e6, true);
  EXPECT_NEAR(size_far, size, 1e-6 * size);
  EXPECT_LT(noise, 1e-10 * size);
  EXPECT_GT(noise_far, 1e-9 * size); // 1e6 is known to 1e-10
  EXPECT_LT(noise_far, 1e-8 * size);
  EXPECT_GT(noise_made, 3 * noise_far); // its load is known to less
}

// The operator does not see a constant, and the solver need not.
TEST(RoundOff, a_constant_on_a_lattice_costs_no_more_than_its_own_rounding)
{
  const auto solve = [](const std::string &name, const std::string &offset)
  {
    const auto scene = scene_of("subsection Problem\n set load = 6.5*sin(3*x)*cos(2*y)\n"
                                " set constraint = " +
                                    offset +
                                    " + sin(3*x)*cos(2*y)\n"
                                    " set local solution = sin(3*x)*cos(2*y)\nend\n",
                                {{"Study/decisive error", "nodal Linf | local"}});
    const problem::Problem<2> problem =
        make_problem(scene, 0, scene.study.series.front().levels.front());
    const auto method = study::find_method(all(), name, "test");
    return analysis::solve(*method, problem).nodal;
  };
  for (const char *name : {"FA", "Q1", "DGQ1"})
  {
    const auto near = solve(name, "0"), far = solve(name, "1e6");
    constexpr double rounding = 1e6 * 4e-16; // of the field itself
    for (std::size_t i = 0; i < near.size(); ++i)
      ASSERT_NEAR(far[i] - 1e6, near[i], 4 * rounding) << name;
  }
}
