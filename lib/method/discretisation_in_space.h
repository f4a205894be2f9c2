#pragma once

#include "algebra/linear_system.h"
#include "algebra/symbol.h"
#include "base/slabs.h"
#include "method/diagnostics.h"
#include "method/equation_of_motion.h"
#include "problem/in_space.h"

#include <deal.II/lac/vector.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace plumbline::method
{
  /// A solution in space, the same view for both families of methods.
  struct FieldInSpace
  {
    std::vector<dealii::Point<3>> nodes; ///< the method's own free nodes in Ω
    std::vector<double> nodal;           ///< values there, shape (n_nodes, n_components)
    std::vector<double> volumes;         ///< of the nodes' cells; empty: all alike [length^3]
    std::vector<double> averages;        ///< over the cells of Ω, shape (n_cells, n_components)
    /// u in the closed domain Ω: trilinear for nodes at vertices; for nodes at centres the value of
    /// a cell that contains x, of either cell on a face between two. Thread-safe;
    /// of distributed discretisations collective instead.
    std::function<double(const dealii::Point<3> &x, unsigned int component)> value;
    /// For nodes at vertices: exact in a cell that contains x; else empty. As value.
    std::function<dealii::Tensor<1, 3>(const dealii::Point<3> &x, unsigned int component)>
        gradient = {};
  };

  /// The planes of cells z = constant of the bounding box of Ω, distributed over ranks. Nodes at
  /// centres of cells have the same slabs, inner vertices those of the cells below them.
  inline base::Slabs slabs_of_cells(const geometry::CubeLattice &lattice,
                                    const base::Communicator &ranks)
  {
    return {ranks, lattice.n_cells()[2]};
  }

  /// The discretisation of a problem in space; the counterpart of Discretisation.
  class DiscretisationInSpace
  {
  public:
    using Vector = algebra::Vector;

    virtual ~DiscretisationInSpace() = default;

    virtual std::size_t n_unknowns() const = 0; ///< of all ranks

    /// Leave to each rank a slab of the planes z = constant: from now on data(), its field and
    /// tangent() are about this rank's slab of the nodes and of the cells, see
    /// slabs_of_cells(). Values at a point are collective then.
    /// @return  false: this discretisation cannot, and each rank has all as before
    /// @note Collective.
    virtual bool distribute(const base::Communicator &ranks)
    {
      (void)ranks;
      return false;
    }

    /// What one case brings: its load less what the constraint adds to the force.
    struct Data
    {
      Vector load;
      std::function<FieldInSpace(const Vector &u)> field;
    };
    virtual Data data(const problem::Problem<3> &problem) const = 0;

    /// @throws NumericalError  it has no solver, e.g. is not symmetric on a lattice
    virtual std::unique_ptr<algebra::LinearSystem> tangent() const = 0;

    /// M ü = -A u on an unbounded lattice; empty where nodes are not all alike.
    virtual std::optional<algebra::WaveOperator> waves() const { return {}; }

    /// The semi-discrete equation of motion, which must not outlive this object; nothing where
    /// motions are not there.
    /// @param is_lumped  Galerkin methods: masses by the scaled diagonal instead of the mass matrix
    virtual std::unique_ptr<MotionOf<3>> motion(bool is_lumped) const
    {
      (void)is_lumped;
      return nullptr;
    }

    virtual Diagnostics diagnostics() const = 0;
  };
} // namespace plumbline::method
