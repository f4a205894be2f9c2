#pragma once

#include "geometry/cube_lattice.h"
#include "geometry/node_cells.h"
#include "geometry/tetrahedral_mesh.h"
#include "physics/chebyshev_in_space.h"
#include "physics/coefficient.h"
#include "physics/kernel.h"
#include "problem/problem.h"

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace plumbline::problem
{
  /// A field in space given pointwise, and as a series where it is smooth.
  template <>
  struct Field<3>
  {
    std::function<double(const dealii::Point<3> &, unsigned int component)> value;
    std::optional<physics::ChebyshevInSpace> series = {}; ///< on the bounding box of Ω
    bool is_piecewise = false; ///< no series is looked for: no number of points shows where pieces
                               ///< end

    /// In Ω: by the series where there is one, which is cheap.
    double operator()(const dealii::Point<3> &x, unsigned int component) const;

    /// Products of functionals, shape (n_z, n_y, n_x).
    /// @param is_wanted  of the same shape: whose points are in Ω, others give 0; empty: all
    std::vector<double> apply(unsigned int component, const physics::AxisFunctionals &functionals,
                              const std::vector<char> &is_wanted = {}) const;
  };

  /// Factors of the kernel that are constant in each group of a mesh's cells.
  struct GroupFactors
  {
    std::vector<double> of_group; ///< a > 0
    physics::Mean kind = physics::Mean::arithmetic;

    /// Of bonds between cells of two groups, or of one.
    double between(unsigned int a, unsigned int b) const
    {
      return physics::mean(kind, of_group[a], of_group[b]);
    }
  };

  /// A boundary-value problem in space at one level: a homogeneous material on a union of boxes,
  /// or on the cells of a mesh, with u given all around them; on a mesh bonds may have factors, and
  /// the surface may be free. Fill in what it has, then complete() it.
  template <>
  struct Problem<3>
  {
    geometry::CubeLattice lattice; ///< whose cells solutions are averaged over: they fill Ω; of a
                                   ///< mesh, see geometry::cubes_within
    physics::Kernel<3> kernel;
    unsigned int n_components = kernel.n_components();
    std::optional<physics::Dilatation<3>> dilatation = {}; ///< homogeneous; empty: bonds only
    Field<3> load = {};                          ///< empty: manufactured from the solution
    Field<3> constraint = {};                    ///< around Ω; empty: the solution
    std::optional<Field<3>> solution = {};       ///< the exact nonlocal solution, if known
    std::optional<Field<3>> local_solution = {}; ///< of the local limit, if known and another
    bool is_load_given = true;                   ///< else it is manufactured from the solution
    MethodSettings settings = {};
    /// Ω and a layer at least a horizon wide around it; null: Ω is the lattice's cells.
    std::shared_ptr<const geometry::TetrahedralMesh> mesh = {};
    std::optional<GroupFactors> factors = {}; ///< of bonds, by the mesh's groups; empty: 1
    /// The body ends where the mesh does, and with it all families: u is given in the cells that
    /// are not in Ω alone, which need not surround it.
    bool is_free = false;
    /// Scattered nodes of meshfree methods; null: the centres of the lattice's cells. Galerkin
    /// methods and averages have the lattice all the same.
    std::shared_ptr<const geometry::NodeCells<3>> cells = {};
    /// Without a mesh: makes tetrahedra for Galerkin methods, at least a horizon wide around Ω;
    /// empty: six for each cube of the lattice.
    std::function<geometry::TetrahedralMesh()> make_tetrahedra = {};

    double h() const { return lattice.h(); }
    double horizon() const { return kernel.horizon(); }
    bool is_homogeneous() const { return !factors; }

    /// How far bonds and dilatations reach from a point of Ω [length].
    double reach() const { return dilatation ? 2 * horizon() : horizon(); }
    Level level() const { return {h(), horizon()}; }
  };

  /// The problem with its fields as series where they are smooth, checked on samples.
  /// @throws InputError      neither a load nor a solution; values that are not finite in Ω or
  /// within reach() around it; no load, where bonds have factors or the surface is free
  /// @throws NumericalError  a load that cannot be manufactured, see physics::LoadInSpace
  Problem<3> complete(Problem<3> problem);

  /// The problem on cubes of another size, with the same fields, and tetrahedra of these cubes; on
  /// a mesh with its cells cut into eight as often as h is halved.
  /// @throws InputError  sides that are not multiples of h; a mesh whose h is not halved
  Problem<3> at_spacing(Problem<3> problem, double h);

  /// Of Ω.
  geometry::Cuboid bounding_box(const Problem<3> &problem);

  /// It can be solved with cells of 2 h by all methods.
  bool has_doubled(const Problem<3> &problem);
} // namespace plumbline::problem
