#pragma once

#include "algebra/csr_matrix.h"
#include "meshfree/rules/families.h"
#include "meshfree/rules/family_statistics.h"
#include "method/sparse_discretisation.h"

namespace plumbline::meshfree
{
  /// Part of a rule's linear system over the free nodes, numbered node by node; held are the nodes
  /// of the collar. CsrMatrix of a share of the nodes, the others empty.
  struct ScatteredOperator
  {
    method::PartedRows rows;
    FamilyStatistics statistics; ///< of these families
  };

  /// Yields the family of a free node, as Families::make does: neighbours ascending.
  using FamilySource = std::function<void(std::size_t node, Family &family)>;

  /// The operator L_h of families on a share [first, last) of the free nodes: rows
  /// -Σ a C(kernel_point) (u_j - u_i) weight, where a is the mean of the coefficients at both
  /// nodes. Not symmetric in general: a bond's two weights differ.
  /// @throws NumericalError  a family that cannot be made
  /// @throws InputError  a coefficient that is not positive
  ScatteredOperator scattered_operator(const FamilySource &families, const scene::Problem &problem,
                                       std::pair<std::size_t, std::size_t> share);
  ScatteredOperator scattered_operator(const Families &families, const scene::Problem &problem,
                                       std::pair<std::size_t, std::size_t> share);

} // namespace plumbline::meshfree
