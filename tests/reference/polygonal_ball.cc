// Polygonal approximation of the ball: entries, the size of the error, and what is refused.
#include "reference/lattice/polygonal_ball.h"

#include "analysis/statics.h"
#include "base/error.h"
#include "method/limit_proof.h"
#include "reference/lattice/stencil.h"
#include "reference/method.h"
#include "scene/problem.h"
#include "study/motion_estimate.h"
#include "study/preflight.h"
#include "study/reference_estimate.h"
#include "tests/reference/stencil_moment.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace plumbline;
using namespace plumbline::reference;
using geometry::Backend;
using geometry::Point;
using physics::Kernel;

namespace
{
  constexpr double h = .1;

  Kernel<2> kernel_of(physics::RadialProfile profile, double ratio = 3)
  {
    return Kernel<2>::with_diffusion(std::move(profile), ratio * h, .5);
  }
  Kernel<2> kernel_called(const std::string &type, double ratio = 3)
  {
    return kernel_of(physics::kernel_type(type).profile, ratio);
  }

  algebra::Stencil stencil_of(const Kernel<2> &kernel, unsigned int n_sides,
                              const AxisShapes &shapes = AxisShapes(true, 1))
  {
    const geometry::Polygon polygon = inscribed_polygon(kernel.horizon(), n_sides);
    return galerkin_stencil(kernel, h, shapes, Backend::fast, geometry::view(polygon));
  }

  /// The largest difference of two stencils, relative to the diagonal.
  double distance(const algebra::Stencil &a, const algebra::Stencil &b)
  {
    double largest = 0;
    for (int k2 = -b.reach(); k2 <= b.reach(); ++k2)
      for (int k1 = -b.reach(); k1 <= b.reach(); ++k1)
        largest = std::max(largest, std::abs(a(0, 0, k1, k2) - b(0, 0, k1, k2)));
    return largest / std::abs(b(0, 0, 0, 0));
  }

  /// ∫ of 1/cos^q over -a ... a.
  double secants(int q, double a)
  {
    const double sec = 1 / std::cos(a), tan = std::tan(a);
    const double cubed = sec * tan + std::asinh(tan);
    if (q == 3)
      return cubed;
    if (q == 4)
      return 2 * (tan + tan * tan * tan / 3);
    return sec * sec * sec * tan / 2 + 3 * cubed / 4; // q = 5
  }

  /// Second moments of a kernel (r/δ)^p over the polygon, relative to the ball's.
  double ratio_of_power(int p, unsigned int n_sides)
  {
    const double a = M_PI / n_sides;
    return std::pow(std::cos(a), p + 4) * secants(p + 4, a) / (2 * a);
  }

  double ratio_of_constant(unsigned int n)
  {
    const double b = 2 * M_PI / n;
    return std::sin(b) / b * (2 + std::cos(b)) / 3;
  }

  using Settings = std::vector<scene::Override>;

  scene::Scene scene_of(const std::string &names, const Settings &more)
  {
    Settings all = {{"Methods/names", names},
                    {"Kernel/type", "constant"},
                    {"Study/h", "0.1"},
                    {"Study/m", "3"}};
    all.insert(all.end(), more.begin(), more.end());
    return scene::parse_scene("test.prm", "", all);
  }

  analysis::Solution solve(const std::string &name, const Settings &more)
  {
    const scene::Scene scene = scene_of(name, more);
    const problem::Problem<2> problem =
        make_problem(scene, 0, scene.study.series.front().levels.front());
    return analysis::solve(*study::find_method(methods(), name, "test"), problem);
  }

  std::string refusal(const std::string &names, const Settings &more)
  {
    try
    {
      (void)study::choose_methods(scene_of(names, more), methods());
    }
    catch (const InputError &error)
    {
      return error.what();
    }
    return "";
  }

  const Settings parabola = {{"Problem/solution", "x*(1-x)/2 + y*(1-y)/2"}};
  /// The load of the parabola, without its values around the domain.
  const Settings of_load = {{"Problem/load", "1"},
                            {"Problem/constraint", "0"},
                            {"Study/norms", "averages L2"},
                            {"Study/decisive error", "averages L2 | own finest level"}};
} // namespace

