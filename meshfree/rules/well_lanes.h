#pragma once

#include "algebra/power_of_two.h"
#include "physics/well_potential.h"
#include "physics/well_tables.h"

// The shape φ of bonds with two wells for vectors of squares q², for inner loops.
namespace plumbline::meshfree
{
  /// φ(s) = 1 - e^(-s), s = ln 2 times the square.
  struct ExponentialLanes
  {
    explicit ExponentialLanes(const physics::WellPotential &) {}

    template <class Vector>
    [[gnu::always_inline]] Vector value(Vector square) const
    {
      const auto power = algebra::power_of_two<Vector>(-square);
      return (1 - power.scale) - power.scale * power.tail;
    }

    template <class Vector>
    [[gnu::always_inline]] Vector derivative(Vector square) const
    {
      const auto power = algebra::power_of_two<Vector>(-square);
      return power.scale + power.scale * power.tail;
    }

    template <class Vector>
    [[gnu::always_inline]] Vector tangent(Vector square) const
    {
      constexpr double twice_ln2 = 1.3862943611198906;
      return derivative(square) * (1 - twice_ln2 * square);
    }
  };

  /// φ by its tables, s = the square.
  struct TabulatedLanes
  {
    explicit TabulatedLanes(const physics::WellPotential &potential) : tables(potential.tables()) {}

    template <class Vector>
    [[gnu::always_inline]] Vector value(Vector square) const
    {
      const Vector last = Vector{} + physics::PiecewisePolynomial::largest,
                   capped = square > last ? last : square;
      return capped * tables.mean_slope(capped);
    }

    template <class Vector>
    [[gnu::always_inline]] Vector derivative(Vector square) const
    {
      return tables.derivative(square);
    }

    template <class Vector>
    [[gnu::always_inline]] Vector tangent(Vector square) const
    {
      return tables.tangent(square);
    }

    const physics::WellTables &tables;
  };

  /// s of the square 1: exponentials count in powers of two. Ways of bonds are divided by its root.
  inline double well_unit(const physics::WellPotential &potential)
  {
    constexpr double ln2 = .6931471805599453;
    return potential.is_exponential() ? ln2 : 1;
  }
} // namespace plumbline::meshfree
