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

    /// How much is looked at before a series is believed.
    struct Search
    {
      /// A grid of base::control_points, which the series must meet as well: a feature of f that
      /// is wider than 1.8/n of the box along both axes cannot hide between interpolation points.
      std::array<unsigned int, 2> n_control{100, 100};
      unsigned int fewest = 9, most = 129; ///< interpolation points along an axis
      double digits = 1e-15; ///< of the largest value, that coefficients are round-off below
    };

    /// Interpolate f with more and more points until the last coefficients are round-off and the
    /// series is equal to f, to 1e-12 of its largest value, at the control points too.
    /// @param noise  absolute error of f's own values; the series is cut there
    /// @return       nothing if search.most² terms do not resolve f: it is not smooth on the box
    static std::optional<ChebyshevField> resolve(const Function &f, unsigned int n_components,
                                                 const Point<2> &lower, const Point<2> &upper,
                                                 double noise, const Search &search);
    static std::optional<ChebyshevField> resolve(const Function &f, unsigned int n_components,
                                                 const Point<2> &lower, const Point<2> &upper,
                                                 double noise = 0)
    {
      return resolve(f, n_components, lower, upper, noise, Search());
    }

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
    /// Whether it is f at all control points, but for rounding and f's noise.
    bool meets(const Function &f, double noise, const Search &search) const;

    Point<2> lower_, upper_;
    unsigned int n_terms_ = 0;
    std::vector<std::vector<double>> coefficients_; ///< a component: row-major (k of x, l of y)
  };
} // namespace plumbline::physics
