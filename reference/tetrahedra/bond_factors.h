#pragma once

#include "algebra/csr_matrix.h"
#include "problem/in_space.h"
#include "reference/tetrahedra/space.h"

namespace plumbline::reference
{
  /// Factors that multiply the kernel of bonds between cells of a mesh, by the groups of the cells.
  /// If the surface is free, bonds to the outside of the mesh have the factor 0.
  class BondFactors
  {
  public:
    /// @param mesh  of the problem, its cells in any order; must outlive the factors
    BondFactors(const problem::Problem<3> &problem, const TetrahedralMesh &mesh)
        : factors_(problem.factors), is_free_(problem.is_free), group_(mesh.group)
    {
    }

    bool are_all_one() const { return !factors_ && !is_free_; }
    bool is_surface_free() const { return is_free_; }
    double between(std::size_t cell, std::size_t other) const
    {
      return factors_ ? factors_->between(group_[cell], group_[other]) : 1;
    }
    bool are_alike(std::size_t cell, std::size_t other) const
    {
      return !factors_ || group_[cell] == group_[other];
    }

  private:
    std::optional<problem::GroupFactors> factors_;
    bool is_free_;
    const std::vector<unsigned int> &group_;
  };

  /// Change rows of a homogeneous material in unbounded space to rows of bonds with factors, for
  /// functions that are constant on cells. The entry of two cells is an integral over the bonds
  /// between them, which all have the same factor. The diagonal is set so that rows annihilate
  /// constants, which leaves out bonds to the outside of the mesh. The result is as exact as the
  /// given rows, and symmetric to the last bit if they are.
  /// @param rows  of free cells by all cells, with n_components for each
  void set_factors_of_cells(const BondFactors &factors, const TetrahedralSpace &space,
                            unsigned int n_components, algebra::CsrMatrix &rows);
} // namespace plumbline::reference
