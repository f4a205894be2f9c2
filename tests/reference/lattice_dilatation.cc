#include "reference/lattice/dilatation.h"

#include "algebra/solve.h"
#include "method/discretisation.h"
#include "physics/state_based.h"
#include "reference/lattice/stencil.h"

#include <deal.II/base/quadrature_lib.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace plumbline;
using namespace plumbline::reference;
using geometry::Point;
using physics::Kernel;
using physics::Lame;

namespace
{
  using Profile = physics::RadialProfile;
  constexpr double h = .1;
  const Profile cone = {{1, -1}}; // the influence 1/r, whose potential is a cone
  const std::vector<Profile> profiles = {cone,
                                         {{1, 0}},
                                         {{1, 0}, {-1, 1}},
                                         {{1, 6}, {1, -1}},
                                         physics::kernel_type("gaussian").make({{}, 0, .4, {}})};

  /// ∫ f over [0, 2δ] by Gauss points graded towards 0, δ and 2δ.
  template <class Function>
  double integrate_radially(double horizon, const Function &f)
  {
    static const dealii::QGauss<1> gauss(20);
    double sum = 0;
    for (const double end : {0., 1., 2.})
      for (const double sign : {-1., 1.})
        for (int level = 1; level < 50 && end + sign > -.5 && end + sign < 2.5; ++level)
          for (unsigned int q = 0; q < gauss.size(); ++q)
          {
            const double size = std::ldexp(.5, -level);
            const double t = end + sign * size * (1 + gauss.point(q)[0]);
            sum += horizon * size * gauss.weight(q) * f(horizon * t);
          }
    return sum;
  }

  algebra::Stencil solid(double ratio, const Lame &lame, const AxisShapes &shapes,
                         const Profile &profile = cone)
  {
    const auto influence = physics::influence_function<2>(profile, ratio * h);
    return add(galerkin_stencil(physics::deviatoric_kernel(influence, lame.mu), h, shapes,
                                geometry::Backend::fast),
               dilatation_stencil(influence, lame.lambda - lame.mu, h, shapes));
  }

  /// u_component = x^a y^b, in units of h, and what the solid's operator makes of it if a + b <= 2.
  struct Monomial
  {
    unsigned int component;
    int a, b;

    double operator()(unsigned int c, double x, double y) const
    {
      return c == component ? std::pow(x, a) * std::pow(y, b) : 0;
    }
    double force(unsigned int c, const Lame &lame) const
    {
      const double second[2][2] = {{a == 2 ? 2. : 0., a == 1 && b == 1 ? 1. : 0.},
                                   {a == 1 && b == 1 ? 1. : 0., b == 2 ? 2. : 0.}};
      return -(c == component ? lame.mu * (second[0][0] + second[1][1]) : 0) -
             (lame.lambda + lame.mu) * second[c][component];
    }
  };

  double mean(const AxisShapes &shapes, unsigned int family) // ∫ φ along an axis
  {
    const dealii::QGauss<1> gauss(4);
    double sum = 0;
    for (const auto &part : shapes.restrictions(family))
      for (unsigned int q = 0; q < gauss.size(); ++q)
        sum += gauss.weight(q) * shapes.value(part.local, gauss.point(q)[0]);
    return sum;
  }

  /// max |(A u)_s - ∫ φ_s L u| for the nodal values of u.
  double defect(const algebra::Stencil &stencil, const AxisShapes &shapes, const Monomial &u,
                const Lame &lame)
  {
    const auto n_axis = static_cast<unsigned int>(shapes.families().size());
    const unsigned int n_families = n_axis * n_axis;
    const auto offset = [&](unsigned int family) { return shapes.families()[family].offset; };
    double worst = 0;
    for (unsigned int s = 0; s < 2 * n_families; ++s)
    {
      const unsigned int sx = s % n_families % n_axis, sy = s % n_families / n_axis;
      double sum = -u.force(s / n_families, lame) * mean(shapes, sx) * mean(shapes, sy);
      for (unsigned int t = 0; t < 2 * n_families; ++t)
        for (int k2 = -stencil.reach(); k2 <= stencil.reach(); ++k2)
          for (int k1 = -stencil.reach(); k1 <= stencil.reach(); ++k1)
            sum += stencil(s, t, k1, k2) * u(t / n_families, k1 + offset(t % n_families % n_axis),
                                             k2 + offset(t % n_families / n_axis));
      worst = std::max(worst, std::abs(sum));
    }
    return worst;
  }
} // namespace

