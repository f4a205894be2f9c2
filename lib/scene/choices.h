#pragma once

#include "base/choice.h"

namespace plumbline::scene
{
  // What a scene chooses by words, see base/choice.h.

  enum class MeshKind
  {
    lattice,
    squares,
    triangles,
    file,     ///< .msh or .geo, by its name
    generator ///< of deal.II, by its name
  };

  /// The local operator that a kernel is scaled to.
  enum class Limit
  {
    half_laplace,
    laplace,
    navier,
    none
  };

  /// ω of double wells, which weakens bonds near the boundary.
  enum class BoundaryFunction
  {
    one,
    smoothstep, ///< t²(3 - 2t), t = min(1, distance to the boundary / horizon)
    expression  ///< in x, y and delta
  };

  enum class LocalSolution
  {
    solution, ///< where it does not depend on the horizon
    none,
    computed,
    expression
  };

  enum class NodeKind
  {
    centres,
    vertices,
    mesh, ///< centroids of its cells
    file  ///< .csv, by its name
  };

  enum class Boundary
  {
    constrained, ///< u is given in the collar
    free,        ///< and families end there
    periodic     ///< a torus
  };

  /// How a sweep refines.
  enum class Regime
  {
    m,       ///< horizon fixed, h → 0: towards the nonlocal solution
    delta,   ///< m = horizon / h fixed, h → 0: towards the local limit; decides asymptotic
             ///< compatibility
    delta_m, ///< horizon → 0 and m → ∞ together
    horizon, ///< h fixed, horizon varies: how errors depend on the horizon
    variable ///< h and m fixed, a number of the scene varies: how errors depend on it
  };

  /// Nothing is refined: errors are seen to depend on something.
  constexpr bool is_without_limit(Regime regime)
  {
    return regime == Regime::horizon || regime == Regime::variable;
  }

  /// What of a solution is compared.
  enum class Quantity
  {
    nodal,
    averages,
    field,
    truncation, ///< no solution: what the exact one leaves of the equations
    bound,      ///< no solution: what follows from that and the norm of the inverse
    energy      ///< nodal values, in the norm of the method's own bilinear form
  };

  enum class Norm
  {
    nodal_linf,
    nodal_l2,
    averages_linf,
    averages_l2,
    field_linf,
    field_l2,
    truncation_linf,
    truncation_l2,
    bound_linf,
    bound_l2,
    energy
  };
  constexpr Quantity quantity(Norm norm)
  {
    return static_cast<Quantity>(static_cast<int>(norm) / 2);
  }

  constexpr bool is_largest(Norm norm) ///< Linf
  {
    return static_cast<int>(norm) % 2 == 0 && norm != Norm::energy;
  }

  /// What a solution is compared with.
  enum class Target
  {
    exact,
    local,
    reference,
    finest ///< the same method's solution of its finest level: no exact one is needed
  };

  /// Whose error is estimated.
  enum class Estimate
  {
    automatic, ///< the reference's; every Galerkin solution's where nothing else is known
    every,     ///< every Galerkin solution's
    reference,
    none
  };

  enum class ExpectedKind
  {
    verdicts,
    errors,
    rates,
    bounds,
    monotone,
    jitter,
    stability,
    orders, ///< in time
    growth, ///< of waves on strains
    sampling,
    strip, ///< with a standing crack
    values ///< of any scalar of an analysis
  };
} // namespace plumbline::scene

namespace plumbline::base
{
  template <>
  inline constexpr auto words<scene::MeshKind> = std::array{"lattice", "squares", "triangles"};
  template <>
  inline constexpr auto words<scene::Limit> =
      std::array{"-1/2 Laplace", "-Laplace", "Navier", "none"};
  template <>
  inline constexpr auto words<scene::BoundaryFunction> = std::array{"one", "smoothstep"};
  template <>
  inline constexpr auto words<scene::LocalSolution> = std::array{"solution", "none", "computed"};
  template <>
  inline constexpr auto words<scene::NodeKind> = std::array{"centres", "vertices", "mesh"};
  template <>
  inline constexpr auto words<scene::Boundary> = std::array{"constrained", "free", "periodic"};
  template <>
  inline constexpr auto words<scene::Regime> =
      std::array{"m", "delta", "delta-m", "horizon", "variable"};
  template <>
  inline constexpr auto words<scene::Quantity> =
      std::array{"nodal", "averages", "field", "truncation", "bound", "energy"};
  template <>
  inline constexpr auto words<scene::Norm> =
      std::array{"nodal Linf", "nodal L2", "averages Linf",   "averages L2",
                 "field Linf", "field L2", "truncation Linf", "truncation L2",
                 "bound Linf", "bound L2", "energy"};
  template <>
  inline constexpr auto words<scene::Target> =
      std::array{"exact", "local", "reference", "own finest level"};
  template <>
  inline constexpr auto words<scene::Estimate> =
      std::array{"automatic", "every", "reference", "none"};
  template <>
  inline constexpr auto words<scene::ExpectedKind> =
      std::array{"verdicts",          "errors",   "rates",     "bounds",
                 "monotone",          "jitter",   "stability", "orders",
                 "wave growth rates", "sampling", "strip",     "values"};
} // namespace plumbline::base
