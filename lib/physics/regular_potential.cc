#include "physics/regular_potential.h"

#include "base/error.h"
#include "physics/gauss.h"

#include <cmath>

namespace plumbline::physics
{
  namespace
  {
    constexpr unsigned int n_points = 64;

    /// ∫_0^1 τ^p F(qτ) dτ
    template <class Function>
    double moment(const Function &function, double q, int p, unsigned int n = n_points)
    {
      const dealii::Quadrature<1> &rule = gauss(n);
      double sum = 0;
      for (unsigned int i = 0; i < rule.size(); ++i)
      {
        const double tau = rule.point(i)[0];
        sum += rule.weight(i) * std::pow(tau, p) * function(q * tau);
      }
      return sum;
    }

    double of_square(const Kernel<2> &kernel, double q)
    {
      return kernel.radial(kernel.horizon() * std::sqrt(std::abs(q))); // tables end beyond 0
    }
  } // namespace

  bool RegularPotential::can_have(const Kernel<2> &kernel, double farthest)
  {
    if (kernel.structure() != Structure::scalar || !kernel.breaks().empty() ||
        !kernel.profile().is_even(false))
      return false;
    const auto value = [&](double q) { return of_square(kernel, q); };
    const double q = farthest * farthest, fine = moment(value, q, 0),
                 coarse = moment(value, q, 0, 3 * n_points / 4);
    constexpr double rounding = 1e-13;
    return std::abs(fine - coarse) <= rounding * std::abs(fine);
  }

  RegularPotential::RegularPotential(const Kernel<2> &kernel, double farthest)
  {
    if (!can_have(kernel, farthest))
      throw NumericalError("a regular potential is asked for with a kernel that has none");
    // D = d/dq (q d/dq), D D f = C/16: (q w')' = C/16 and (q f')' = w
    const double lowest = 1 - farthest * farthest;
    const auto table = [&](const auto &function)
    {
      return LocalPolynomials<1>(
          [&](double rho) { return std::array<double, 1>{function(1 - rho)}; }, lowest, 1);
    };
    const auto at = [](const LocalPolynomials<1> &values)
    { return [&values](double q) { return values(1 - q)[0]; }; };
    const auto first = table(
        [&](double q) { return moment([&](double s) { return of_square(kernel, s); }, q, 0); });
    const auto second = table([&](double q) { return moment(at(first), q, 0); });
    const auto third = table([&](double q) { return moment(at(second), q, 1); });
    const auto f = table([&](double q) { return moment(at(third), q, 1) / 16; });
    tables_ = {[&](double rho)
               {
                 const double q = 1 - rho;
                 return std::array<double, 2>{at(f)(q), .5 * moment(at(f), q, 2)};
               },
               lowest, 1};
  }
} // namespace plumbline::physics
