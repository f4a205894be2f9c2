#pragma once

#include "physics/expression.h"

namespace plumbline::physics
{
  /// How the coefficients at the two ends of a bond make one.
  enum class Mean
  {
    arithmetic, ///< (a(x) + a(y)) / 2
    harmonic    ///< 2 / (1/a(x) + 1/a(y))
  };

  double mean(Mean kind, double a, double b);

  /// A factor of the kernel that varies with the material, symmetric in both ends of a bond:
  /// mean(a(x), a(y)). Copies share nothing: give each thread its own.
  class Coefficient
  {
  public:
    Coefficient(Expression a, Mean kind) : a_(std::move(a)), kind_(kind) {}

    /// a(x) > 0. @throws InputError  not a positive number
    double at(const Point<2> &x) const;
    double mean(double a, double b) const { return physics::mean(kind_, a, b); }

  private:
    Expression a_;
    Mean kind_;
  };
} // namespace plumbline::physics
