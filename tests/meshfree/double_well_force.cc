#include "meshfree/lattice/double_well_force.h"

#include "base/error.h"
#include "meshfree/rules/rules.h"

#include <deal.II/base/multithread_info.h>

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

using namespace plumbline;
using namespace plumbline::meshfree;
using physics::DoubleWell;
using physics::PowerTerm;
using physics::WellPotential;

namespace
{
  using Vector = std::vector<double>;
  const std::vector<PowerTerm> constant = {{1, 0}}, decaying = {{1, 0}, {-1, 1}};

  DoubleWell well(double horizon, const std::vector<PowerTerm> &influence = constant, int dim = 2,
                  const WellPotential &shape = {})
  {
    return {dim, influence, 1.3, 2.1, horizon, shape};
  }

  WellPotential potential(const std::string &text)
  {
    return {"Material/potential", text};
  }

  Bonds<2> bonds_of(const DoubleWell &law, double h, const std::string &name)
  {
    const auto kernel = law.linear_kernel();
    for (const Rule &rule : rules())
      if (rule.name == name)
        return lattice_bonds(rule.in_plane(kernel), kernel, h, Backend::fast);
    throw std::logic_error(name);
  }

  /// A field without symmetry, in which some bonds have softened.
  Vector rough_field(std::size_t n, double amplitude)
  {
    Vector u(n);
    for (std::size_t i = 0; i < n; ++i)
      u[i] = amplitude * (std::sin(1. + static_cast<double>(i * i % 101)) +
                          .3 * std::cos(static_cast<double>(i)));
    return u;
  }

  Vector rough_omega(std::size_t n)
  {
    Vector omega(n);
    for (std::size_t i = 0; i < n; ++i)
      omega[i] = .5 + .5 * std::sin(static_cast<double>(3 * i));
    return omega;
  }

  /// PD by its definition, bond by bond with J, r and S, in any kind of number; of an exponential
  /// potential or of c s/(1 + s).
  template <typename Number>
  Number energy(const DoubleWell &law, const Bonds<2> &bonds, std::array<int, 2> n,
                Exterior exterior, const Vector &omega, const std::vector<Number> &u)
  {
    Number sum = 0;
    const double eps = law.horizon();
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i)
        for (const Bond<2> &bond : bonds.family)
        {
          int k = i + static_cast<int>(std::lround(bond.xi[0] / bonds.h)),
              l = j + static_cast<int>(std::lround(bond.xi[1] / bonds.h));
          if (exterior == Exterior::empty && (k < 0 || k >= n[0] || l < 0 || l >= n[1]))
            continue;
          k = (k + 3 * n[0]) % n[0], l = (l + 3 * n[1]) % n[1];
          const double r = bond.kernel_point.norm();
          const std::size_t here = i + j * n[0], there = k + l * n[0], block = n[0] * n[1];
          const Number strain = ((u[there] - u[here]) * bond.kernel_point[0] +
                                 (u[block + there] - u[block + here]) * bond.kernel_point[1]) /
                                (r * r);
          const Number s = law.beta() * r * strain * strain,
                       f = law.c() *
                           (law.shape().is_exponential() ? 1. - std::exp(-s) : s / (1. + s));
          sum += omega[here] * omega[there] * bond.weight * law.influence(r) * f;
        }
    return sum * bonds.h * bonds.h / (M_PI * eps * eps * eps);
  }
} // namespace

TEST(DoubleWellForce, is_the_gradient_of_the_energy)
{
  const double h = .1;
  for (const WellPotential &shape : {WellPotential(), potential("r/(1 + r)")})
    for (const std::string rule : {"FA", "PA-AC", "IPA-AC", "IPA-AC-R2"})
      for (const Exterior exterior : {Exterior::periodic, Exterior::empty})
      {
        const DoubleWell law = well(.3, decaying, 2, shape);
        const Bonds<2> bonds = bonds_of(law, h, rule);
        const std::array<int, 2> n{21, 11}; // two tiles a row, one of them in part
        const std::size_t n_nodes = n[0] * n[1];
        const Vector omega = rough_omega(n_nodes), u = rough_field(2 * n_nodes, .4);
        const DoubleWellForce<2> force(well_bonds(law, bonds), h, n, exterior, omega, {}, shape);
        Vector f;
        force.force(u, f);
        ASSERT_EQ(f.size(), 2 * n_nodes);
        const double pd = energy(law, bonds, n, exterior, omega, u);
        EXPECT_NEAR(force.energy(u), pd, 1e-13 * pd);
        double size = 0;
        for (const double value : f)
          size = std::max(size, std::abs(value));
        for (const std::size_t i : {0, 5, 20, 115, 230, 231, 340, 461})
        {
          std::vector<std::complex<double>> moved(u.begin(), u.end());
          moved[i] += std::complex<double>(0, 1e-30); // the derivative without differences
          const double gradient = energy(law, bonds, n, exterior, omega, moved).imag() / 1e-30;
          EXPECT_NEAR(f[i], -gradient / (h * h), 1e-13 * size) << rule << " at " << i;
        }
      }
}

