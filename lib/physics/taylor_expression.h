#pragma once

#include <array>
#include <string>
#include <vector>

namespace plumbline::physics
{
  /// Coefficients of a Taylor polynomial: g, g', g''/2, g'''/6.
  using Taylor = std::array<double, 4>;

  /// An expression in r with its derivatives, by arithmetic of Taylor polynomials: numbers, pi, r,
  /// + - * / ^, brackets, and the functions exp, ln, sqrt, sin, cos, atan, sinh, cosh and tanh. It
  /// reads as Expression does where both apply; Expression has no derivatives.
  /// Accuracy: round-off of the terms. Values that are not finite are the caller's to refuse.
  class TaylorExpression
  {
  public:
    /// @param key   the scene key that the text comes from, for messages
    /// @throws InputError  text that does not parse
    TaylorExpression(const std::string &key, const std::string &text);

    Taylor operator()(double r) const;

    /// A constant, r, or an operation on the last one or two results.
    struct Step
    {
      double constant = 0;
      bool is_variable = false;
      Taylor (*unary)(const Taylor &) = nullptr;
      Taylor (*binary)(const Taylor &, const Taylor &) = nullptr;
    };

  private:
    std::vector<Step> steps_; ///< in postfix order
  };
} // namespace plumbline::physics
