#include "physics/load.h"

#include "base/error.h"
#include "physics/gauss.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

namespace plumbline::physics
{
  namespace
  {
    /// An integrand at ξ, the difference of values that it is made of, and their own size, whose
    /// rounding no quadrature can mend.
    struct Sample
    {
      double value, difference, size;
    };

    /// ∫_{|ξ|<δ} g(ξ) dξ, the largest difference and size, with so many angles, and radii between
    /// any two of the kernel's breaks.
    template <typename Integrand>
    Sample over_ball(const std::vector<double> &ends, unsigned int n_radii, unsigned int n_angles,
                     const Integrand &g)
    {
      Sample result{0, 0, 0};
      std::vector<Point<2>> directions;
      for (unsigned int k = 0; k < n_angles; ++k)
      {
        const double angle = 2 * M_PI * (k + .5) / n_angles;
        directions.emplace_back(std::cos(angle), std::sin(angle));
      }
      double from = 0;
      for (const double to : ends)
      {
        for (unsigned int q = 0; q < n_radii; ++q)
        {
          const double r = from + (to - from) * gauss(n_radii).point(q)[0];
          double ring = 0;
          for (const Point<2> &direction : directions)
          {
            const Sample sample = g(r * direction);
            ring += sample.value;
            result.difference = std::max(result.difference, std::abs(sample.difference));
            result.size = std::max(result.size, std::abs(sample.size));
          }
          result.value += ring * r * gauss(n_radii).weight(q) * (to - from) * 2 * M_PI / n_angles;
        }
        from = to;
      }
      return result;
    }

    /// The same with more and more points until the value settles.
    /// @param fewest of radii, to begin with
    /// @param scale  of round-off: ∫ of the size of the factor of the differences
    /// @param what   the integral is, and @param x  where, for the message
    template <typename Integrand>
    double settled_integral(const Kernel<2> &kernel, const FewestRadii &fewest, double scale,
                            const char *what, const Point<2> &x, const Integrand &g)
    {
      constexpr unsigned int least = 6, most = 192; // of radii
      constexpr double settled = 1e-14, acceptable = 1e-12;
      constexpr double round_off = 2 * std::numeric_limits<double>::epsilon(); // of a difference
      std::vector<double> ends = kernel.breaks();
      ends.push_back(kernel.horizon());
      unsigned int first = least;
      for (const unsigned int wanted = fewest ? fewest(x) : 0; first < wanted && 2 * first < most;)
        first *= 2;
      Sample coarse = over_ball(ends, first, 2 * first, g);
      double change = 0, size = 0, noise = 0, before = 0;
      for (unsigned int n = 2 * first; n <= most; n *= 2)
      {
        const Sample fine = over_ball(ends, n, 2 * n, g);
        change = std::abs(fine.value - coarse.value);
        size = std::abs(fine.value) + scale * fine.difference;
        noise = round_off * scale * fine.size;
        // errors of twice as many points fall at least as fast again: what is left after this
        // change is that much smaller than it
        const double fall = before > 0 ? std::min(1., change / before) : 1;
        if (fall * change <= settled * size + noise)
          return fine.value;
        coarse = fine;
        before = change;
      }
      if (change <= acceptable * size + noise)
        return coarse.value;
      std::ostringstream message;
      message << what << " at (" << x << ") does not settle: still moving by " << change
              << " with 192 radii; u must be smooth in the ball, or give Problem/load itself";
      throw NumericalError(message.str());
    }
  } // namespace

  ManufacturedLoad::ManufacturedLoad(Kernel<2> kernel, const Expression &u,
                                     std::optional<Coefficient> a, FewestRadii fewest)
      : ManufacturedLoad(std::move(kernel), FieldFunction(u), std::move(a), std::move(fewest))
  {
    if (u.n_components() < kernel_.n_components())
      throw InputError("the field '" + u.text() + "' has " + std::to_string(u.n_components()) +
                       " component(s) but the kernel couples " +
                       std::to_string(kernel_.n_components()) +
                       "; give one expression a component, separated by commas");
  }

  double ManufacturedLoad::operator()(const Point<2> &x, unsigned int component) const
  {
    const unsigned int n_components = kernel_.n_components();
    const bool is_scalar = kernel_.structure() == Structure::scalar;
    std::array<double, 2> u0{};
    for (unsigned int b = 0; b < n_components; ++b)
      u0[b] = u_(x, is_scalar ? component : b);
    const double a0 = a_ ? a_->at(x) : 1;
    const auto integrand = [&](const Point<2> &xi)
    {
      Sample result{0, 0, 0};
      for (unsigned int b = 0; b < n_components; ++b)
      {
        const double difference = u_(x + xi, is_scalar ? component : b) - u0[b];
        result.size = std::max(result.size, std::abs(u0[b]));
        result.value -= difference * (is_scalar ? 1. : kernel_.direction_factor(component, b, xi));
        result.difference = std::max(result.difference, std::abs(difference));
      }
      result.value *= kernel_.radial(xi.norm()) * (a_ ? a_->mean(a0, a_->at(x + xi)) : 1);
      return result;
    };
    return settled_integral(kernel_, fewest_, operator_scale(kernel_), "the load L u", x,
                            integrand);
  }

  double FieldDilatation::operator()(const Point<2> &x) const
  {
    const std::array<double, 2> u0{u_(x, 0), u_(x, 1)};
    const auto integrand = [&](const Point<2> &xi)
    {
      const double first = u_(x + xi, 0) - u0[0], second = u_(x + xi, 1) - u0[1];
      return Sample{influence_.radial(xi.norm()) * (xi[0] * first + xi[1] * second),
                    std::max(std::abs(first), std::abs(second)),
                    std::max(std::abs(u0[0]), std::abs(u0[1]))};
    };
    return settled_integral(influence_, fewest_, influence_.horizon() * operator_scale(influence_),
                            "the dilatation of u", x, integrand);
  }

  double DilatationForce::operator()(const Point<2> &x, unsigned int component) const
  {
    const Kernel<2> &influence = dilatation_.influence;
    const double theta0 = theta_(x);
    const Lame own = dilatation_.material(x);
    const auto integrand = [&](const Point<2> &xi)
    {
      const double theta = theta_(x + xi);
      const Lame other = dilatation_.material(x + xi);
      const double sum =
          dilatation_.factor(own, other) * theta0 + dilatation_.factor(other, own) * theta;
      const double size =
          std::max(std::abs(own.lambda - own.mu), std::abs(other.lambda - other.mu)) *
          std::max(std::abs(theta), std::abs(theta0));
      return Sample{-influence.radial(xi.norm()) * xi[component] * sum, size, size};
    };
    return settled_integral(influence, fewest_, influence.horizon() * operator_scale(influence),
                            "the load of the dilatation", x, integrand);
  }

  double operator_scale(const Kernel<2> &kernel)
  {
    return std::abs(kernel.constant()) * kernel.profile().size() * 2 * M_PI * kernel.horizon() *
           kernel.horizon();
  }
} // namespace plumbline::physics
