// Kernels, rules and Galerkin entries on a line against closed forms.
#include "algebra/banded_system.h"
#include "base/error.h"
#include "meshfree/lattice/stencil.h"
#include "meshfree/rules/rules.h"
#include "physics/load_on_line.h"
#include "reference/lattice/intervals.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>

namespace
{
  using namespace plumbline;
  using physics::Kernel;
  using physics::RadialProfile;
  using Point = dealii::Point<1>;

  const RadialProfile constant = {{1, 0}}, inverse = {{1, -1}}, inverse_square = {{1, -2}},
                      conical = {{1, 0}, {-1, 1}};

  /// -½ Σ A(k) (k h)² / mass over the diffusion of the kernel.
  double second_moment(const algebra::Stencil &A, double h, double mass, double diffusion)
  {
    double sum = 0;
    for (int k = -A.reach(); k <= A.reach(); ++k)
      sum -= .5 * A(0, 0, k, 0) * std::pow(k * h, 2);
    return sum / mass / diffusion;
  }

  algebra::Stencil stencil_of(const std::string &rule, const RadialProfile &profile, double m,
                              double h)
  {
    const auto kernel = Kernel<1>::with_diffusion(profile, m * h, 1);
    return meshfree::lattice_operator(
        kernel, meshfree::lattice_bonds(meshfree::find_rule(rule, "rule").on_line(kernel), kernel,
                                        h, geometry::Backend::fast));
  }

  double ratio_of(const std::string &rule, const RadialProfile &profile, double m)
  {
    constexpr double h = .01;
    return second_moment(stencil_of(rule, profile, m, h), h, 1, 1);
  }
} // namespace

TEST(KernelOnLine, has_the_constants_of_one_dimension)
{
  // ½ ∫ C ξ² dξ = c δ³ ∫ t² ρ dt = 1
  constexpr double delta = .3, cube = delta * delta * delta;
  EXPECT_NEAR(Kernel<1>::with_diffusion(constant, delta, 1).constant() * cube, 3, 1e-13);
  EXPECT_NEAR(Kernel<1>::with_diffusion(inverse, delta, 1).constant() * cube, 2, 1e-13);
  EXPECT_NEAR(Kernel<1>::with_diffusion(inverse_square, delta, 1).constant() * cube, 1, 1e-13);
  EXPECT_NEAR(Kernel<1>::with_diffusion(conical, delta, 1).constant() * cube, 12, 1e-12);
  // ∫_0^1 t² e^(-4t²) dt = √π erf(2)/32 - e^-4/8
  const auto gaussian = RadialProfile::smooth([](double t) { return std::exp(-4 * t * t); }, true);
  EXPECT_NEAR(Kernel<1>::with_diffusion(gaussian, delta, 1).constant() * cube *
                  (std::sqrt(M_PI) * std::erf(2.) / 32 - std::exp(-4.) / 8),
              1, 1e-13);
  EXPECT_NEAR(Kernel<1>::with_diffusion(inverse, delta, .5).limit().diffusion, .5, 1e-15);
  EXPECT_THROW(Kernel<1>(physics::Structure::scalar, {{1, -3}}, delta, 1), InputError);
}

