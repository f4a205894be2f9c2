#pragma once

#include "physics/state_based.h"

#include <functional>
#include <optional>
#include <vector>

namespace plumbline::physics
{
  /// The load b = L_δ u of a given field u in space: -∫_{|ξ|<δ} C(ξ) (u(x+ξ) - u(x)) dξ and what a
  /// dilatation adds, which is of the same form (DilatationInSpace), by Gauss points in the radius
  /// and in the height on the sphere and equidistant angles about its axis.
  /// Opposite bonds are taken together, so that odd parts cancel exactly. Exact for polynomials.
  /// Accuracy: 1e-13 of the largest |b| for smooth u, down to the round-off 1e-15 ∫|C| max|u|.
  class LoadInSpace
  {
  public:
    using Field = std::function<double(const Point<3> &, unsigned int component)>;

    /// @param dilatation  of a homogeneous solid, or empty
    /// @param u        of as many components as the kernel couples
    /// @param samples  where finer and finer rules are compared until they agree
    /// @throws NumericalError  the finest two do not: u is not smooth in the ball
    LoadInSpace(const Kernel<3> &kernel, const std::optional<Dilatation<3>> &dilatation, Field u,
                const std::vector<Point<3>> &samples);

    double operator()(const Point<3> &x, unsigned int component) const;

    double noise() const { return noise_; } ///< round-off, absolute

  private:
    /// A quadrature point in one half of the ball; it also stands for the opposite point. Its
    /// values are those of C = across I + excess ξ⊗ξ/|ξ|², times the weight.
    struct BondPoint
    {
      Point<3> xi;
      double across = 0, excess = 0;
    };

    /// Exact for polynomials of a degree on the sphere, and for C in the radius.
    static std::vector<BondPoint> rule(const Kernel<3> &kernel,
                                       const std::optional<Dilatation<3>> &dilatation,
                                       unsigned int degree);

    double integral(const std::vector<BondPoint> &rule, const Point<3> &x,
                    unsigned int component) const;

    unsigned int n_components_;
    Field u_;
    std::vector<BondPoint> rule_;
    double noise_ = 0;
  };

  /// ∫_{|ξ|<δ} |C_aa|, or somewhat more: the size of the operator's two terms, which cancel [unit
  /// of C length^3].
  double operator_scale(const Kernel<3> &kernel);

  /// The same for a dilatation: an upper bound of |λ - μ| ∫_{|w|<2δ} |C(w)|.
  double operator_scale(const Dilatation<3> &dilatation);
} // namespace plumbline::physics
