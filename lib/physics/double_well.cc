#include "physics/double_well.h"

#include "base/error.h"
#include "physics/profile_shape.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

namespace plumbline::physics
{
  namespace
  {
    void require_positive(const char *key, double value, const char *remedy)
    {
      if (value > 0 && std::isfinite(value))
        return;
      std::ostringstream message;
      message << "double well: " << key << " = " << value << " must be positive and finite; "
              << remedy;
      throw InputError(message.str());
    }

    /// J >= 0 is what makes small strains stable.
    void check_influence(const RadialProfile &influence)
    {
      constexpr int n_samples = 1000;
      constexpr double rounding = 1e-14; // of the terms that make the values
      if (influence.is_empty())
        throw InputError("double well: the influence function is empty; give coefficients such as "
                         "1, -1 for 1 - r");
      if (influence.lowest_exponent() < 0)
        throw InputError(
            "double well: the influence function behaves like r^" +
            std::to_string(influence.lowest_exponent()) +
            " at 0; it must be bounded: take Kernel/type = constant, conical or linear-decay, or "
            "powers from 0");
      double largest = 0;
      for (int i = 0; i <= n_samples; ++i)
      {
        const double t = static_cast<double>(i) / n_samples, value = influence(t);
        if (!std::isfinite(value))
          throw InputError("double well: the influence function is " + std::to_string(value) +
                           " at r = " + std::to_string(t) + " horizons; use finite coefficients");
        largest = std::max(largest, value);
      }
      if (const LeastValue least = least_value(influence);
          least.value < -rounding * (largest + influence.size()) - least.rounding)
        throw InputError("double well: the influence function is " + std::to_string(least.value) +
                         " at r = " + std::to_string(least.t) +
                         " horizons; it must not be negative in [0, 1], change its coefficients");
      if (!(largest > 0))
        throw InputError("double well: the influence function vanishes, so there are no forces; "
                         "give coefficients such as 1, -1 for 1 - r");
    }

    double ball_volume(int dim)
    {
      return dim == 1 ? 2 : dim == 2 ? M_PI : 4 * M_PI / 3;
    }
  } // namespace

  DoubleWell::DoubleWell(int dim, RadialProfile influence, double c, double beta, double horizon,
                         WellPotential shape)
      : dim_(dim), influence_(std::move(influence)), c_(c), beta_(beta), horizon_(horizon),
        shape_(std::move(shape))
  {
    if (dim < 1 || dim > 3)
      throw InputError("double well: dimension = " + std::to_string(dim) +
                       " is not supported; choose 1, 2 or 3");
    require_positive("c", c, "it is the energy of a broken bond, take for example c = 1");
    require_positive("beta", beta,
                     "bonds soften at strains 1/sqrt(2 beta r), take for example beta = 1");
    require_positive("horizon", horizon, "give a length > 0");
    check_influence(influence_);
  }

  double DoubleWell::influence(double r) const
  {
    return std::max(0., influence_(r / horizon_));
  }

  double DoubleWell::moment(int n) const
  {
    if (influence_.lowest_exponent() + n + 1 <= 0)
      return std::numeric_limits<double>::infinity();
    return influence_.moment(n);
  }

  double DoubleWell::potential(double s) const
  {
    return c_ * shape_.value(beta_ * s);
  }

  double DoubleWell::derivative(double s) const
  {
    return c_ * beta_ * shape_.derivative(beta_ * s);
  }

  double DoubleWell::tangent(double s) const
  {
    return c_ * beta_ * shape_.tangent(beta_ * s);
  }

  double DoubleWell::force_factor() const
  {
    return 4 / (std::pow(horizon_, dim_ + 1) * ball_volume(dim_));
  }

  double DoubleWell::softening_strain(double r) const
  {
    return std::sqrt(shape_.softening() / (beta_ * r));
  }

  double DoubleWell::c1() const
  {
    return c_ * std::sqrt(beta_) * shape_.largest_derivatives()[0];
  }

  double DoubleWell::c2() const
  {
    return c_ * beta_ * shape_.largest_derivatives()[1];
  }

  double DoubleWell::c3() const
  {
    return c_ * beta_ * std::sqrt(beta_) * shape_.largest_derivatives()[2];
  }

  double DoubleWell::c_bar() const
  {
    // the unit sphere has the area dim ω_dim
    return c2() * dim_ * moment(dim_ - 2);
  }

  double DoubleWell::modulus() const
  {
    const double factor = dim_ == 1 ? 2 : dim_ == 2 ? .5 : .4;
    return factor * stiffness() * moment(dim_);
  }

  double DoubleWell::toughness() const
  {
    const double factor = dim_ == 1 ? 1 : dim_ == 2 ? 4 / M_PI : 1.5;
    return factor * c_ * moment(dim_);
  }

  DoubleWell::WaveSpeeds DoubleWell::wave_speeds(double density) const
  {
    require_positive("density", density, "give the mass of a unit of volume");
    const double speed = std::sqrt(modulus() / density);
    return dim_ == 1 ? WaveSpeeds{speed, 0} : WaveSpeeds{std::sqrt(3.) * speed, speed};
  }

  Kernel<2> DoubleWell::linear_kernel() const
  {
    return {dim_ == 1 ? Structure::scalar : Structure::tensor, influence_.over_t(), horizon_,
            force_factor() * stiffness() / horizon_};
  }
} // namespace plumbline::physics