TEST(RulesOnLine, have_second_moments_of_closed_forms)
{
  using Ratio = std::function<double(double m)>;
  const std::map<std::string, std::map<const RadialProfile *, Ratio>> known = {
      // Σ_{k<=m} k² = m(m+1)(2m+1)/6, all of it: the node at r = δ has a whole cell
      {"FA",
       {{&constant, [](double m) { return 1 + 3 / (2 * m) + 1 / (2 * m * m); }},
        {&inverse, [](double m) { return 1 + 1 / m; }},
        {&conical, [](double m) { return 1 - 1 / (m * m); }}}},
      // the trapezoidal rule: half a cell at r = δ
      {"PA-AC",
       {{&constant, [](double m) { return 1 + 1 / (2 * m * m); }},
        {&inverse, [](double) { return 1; }},
        {&conical, [](double m) { return 1 - 1 / (m * m); }}}},
      // the kernel of the last bond is taken at r = δ - h/4
      {"IPA-AC",
       {{&constant, [](double m) { return 1 + 1 / (2 * m * m); }},
        {&inverse, [](double m) { return 1 + 1 / (m * (4 * m - 1)); }},
        {&conical, [](double m) { return 1 + 1 / (2 * m * m); }}}},
      {"IPA-AC-R2", {{&constant, [](double) { return 1; }}, {&conical, [](double) { return 1; }}}},
      {"IPA-AC-R4", {{&inverse, [](double) { return 1; }}}}};
  for (const auto &[rule, ratios] : known)
    for (const auto &[profile, ratio] : ratios)
      for (const int m : {2, 3, 4, 7, 10})
        EXPECT_NEAR(ratio_of(rule, *profile, m), ratio(m), 1e-14 * m) << rule << ", m = " << m;
  for (const std::string rule : {"LAMMPS", "QWJ"}) // ramps give half a cell there, too
    for (const RadialProfile *profile : {&constant, &inverse, &conical})
      for (const int m : {1, 3, 8})
        EXPECT_NEAR(ratio_of(rule, *profile, m), ratio_of("PA-AC", *profile, m), 1e-14 * m) << rule;
  // the ball cuts the cell of k = 2 at three quarters: 2 (1 + 4 · 3/4) h³ over ⅔ δ³
  EXPECT_NEAR(ratio_of("PA-AC", constant, 2.25), 3 * 4 / std::pow(2.25, 3), 1e-14);
  EXPECT_FALSE(meshfree::find_rule("OPT", "rule").on_line);
}

TEST(RulesOnLine, have_the_symbol_of_a_geometric_sum)
{
  constexpr double h = .02, m = 6, c = 3 / (m * m * m * h * h * h);
  const algebra::Stencil A = stencil_of("FA", constant, m, h);
  for (const double theta : {.1, .7, 1.9, 3.})
  {
    double symbol = 0;
    for (int k = -A.reach(); k <= A.reach(); ++k)
      symbol += A(0, 0, k, 0) * std::cos(k * theta);
    // Σ_{|k|<=m} e^{ikθ} = sin((m + ½)θ) / sin(θ/2)
    const double exact = c * h * (2 * m + 1 - std::sin((m + .5) * theta) / std::sin(theta / 2));
    EXPECT_NEAR(symbol / exact, 1, 1e-13);
  }
}

TEST(GalerkinOnLine, has_entries_of_closed_forms)
{
  constexpr double h = .05;
  const reference::AxisShapes constants(false, 0), linear(true, 1);
  for (const int m : {1, 2, 3, 5, 9})
  {
    const auto uniform = Kernel<1>::with_diffusion(constant, m * h, 1);
    const algebra::Stencil A = reference::galerkin_stencil(uniform, h, constants);
    for (int k = 1; k <= A.reach(); ++k) // hats of width 2 h, the last one cut in two
      EXPECT_NEAR(A(0, 0, k, 0) / (uniform.constant() * h * h),
                  k < m    ? -1
                  : k == m ? -.5
                           : 0,
                  1e-13);
    // the piecewise linear interpolation of z² exceeds it by h²/6 in the mean
    EXPECT_NEAR(second_moment(A, h, h, 1), 1 + 1. / (2 * m * m), 1e-13);
    const auto singular = Kernel<1>::with_diffusion(inverse, m * h, 1);
    double sum = 0; // ∫ of the interpolation of z² over z
    for (int k = 0; k < m; ++k)
      sum += 2 * k + 1 - (k == 0 ? 0 : k * (k + 1) * std::log((k + 1.) / k));
    EXPECT_NEAR(second_moment(reference::galerkin_stencil(singular, h, constants), h, h, 1),
                2 * sum / (m * m), 1e-13);
    for (const RadialProfile &profile : {constant, inverse, inverse_square, conical})
      for (const double part : {1., .93}) // the ball ends at a node, or in a cell
      {
        const auto kernel = Kernel<1>::with_diffusion(profile, part * m * h, 1);
        const algebra::Stencil Q1 = reference::galerkin_stencil(kernel, h, linear);
        double row = 0;
        for (int k = -Q1.reach(); k <= Q1.reach(); ++k)
          row += Q1(0, 0, k, 0);
        EXPECT_NEAR(second_moment(Q1, h, h, 1), 1, 1e-12) << m;
        EXPECT_NEAR(row / Q1(0, 0, 0, 0), 0, 1e-14);
        EXPECT_LT(Q1.symmetry_defect(), 1e-14);
      }
  }
}

