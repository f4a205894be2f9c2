#pragma once

#include "base/communicator.h"
#include "method/capabilities.h"
#include "method/method_family.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace plumbline::method
{
  class DiscretisationInSpace;
  class ContinuousMotion;
  class Discretisation;
  class DynamicFractureSolver;
  class FractureSolver;
  class StripSolver;

  /// How large a problem is, which can be known before anything of it is made.
  struct ProblemSize
  {
    problem::Level level;
    std::array<double, 2> extents{}; ///< of Ω's bounding box on a lattice [cells]
    double depth = 0;                ///< of a box in space along its third axis [cells]
    double n_cells = 0, n_free = 0;  ///< of a mesh with its collar, and in Ω
    double cell_area = 0;            ///< of a mesh, in the mean [length^2]
    unsigned int n_components = 1;
    bool is_body = false;        ///< with a free boundary
    bool has_factors = false;    ///< of bonds, see problem::GroupFactors
    bool has_dilatation = false; ///< so that bonds are as long as two horizons
    bool is_scattered = false;   ///< meshfree nodes in a box in space that are not its lattice's
    bool is_box = false;         ///< in space: neither a union of boxes nor one with holes

    bool is_lattice() const { return extents[0] > 0; }
    double reach() const { return has_dilatation ? 2 * level.horizon : level.horizon; }
  };

  /// A way to solve scenes, on either side.
  class Method
  {
  public:
    virtual ~Method() = default;
    virtual std::string name() const = 0;
    virtual MethodFamily family() const = 0;
    virtual std::string help() const = 0;

    /// Whether Methods/names = all takes it: not where it is there to show how it fails.
    virtual bool is_in_all() const { return true; }

    /// What a scene may need of it; see study/refusal.h.
    virtual Capabilities can() const { return all_capabilities(); }

    /// What a scene in space may need of it.
    virtual Capabilities can_in_space() const { return can(); }

    /// Empty if the method can do problems in space with this kernel, else the reason, if it is
    /// none of its capabilities.
    /// @param has_dilatation  with a dilatation whose influence function has the kernel's profile
    /// @param is_on_mesh      on the cells of a mesh file
    virtual std::string why_not_in_space(const physics::Kernel<3> &, bool has_dilatation,
                                         bool is_on_mesh) const
    {
      (void)has_dilatation, (void)is_on_mesh;
      return {};
    }

    /// Empty if the method can do the problem, of any case and level, else the reason that is none
    /// of its capabilities.
    virtual std::string why_not(const problem::Problem<2> &) const { return {}; }

    /// Collective over the communicator.
    /// @param problem  must outlive what is made
    /// @throws NumericalError  there is none, e.g. weights are infeasible; @throws InputError  data
    /// that is not finite
    virtual std::unique_ptr<Discretisation>
    discretise(const problem::Problem<2> &problem,
               const base::Communicator &communicator = base::Communicator::all()) const = 0;

    /// The same on a union of boxes in space.
    /// @pre  can() has Capability::space, and why_not_in_space() of the kernel is empty
    virtual std::unique_ptr<DiscretisationInSpace>
    discretise_in_space(const problem::Problem<3> &problem) const;

    /// Null: the method moves no strips whose bonds soften, see dynamic_fracture_solver.h.
    virtual const DynamicFractureSolver *dynamic_fracture_solver() const { return nullptr; }

    /// Null: the method makes no bodies whose bonds can break, see fracture_solver.h.
    virtual const FractureSolver *fracture_solver() const { return nullptr; }

    /// Null: the method solves no strips with a crack, see rice_strip.h.
    virtual const StripSolver *strip_solver() const { return nullptr; }

    /// Double wells on a square torus, or a line that closes, without a mesh, by n points a side;
    /// null: the method knows no such motion.
    virtual std::unique_ptr<ContinuousMotion> continuous_motion(const physics::DoubleWell &law,
                                                                const geometry::Box &torus,
                                                                unsigned int dimension,
                                                                unsigned int n) const;

    /// The most memory that a static solution takes above what stood before (Cost::peak_bytes),
    /// within a factor of 2 where it is more than some 50 MB, for one rank; 0 where it is little.
    /// Not in it: the factors of a direct solver.
    virtual double expected_bytes(const ProblemSize &) const { return 0; }

    /// Whether ranks share its static solution, see DiscretisationInSpace::distribute. A rank takes
    /// the expected_bytes() of its slab then.
    virtual bool is_distributed_in_space(const ProblemSize &) const { return false; }

    /// The rate at which field and averages tend to a smooth solution at a fixed horizon, at least:
    /// p + 1 of Galerkin methods whose kernel is integrable. For error estimates.
    virtual unsigned int order() const { return 1; }

    /// The same method one polynomial degree higher, if it has one: for its error estimate.
    virtual std::shared_ptr<const Method> higher_degree() const { return nullptr; }
  };

  using Methods = std::vector<std::shared_ptr<const Method>>;

  /// The cells that solutions on a lattice are averaged over, one for each meshfree node: the
  /// lattice cells of Ω, or squares around its inner vertices. One family of nodes with the given
  /// number of components.
  geometry::NodeSet comparison_nodes(const problem::Problem<2> &problem, unsigned int n_components);
} // namespace plumbline::method