TEST(DoubleWellForce, tangent_is_its_derivative_and_symmetric)
{
  const double h = .1, step = 1e-5;
  for (const WellPotential &shape : {WellPotential(), potential("r/(1 + r)")})
  {
    const DoubleWell law = well(.3);
    const std::array<int, 2> n{19, 9};
    const DoubleWellForce<2> force(well_bonds(law, bonds_of(law, h, "IPA-AC")), h, n,
                                   Exterior::empty, rough_omega(n[0] * n[1]), {}, shape);
    const Vector u = rough_field(force.size(), .4), v = rough_field(force.size(), 1);
    Vector w(force.size()), tangent, other, plus = u, minus = u, f_plus, f_minus;
    for (std::size_t i = 0; i < u.size(); ++i)
    {
      w[i] = std::cos(static_cast<double>(7 * i));
      plus[i] += step * v[i];
      minus[i] -= step * v[i];
    }
    force.tangent(u, v, tangent);
    force.tangent(u, w, other);
    force.force(plus, f_plus);
    force.force(minus, f_minus);
    double left = 0, right = 0, size = 0;
    for (std::size_t i = 0; i < u.size(); ++i)
    {
      EXPECT_NEAR(tangent[i], (f_plus[i] - f_minus[i]) / (2 * step), 1e-5);
      left += w[i] * tangent[i];
      right += v[i] * other[i];
      size += std::abs(w[i] * tangent[i]);
    }
    EXPECT_NEAR(left, right, 1e-14 * size);
  }
}

TEST(DoubleWellForce, is_the_same_by_an_expression)
{
  const WellPotential shape = potential("1 - exp(-r)");
  const auto expect = [&](const auto &built_in, const auto &by_expression)
  {
    const Vector u = rough_field(built_in.size(), .4), v = rough_field(built_in.size(), 1);
    Vector force, same_force, tangent, same_tangent;
    built_in.force(u, force);
    by_expression.force(u, same_force);
    built_in.tangent(u, v, tangent);
    by_expression.tangent(u, v, same_tangent);
    for (std::size_t i = 0; i < u.size(); ++i)
    {
      EXPECT_NEAR(same_force[i], force[i], 1e-12);
      EXPECT_NEAR(same_tangent[i], tangent[i], 1e-11);
    }
    EXPECT_NEAR(by_expression.energy(u), built_in.energy(u), 1e-13 * built_in.energy(u));
    Vector small = u;
    for (double &value : small)
      value *= 1e-9;
    EXPECT_NEAR(by_expression.energy(small), built_in.energy(small),
                1e-13 * built_in.energy(small));
  };
  const DoubleWell line = well(.5, constant, 1), plane = well(.3);
  const auto on_line = axis_bonds(line, .1, "FA"),
             in_plane = well_bonds(plane, bonds_of(plane, .1, "IPA-AC"));
  expect(DoubleWellForce<1>(on_line, .1, {23, 1}, Exterior::periodic),
         DoubleWellForce<1>(on_line, .1, {23, 1}, Exterior::periodic, {}, {}, shape));
  expect(DoubleWellForce<2>(in_plane, .1, {19, 9}, Exterior::empty),
         DoubleWellForce<2>(in_plane, .1, {19, 9}, Exterior::empty, {}, {}, shape));
}

TEST(DoubleWellForce, exponential_is_exact_from_small_strains_to_broken_bonds)
{
  // two nodes and their images, one bond of each: energy and force in closed form
  const double h = .5;
  for (double amplitude = 1e-9; amplitude < 1e3; amplitude *= 1.37)
  {
    const DoubleWell law = well(.5, constant, 1);
    const DoubleWellForce<1> force(axis_bonds(law, h, "FA"), h, {2, 1}, Exterior::empty);
    Vector f;
    force.force({0, amplitude}, f);
    const double strain = amplitude / h, s = h * strain * strain;
    const double exact = law.force_factor() * h * law.derivative(s) * strain;
    // of the exponent's relative rounding, eight halves of 2^-52, comes that of the exponential
    const double rounding = 2e-15 + 9e-16 * law.beta() * s;
    EXPECT_NEAR(f[0], exact, rounding * exact + 1e-290);
    EXPECT_EQ(f[1], -f[0]);
    const double energy = .5 * law.force_factor() * h * h * law.potential(s);
    EXPECT_NEAR(force.energy({0, amplitude}), energy, 2e-15 * energy);
  }
}

TEST(DoubleWellForce, mirror_images_stay_so_to_the_last_bit)
{
  const double h = .1;
  const std::array<int, 2> n{37, 20};
  const DoubleWell law = well(.4);
  for (const Exterior exterior : {Exterior::empty, Exterior::periodic})
  {
    const DoubleWellForce<2> force(well_bonds(law, bonds_of(law, h, "IPA-AC")), h, n, exterior);
    const std::size_t n_nodes = force.n_nodes();
    for (const int axis : {0, 1})
    {
      Vector u = rough_field(force.size(), .3), f;
      const auto image = [&](std::size_t i)
      {
        const std::size_t x = i % n[0], y = i % n_nodes / n[0], a = i / n_nodes;
        return a * n_nodes + (axis == 1 ? (n[1] - 1 - y) * n[0] + x : y * n[0] + n[0] - 1 - x);
      };
      const auto sign = [&](std::size_t i)
      { return i / n_nodes == static_cast<std::size_t>(axis) ? -1. : 1.; };
      for (std::size_t i = 0; i < u.size(); ++i)
        u[image(i)] = image(i) == i && sign(i) < 0 ? 0 : sign(i) * u[i];
      force.force(u, f);
      for (std::size_t i = 0; i < u.size(); ++i)
        EXPECT_EQ(f[image(i)], sign(i) * f[i]);
    }
  }
}