TEST(GalerkinOnLine, knows_which_jumps_have_infinite_energy)
{
  const auto kernel = Kernel<1>::with_diffusion(inverse_square, .1, 1);
  EXPECT_EQ(reference::why_not_on_intervals(kernel, true), "");
  EXPECT_NE(reference::why_not_on_intervals(kernel, false).find("infinite energy"),
            std::string::npos);
  EXPECT_EQ(reference::why_not_on_intervals(Kernel<1>::with_diffusion(inverse, .1, 1), false), "");
}

TEST(BandedSystem, solves_what_it_multiplies)
{
  const auto kernel = Kernel<1>::with_diffusion(conical, .13, 1);
  const reference::AxisShapes shapes(false, 1);
  const algebra::Stencil A = reference::galerkin_stencil(kernel, .05, shapes);
  constexpr int n = 23;
  std::vector<char> is_free(2 * n, 1);
  is_free[5] = is_free[n + 17] = 0;
  const algebra::BandedSystem system(A, n, is_free);
  algebra::Vector x(2 * n), b(2 * n), y(2 * n);
  for (unsigned int i = 0; i < x.size(); ++i)
    x[i] = is_free[i] != 0 ? std::sin(1. + i * i) : 0;
  system.vmult(b, x);
  EXPECT_LT(system.solve(y, b, {}).relative_residual, 1e-13);
  y -= x;
  EXPECT_LT(y.linfty_norm(), 1e-12);
  algebra::Stencil negative(1, std::array<int, 3>{1, 0, 0});
  negative(0, 0, 0, 0) = 1;
  negative(0, 0, 1, 0) = negative(0, 0, -1, 0) = -2;
  EXPECT_THROW(algebra::BandedSystem(negative, 4, std::vector<char>(4, 1)), NumericalError);
}

TEST(LoadOnLine, is_exact_for_polynomials_waves_and_kinks)
{
  constexpr double delta = .2, x = .37;
  for (const RadialProfile &profile : {constant, inverse, inverse_square, conical})
  {
    const auto kernel = Kernel<1>::with_diffusion(profile, delta, 1);
    // u(x + r) + u(x - r) - 2u = 12 x² r² + 2 r⁴ for u = x⁴
    const auto quartic = physics::load_on_line(kernel, [](const Point &p, unsigned int)
                                               { return std::pow(p[0], 4); });
    const double b = -6 * x * x * kernel.moment({2}) - kernel.moment({4});
    EXPECT_NEAR(quartic(Point(x), 0) / b, 1, 1e-12);
  }
  const auto kernel = Kernel<1>::with_diffusion(constant, delta, 1);
  constexpr double k = 40;
  const auto wave = physics::load_on_line(kernel, [](const Point &p, unsigned int)
                                          { return std::sin(k * p[0]); });
  EXPECT_NEAR(wave(Point(x), 0),
              std::sin(k * x) * 2 * kernel.constant() * (delta - std::sin(k * delta) / k), 1e-9);
  const auto kink = physics::load_on_line(kernel, [](const Point &p, unsigned int)
                                          { return std::abs(p[0] - .3); });
  // u(.37 + r) + u(.37 - r) - 2u = 2 (r - .07) beyond the kink
  EXPECT_NEAR(kink(Point(x), 0), -kernel.constant() * std::pow(delta - .07, 2), 1e-9);
  // nothing but at the ends of the ball, where first points see no more than 0
  constexpr double end = .995 * delta;
  const auto late = physics::load_on_line(kernel, [](const Point &p, unsigned int)
                                          { return std::max(0., p[0] - x - end); });
  EXPECT_NEAR(late(Point(x), 0), -kernel.constant() * std::pow(delta - end, 2) / 2, 1e-12);
  const auto jump = physics::load_on_line(kernel, [](const Point &p, unsigned int)
                                          { return p[0] < x + end ? 0. : 1.; });
  EXPECT_NEAR(jump(Point(x), 0), -kernel.constant() * (delta - end), 1e-9);
}