TEST(PolygonalBall, second_moments_are_those_of_closed_forms)
{
  const Kernel<2> constant = kernel_called("constant"), inverse = kernel_called("1/r"),
                  linear = kernel_called("linear-decay");
  for (const unsigned int n : {4u, 8u, 16u, 32u, 256u})
  {
    EXPECT_NEAR(second_moment_ratio(constant, n), ratio_of_constant(n), 2e-15) << n;
    EXPECT_NEAR(ratio_of_power(0, n), ratio_of_constant(n), 2e-15) << n;
    EXPECT_NEAR(second_moment_ratio(inverse, n), ratio_of_power(-1, n), 2e-15) << n;
    // 1 - t: the integrals of r^3 and r^4 are 1/4 and 1/5
    EXPECT_NEAR(second_moment_ratio(linear, n), 5 * ratio_of_power(0, n) - 4 * ratio_of_power(1, n),
                2e-14)
        << n;
  }
  EXPECT_NEAR(second_moment_ratio(constant, 8), .812417, 1e-6);
  const geometry::Polygon polygon = inscribed_polygon(2, 8); // a vertex on each half axis
  for (const auto &[k, x] : {std::pair(0, Point<2>(2, 0)), {2, {0, 2}}, {4, {-2, 0}}, {6, {0, -2}}})
    EXPECT_LT(polygon[k].distance(x), 1e-15) << k;
  // a square: ∫ |x|<1-|y| of x^2 is 1/3, that of the disc π/4
  EXPECT_NEAR(second_moment_ratio(constant, 4), 4 / (3 * M_PI), 1e-15);
}

TEST(PolygonalBall, twice_the_sides_divide_the_error_by_4_or_by_16_where_the_kernel_vanishes)
{
  const auto defect = [](const std::string &type, unsigned int n)
  { return 1 - second_moment_ratio(kernel_called(type), n); };
  const double n = 128, a = M_PI / n;
  EXPECT_NEAR(defect("constant", 128) / (4 * a * a / 3), 1, 1e-3);
  EXPECT_NEAR(defect("1/r", 128) / (a * a), 1, 1e-3); // (p + 4) a²/3
  EXPECT_NEAR(defect("linear-decay", 128) / (4 * std::pow(a, 4) / 3), 1, 2e-3);
  for (const auto &[type, factor] : {std::pair("constant", 4.), {"1/r", 4.}, {"linear-decay", 16.}})
    EXPECT_NEAR(defect(type, 32) / defect(type, 64), factor, .01 * factor) << type;
}

TEST(PolygonalBall, entries_have_the_second_moments_of_the_polygon_for_every_ratio_of_horizon_to_h)
{
  const physics::RadialProfile table =
      physics::RadialProfile::table({{0, 2}, {.3, 1.5}, {.5, .2}, {.98, .1}, {1, .1}});
  for (const double ratio : {1., 1.5, 2.5, 3., 5., 7.3})
    for (const unsigned int n : {8u, 16u, 32u})
      for (const auto &profile :
           {physics::kernel_type("constant").profile, physics::kernel_type("1/r").profile,
            physics::kernel_type("linear-decay").profile,
            physics::kernel_type("gaussian").make({{}, 0, .2, {}}), table})
      {
        const Kernel<2> kernel = kernel_of(profile, ratio);
        const auto stencil = stencil_of(kernel, n);
        const double size = stencil(0, 0, 0, 0),
                     rounding = kernel.profile().is_function() ? 3e-13 : 3e-14;
        EXPECT_NEAR(stencil_moment(stencil, 0, 0, 0, 0), 0, 2e-14 * size);
        for (const auto &[a, b] : {std::pair(2, 0), {0, 2}}) // Σ_k A(k) (k1 h)² = -h² ∫ C ξ_1²
          EXPECT_NEAR(-stencil_moment(stencil, 0, 0, a, b) / kernel.moment({2, 0}),
                      second_moment_ratio(kernel, n), rounding)
              << ratio << ' ' << n;
        EXPECT_NEAR(stencil_moment(stencil, 0, 0, 1, 1), 0, 1e-13 * size);
      }
}

