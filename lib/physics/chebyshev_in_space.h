#pragma once

#include <deal.II/base/point.h>

#include <array>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace plumbline::physics
{
  /// A linear functional of functions along an axis: Σ weight f(coordinate).
  using AxisFunctional = std::vector<std::pair<double, double>>; ///< coordinates and weights

  /// Functionals of each axis, whose products apply to fields in space.
  using AxisFunctionals = std::array<std::vector<AxisFunctional>, 3>;

  /// A smooth field on a cuboid as a tensor-product Chebyshev series, so that a whole lattice of
  /// functionals applies to it axis by axis; as ChebyshevField in the plane.
  class ChebyshevInSpace
  {
  public:
    using Function = std::function<double(const dealii::Point<3> &, unsigned int component)>;

    /// Interpolate f with more and more points, up to 65 along an axis, until the last coefficients
    /// are round-off and the series is equal to f, to 1e-12 of its largest value, at 10 × 10 × 10
    /// control points too.
    /// @param noise  absolute error of f's own values; the series is cut there
    /// @return       nothing if so many terms do not resolve f, or a value is not finite
    static std::optional<ChebyshevInSpace> resolve(const Function &f, unsigned int n_components,
                                                   const dealii::Point<3> &lower,
                                                   const dealii::Point<3> &upper, double noise = 0);

    const std::array<unsigned int, 3> &n_terms() const { return n_terms_; }

    /// @return  shape (n_z, n_y, n_x) of the functionals of the axes
    std::vector<double> apply(unsigned int component, const AxisFunctionals &functionals) const;

  private:
    using Box = std::array<dealii::Point<3>, 2>;

    bool meets(const Function &f, double noise) const;

    Box box_;
    std::array<unsigned int, 3> n_terms_{};
    std::vector<std::vector<double>> coefficients_; ///< a component: shape (z, y, x)
  };
} // namespace plumbline::physics
