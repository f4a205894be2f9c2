#pragma once

#include "scene/problem.h"

#include <optional>
#include <string>

namespace plumbline::study
{
  /// How far a load b that is given is from what the operator makes of the solution u that is given
  /// beside it: largest values over some points of Ω, the broken bonds of cracks left out.
  struct Contradiction
  {
    double difference = 0;    ///< |Lu - b|, where it is more than round-off and quadrature
    double of_operator = 0;   ///< |Lu|
    double load = 0;          ///< |b|
    std::size_t n_points = 0; ///< there were
    dealii::Point<2> where;   ///< the difference is largest

    /// More than 1 % of both.
    bool is_clear() const;
    std::string text() const;
  };

  /// At some 16 nodes, and at 16 more whose bonds cracks cut. Accuracy: that of ManufacturedLoad;
  /// 2 % of ∫|C| |u(y) - u(x)| dy where bonds are cut.
  /// @return  nothing unless the scene gives solution and load, or where u is not smooth enough
  ///          to tell. Not for: free surfaces (Domain/outside), dilatations within two horizons
  ///          of a crack; points there are left out.
  std::optional<Contradiction> measure_contradiction(const problem::Problem<2> &problem);
} // namespace plumbline::study
