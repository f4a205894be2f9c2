#pragma once

#include "algebra/csr_matrix.h"
#include "meshfree/rules/families.h"
#include "meshfree/rules/family_statistics.h"
#include "method/sparse_discretisation.h"

namespace plumbline::meshfree
{
  /// Surface forces of a linear peridynamic solid on the nodes about a crack's tip.
  struct TipRows
  {
    /// Of the tip: how far the feet of nodes are away [horizons]. Larger than 1, as consistent
    /// terms begin there.
    static constexpr double reach = 2;

    dealii::Point<2> place;
    std::vector<double> volume; ///< of each node
    /// Force densities, two rows for each node, columns by all nodes, those of the collar too.
    algebra::CsrMatrix rows;

    /// On each node [force].
    /// @param u  of all nodes, shape (n_nodes, 2)
    std::vector<dealii::Tensor<1, 2>> forces(const std::vector<double> &u) const;
  };

  /// Part of a rule's linear system over the free nodes, numbered node by node; held are the nodes
  /// of the collar. CsrMatrix of a share of the nodes, the others empty.
  struct ScatteredOperator
  {
    method::PartitionedRows rows;
    FamilyStatistics<2> statistics; ///< of these families
    std::vector<TipRows> tips;      ///< of all cracks, of nodes of the share; the same on all ranks
  };

  /// Yields the family of a free node, as Families::make does: neighbours ascending.
  template <int dim>
  using FamilySource = std::function<void(std::size_t node, Family<dim> &family)>;

  /// Rows -Σ f C(kernel_point) (u_j - u_i) weight of families on a share [first, last) of the
  /// nodes.
  /// @param n_components  of u
  /// @param factors       f of each bond of a family, overwritten; empty: 1
  /// @return              columns of all nodes; of nodes before the share there are no rows
  template <int dim>
  algebra::CsrMatrix bond_rows(const FamilySource<dim> &families, const Kernel<dim> &kernel,
                               unsigned int n_components, std::pair<std::size_t, std::size_t> share,
                               const std::function<void(std::size_t node, const Family<dim> &family,
                                                        std::vector<double> &factors)> &factors);

  /// The operator L_h of families on a share [first, last) of the free nodes: rows
  /// -Σ a C(kernel_point) (u_j - u_i) weight, where a is the mean of the coefficients at both
  /// nodes. Not symmetric in general: a bond's two weights differ.
  /// @throws NumericalError  a family that cannot be made
  /// @throws InputError  a coefficient that is not positive
  ScatteredOperator scattered_operator(const FamilySource<2> &families,
                                       const problem::Problem<2> &problem,
                                       std::pair<std::size_t, std::size_t> share);
  ScatteredOperator scattered_operator(const Families<2> &families,
                                       const problem::Problem<2> &problem,
                                       std::pair<std::size_t, std::size_t> share);

} // namespace plumbline::meshfree
