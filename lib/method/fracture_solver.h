#pragma once

#include "geometry/ball_cell.h"
#include "geometry/cracks.h"
#include "geometry/node_cells.h"
#include "geometry/of_dimension.h"
#include "method/breakable_body.h"
#include "method/breaking_motion.h"
#include "physics/kernel.h"
#include "physics/state_based.h"
#include "problem/fracture.h"
#include "problem/surface_terms.h"

#include <functional>
#include <memory>
#include <vector>

namespace plumbline::method
{
  /// What a body whose bonds break is made of. In space lines of x and y stand for the surfaces
  /// that they sweep along z through the body, and surface terms are not available.
  template <int dim>
  struct BreakingSolid
  {
    geometry::RegionOf<dim> domain; ///< with its grips
    std::vector<geometry::BoxOf<dim>>
        grips; ///< nodes are constrained whose cell shares area with one of them
    std::vector<geometry::BoxOf<dim>> unbreaking; ///< bonds with an end in them do not break
    std::vector<geometry::Polyline> notch;        ///< what it is cut by from the beginning
    std::function<dealii::Tensor<1, dim>(const dealii::Point<dim> &)>
        constrained; ///< u in the grips at load 1
    /// Dead load at load 1, at free nodes; empty: none. Without surface terms [force/length^dim].
    std::function<dealii::Tensor<1, dim>(const dealii::Point<dim> &)> load = {};
    std::function<physics::Lame(const dealii::Point<dim> &)> material;
    std::function<double(const dealii::Point<dim> &)> toughness; ///< G [force/length]
    /// Published, none or consistent, see meshfree::SurfaceForces; else the forces have an energy.
    problem::SurfaceTerms surface_terms = problem::SurfaceTerms::uncorrected;
    bool takes_least_toughness = false; ///< of a bond: of samples along it; else its ends' mean
    /// A line that bonds across have this G from, across several the smallest.
    struct Interface
    {
      geometry::Polyline line;
      double toughness = 0; ///< [force/length]
    };
    std::vector<Interface> interfaces = {};
    double trapping = 1; ///< G is divided by it for critical stretches, see problem::Criterion
    /// Of scattered nodes, all of them free: the body is the union of the cells instead of the
    /// domain, and nodes in the grips' boxes are constrained; null: a lattice. In the plane.
    std::shared_ptr<const geometry::NodeCells<dim>> cells = {};
  };

  /// What makes bodies whose bonds can break, on the nodes of a lattice or on scattered nodes.
  class FractureSolver
  {
  public:
    virtual ~FractureSolver() = default;

    /// @param influence  ∫K|ξ|² = dim
    /// @param h          of the lattice
    /// @throws InputError  h that does not fit the boxes; grips without a node; G <= 0; a notch
    /// through a node
    /// @throws NumericalError  the body is a mechanism
    virtual BreakableBody<2> breakable_body(const BreakingSolid<2> &solid,
                                            const physics::Kernel<2> &influence, double h,
                                            geometry::Backend backend, problem::Stretch stretch,
                                            problem::GrowthSolver solver) const = 0;
    /// The same in space.
    /// @throws InputError  also: a rule that has no weights in space
    virtual BreakableBody<3> breakable_body(const BreakingSolid<3> &solid,
                                            const physics::Kernel<3> &influence, double h,
                                            geometry::Backend backend, problem::Stretch stretch,
                                            problem::GrowthSolver solver) const = 0;

    /// A body in the plane in motion, on a lattice; `constrained` of the solid is not used.
    /// @throws InputError  as breakable_body
    virtual MovingBody moving_body(const BreakingSolid<2> &solid,
                                   const physics::Kernel<2> &influence, double h,
                                   geometry::Backend backend) const = 0;

    /// Energy of all bonds across an infinite straight line, or a plane in space, each at its limit
    /// of G = 1, per length or area.
    virtual double lattice_toughness(const physics::Kernel<2> &influence, double h,
                                     geometry::Backend backend) const = 0;
    virtual double lattice_toughness(const physics::Kernel<3> &influence, double h,
                                     geometry::Backend backend) const = 0;
  };
} // namespace plumbline::method
