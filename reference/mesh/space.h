#pragma once

#include "reference/mesh/cell_shapes.h"

#include <memory>

namespace plumbline::reference
{
  /// Continuous or discontinuous piecewise polynomials on a mesh of triangles or of quadrilaterals.
  /// Degrees of freedom that are not given by the volume constraint (free) come first.
  class MeshSpace
  {
  public:
    /// Where the middles of sides are, on curves: nodes of quadratic functions.
    using Middles = std::vector<std::array<Point<2>, 3>>;

    /// @param degree   0 to 4; 0 is discontinuous in any case
    /// @param middles  of continuous quadratic functions, shape (n_cells); empty: sides are
    /// straight
    /// @param order    of the cells, for numbering unknowns and sharing cells among ranks; empty:
    /// the order of the mesh
    /// @throws InputError  a mesh of both triangles and quadrilaterals
    MeshSpace(std::shared_ptr<const geometry::Mesh> mesh, bool is_continuous, unsigned int degree,
              const Middles &middles = {}, std::vector<unsigned int> order = {});

    const geometry::Mesh &mesh() const { return *mesh_; }
    bool is_continuous() const { return is_continuous_; }
    const CellShapes &shapes() const { return shapes_; }
    /// The i-th cell in the order of numbering.
    std::size_t cell_at(std::size_t i) const { return order_.empty() ? i : order_[i]; }
    const CellMap &map(std::size_t cell) const { return maps_[cell]; }

    std::size_t n_dofs() const { return support_.size(); }
    std::size_t n_free() const { return n_free_; } ///< dofs 0 ... n_free - 1 touch no collar cell
    const Point<2> &support(std::size_t dof) const { return support_[dof]; }

    /// Degrees of freedom of a cell in the order of the shape functions.
    const unsigned int *dofs(std::size_t cell) const { return &dofs_[cell * shapes_.size()]; }

    /// All shape functions of a cell at a point: those of `shapes`, or where nodes lie on curves,
    /// polynomials that are 1 at one of its nodes and 0 at the others. @param phi  shape (n)
    void values(std::size_t cell, const Point<2> &unit, double *phi) const;

    /// Their gradients by x [1/length]. @param gradient  shape (n)
    void gradients(std::size_t cell, const Point<2> &unit, dealii::Tensor<1, 2> *gradient) const;

    /// Those of a cell as sums of those of `shapes`, shape (n, n); empty: they are the same.
    const std::vector<double> &own_functions(std::size_t cell) const
    {
      static const std::vector<double> same;
      return own_.empty() ? same : own_[cell];
    }

  private:
    void move_nodes(const Middles &middles);

    std::shared_ptr<const geometry::Mesh> mesh_;
    bool is_continuous_;
    CellShapes shapes_;
    std::vector<unsigned int> order_; ///< empty: cells as they are
    std::vector<CellMap> maps_;
    std::vector<unsigned int> dofs_; ///< shape (n_cells, shapes.size())
    std::vector<Point<2>> support_;
    std::vector<std::vector<double>> own_; ///< see own_functions; empty: all are the same
    std::size_t n_free_ = 0;
  };
} // namespace plumbline::reference
