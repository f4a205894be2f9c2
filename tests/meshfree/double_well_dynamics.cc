// Motions of lattices of bonds with two wells.

#include "analysis/critical_step.h"
#include "analysis/integrate.h"
#include "base/error.h"
#include "meshfree/lattice/double_well_force.h"
#include "meshfree/rules/rules.h"
#include "physics/double_well_stability.h"
#include "physics/expression.h"
#include "reference/lattice/torus_force.h"
#include "study/trend.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

using namespace plumbline;
using namespace plumbline::meshfree;
using analysis::Motion;
using analysis::scheme;
using analysis::State;
using physics::DoubleWell;
using physics::PowerTerm;

namespace
{
  using Vector = std::vector<double>;
  const std::vector<PowerTerm> constant = {{1, 0}}, decaying = {{1, 0}, {-1, 1}};

  DoubleWell well(int dim, double horizon, const std::vector<PowerTerm> &influence)
  {
    return {dim, influence, 1, 1, horizon};
  }

  template <int dim>
  Motion motion_of(const DoubleWellForce<dim> &force)
  {
    return {force.size(), [&](const Vector &u, double, Vector &a) { force.force(u, a); },
            [&](const Vector &u, const Vector &v, Vector &out) { force.tangent(u, v, out); }};
  }

  DoubleWellForce<1> ring(const DoubleWell &law, int n, const std::string &rule)
  {
    return {axis_bonds(law, 1. / n, rule), 1. / n, {n, 1}, Exterior::periodic};
  }

  DoubleWellForce<2> torus(const DoubleWell &law, int n, const std::string &name)
  {
    const auto kernel = law.linear_kernel();
    for (const Rule &rule : rules())
      if (rule.name == name)
        return {
            well_bonds(law, lattice_bonds(rule.in_plane(kernel), kernel, 1. / n, Backend::fast)),
            1. / n,
            {n, n},
            Exterior::periodic};
    throw std::logic_error(name);
  }

  /// a sin 2πx at rest
  State sine(int n, double a)
  {
    State state{Vector(n), Vector(n), 0};
    for (int i = 0; i < n; ++i)
      state.u[i] = a * std::sin(2 * M_PI * i / n);
    return state;
  }

  double root_mean_square(const Vector &a, const Vector &b)
  {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
      sum += (a[i] - b[i]) * (a[i] - b[i]);
    return std::sqrt(sum / static_cast<double>(a.size()));
  }
} // namespace

TEST(DoubleWellDynamics, small_waves_move_as_powers_of_two_by_two_matrices_do)
{
  constexpr int n = 100;
  constexpr double amplitude = 1e-6; // what is left of nonlinearity is its square
  const DoubleWell law = well(1, .1, decaying);
  const auto force = ring(law, n, "FA");
  Vector f;
  force.force(sine(n, amplitude).u, f);
  const double omega = std::sqrt(-f[n / 4] / amplitude);
  EXPECT_NEAR(omega, 3.591787513, 5e-10);
  EXPECT_NEAR(std::cos(omega), -.900362328, 5e-9);
  const std::map<std::string, std::array<double, 2>> expected = {
      {"symplectic Euler", {-.8586191, -.8954443}}, {"velocity Verlet", {-.8982438, -.9003295}},
      {"trapezoidal", {-.9045012, -.9004279}},      {"implicit Euler", {-.6670067, -.8650465}},
      {"explicit Euler", {-1.2584842, -.9376660}},
  };
  for (const auto &[name, values] : expected)
    for (const bool is_fine : {false, true})
    {
      State state = sine(n, amplitude);
      analysis::integrate(motion_of(force), scheme(name), {is_fine ? 1. / 160 : 1. / 20}, 1, state);
      EXPECT_NEAR(state.u[n / 4] / amplitude, values[is_fine ? 1 : 0], 6e-8) << name;
    }
}

TEST(DoubleWellDynamics, critical_steps_are_those_of_the_symbol)
{
  const auto &verlet = scheme("velocity Verlet");
  const auto line = ring(well(1, .1, decaying), 100, "FA");
  EXPECT_NEAR(critical_step(motion_of(line), verlet, Vector(line.size()), 1e-8), .0623225, 5e-8);
  // Δt √p / ε
  const double of_decaying[] = {1.4905, 1.4558, 1.4285, 1.4252},
               of_constant[] = {.9451, .9321, .9467, .9264};
  for (int m = 2; m <= 5; ++m)
    for (const bool decays : {false, true})
    {
      const int n = 48;
      const double horizon = static_cast<double>(m) / n;
      const auto force = torus(well(2, horizon, decays ? decaying : constant), n, "FA");
      const double step =
          critical_step(motion_of(force), verlet, Vector(force.size()), 1e-7) / horizon;
      EXPECT_NEAR(step, decays ? of_decaying[m - 2] : of_constant[m - 2], 5e-4) << m << decays;
    }
}