// c_k is a polynomial of degree 3 along each axis on each cell: exact by Gauss's rule on triangles.
TEST(PolygonalBall, entries_are_those_of_a_rule_on_the_polygon_cut_by_the_lattice_lines)
{
  const Correlations r(AxisShapes(true, 1));
  for (const double ratio : {1.5, 3., 3.7})
    for (const unsigned int n : {8u, 32u})
    {
      const Kernel<2> kernel = kernel_called("constant", ratio);
      const auto stencil = stencil_of(kernel, n);
      const int reach = stencil.reach();
      algebra::Stencil expected(1, reach);
      std::vector<double> at_0;
      for (int k = -reach; k <= reach; ++k)
        at_0.push_back(r(0, 0, k));
      const geometry::Polygon whole = inscribed_polygon(kernel.horizon(), n);
      for (int j = -reach; j < reach; ++j)
        for (int i = -reach; i < reach; ++i)
        {
          geometry::Polygon cell = whole;
          const double x = i * h, y = j * h;
          const std::vector<std::array<Point<2>, 2>> lines = {{Point<2>(x, y), Point<2>(x + h, y)},
                                                              {Point<2>(x + h, y), {x + h, y + h}},
                                                              {Point<2>(x + h, y + h), {x, y + h}},
                                                              {Point<2>(x, y + h), {x, y}}};
          for (const auto &[a, b] : lines)
            cell = geometry::left_of(geometry::view(cell), a, b);
          if (cell.size() < 3)
            continue;
          const geometry::CutRule rule = geometry::polygon_rule(geometry::view(cell), 6);
          for (std::size_t q = 0; q < rule.points.size(); ++q)
          {
            std::array<std::vector<double>, 2> at_z; // r(z - k) along the axes
            for (unsigned int axis = 0; axis < 2; ++axis)
              for (int k = -reach; k <= reach; ++k)
                at_z[axis].push_back(r(0, 0, rule.points[q][axis] / h - k));
            for (int k2 = -reach; k2 <= reach; ++k2)
              for (int k1 = -reach; k1 <= reach; ++k1)
                expected(0, 0, k1, k2) += h * h * kernel.constant() * rule.weights[q] *
                                          (at_0[k1 + reach] * at_0[k2 + reach] -
                                           at_z[0][k1 + reach] * at_z[1][k2 + reach]);
          }
        }
      EXPECT_LT(distance(stencil, expected), 1e-14) << ratio << ' ' << n;
    }
}

// ∫ (4 - 5 t) t³ dt = 0: the local limit is 0, to which nothing is relative
TEST(PolygonalBall, proves_nothing_of_kernels_without_second_moments)
{
  const scene::Scene scene =
      scene_of("Q1", {{"Kernel/type", "polynomial"},
                      {"Kernel/coefficients", "4, -5"},
                      {"Kernel/limit", "none"},
                      {"Problem/load", "1"},
                      {"Problem/constraint", "0"},
                      {"Study/norms", "averages L2"},
                      {"Study/decisive error", "averages L2 | own finest level"}});
  const problem::Problem<2> problem =
      make_problem(scene, 0, scene.study.series.front().levels.front());
  for (const unsigned int n : {8u, 32u})
  {
    EXPECT_TRUE(std::isnan(second_moment_ratio(problem.kernel, n))) << n;
    const method::LimitProof limit = limit_of_polygon(problem, n);
    EXPECT_EQ(limit.answer, method::LimitProof::Answer::unknown) << n;
    EXPECT_EQ(limit.defect, 0) << n;
  }
}

