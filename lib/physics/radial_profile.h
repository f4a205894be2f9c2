#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <memory>
#include <vector>

namespace plumbline::physics
{
  /// One term a t^p.
  struct PowerTerm
  {
    double coefficient = 0;
    int exponent = 0;
  };

  /// The profile ρ(t) of a kernel, t = |ξ|/δ in (0, 1]: a sum of powers, a smooth function, or a
  /// table that is linear between its rows. Beyond t = 1, where the kernel itself is zero, it goes
  /// on by its formula. A value.
  class RadialProfile
  {
  public:
    using Powers = std::vector<PowerTerm>;

    RadialProfile() = default; ///< empty
    RadialProfile(Powers powers);
    RadialProfile(std::initializer_list<PowerTerm> powers) : RadialProfile(Powers(powers)) {}

    /// A function that is smooth in [0, 1], ends included.
    /// @param is_even  it is smooth as a function of ξ, too: a function of t²
    /// @throws InputError  a value that is not finite, or a function that 128 points do not resolve
    ///                     to round-off; parts down to 1/128 of it are looked at as closely, so
    ///                     that a feature of 1e-4 horizons is seen
    static RadialProfile smooth(std::function<double(double t)> value, bool is_even);

    /// Linear between rows (t, ρ).
    /// @throws InputError  fewer than 2 rows or more than 1000, t that does not increase from 0 to
    ///                     1, a value that is not finite
    static RadialProfile table(std::vector<std::array<double, 2>> rows);

    bool is_empty() const { return pieces_.empty() && !function_; }

    /// ρ(t), t > 0.
    double operator()(double t) const
    {
      return pieces_.size() == 1 ? sum(pieces_[0].powers, t) : other(t);
    }

    /// ∫ t^n ρ dt over [from, 1], n + lowest_exponent() > -1 if from = 0. Exact for powers and
    /// tables, to round-off for functions.
    double moment(int n, double from = 0) const;

    /// ∫_0^1 t |ρ| dt, or more: a size, to measure round-off by.
    double size() const;

    /// At 0 it behaves like t to this power.
    int lowest_exponent() const;

    /// On any interval of this length between breaks it is t^lowest_exponent() times a polynomial
    /// of this degree, to an accuracy relative to its largest value; 0: to round-off.
    unsigned int degree(double length = 1, double accuracy = 0) const;

    /// It is smooth as a function of ξ, or times ξ⊗ξ/|ξ|².
    bool is_even(bool is_tensor) const;

    /// Where it is not smooth, between 0 and 1, ascending; often nowhere.
    std::vector<double> breaks() const;

    struct Piece;
    /// The smooth profiles, functions of t, that it is made of: each from the end of the one before
    /// to its own; together they go from 0 to 1. Each may be taken from 0.
    std::vector<Piece> pieces() const;

    /// Smooth profiles, functions of t/end, that add up to it where each of them is zero beyond its
    /// end; the last ends at 1.
    std::vector<Piece> parts() const;

    /// The terms, unless it is a function.
    /// @pre  no breaks
    const Powers &powers() const { return pieces_[0].powers; }
    bool is_function() const { return function_ != nullptr; }

    RadialProfile over_t() const; ///< ρ(t) / t

  private:
    struct PowerPiece
    {
      double end = 1;
      Powers powers;
    };
    struct Function;

    explicit RadialProfile(std::shared_ptr<const Function> function) : function_(function) {}
    static RadialProfile make(std::function<double(double)> value, bool is_even, int exponent);
    static double sum(const Powers &powers, double t);
    double other(double t) const;

    std::vector<PowerPiece> pieces_; ///< several: a table
    std::shared_ptr<const Function> function_;
  };

  struct RadialProfile::Piece
  {
    double end = 1;
    RadialProfile profile; ///< without breaks
  };

  inline double RadialProfile::sum(const Powers &powers, double t)
  {
    double sum = 0;
    for (const PowerTerm &term : powers)
      switch (term.exponent)
      {
      case -1:
        sum += term.coefficient / t;
        break;
      case 0:
        sum += term.coefficient;
        break;
      case 1:
        sum += term.coefficient * t;
        break;
      default:
        sum += term.coefficient * std::pow(t, term.exponent);
      }
    return sum;
  }
} // namespace plumbline::physics
