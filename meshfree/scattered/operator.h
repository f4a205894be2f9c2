#pragma once

#include "algebra/rows.h"
#include "meshfree/rules/families.h"
#include "meshfree/rules/family_statistics.h"
#include "study/method.h"

namespace plumbline::meshfree
{
  /// Part of a rule's linear system over the free nodes, numbered node by node.
  struct ScatteredOperator
  {
    algebra::Rows rows;                  ///< of a share of the nodes, the others empty; (n, n)
    std::vector<double> right_hand_side; ///< what the data in the collar add, shape (n)
    FamilyStatistics statistics;         ///< of these families
  };

  /// Yields the family of a free node, as Families::make does: neighbours ascending.
  using FamilySource = std::function<void(std::size_t node, Family &family)>;

  /// The operator L_h of families on a share [first, last) of the free nodes: rows
  /// -Σ a C(kernel_point) (u_j - u_i) weight, where a is the mean of the coefficients at both
  /// nodes. Not symmetric in general: a bond's two weights differ.
  /// @throws NumericalError  a family that cannot be made
  /// @throws InputError  a coefficient that is not positive, a constraint that is not finite
  ScatteredOperator scattered_operator(const FamilySource &families, const scene::Problem &problem,
                                       std::pair<std::size_t, std::size_t> share);
  ScatteredOperator scattered_operator(const Families &families, const scene::Problem &problem,
                                       std::pair<std::size_t, std::size_t> share);

  /// Solve with an operator of which every rank makes its share.
  /// @note Collective.
  /// @throws NumericalError  no solution; @throws InputError  a load that is not finite
  study::Solution scattered_solution(
      const std::function<ScatteredOperator(std::pair<std::size_t, std::size_t> share)> &make,
      const scene::Scene &scene, const scene::Problem &problem);
} // namespace plumbline::meshfree
