#pragma once

#include "physics/coefficient.h"
#include "physics/kernel.h"
#include "physics/state_based.h"

#include <optional>

namespace plumbline::physics
{
  /// How many radii the quadrature of a ball at x begins with, and twice as many angles. Two rules
  /// that agree have missed a feature that lies between the points of both: the first is to be fine
  /// enough for what u and the material are known to hold (degree/2 of the polynomials that they
  /// are in the ball). Empty: 6.
  using FewestRadii = std::function<unsigned int(const Point<2> &x)>;

  /// A field by its values. Give each thread a copy.
  using FieldFunction = std::function<double(const Point<2> &x, unsigned int component)>;

  /// The load b = L_δ u of a given field u: -∫_{|ξ|<δ} a C(ξ) (u(x+ξ) - u(x)) dξ, a the mean of the
  /// coefficients at x and x+ξ (1 if there is none), by Gauss points in the radius and equidistant
  /// angles, both doubled until the value stops moving. Exact for polynomials. Accuracy: 1e-13 of
  /// |b| for smooth u, down to the round-off 1e-16 ∫C max|u|. Not for: u or a that is not smooth in
  /// the ball; give the load itself then.
  class ManufacturedLoad
  {
  public:
    /// @param u  of as many components as the kernel couples
    ManufacturedLoad(Kernel<2> kernel, FieldFunction u, std::optional<Coefficient> a = {},
                     FewestRadii fewest = {})
        : kernel_(std::move(kernel)), u_(std::move(u)), a_(std::move(a)), fewest_(std::move(fewest))
    {
    }

    /// @throws InputError  u has too few components for the kernel
    ManufacturedLoad(Kernel<2> kernel, const Expression &u, std::optional<Coefficient> a = {},
                     FewestRadii fewest = {});

    /// @throws NumericalError  the quadrature does not settle to 1e-12
    double operator()(const Point<2> &x, unsigned int component) const;

  private:
    Kernel<2> kernel_;
    FieldFunction u_;
    std::optional<Coefficient> a_;
    FewestRadii fewest_;
  };

  /// The dilatation θ(x) = ∫ K ξ·(u(x+ξ) - u(x)) dξ of a given field, to the same accuracy.
  class FieldDilatation
  {
  public:
    /// @param influence  K, scalar
    /// @param u          of two components
    FieldDilatation(Kernel<2> influence, FieldFunction u, FewestRadii fewest = {})
        : influence_(std::move(influence)), u_(std::move(u)), fewest_(std::move(fewest))
    {
    }

    /// @throws NumericalError  the quadrature does not settle to 1e-12
    double operator()(const Point<2> &x) const;

  private:
    Kernel<2> influence_;
    FieldFunction u_;
    FewestRadii fewest_;
  };

  /// What the dilatation adds to the load, for a given θ: the first integral of `Dilatation`.
  class DilatationForce
  {
  public:
    /// @param theta  on Ω and the horizon around it
    DilatationForce(Dilatation<2> dilatation, std::function<double(const Point<2> &)> theta,
                    FewestRadii fewest = {})
        : dilatation_(std::move(dilatation)), theta_(std::move(theta)), fewest_(std::move(fewest))
    {
    }

    /// @throws NumericalError  the quadrature does not settle to 1e-12
    double operator()(const Point<2> &x, unsigned int component) const;

  private:
    Dilatation<2> dilatation_;
    std::function<double(const Point<2> &)> theta_;
    FewestRadii fewest_;
  };

  /// ∫_{|ξ|<δ} |C_aa|, the size of the operator's two terms, which cancel [unit of C length^2].
  double operator_scale(const Kernel<2> &kernel);
} // namespace plumbline::physics
