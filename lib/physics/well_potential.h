#pragma once

#include <array>
#include <memory>
#include <string>

namespace plumbline::physics
{
  struct WellTables;

  /// The shape φ of a double-well potential f(s) = f_∞ φ(s f'(0)/f_∞): smooth and concave, φ(0) =
  /// 0, φ'(0) = 1 and φ(∞) = 1. Exponential, φ = 1 - e^(-s), unless an expression gives f. That one
  /// is evaluated by polynomials. Accuracy: round-off for the exponential; else φ, φ' √(1+s) and φ'
  /// + 2sφ'' to 1e-12, checked for each f, and φ relative to itself where s is small. Source: Jha &
  /// Lipton 2018, doi:10.1137/17M1112236, (7).
  class WellPotential
  {
  public:
    WellPotential() = default; ///< the exponential

    /// @param key   the scene key of the text, for messages
    /// @param text  f as an expression in r, see TaylorExpression
    /// @throws InputError  an f that does not satisfy (7), or changes on scales much shorter than
    /// f_∞/f'(0) + r
    WellPotential(const std::string &key, const std::string &text);

    bool is_exponential() const { return tables_ == nullptr; }
    const std::string &text() const { return text_; } ///< of f; empty: exponential
    double limit() const { return limit_; }           ///< f_∞ of the text
    double slope() const { return slope_; }           ///< f'(0) of the text

    double value(double s) const;      ///< φ
    double derivative(double s) const; ///< φ'
    double tangent(double s) const;    ///< φ' + 2sφ'', the derivative of x φ'(x²) at x = √s

    /// r̄², the first zero of φ' + 2sφ''. Source: ibid., after (7).
    double softening() const { return softening_; }

    /// max |F'|, |F''|, |F'''| of F(x) = φ(x²).
    const std::array<double, 3> &largest_derivatives() const { return largest_; }

    const WellTables &tables() const
    {
      return *tables_;
    } ///< see physics/well_tables.h; @pre !is_exponential()

  private:
    std::string text_;
    double limit_ = 1, slope_ = 1, softening_ = .5;
    std::array<double, 3> largest_ = of_exponential();
    std::shared_ptr<const WellTables> tables_;

    static std::array<double, 3> of_exponential();
  };
} // namespace plumbline::physics