TEST(DoubleWellDynamics, one_percent_beyond_the_critical_step_waves_grow_without_bound)
{
  constexpr int n = 100, n_steps = 400;
  const auto force = ring(well(1, .1, decaying), n, "FA");
  const Motion motion = motion_of(force);
  const double critical =
      critical_step(motion, scheme("velocity Verlet"), Vector(force.size()), 1e-10);
  const auto growth = [&](double fraction, double amplitude)
  {
    const double step = fraction * critical;
    State state{Vector(n), Vector(n), 0};
    for (int i = 0; i < n; ++i)
      state.u[i] = amplitude * std::sin(1. + i * i);
    const double before = analysis::norm(state.u);
    double largest = 0;
    analysis::integrate(motion, scheme("symplectic Euler"), {step, {}, true}, n_steps * step, state,
                        [&](const State &now)
                        { largest = std::max(largest, analysis::norm(now.u)); });
    return largest / before;
  };
  EXPECT_LT(growth(.99, 1e-8), 20);
  EXPECT_LT(growth(1, 1e-8), 500); // at most linear in the steps
  EXPECT_GT(growth(1.01, 1e-8), 1e5);
}

TEST(DoubleWellDynamics, energy_swings_with_the_order_of_the_scheme_and_does_not_drift)
{
  constexpr int n = 40;
  const auto force = ring(well(1, .1, decaying), n, "FA");
  const Motion motion = motion_of(force);
  const double step =
      .56 * critical_step(motion, scheme("velocity Verlet"), Vector(force.size()), 1e-8);
  const double period = 2 * M_PI / 3.59, start = force.energy(sine(n, .2).u);
  struct Swing
  {
    double early = 0, whole = 0; // max |ΔE| / E0 in the first half, and in all
    analysis::Counts counts = {};
  };
  const auto swing = [&](const std::string &name, double time_step)
  {
    Swing result;
    State state = sine(n, .2);
    result.counts =
        analysis::integrate(motion, scheme(name), {time_step}, 100 * period, state,
                            [&](const State &now)
                            {
                              const double energy =
                                  force.energy(now.u) + .5 / n * analysis::dot(now.v, now.v);
                              result.whole = std::max(result.whole, std::abs(energy / start - 1));
                              if (now.t < 50 * period)
                                result.early = result.whole;
                            });
    return result;
  };
  for (const auto &[name, largest] :
       {std::pair{"symplectic Euler", 8.0e-2}, std::pair{"velocity Verlet", 6.1e-3},
        std::pair{"trapezoidal", 4.6e-4}})
  {
    const Swing coarse = swing(name, step), fine = swing(name, step / 2);
    EXPECT_NEAR(coarse.whole, largest, .02 * largest) << name;
    EXPECT_LT(coarse.whole, 1.05 * coarse.early) << name;
    if (!scheme(name).is_implicit())
    {
      EXPECT_NEAR(std::log2(coarse.whole / fine.whole), scheme(name).order, .1) << name;
    }
    else
    {
      EXPECT_LT(fine.whole, coarse.whole / 3);
      EXPECT_LT(static_cast<double>(coarse.counts.n_newton),
                3.5 * static_cast<double>(coarse.counts.n_steps));
    }
  }
  State state = sine(n, .2); // implicit Euler loses everything
  analysis::integrate(motion, scheme("implicit Euler"), {step}, 100 * period, state);
  EXPECT_LT(force.energy(state.u), 1e-3 * start);
}

// the energy of velocity Verlet's own Hamiltonian differs from that of the bonds by O(Δt²)
TEST(DoubleWellDynamics, of_another_potential_keeps_its_energy)
{
  const physics::WellPotential shape("Material/potential", "r/(1 + r)");
  const DoubleWell law(1, decaying, 1, 1, .1, shape);
  constexpr int n = 100;
  const DoubleWellForce<1> force(axis_bonds(law, 1. / n, "FA"), 1. / n, {n, 1}, Exterior::periodic,
                                 {}, {}, shape);
  const auto drift = [&](double step)
  {
    State state = sine(n, .2);
    const double start = force.energy(state.u);
    double largest = 0;
    for (int part = 1; part <= 20; ++part)
    {
      analysis::integrate(motion_of(force), scheme("velocity Verlet"), {step}, .1 * part, state);
      const double kinetic = .5 * analysis::dot(state.v, state.v) / n;
      largest = std::max(largest, std::abs(force.energy(state.u) + kinetic - start) / start);
    }
    return largest;
  };
  const double coarse = drift(.01), fine = drift(.005);
  EXPECT_LT(coarse, 1e-2);
  EXPECT_NEAR(std::log2(coarse / fine), 2, .15);
}

