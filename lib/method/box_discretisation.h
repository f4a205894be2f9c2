#pragma once

#include "geometry/cell_counts.h"
#include "method/discretisation_in_space.h"
#include "method/linear_equations.h"

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace plumbline::method
{
  /// Averages over the cells as VTK image data in 64-bit floating point. Cells of the bounding box
  /// outside of Ω are blanked (vtkGhostType) and have the value 0.
  /// @param averages  over the cells of Ω, shape (n_cells, n_components)
  /// @throws InputError  the file cannot be written
  void write_vti(const problem::Problem<3> &problem, const std::vector<double> &averages,
                 const std::string &file);

  /// Where the nodes of a lattice are: at the centres of its cells, or at the vertices inside it.
  enum class NodePlace
  {
    centres, ///< u is constant on each cell
    vertices ///< u is trilinear on each cell
  };

  /// A problem on a union of boxes in space, as both families of methods have it: one stencil for
  /// all nodes, the constraint on those that are not free. A state has the shape of the BoxNodes.
  class BoxDiscretisation : public DiscretisationInSpace, public HasLinearEquations<3>
  {
  public:
    /// @throws NumericalError  no node is free
    BoxDiscretisation(const problem::Problem<3> &problem, NodePlace nodes,
                      algebra::Stencil stencil);

    std::size_t n_unknowns() const override;

    /// Not possible if a maximal box of free nodes is a single line of nodes along z. For motion()
    /// Ω must be a box.
    bool distribute(const base::Communicator &ranks) override;

    Data data(const problem::Problem<3> &problem) const override;
    LinearEquations<3> equations(const problem::Problem<3> &problem) const override;

    /// @throws NumericalError  the stencil is not symmetric
    std::unique_ptr<algebra::LinearSystem> tangent() const override;

    std::optional<algebra::WaveOperator> waves() const override;
    std::unique_ptr<MotionOf<3>> motion(bool is_lumped) const override;

  protected:
    const geometry::CubeLattice &lattice() const { return lattice_; }
    const algebra::Stencil &stencil() const { return stencil_; }

  private:
    /// Row i states the equation at node i; else rows are tested by shape functions.
    virtual bool is_collocated() const = 0;

    /// The mass matrix of density 1.
    virtual algebra::Stencil mass_stencil() const = 0;

    /// Along an axis: what tests a load at the node with this coordinate, the load's value there or
    /// a shape function.
    virtual physics::AxisFunctional load_functional(double coordinate) const = 0;

    double coordinate(unsigned int axis, int position) const;
    dealii::Point<3> place(const std::array<int, 3> &position) const;

    /// The nodes of this rank.
    geometry::CubeRange own_nodes() const;

    /// A field by the method's own test functions at the nodes of this rank, 0 where they are not
    /// free.
    Vector tested(const problem::Field<3> &field) const;

    /// The constraint within a margin around the nodes, 0 where they are free or Ω is far away:
    /// shape (n_components, n[2] + 2 margin, n[1] + 2 margin, n[0] + 2 margin).
    std::vector<double> constraint_values(const problem::Problem<3> &problem, int margin) const;

    std::vector<dealii::Point<3>> free_points() const;

    geometry::CubeLattice lattice_;
    NodePlace node_place_;
    geometry::BoxNodes nodes_; ///< of all ranks
    base::Slabs cell_slabs_;   ///< one slab, unless they are distributed
    base::Slabs node_slabs_;
    unsigned int n_components_;
    algebra::Stencil stencil_;
    algebra::OperatorBackend backend_;
  };
} // namespace plumbline::method
