#pragma once

#include "physics/expression.h"

#include <functional>
#include <string>

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
    /// @param text  what the scene says, for messages
    /// @param is_smooth  surely so
    Coefficient(std::function<double(const Point<2> &)> a, std::string text, Mean kind,
                bool is_smooth = false)
        : a_(std::move(a)), text_(std::move(text)), kind_(kind), is_smooth_(is_smooth)
    {
    }
    Coefficient(const Expression &a, Mean kind)
        : Coefficient([a](const Point<2> &x) { return a(x); }, a.text(), kind, a.is_smooth())
    {
    }

    /// a(x) > 0. @throws InputError  not a positive number
    double at(const Point<2> &x) const;
    double mean(double a, double b) const { return physics::mean(kind_, a, b); }
    bool is_smooth() const { return is_smooth_; } ///< false: it may not be

  private:
    std::function<double(const Point<2> &)> a_;
    std::string text_;
    Mean kind_;
    bool is_smooth_;
  };
} // namespace plumbline::physics
