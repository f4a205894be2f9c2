#include "physics/load.h"

#include "base/error.h"

#include <deal.II/base/quadrature_lib.h>

#include <cmath>
#include <map>
#include <mutex>
#include <sstream>
#include <utility>

namespace plumbline::physics
{
  namespace
  {
    /// Gauss points on (0,1), made once an order.
    const dealii::Quadrature<1> &gauss(unsigned int n)
    {
      static std::mutex mutex;
      static std::map<unsigned int, dealii::QGauss<1>> rules;
      const std::lock_guard<std::mutex> lock(mutex);
      return rules.try_emplace(n, n).first->second;
    }

    struct Integral
    {
      double value;
      double largest_difference; ///< max |u(x+ξ) - u(x)| over the points
    };

    Integral integrate(const Kernel<2> &kernel, const Expression &u,
                       const std::optional<Coefficient> &a, const Point<2> &x,
                       unsigned int component, unsigned int n_radii, unsigned int n_angles)
    {
      const unsigned int n_components = kernel.n_components();
      const bool is_scalar = kernel.structure() == Structure::scalar;
      std::vector<double> u0(n_components);
      for (unsigned int b = 0; b < n_components; ++b)
        u0[b] = u(x, is_scalar ? component : b);

      const double a0 = a ? a->at(x) : 1;
      Integral result{0, 0};
      for (unsigned int q = 0; q < n_radii; ++q)
      {
        const double r = kernel.horizon() * gauss(n_radii).point(q)[0];
        double ring = 0;
        for (unsigned int k = 0; k < n_angles; ++k)
        {
          const double angle = 2 * M_PI * (k + .5) / n_angles;
          const Point<2> xi(r * std::cos(angle), r * std::sin(angle));
          const double factor = a ? a->mean(a0, a->at(x + xi)) : 1;
          for (unsigned int b = 0; b < n_components; ++b)
          {
            const double difference = u(x + xi, is_scalar ? component : b) - u0[b];
            ring +=
                factor * difference * (is_scalar ? 1. : kernel.direction_factor(component, b, xi));
            result.largest_difference = std::max(result.largest_difference, std::abs(difference));
          }
        }
        result.value -= ring * kernel.radial(r) * r * gauss(n_radii).weight(q) * kernel.horizon() *
                        2 * M_PI / n_angles;
      }
      return result;
    }
  } // namespace

  ManufacturedLoad::ManufacturedLoad(Kernel<2> kernel, Expression u, std::optional<Coefficient> a)
      : kernel_(std::move(kernel)), u_(std::move(u)), a_(std::move(a))
  {
    if (u_.n_components() < kernel_.n_components())
      throw InputError("the field '" + u_.text() + "' has " + std::to_string(u_.n_components()) +
                       " component(s) but the kernel couples " +
                       std::to_string(kernel_.n_components()) +
                       "; give one expression a component, separated by commas");
  }

  double ManufacturedLoad::operator()(const Point<2> &x, unsigned int component) const
  {
    constexpr double settled = 1e-14, acceptable = 1e-12;
    Integral coarse = integrate(kernel_, u_, a_, x, component, 6, 12);
    double change = 0, scale = 0;
    for (unsigned int n = 12; n <= 192; n *= 2)
    {
      const Integral fine = integrate(kernel_, u_, a_, x, component, n, 2 * n);
      change = std::abs(fine.value - coarse.value);
      scale = std::abs(fine.value) + operator_scale(kernel_) * fine.largest_difference;
      if (change <= settled * scale)
        return fine.value;
      coarse = fine;
    }
    if (change <= acceptable * scale)
      return coarse.value;
    std::ostringstream message;
    message << "the load L u at (" << x << ") for u = '" << u_.text()
            << "' does not settle: still moving by " << change
            << " with 192 radii; u must be smooth in the ball, or give Problem/load itself";
    throw NumericalError(message.str());
  }

  double operator_scale(const Kernel<2> &kernel)
  {
    double integral = 0;
    for (const PowerTerm &term : kernel.profile())
      integral += std::abs(term.coefficient) / (term.exponent + 2);
    return std::abs(kernel.constant()) * integral * 2 * M_PI * kernel.horizon() * kernel.horizon();
  }
} // namespace plumbline::physics
