#pragma once

#include "algebra/linear_system.h"
#include "method/diagnostics.h"
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
  };

  /// Averages over the cells as VTK image data in 64-bit floating point.
  /// @param averages  shape (n_cells, n_components)
  /// @throws InputError  the file cannot be written
  void write_vti(const problem::Problem<3> &problem, const std::vector<double> &averages,
                 const std::string &file);

  /// Nodes that are alike, n of them along each axis, all free: node (i, j, k) is `offset` + (i, j,
  /// k) cells from the origin of the lattice. The constraint holds at all other nodes around them.
  struct BoxNodes
  {
    std::array<int, 3> n{};
    double offset = 0; ///< along each axis [cells]
  };

  /// A problem on a box in space, as both families of methods have it: one stencil for all nodes. A
  /// state has shape (n_components, n[2], n[1], n[0]).
  class BoxDiscretisation
  {
  public:
    using Vector = algebra::Vector;

    BoxDiscretisation(const problem::Problem<3> &problem, const BoxNodes &nodes,
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

    virtual Diagnostics diagnostics() const = 0;

  protected:
    const geometry::CubeLattice &lattice() const { return lattice_; }
    const BoxNodes &nodes() const { return nodes_; }
    const algebra::Stencil &stencil() const { return stencil_; }

  private:
    /// What tests a load at the nodes of an axis: its value there, or a shape function.
    virtual std::vector<physics::AxisFunctional> load_functionals(unsigned int axis) const = 0;

    /// Over the cells of Ω.
    /// @param values  solution and, around it, the constraint at positions -1 ... n of each axis:
    /// shape (n_components, n[2] + 2, n[1] + 2, n[0] + 2)
    virtual std::vector<double> averages(const std::vector<double> &values) const = 0;

    geometry::CubeLattice lattice_;
    BoxNodes nodes_;
    unsigned int n_components_;
    algebra::Stencil stencil_;
    algebra::OperatorBackend backend_;
  };
} // namespace plumbline::method
