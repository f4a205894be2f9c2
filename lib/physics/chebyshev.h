#pragma once

#include <deal.II/base/point.h>

#include <array>
#include <functional>
#include <optional>
#include <vector>

namespace plumbline::physics
{
  using dealii::Point;

  /// A smooth field on a box as tensor-product Chebyshev series, so that it can be evaluated,
  /// averaged and tested against shape functions on a whole lattice axis by axis.
  class ChebyshevField
  {
  public:
    using Function = std::function<double(const Point<2> &, unsigned int component)>;

    /// Interpolate f with more and more points until the last coefficients are round-off.
    /// @param noise  absolute error of f's own values; the series is cut there
    /// @return       nothing if 129² terms do not resolve f: it is not smooth on the box
    static std::optional<ChebyshevField> resolve(const Function &f, unsigned int n_components,
                                                 const Point<2> &lower, const Point<2> &upper,
                                                 double noise = 0);

    unsigned int n_components() const { return static_cast<unsigned int>(coefficients_.size()); }
    unsigned int n_terms() const { return n_terms_; } ///< along each axis

    double operator()(const Point<2> &x, unsigned int component) const;

    /// T_0 ... T_{n_terms-1} at a coordinate of an axis.
    std::vector<double> basis(unsigned int axis, double coordinate) const;

    /// Σ_kl c_kl A_ik B_jl for linear functionals A of T_k(x) and B of T_l(y).
    /// @param a, b  row-major, shapes (n_a, n_terms) and (n_b, n_terms)
    /// @return      row-major, shape (n_b, n_a): the index of x runs fastest
    std::vector<double> contract(unsigned int component, const std::vector<double> &a,
                                 const std::vector<double> &b) const;

  private:
    Point<2> lower_, upper_;
    unsigned int n_terms_ = 0;
    std::vector<std::vector<double>> coefficients_; ///< a component: row-major (k of x, l of y)
  };
} // namespace plumbline::physics
