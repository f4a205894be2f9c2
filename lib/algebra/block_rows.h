#pragma once

#include "algebra/csr_matrix.h"

#include <optional>

namespace plumbline::algebra
{
  /// A sparse matrix for many products, in blocks of 2 or 3 components: one column index for each
  /// pair of nodes. Bonds whose force acts along the bond have off-diagonal blocks -g⊗g, of which
  /// only g is stored: 28 bytes per bond in three dimensions instead of 108. Their products differ
  /// from those of the matrix by rounding: a block is taken as -g⊗g if its entries are met to 8 ε
  /// of its largest one, so that y_i differs by at most 2e-15 Σ max |A_ij| |x_j|₁ over blocks A_ij,
  /// which may be more than 1e-15 of Σ |a_ij x_j|.
  class BlockRows
  {
  public:
    /// @param rows  of unknowns numbered node by node
    /// @return      nothing unless all rows of a node have the same nodes as columns, with all
    /// components, and its own among them; or for another number of components
    static std::optional<BlockRows> make(const CsrMatrix &rows, unsigned int n_components);

    std::size_t n_nodes() const { return column_start_.size() - 1; }
    std::size_t n_bonds() const { return column_.size(); } ///< blocks off the diagonal
    bool are_directed() const { return are_directed_; }    ///< blocks are -g⊗g

    /// y = A x for the rows of the nodes [from, to).
    void vmult(const double *x, double *y, std::size_t from, std::size_t to) const;

  private:
    bool take_directions(); ///< @return all blocks are -g⊗g

    unsigned int n_components_ = 0;
    bool are_directed_ = false;
    std::vector<std::size_t> column_start_; ///< shape (n_nodes + 1)
    std::vector<unsigned int> column_;      ///< nodes, but for the row's own
    std::vector<double> diagonal_;          ///< shape (n_nodes, n_components, n_components)
    std::vector<double> value_;             ///< of each bond: g, or its block
  };
} // namespace plumbline::algebra