// T_abcd of Σ_k A_ab(k) k_c k_d against that of the kernel; all of them are off by the same factor
TEST(PolygonalBall, moduli_of_bond_tensors_are_off_by_the_ratio_of_second_moments)
{
  const scene::Scene scene = scene_of("Q1", {{"Kernel/type", "bond-tensor"},
                                             {"Kernel/limit", "Navier"},
                                             {"Problem/solution", "x, y"},
                                             {"Study/regime", "delta"}});
  const problem::Problem<2> problem =
      make_problem(scene, 0, scene.study.series.front().levels.front());
  EXPECT_EQ(problem.kernel.n_components(), 2u);
  for (const unsigned int n : {8u, 16u, 32u})
  {
    const auto stencil = stencil_of(problem.kernel, n);
    const auto limit = method::prove_by_moments(problem, stencil, h * h);
    EXPECT_NEAR(limit.defect, 1 - ratio_of_power(-1, n), 1e-13) << n;
    EXPECT_NEAR(limit_of_polygon(problem, n).defect, limit.defect, 1e-13) << n;
    const auto sum = [&](unsigned int a, unsigned int b, int c, int d)
    {
      double value = 0;
      for (int k2 = -stencil.reach(); k2 <= stencil.reach(); ++k2)
        for (int k1 = -stencil.reach(); k1 <= stencil.reach(); ++k1)
          value += stencil(a, b, k1, k2) * std::pow(k1, c) * std::pow(k2, d);
      return value;
    };
    EXPECT_NEAR(sum(0, 0, 2, 0) / sum(0, 0, 0, 2), 3, 1e-12); // isotropic: C1111 = 3 C1212
    EXPECT_NEAR(sum(0, 1, 1, 1) / sum(0, 0, 0, 2), 1, 1e-12);
  }
}

TEST(PolygonalBall, entries_tend_to_those_of_the_ball_as_sides_are_added)
{
  const Kernel<2> kernel = kernel_called("constant", 2.5);
  const auto ball = galerkin_stencil(kernel, h, AxisShapes(true, 1), Backend::fast);
  const auto from_ball = [&](unsigned int n) { return distance(stencil_of(kernel, n), ball); };
  EXPECT_GT(from_ball(8), .05);
  EXPECT_NEAR(from_ball(128) / from_ball(256), 4, .1);
  EXPECT_LT(from_ball(4096), 1e-6);
}

// A u of a parabola is C b, exactly: A e = (1 - C) b where A z = b.
TEST(PolygonalBall, the_error_of_a_parabola_is_what_second_moments_say)
{
  for (const std::string n : {"8", "16", "32"})
  {
    const std::string name = "Q1+polygon" + n;
    const double c = ratio_of_constant(std::stoi(n));
    const auto found = solve(name, parabola), exact = solve("Q1", parabola),
               z = solve(name, of_load);
    ASSERT_EQ(found.nodal.size(), z.nodal.size());
    for (std::size_t i = 0; i < z.nodal.size(); ++i)
      EXPECT_NEAR(found.nodal[i] - exact.nodal[i], (1 - c) * z.nodal[i], 1e-12) << name;
  }
}

// -1/2 Laplace z = 1 on the unit square has max z = .1473427 (the torsion of a square)
TEST(PolygonalBall, the_error_tends_to_the_share_that_second_moments_miss)
{
  const auto error = [](const std::string &h)
  {
    Settings settings = parabola;
    settings.push_back({"Study/h", h});
    const auto found = solve("Q1+polygon8", settings), exact = solve("Q1", settings);
    double largest = 0;
    for (std::size_t i = 0; i < found.nodal.size(); ++i)
      largest = std::max(largest, std::abs(found.nodal[i] - exact.nodal[i]));
    return largest;
  };
  const double limit = (1 / ratio_of_constant(8) - 1) * .1473427;
  const double coarse = error("0.025"), fine = error("0.0125"); // what remains is O(δ)
  EXPECT_NEAR(2 * fine - coarse, limit, .003 * limit);
}

