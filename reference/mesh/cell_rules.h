#pragma once

#include "reference/mesh/cells.h"
#include "reference/mesh/space.h"

#include <deal.II/base/quadrature.h>

namespace plumbline::reference
{
  /// A rule on a cell of a mesh with the shape functions at its points.
  struct CellRule
  {
    std::vector<Point<2>> points; ///< [length]
    std::vector<double> weights;  ///< [length^2]
    std::vector<double> phi;      ///< shape (n_points, n_shapes)
  };

  /// On the parts of a cell, exact to a degree on each; phi: MeshSpace::shapes.
  /// @param rule  overwritten
  void rule_by_parts(const MeshSpace &space, const MeshCells &cells, std::size_t cell,
                     unsigned int degree, CellRule &rule);

  /// One rule for all cells of a mesh, on those with curved sides part by part; phi:
  /// MeshSpace::values. Thread safe.
  class CellRules
  {
  public:
    /// @param gauss   on the unit cell
    /// @param degree  to which it is exact: of rules on parts
    CellRules(const MeshSpace &space, const MeshCells &cells, const dealii::Quadrature<2> &gauss,
              unsigned int degree);

    /// @param rule  overwritten
    void find(std::size_t cell, CellRule &rule) const;

  private:
    const MeshSpace &space_;
    const MeshCells &cells_;
    dealii::Quadrature<2> gauss_;
    unsigned int degree_;
    std::vector<double> phi_;
  };

  /// Gauss's product rule on squares, a symmetric one on triangles, exact to degree 2 n - 1.
  /// @param n  1 to 7
  CellRules gauss_on_cells(const MeshSpace &space, const MeshCells &cells, unsigned int n);
} // namespace plumbline::reference
