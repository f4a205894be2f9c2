#include "reference/mesh/whole_potential.h"

#include "base/error.h"
#include "physics/gauss.h"
#include "reference/mesh/line_rules.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace plumbline::reference
{
  namespace
  {
    /// A profile as powers up to some t, by Chebyshev's interpolant; nothing where that takes too
    /// many or they cancel each other.
    std::optional<physics::RadialProfile::Powers> fit(const physics::RadialProfile &profile,
                                                      double farthest)
    {
      constexpr unsigned int n = 40;
      const int lowest = profile.lowest_exponent();
      std::vector<long double> coefficient(n), before(n), now(n), sum(n); // by powers of x = t/T
      double largest = 0;
      for (unsigned int j = 0; j < n; ++j)
      {
        const double t = farthest * (.5 + .5 * std::cos(M_PI * (j + .5) / n));
        const double value = profile(t) * std::pow(t, -lowest);
        largest = std::max(largest, std::abs(value));
        for (unsigned int k = 0; k < n; ++k)
          coefficient[k] += (k == 0 ? 1.L : 2.L) / n * value *
                            std::cos(static_cast<long double>(M_PI * k * (j + .5) / n));
      }
      constexpr double noise = 4e-15, most_cancelled = 1e4; // the latter leaves twelve digits
      while (!coefficient.empty() && std::abs(coefficient.back()) < noise * largest)
        coefficient.pop_back();
      if (coefficient.size() > n - 10)
        return {};
      now[0] = 1;
      for (std::size_t k = 0; k < coefficient.size(); ++k) // T_k of 2 x - 1
      {
        std::vector<long double> next(n);
        for (unsigned int p = 0; p < n; ++p)
        {
          sum[p] += coefficient[k] * now[p];
          const long double shifted = (p > 0 ? 2 * now[p - 1] : 0) - now[p];
          next[p] = k == 0 ? shifted : 2 * shifted - before[p];
        }
        before = std::exchange(now, next);
      }
      physics::RadialProfile::Powers powers;
      double size = 0;
      for (unsigned int p = 0; p < coefficient.size(); ++p)
      {
        size += static_cast<double>(std::abs(sum[p]));
        powers.push_back({static_cast<double>(sum[p]) * std::pow(farthest, -static_cast<double>(p)),
                          static_cast<int>(p) + lowest});
      }
      if (size > most_cancelled * largest)
        return {};
      return powers;
    }

    /// Of tables: inside they begin at .2 δ, as closed forms are taken near 0.
    constexpr double highest_rho = .96, nearest = .21;

    using Values = physics::OuterPotential::Values;

    /// f of Ψ = δ⁴ f, of the rest δ² H f, see PowerPotential, and ∫_0^q of f, of the rest q f.
    struct Inside
    {
      Values value{}, integral{};
    };

    Inside of_powers(const physics::Kernel<2> &kernel, long double q)
    {
      const bool is_tensor = kernel.structure() == physics::Structure::tensor;
      Inside sum;
      for (const physics::PowerTerm &term : kernel.profile().powers())
      {
        const int k = term.exponent;
        const long double c = static_cast<long double>(kernel.constant()) * term.coefficient;
        const long double trace = (is_tensor ? .5L : 1.L) * c /
                                  ((k + 2.L) * (k + 2) * (k + 4) * (k + 4)) *
                                  std::pow(q, k / 2.L + 2);
        sum.value[0] += trace;
        sum.integral[0] += trace * q / (k / 2.L + 3);
        if (!is_tensor)
          continue;
        const long double rest =
            k == 0 ? c * q / 96
                   : c * std::pow(q, k / 2.L + 1) / (k * (k + 2.L) * (k + 4) * (k + 6));
        sum.value[1] += k == 0 ? rest * std::log(q) : rest;
        sum.integral[1] +=
            rest * q * q * (k == 0 ? (std::log(q) - 1 / 3.L) / 3 : 1 / (k / 2.L + 3));
      }
      return sum;
    }

    template <unsigned int n>
    std::array<double, n> cut_to(const Values &values)
    {
      std::array<double, n> result;
      for (unsigned int i = 0; i < n; ++i)
        result[i] = static_cast<double>(values[i]);
      return result;
    }

    /// The line through two points.
    std::array<double, 2> line(long double q0, long double f0, long double q1, long double f1)
    {
      const long double slope = (f1 - f0) / (q1 - q0);
      return {static_cast<double>(f0 - slope * q0), static_cast<double>(slope)};
    }
  } // namespace

  std::string WholePotential::refuse(const physics::Kernel<2> &kernel)
  {
    if (physics::RegularPotential::can_have(kernel, 1) || as_powers(kernel, kernel.horizon()))
      return "";
    return "the kernel varies fast in relation to the horizon";
  }

  std::optional<physics::Kernel<2>> WholePotential::as_powers(const physics::Kernel<2> &kernel,
                                                              double farthest)
  {
    if (!kernel.profile().is_function())
      return kernel;
    const auto powers = fit(kernel.profile(), farthest / kernel.horizon());
    if (!powers)
      return {};
    return physics::Kernel<2>(kernel.structure(), *powers, kernel.horizon(), kernel.constant());
  }

  bool WholePotential::is_product(const physics::Kernel<2> &kernel)
  {
    const physics::RadialProfile &profile = kernel.profile();
    return kernel.structure() == physics::Structure::scalar && !profile.is_function() &&
           profile.degree() == 0 && profile.lowest_exponent() == 0;
  }

  WholePotential::WholePotential(const physics::Kernel<2> &kernel, double farthest, double longest)
      : horizon_(kernel.horizon()), is_tensor_(kernel.structure() == physics::Structure::tensor)
  {
    const double t = farthest / horizon_;
    if (is_product(kernel))
    {
      constant_ = kernel.radial(horizon_);
      product_.emplace(kernel, 1 - t * t);
    }
    else if (kernel.profile().is_function() && physics::RegularPotential::can_have(kernel, 1))
    {
      regular_.emplace(kernel, 1);
      // as many as resolve the kernel along a line, and the powers that its potential adds
      constexpr unsigned int of_potential = 8;
      n_points_ =
          (kernel.profile().degree(std::min(1., 2 * longest / horizon_)) + of_potential) / 2 + 1;
      scalar_ = make_tables<1>(kernel, physics::OuterPotential::of_smooth(kernel), t);
    }
    else if (const auto powers = as_powers(kernel, horizon_))
    {
      powers_.emplace(*powers);
      const physics::OuterPotential outside(*powers);
      if (is_tensor_)
        tensor_ = make_tables<2>(*powers, outside, t);
      else
        scalar_ = make_tables<1>(*powers, outside, t);
      powers_->subtract(shift_trace_, shift_rest_);
    }
    else
      throw NumericalError("a potential is asked for with a kernel that varies too fast");
  }

  /// Sets what is taken off, too.
  /// @param farthest  points from each other [horizons]
  template <unsigned int n>
  WholePotential::Tables<n> WholePotential::make_tables(const physics::Kernel<2> &kernel,
                                                        const physics::OuterPotential &outside,
                                                        double farthest)
  {
    const auto at = [&](long double q)
    {
      if (!regular_)
        return of_powers(kernel, q);
      const auto value = static_cast<double>(q);
      return Inside{{regular_->f(value), 0}, {2 * q * regular_->g(value), 0}};
    };
    const auto value = [&](long double q) { return q < 1 ? at(q).value : outside.f(q); };
    // Chebyshev's points, for the rest, which is multiplied by q, moved outwards
    const long double largest = static_cast<long double>(farthest) * farthest;
    const long double q0 = .146L * largest, q1 = .854L * largest, r0 = .35L * largest,
                      r1 = .9L * largest;
    shift_trace_ = line(q0, value(q0)[0], q1, value(q1)[0]);
    shift_rest_ = line(r0, value(r0)[1], r1, value(r1)[1]);
    const auto &a = shift_trace_, &b = shift_rest_;
    const Values to_circle = at(1).integral;
    const auto f = [&](double rho)
    {
      const long double q = 1 - static_cast<long double>(rho);
      const Values found = value(q);
      return cut_to<n>({found[0] - a[0] - a[1] * q, found[1] - b[0] - b[1] * q});
    };
    const auto g = [&](double rho)
    {
      const long double q = 1 - static_cast<long double>(rho);
      Values found = q < 1 ? at(q).integral : outside.integral(q);
      for (unsigned int i = 0; i < 2 && q >= 1; ++i)
        found[i] += to_circle[i];
      return cut_to<n>({found[0] / (2 * q) - a[0] / 2 - a[1] * q / 4,
                        found[1] / (2 * q * q) - b[0] / 4 - b[1] * q / 6});
    };
    const double lowest = 1 - farthest * farthest;
    return {{f, lowest, highest_rho}, {g, lowest, highest_rho}};
  }

  PowerPotential::Entries WholePotential::inside(const Vector2 &e, double from, double length,
                                                 double h, double a, double b,
                                                 bool for_divergence) const
  {
    if (product_)
      return {};
    if (is_far(from, length, h))
    {
      PowerPotential::Entries sum{};
      add_by_table(e, from, length, h, a, b, for_divergence, sum);
      return sum;
    }
    if (powers_)
      return powers_->integrate(e, from, length, h, a, b, for_divergence);
    const auto &rule = physics::gauss(n_points_);
    const double scale = 1 / (horizon_ * horizon_);
    const auto &[value, slope] = shift_trace_;
    double sum = 0;
    for (std::size_t i = 0; i < rule.size(); ++i)
    {
      const double x = from + length * rule.point(i)[0], q = (x * x + h * h) * scale;
      sum += rule.weight(i) * (a + b * x) *
             (for_divergence ? regular_->g(q) - value / 2 - slope * q / 4
                             : regular_->f(q) - value - slope * q);
    }
    return {length * sum / (scale * scale), 0, 0};
  }

  /// Where a short rule for the tables costs no more than closed forms, and rounds off less.
  bool WholePotential::is_far(double from, double length, double h) const
  {
    constexpr std::size_t few_points = 8;
    const double middle = from + .5 * length, square = middle * middle + h * h;
    return std::sqrt(square) - .5 * length > nearest * horizon_ &&
           line_rules().of(square, length).size() <= few_points;
  }

  /// @param table  ρ -> values
  template <unsigned int n, class Table>
  void WholePotential::add_by_rule(const Table &table, const Vector2 &e, double from, double length,
                                   double h, double a, double b, PowerPotential::Entries &sum) const
  {
    const double scale = 1 / (horizon_ * horizon_), middle = from + .5 * length;
    const auto &rule = line_rules().of(middle * middle + h * h, length);
    PowerPotential::Entries part{}; // the rest along the line and across
    for (std::size_t i = 0; i < rule.size(); ++i)
    {
      const double x = from + length * rule.point(i)[0];
      const auto value = table(1 - (x * x + h * h) * scale);
      const double weight = rule.weight(i) * (a + b * x);
      part[0] += weight * value[0];
      if constexpr (n == 2)
      {
        part[1] += weight * value[1] * .5 * (x * x - h * h);
        part[2] += weight * value[1] * x * h;
      }
    }
    sum[0] += length / (scale * scale) * part[0];
    if constexpr (n == 1)
      return;
    const double rest = length / scale;
    const double cosine = e[0] * e[0] - e[1] * e[1], sine = 2 * e[0] * e[1]; // of twice the angle
    sum[1] += rest * (cosine * part[1] - sine * part[2]);
    sum[2] += rest * (sine * part[1] + cosine * part[2]);
  }

  void WholePotential::add_by_table(const Vector2 &e, double from, double length, double h,
                                    double a, double b, bool for_divergence,
                                    PowerPotential::Entries &sum) const
  {
    using One = std::array<double, 1>;
    if (is_tensor_)
      add_by_rule<2>(for_divergence ? tensor_.g : tensor_.f, e, from, length, h, a, b, sum);
    else if (!product_)
      add_by_rule<1>(for_divergence ? scalar_.g : scalar_.f, e, from, length, h, a, b, sum);
    else if (for_divergence) // -div of what is taken off
      add_by_rule<1>([&](double rho) { return One{product_->g(rho)[0]}; }, e, from, length, h, a, b,
                     sum);
    else
      add_by_rule<1>([&](double rho) { return One{-product_->f(rho)[0]}; }, e, from, length, h, a,
                     b, sum);
  }

  PowerPotential::Entries WholePotential::integrate(const Vector2 &e, double from, double length,
                                                    double h, double a, double b,
                                                    bool for_divergence) const
  {
    const double square = horizon_ * horizon_ - h * h, root = square > 0 ? std::sqrt(square) : 0;
    const double to = from + length;
    if (from >= -root && to <= root)
      return inside(e, from, length, h, a, b, for_divergence);
    const double enter = std::clamp(-root, from, to), leave = std::clamp(root, from, to);
    PowerPotential::Entries sum{};
    const auto add_outside = [&](double first, double part)
    {
      if (part > 0)
        add_by_table(e, first, part, h, a, b, for_divergence, sum);
    };
    if (!(leave > enter))
    {
      add_outside(from, length);
      return sum;
    }
    sum = inside(e, enter, leave - enter, h, a, b, for_divergence);
    add_outside(from, enter - from);
    add_outside(leave, to - leave);
    return sum;
  }
} // namespace plumbline::reference