TEST(DoubleWellDynamics, uniform_strain_is_in_equilibrium_on_a_torus)
{
  const DoubleWell law = well(2, .3, constant);
  const auto kernel = law.linear_kernel();
  const auto bonds =
      well_bonds(law, lattice_bonds(partial_area(kernel), kernel, .1, Backend::fast));
  const DoubleWellForce<2> force(bonds, .1, {10, 7}, Exterior::periodic, {},
                                 {{{1.5, .4}, {-.3, .7}}});
  Vector u(force.size()), f;
  for (int j = 0; j < 7; ++j)
    for (int i = 0; i < 10; ++i)
    {
      u[j * 10 + i] = .1 * (1.5 * i + .4 * j);
      u[70 + j * 10 + i] = .1 * (-.3 * i + .7 * j);
    }
  force.force(u, f);
  EXPECT_LT(analysis::norm(f), 1e-11);
  EXPECT_GT(force.energy(u), .1);
}

TEST(DoubleWellDynamics, rules_on_one_axis_converge_at_their_rates)
{
  // a = .3, ε = .1, T = .5, against the torus without a mesh: ‖u - u_h‖ + ‖v - v_h‖ as in
  // Jha & Lipton 2018, doi:10.1137/17M1112236, theorem 3
  const auto error = [](const std::vector<PowerTerm> &influence, const std::string &rule, int n)
  {
    const DoubleWell law = well(1, .1, influence);
    const reference::TorusForce<1> exact_force(law, 160, 1, 20);
    State exact = sine(160, .3), state = sine(n, .3);
    const Motion exact_motion{160,
                              [&](const Vector &u, double, Vector &a) { exact_force.force(u, a); }};
    analysis::integrate(exact_motion, scheme("Blanes-Moan"), {.5 / 200}, .5, exact);
    const auto force = ring(law, n, rule);
    analysis::integrate(motion_of(force), scheme("Blanes-Moan"), {.5 / 200}, .5, state);
    Vector at_nodes(n), velocity_at_nodes(n);
    for (int i = 0; i < n; ++i)
    {
      at_nodes[i] = exact_force.interpolate(exact.u.data(), {static_cast<double>(i) / n});
      velocity_at_nodes[i] = exact_force.interpolate(exact.v.data(), {static_cast<double>(i) / n});
    }
    return root_mean_square(state.u, at_nodes) + root_mean_square(state.v, velocity_at_nodes);
  };
  for (const auto &[rule, coarse, fine] :
       {std::tuple{"FA", 1.43e-1, 4.46e-4}, std::tuple{"IPA-AC", 4.36e-2, 1.58e-4},
        std::tuple{"IPA-AC-R2", 1.39e-3, 5.6e-6}})
  {
    const double first = error(decaying, rule, 20), last = error(decaying, rule, 320);
    EXPECT_NEAR(std::log2(error(decaying, rule, 160) / last), 2, .1) << rule;
    EXPECT_NEAR(first, coarse, .005 * coarse) << rule;
    EXPECT_NEAR(last, fine, .01 * fine) << rule;
  }
  const double first = error(constant, "FA", 80), last = error(constant, "FA", 320);
  EXPECT_NEAR(std::log2(first / last) / 2, 1, .1);
  EXPECT_NEAR(std::log2(error(constant, "PA-AC", 80) / error(constant, "PA-AC", 320)) / 2, 2, .1);
}

namespace
{
  /// Small waves of Hölder exponent γ on the line, ε = .1, that start at rest: Σ 2^(-γk) cos(2π 2^k
  /// x + 1.3 k²), k <= 14, each at its own frequency.
  class RoughWaves
  {
  public:
    /// @param frequencies  by frequencies_of(law)
    RoughWaves(const DoubleWell &law, const Vector &frequencies, double gamma)
        : law_(law), gamma_(gamma)
    {
      Vector of_u, of_v;
      for (int k = 0; k <= n_terms; ++k)
      {
        const double frequency = frequencies[k], amplitude = std::exp2(-gamma * k);
        of_u.push_back(amplitude * std::cos(frequency * end));
        of_v.push_back(-amplitude * frequency * std::sin(frequency * end));
      }
      for (int i = 0; i < n_fine; ++i)
      {
        const double x = (i + .5) / n_fine;
        double u = 0, v = 0;
        for (int k = 0; k <= n_terms; ++k)
        {
          const double wave = std::cos(2 * M_PI * std::exp2(k) * x + 1.3 * k * k);
          u += of_u[k] * wave;
          v += of_v[k] * wave;
        }
        u_.push_back(u);
        v_.push_back(v);
      }
    }

    static Vector frequencies_of(const DoubleWell &law)
    {
      Vector frequencies;
      for (int k = 0; k <= n_terms; ++k)
        frequencies.push_back(std::sqrt(wave_symbol(law, {}, {2 * M_PI * std::exp2(k), 0}).xx));
      return frequencies;
    }