TEST(DilatationKernel, derives_from_a_function_of_unit_mass_with_twice_the_spread_of_the_cone)
{
  for (const auto &profile : profiles)
    for (const double horizon : {1., .3})
    {
      const auto influence = physics::influence_function<2>(profile, horizon);
      const DilatationKernel c(influence);
      const auto across = [&](int power) {
        return integrate_radially(horizon,
                                  [&](double r) { return std::pow(r, power) * c(r).across; });
      };
      const auto along = [&](int power) {
        return integrate_radially(horizon,
                                  [&](double r) { return std::pow(r, power) * c(r).along; });
      };
      // by parts, with Ψ' = r across: ∫ Ψ = -π ∫ r² Ψ' dr, ∫ Ψ |w|² = -π/2 ∫ r⁴ Ψ' dr
      EXPECT_NEAR(-M_PI * across(3), 1, 1e-12);
      const double fourth =
          influence.moment({4, 0}) + 2 * influence.moment({2, 2}) + influence.moment({0, 4});
      EXPECT_NEAR(-.5 * M_PI * across(5) / (.5 * fourth), 1, 1e-12); // ∫ φ|ξ|² = ¼ ∫ K|ξ|⁴
      // ∫ Ψ'' = 0 and ∫ r Ψ'' = Ψ(0)
      EXPECT_NEAR(along(0) * std::pow(horizon, 3), 0, 1e-11);
      EXPECT_NEAR((along(1) + across(1)) * horizon * horizon, 0, 1e-11);
      EXPECT_NEAR(c(c.radius()).along * std::pow(horizon, 4), 0, 2e-11);
    }
}

TEST(DilatationKernel, of_the_cone_has_its_closed_forms_at_0)
{
  const double horizon = .7;
  const DilatationKernel c(physics::influence_function<2>(cone, horizon));
  const double peak =
      -integrate_radially(horizon, [&](double r) { return r * c(r).across; }); // Ψ(0) = ∫ φ²
  EXPECT_NEAR(peak * std::pow(horizon, 2), 1.5 / M_PI, 1e-13);
  EXPECT_NEAR(c(0).along * std::pow(horizon, 4), -4.5 / M_PI, 1e-13); // -½ ∫ K²|ξ|²
  EXPECT_NEAR(c(0).across * std::pow(horizon, 4), -4.5 / M_PI, 1e-13);
}

TEST(SolidStencil, gives_no_force_for_linear_fields_and_the_exact_force_for_quadratic_ones)
{
  const Lame lame{3, 1.1};
  for (unsigned int degree = 1; degree <= 3; ++degree)
    for (const double ratio : {.7, 2.5, 3., 6.})
    {
      const AxisShapes shapes(true, degree);
      const auto stencil = solid(ratio, lame, shapes);
      for (unsigned int component = 0; component < 2; ++component)
        for (int a = 0; a <= 2; ++a)
          for (int b = 0; a + b <= 2; ++b)
            EXPECT_LT(defect(stencil, shapes, {component, a, b}, lame), a + b < 2 ? 1e-13 : 5e-13)
                << degree << ", ratio " << ratio << ", " << a << b;
    }
}

TEST(SolidStencil, of_discontinuous_spaces_is_exact_for_polynomials_that_they_contain)
{
  const Lame lame{3, 1.1};
  for (unsigned int degree = 0; degree <= 3; ++degree)
  {
    const AxisShapes shapes(false, degree);
    const auto stencil = solid(2.5, lame, shapes);
    for (unsigned int component = 0; component < 2; ++component)
      for (int a = 0; a <= 2; ++a)
        for (int b = 0; a + b <= (degree < 2 ? 1 : 2); ++b)
          EXPECT_LT(defect(stencil, shapes, {component, a, b}, lame), 1e-12)
              << degree << ", " << a << b;
  }
}

TEST(SolidStencil, serves_every_profile)
{
  const Lame lame{1, 4};
  const AxisShapes shapes(true, 1);
  for (const auto &profile : profiles)
    EXPECT_LT(defect(solid(2.3, lame, shapes, profile), shapes, {0, 1, 1}, lame), 1e-12);
}

TEST(DilatationStencil, is_symmetric_for_every_space)
{
  for (const bool is_continuous : {true, false})
    for (unsigned int degree = is_continuous ? 1 : 0; degree <= 3; ++degree)
    {
      const auto stencil = dilatation_stencil(physics::influence_function<2>(cone, 2.5 * h), 1, h,
                                              AxisShapes(is_continuous, degree));
      EXPECT_LT(stencil.symmetry_defect(), 1e-14);
      EXPECT_EQ(stencil.reach(), 6);
    }
}