TEST(PolygonalBall, is_known_to_have_a_wrong_limit_in_every_regime)
{
  using Answer = method::LimitProof::Answer;
  const auto limit = [](Settings settings)
  {
    settings.push_back({"Problem/solution", "exp(x)*cos(y)"});
    return solve("Q1+polygon16", settings).diagnostics.limit;
  };
  for (const Settings &regime : {Settings{{"Study/regime", "delta"}},
                                 Settings{{"Study/regime", "m"}, {"Study/horizon", "0.3"}},
                                 Settings{{"Study/regime", "delta-m"}}})
  {
    const auto found = limit(regime);
    EXPECT_EQ(found.answer, Answer::incompatible);
    EXPECT_NEAR(found.defect, 1 - ratio_of_constant(16), 1e-14);
    EXPECT_NE(found.reason.find("16 sides replaces the ball"), std::string::npos) << found.reason;
    EXPECT_NE(found.reason.find("off by 5.02 %"), std::string::npos) << found.reason;
  }
}

TEST(PolygonalBall, is_refused_where_it_is_not_implemented)
{
  EXPECT_EQ(refusal("Q1+polygon8", parabola), "");
  EXPECT_EQ(refusal("q1+POLYGON8", parabola), "");
  const auto says = [](const std::string &message, const std::vector<std::string> &parts)
  {
    for (const std::string &part : parts)
      EXPECT_NE(message.find(part), std::string::npos) << part << " is not in: " << message;
  };
  const auto with = [](Settings more)
  {
    if (std::none_of(more.begin(), more.end(),
                     [](const auto &one) { return one.key == "Problem/solution"; }))
      more.insert(more.end(), parabola.begin(), parabola.end());
    return refusal("Q1+polygon8", more);
  };
  says(with({{"Kernel/type", "1/r"},
             {"Kernel/limit", "Navier"},
             {"Material/model", "LPS"},
             {"Material/E", "1"},
             {"Material/nu", "0.3"},
             {"Problem/solution", "x, y"}}),
       {"Methods/names: 'Q1+polygon8'", "Material/model = LPS", "take Q1",
        "write Material/model = bond-based"});
  says(with({{"Domain/mesh", "squares"}}), {"Methods/names: 'Q1+polygon8'", "Domain/mesh", "Q1"});
  says(with({{"Domain/dimension", "3"},
             {"Domain/boxes", "0, 0, 0 : 1, 1, 1"},
             {"Problem/solution", "x*y*z"}}),
       {"Methods/names: 'Q1+polygon8'", "two dimensions only", "Domain/dimension = 3", "take Q1"});
  says(with({{"Domain/dimension", "1"}, {"Domain/boxes", "0 : 1"}, {"Problem/solution", "x^2"}}),
       {"Methods/names: 'Q1+polygon8'", "one dimension", "Domain/dimension = 1", "take Q1"});
  says(refusal("Q1+polygon12", parabola),
       {"Methods/names", "'Q1+polygon12' is not known", "choose one of", "Q1+polygon16"});
}

TEST(PolygonalBall, is_no_reference_and_has_no_error_estimate)
{
  const std::string message = refusal("Q1", {{"Reference/method", "Q1+polygon32"},
                                             {"Problem/load", "1"},
                                             {"Problem/constraint", "0"},
                                             {"Study/norms", "averages L2"},
                                             {"Study/decisive error", "averages L2 | reference"}});
  EXPECT_NE(message.find("Reference/method: 'Q1+polygon32' replaces the ball by a polygon of 32 "
                         "sides"),
            std::string::npos)
      << message;
  EXPECT_NE(message.find("choose Q2"), std::string::npos) << message;
  Settings settings = parabola;
  settings.push_back({"Reference/estimate", "every"});
  const scene::Scene scene = scene_of("Q1, Q1+polygon8", settings);
  const auto is_estimated = [&](const std::string &name)
  {
    const auto method = study::find_method(methods(), name, "test");
    EXPECT_EQ(study::wants_estimate(scene, *method), study::is_estimated(scene, *method));
    return study::is_estimated(scene, *method);
  };
  EXPECT_TRUE(is_estimated("Q1"));
  EXPECT_FALSE(is_estimated("Q1+polygon8"));
}