TEST(DoubleWellForce, number_of_threads_changes_no_bit)
{
  const double h = .1;
  const DoubleWell law = well(.4);
  const DoubleWellForce<2> force(well_bonds(law, bonds_of(law, h, "FA")), h, {64, 200},
                                 Exterior::periodic);
  const Vector u = rough_field(force.size(), .2);
  Vector one, two;
  dealii::MultithreadInfo::set_thread_limit(1);
  force.force(u, one);
  const double energy = force.energy(u);
  dealii::MultithreadInfo::set_thread_limit(2);
  force.force(u, two);
  EXPECT_EQ(one, two);
  EXPECT_EQ(energy, force.energy(u));
}

TEST(DoubleWellForce, momentum_is_conserved_on_the_torus)
{
  const DoubleWell law = well(.3);
  const DoubleWellForce<2> force(well_bonds(law, bonds_of(law, .1, "PA-AC")), .1, {17, 13},
                                 Exterior::periodic);
  Vector f;
  force.force(rough_field(force.size(), .3), f);
  double sum = 0, size = 0;
  for (const double value : f)
  {
    sum += value;
    size += std::abs(value);
  }
  EXPECT_NEAR(sum, 0, 1e-14 * size);
}

TEST(WellBonds, toughness_of_a_lattice_is_that_of_its_bonds)
{
  // closed form: Σ_{k2 > 0} J |k2| h³ 2 / (πε³) against 4/(3π) (J = 1), 1/(3π) (J = 1 - r)
  const double of_constant[] = {.9375, 1, .9375, 1.044}, of_decaying[] = {.814, .922, .963, .967};
  for (int m = 2; m <= 5; ++m)
    for (const bool decays : {false, true})
    {
      const DoubleWell law = well(1, decays ? decaying : constant);
      const double ratio =
          lattice_toughness(well_bonds(law, bonds_of(law, 1. / m, "FA")), 2, 1. / m) /
          law.toughness();
      EXPECT_NEAR(ratio, decays ? of_decaying[m - 2] : of_constant[m - 2], 5e-4) << m;
    }
  const DoubleWell law = well(1, constant, 1); // half the end's weight makes a trapezoidal rule
  EXPECT_NEAR(lattice_toughness(axis_bonds(law, .25, "PA-AC"), 1, .25), law.toughness(), 1e-14);
}

TEST(WellBonds, rules_on_one_axis_coincide_where_they_must)
{
  const DoubleWell law = well(.1, constant, 1);
  const auto strengths = [&](const std::string &rule)
  {
    Vector result;
    for (const WellBond &bond : axis_bonds(law, .01, rule))
      result.push_back(bond.strength);
    return result;
  };
  const Vector cut = strengths("PA-AC"), full = strengths("FA");
  ASSERT_EQ(cut.size(), 20u);
  EXPECT_NEAR(cut.back(), .5 * full.back(), 1e-12 * full.back());
  for (std::size_t i = 0; i < cut.size(); ++i)
  {
    EXPECT_NEAR(strengths("IPA-AC")[i], cut[i], 1e-12 * cut[i]);
    EXPECT_NEAR(strengths("IPA-AC-R2")[i], cut[i], 1e-12 * cut[i]);
  }
}

TEST(DoubleWellForce, refuses_what_it_cannot_sum)
{
  const DoubleWell law = well(.3);
  auto bonds = well_bonds(law, bonds_of(law, .1, "FA"));
  const auto make = [&](std::array<int, 2> n, Vector omega)
  { DoubleWellForce<2>(bonds, .1, n, Exterior::empty, std::move(omega)); };
  EXPECT_NO_THROW(make({3, 3}, {}));
  EXPECT_THROW(make({0, 3}, {}), InputError);
  EXPECT_THROW(make({3, 3}, Vector(8, 1)), InputError);
  EXPECT_THROW(make({3, 3}, Vector(9, 0)), InputError);
  EXPECT_THROW(make({3, 3}, Vector(9, -1)), InputError);
  EXPECT_THROW(make({3, 3}, Vector(9, NAN)), InputError);
  EXPECT_THROW(axis_bonds(well(.3, constant, 1), .1, "QWJ"), InputError);
  EXPECT_THROW(axis_bonds(well(.3, constant, 1), .7, "FA"), InputError);
  bonds[3].strength *= 1.001;
  EXPECT_THROW(make({3, 3}, {}), NumericalError);
  bonds.pop_back();
  bonds.erase(bonds.begin() + 3);
  EXPECT_THROW(make({3, 3}, {}), NumericalError);
}