// Continuous shape functions are sums of discontinuous ones: so are their entries.
TEST(DilatationStencil, of_a_continuous_space_lies_in_that_of_the_discontinuous_one)
{
  for (unsigned int degree = 1; degree <= 3; ++degree)
  {
    const AxisShapes q(true, degree), dgq(false, degree);
    const auto influence = physics::influence_function<2>(cone, 1.7 * h);
    const auto continuous = dilatation_stencil(influence, 1, h, q);
    const auto broken = dilatation_stencil(influence, 1, h, dgq);
    const unsigned int n_q = degree, n_dgq = degree + 1;
    for (unsigned int s = 0; s < 2 * n_q * n_q; ++s)
      for (unsigned int t = 0; t < 2 * n_q * n_q; ++t)
        for (int k2 = -4; k2 <= 4; ++k2)
          for (int k1 = -4; k1 <= 4; ++k1)
          {
            const auto parts = [&](unsigned int block, bool is_x)
            {
              const unsigned int family = block % (n_q * n_q);
              return q.restrictions(is_x ? family % n_q : family / n_q);
            };
            double sum = 0;
            for (const auto &sx : parts(s, true))
              for (const auto &sy : parts(s, false))
                for (const auto &tx : parts(t, true))
                  for (const auto &ty : parts(t, false))
                  {
                    const int x = k1 + tx.cell - sx.cell, y = k2 + ty.cell - sy.cell;
                    const unsigned int row = s / (n_q * n_q), column = t / (n_q * n_q);
                    if (std::max(std::abs(x), std::abs(y)) <= broken.reach())
                      sum += broken((row * n_dgq + sy.local) * n_dgq + sx.local,
                                    (column * n_dgq + ty.local) * n_dgq + tx.local, x, y);
                  }
            EXPECT_NEAR(continuous(s, t, k1, k2), sum, 1e-13);
          }
  }
}

// θ_a(x) = ∫ K ξ_a φ(x+ξ) dξ cell by cell, then ∫ θ_a(x) θ_b(x-k) dx over a fine grid.
TEST(DilatationStencil, agrees_with_brute_force_over_dilatations)
{
  constexpr int n_parts = 12, reach = 4; // of a cell; cells where θ does not vanish
  const double horizon = 1.5;            // h = 1
  const auto influence = physics::influence_function<2>(cone, horizon);
  const dealii::QIterated<1> outer(dealii::QGauss<1>(3), n_parts);
  const int n_points = static_cast<int>(outer.size()), width = 2 * reach * n_points;
  for (const bool is_continuous : {true, false})
  {
    const AxisShapes shapes(is_continuous, is_continuous ? 1 : 0);
    const auto parts = shapes.restrictions(0);
    std::array<std::vector<double>, 2> theta;
    theta.fill(std::vector<double>(static_cast<std::size_t>(width) * width));
    geometry::CutRule rule;
    for (int j = 0; j < width; ++j)
      for (int i = 0; i < width; ++i)
      {
        const Point<2> x(i / n_points - reach + outer.point(i % n_points)[0],
                         j / n_points - reach + outer.point(j % n_points)[0]);
        for (const auto &px : parts)
          for (const auto &py : parts)
          {
            const auto cell = geometry::square(Point<2>(px.cell, py.cell), 1);
            geometry::polar_rule({x, horizon}, geometry::view(cell), 8, 4, rule);
            for (std::size_t q = 0; q < rule.points.size(); ++q)
            {
              const auto xi = rule.points[q] - x;
              const double value = rule.weights[q] * influence.radial(xi.norm()) *
                                   shapes.value(px.local, rule.points[q][0] - px.cell) *
                                   shapes.value(py.local, rule.points[q][1] - py.cell);
              for (unsigned int a = 0; a < 2; ++a)
                theta[a][static_cast<std::size_t>(j) * width + i] += value * xi[a];
            }
          }
      }
    const auto stencil = dilatation_stencil(influence, 1, 1, shapes);
    for (unsigned int a = 0; a < 2; ++a)
      for (unsigned int b = 0; b < 2; ++b)
        for (int k2 = 0; k2 <= 4; ++k2)
          for (int k1 = 0; k1 <= 4; ++k1)
          {
            double sum = 0;
            for (int j = k2 * n_points; j < width; ++j)
              for (int i = k1 * n_points; i < width; ++i)
                sum += outer.weight(i % n_points) * outer.weight(j % n_points) *
                       theta[a][static_cast<std::size_t>(j) * width + i] *
                       theta[b][static_cast<std::size_t>(j - k2 * n_points) * width + i -
                                k1 * n_points];
            EXPECT_NEAR(stencil(a, b, k1, k2), sum, is_continuous ? 1e-6 : 1e-5)
                << a << b << ", " << k1 << ", " << k2;
          }
  }
}

