#pragma once

#include "algebra/linear_system.h"
#include "algebra/symbol.h"
#include "method/diagnostics.h"
#include "method/equation_of_motion.h"
#include "problem/in_space.h"

#include <deal.II/lac/vector.h>

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace plumbline::method
{
  /// A solution in space, the same view for both families of methods.
  struct FieldInSpace
  {
    std::vector<dealii::Point<3>> nodes; ///< the method's own free nodes in Ω
    std::vector<double> nodal;           ///< values there, shape (n_nodes, n_components)
    std::vector<double> averages;        ///< over the cells of Ω, shape (n_cells, n_components)
    /// u in the closed domain Ω: trilinear for nodes at vertices; for nodes at centres the value of
    /// a cell that contains x, of either cell on a face between two. Thread-safe.
    std::function<double(const dealii::Point<3> &x, unsigned int component)> value;
  };

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
  class BoxDiscretisation
  {
  public:
    using Vector = algebra::Vector;

    /// @throws NumericalError  no node is free
    BoxDiscretisation(const problem::Problem<3> &problem, NodePlace nodes,
                      algebra::Stencil stencil);
    virtual ~BoxDiscretisation() = default;

    std::size_t n_unknowns() const;

    /// What one case brings: its load less what the constraint adds to the force.
    struct Data
    {
      Vector load;
      std::function<FieldInSpace(const Vector &u)> field;
    };
    Data data(const problem::Problem<3> &problem) const;

    /// @throws NumericalError  the stencil is not symmetric
    std::unique_ptr<algebra::LinearSystem> tangent() const;

    /// M ü = -A u on an unbounded lattice.
    algebra::WaveOperator waves() const;

    /// The semi-discrete equation of motion; it must not outlive this object.
    /// @param is_lumped  Galerkin methods: masses by the scaled diagonal instead of the mass matrix
    std::unique_ptr<MotionOf<3>> motion(bool is_lumped) const;

    virtual Diagnostics diagnostics() const = 0;

  protected:
    const geometry::CubeLattice &lattice() const { return lattice_; }
    const algebra::Stencil &stencil() const { return stencil_; }

  private:
    /// The mass matrix of density 1.
    virtual algebra::Stencil mass_stencil() const = 0;

    /// Along an axis: what tests a load at the node with this coordinate, the load's value there or
    /// a shape function.
    virtual physics::AxisFunctional load_functional(double coordinate) const = 0;

    double coordinate(unsigned int axis, int position) const;
    dealii::Point<3> place(const std::array<int, 3> &position) const;

    /// A field by the method's own test functions, 0 where nodes are not free.
    Vector tested(const problem::Field<3> &field) const;

    /// The constraint within a margin around the nodes, 0 where they are free or Ω is far away:
    /// shape (n_components, n[2] + 2 margin, n[1] + 2 margin, n[0] + 2 margin).
    std::vector<double> constraint_values(const problem::Problem<3> &problem, int margin) const;

    std::vector<dealii::Point<3>> free_points() const;

    geometry::CubeLattice lattice_;
    NodePlace node_place_;
    geometry::BoxNodes nodes_;
    unsigned int n_components_;
    algebra::Stencil stencil_;
    algebra::OperatorBackend backend_;
  };
} // namespace plumbline::method