    /// ‖u - u_h‖ + ‖v - v_h‖ in L2 at T = 1 of a lattice of n nodes that starts from cell averages;
    /// u_h is constant on cells.
    double error(const std::string &rule, int n) const
    {
      constexpr double amplitude = 1e-7; // what is left of nonlinearity is its square
      const double h = 1. / n;
      const auto force = ring(law_, n, rule);
      State state{Vector(n), Vector(n), 0};
      const physics::Expression start(
          "u", "weierstrass_mean(x, gamma, " + std::to_string(n_terms) + ", h)",
          {{"gamma", gamma_}, {"h", h}});
      for (int i = 0; i < n; ++i)
        state.u[i] = amplitude * start({i * h, 0});
      analysis::integrate(motion_of(force), scheme("Blanes-Moan"), {end / 100}, end, state);
      const auto distance = [&](const Vector &exact, const Vector &found)
      {
        double sum = 0;
        for (int i = 0; i < n_fine; ++i)
          sum += std::pow(exact[i] - found[std::lround((i + .5) * n / n_fine) % n] / amplitude, 2);
        return std::sqrt(sum / n_fine);
      };
      return distance(u_, state.u) + distance(v_, state.v);
    }

  private:
    static constexpr int n_terms = 14, n_fine = 1 << 16; // four points on the shortest wave
    static constexpr double end = 1;
    DoubleWell law_;
    double gamma_;
    Vector u_, v_; ///< at T, in the middles of n_fine parts
  };
} // namespace

TEST(DoubleWellDynamics, rough_data_converge_at_their_hoelder_exponent)
{
  // Jha & Lipton 2018, doi:10.1137/17M1112236, theorem 3: h^γ. Where J does not vanish at the end,
  // the last bond counts half: half its cell is in reach. Fitted rates are those of an independent
  // program.
  for (const auto &[influence, rule, rates] :
       {std::tuple{decaying, "FA", std::array{.29, .54, .79, .97}},
        std::tuple{constant, "PA-AC", std::array{.20, .46, .72, .95}}})
  {
    const DoubleWell law = well(1, .1, influence);
    const Vector frequencies = RoughWaves::frequencies_of(law);
    for (std::size_t i = 0; i < rates.size(); ++i)
    {
      const double gamma = .25 * static_cast<double>(i + 1);
      const RoughWaves waves(law, frequencies, gamma);
      Vector sizes, errors;
      for (const int n : {160, 320, 640, 1280})
      {
        sizes.push_back(1. / n);
        errors.push_back(waves.error(rule, n));
      }
      const double rate = study::fit_slope(sizes, errors).value;
      EXPECT_NEAR(rate, gamma, .06) << rule;
      EXPECT_NEAR(rate, rates[i], .012) << rule << ' ' << gamma;
    }
  }
}

TEST(DoubleWellDynamics, no_state_is_stiffer_than_rest)
{
  // a bond's second derivative is never above p: steps that are stable at rest are so at any state
  const DoubleWell law = well(2, .2, decaying);
  const int n = 20;
  const auto force = torus(law, n, "PA-AC");
  const auto stiffness = [&](double amplitude)
  {
    Vector u(force.size());
    for (std::size_t i = 0; i < u.size(); ++i)
      u[i] = amplitude * std::sin(1. + static_cast<double>(i * i % 41));
    return analysis::largest_eigenvalue(
        [&](const Vector &x, Vector &y)
        {
          force.tangent(u, x, y);
          for (double &value : y)
            value = -value;
        },
        u.size(), 1e-6);
  };
  const double rest = stiffness(0);
  EXPECT_GT(rest, 1 / (.2 * .2));
  for (const double amplitude : {.01, .1, .3, 1.})
    EXPECT_LE(stiffness(amplitude), rest * (1 + 1e-6)) << amplitude;
  EXPECT_LT(stiffness(.3), .9 * rest); // rough ones are softer
}

TEST(DoubleWellDynamics, finer_lattices_on_the_line_grow_stiffer_without_bound)
{
  // C̄ is infinite on the line: λ_max grows by 4 p ln 2 / ε² with each doubling of m
  const DoubleWell law = well(1, .1, constant);
  const auto largest = [&](int m)
  {
    double sum = 0;
    for (const WellBond &bond : axis_bonds(law, .1 / m, "PA-AC"))
      sum += bond.strength * bond.way[0] * bond.way[0] * (1 - std::cos(M_PI * bond.k[0]));
    return sum; // of the wave of two cells, the stiffest
  };
  for (const int m : {16, 32, 64})
    EXPECT_NEAR(largest(2 * m) - largest(m), 4 * std::log(2.) / .01, .02 * 4 * std::log(2.) / .01)
        << m;
}