// Σ_k A_ab(k) exp(ik·ω) = Σ_n ω_a ω_b φ̂(ω)² ĉ(ω) over the aliases ω + 2πn, h = 1: φ̂ by Bessel
// functions, and ĉ = Π sinc⁴(ω/2) for bilinear elements.
TEST(DilatationStencil, has_the_symbol_that_follows_from_the_transform_of_the_cone)
{
  const double horizon = 2.6;
  const auto stencil =
      dilatation_stencil(physics::influence_function<2>(cone, horizon), 1, 1, AxisShapes(true, 1));
  const dealii::QIterated<1> gauss(dealii::QGauss<1>(10), 12);
  const auto transform = [&](double k)
  {
    double sum = 0;
    for (unsigned int q = 0; q < gauss.size(); ++q)
    {
      const double r = horizon * gauss.point(q)[0];
      sum += horizon * gauss.weight(q) * 6 / std::pow(horizon, 3) * (horizon - r) * r *
             std::cyl_bessel_j(0., k * r);
    }
    return sum;
  };
  const auto sinc = [](double x) { return x == 0 ? 1 : std::sin(x) / x; };
  for (const auto &base : {Point<2>(.3, .2), Point<2>(1.7, -.4), Point<2>(3., 2.5)})
  {
    double expected[2][2] = {{0, 0}, {0, 0}};
    for (int n2 = -9; n2 <= 9; ++n2)
      for (int n1 = -9; n1 <= 9; ++n1)
      {
        const Point<2> omega(base[0] + 2 * M_PI * n1, base[1] + 2 * M_PI * n2);
        const double value = std::pow(
            transform(omega.norm()) * std::pow(sinc(.5 * omega[0]) * sinc(.5 * omega[1]), 2), 2);
        for (unsigned int a = 0; a < 2; ++a)
          for (unsigned int b = 0; b < 2; ++b)
            expected[a][b] += omega[a] * omega[b] * value;
      }
    for (unsigned int a = 0; a < 2; ++a)
      for (unsigned int b = 0; b < 2; ++b)
      {
        double sum = 0;
        for (int k2 = -stencil.reach(); k2 <= stencil.reach(); ++k2)
          for (int k1 = -stencil.reach(); k1 <= stencil.reach(); ++k1)
            sum += stencil(a, b, k1, k2) * std::cos(k1 * base[0] + k2 * base[1]);
        EXPECT_NEAR(sum, expected[a][b], 1e-9) << base;
      }
  }
}

TEST(SolidStencil, a_box_under_a_constant_load_takes_on_the_quadratic_field_of_its_collar)
{
  for (const unsigned int degree : {1u, 2u})
    for (const double nu : {.3, .495})
    {
      const Lame lame = physics::lame_from_young(1, nu, physics::PlaneState::strain);
      const AxisShapes shapes(true, degree);
      const auto stencil = solid(2, lame, shapes);
      const int n = 8, reach = stencil.reach();
      const geometry::Lattice lattice({{{Point<2>(0, 0), Point<2>(n * h, n * h)}}, {}}, h);
      const auto nodes = free_nodes(lattice, shapes.families(), 2);
      const Monomial terms[] = {{0, 2, 0}, {0, 1, 1}, {1, 1, 1}, {1, 0, 2}, {1, 1, 0}};
      const auto n_axis = static_cast<unsigned int>(shapes.families().size());

      std::vector<double> data;
      algebra::Vector exact(nodes.size()), load(nodes.size());
      std::size_t index = 0;
      for (unsigned int block = 0; block < nodes.n_blocks(); ++block)
        for (int j = -reach; j < nodes.n[1] + reach; ++j)
          for (int i = -reach; i < nodes.n[0] + reach; ++i)
          {
            const unsigned int family = block % nodes.n_families(), c = block / nodes.n_families();
            const Point<2> x = nodes.place(family, i, j);
            double value = 0, force = 0;
            for (const auto &term : terms)
            {
              value += term(c, x[0] / n, x[1] / n);
              force += term.force(c, lame) / (n * n);
            }
            const bool is_free = nodes.free(family, i, j);
            data.push_back(is_free ? 0 : value);
            if (i < 0 || i >= nodes.n[0] || j < 0 || j >= nodes.n[1])
              continue;
            if (is_free)
            {
              exact[index] = value;
              load[index] = force * mean(shapes, family % n_axis) * mean(shapes, family / n_axis);
            }
            ++index;
          }
      load -= collar_action(stencil, nodes, data);
      algebra::Vector solution(nodes.size());
      solve(*make_operator(stencil, nodes), solution, load, 1e-14, 2000);
      solution -= exact;
      EXPECT_LT(solution.linfty_norm(), 1e-10) << degree << ", nu = " << nu;
    }
}
