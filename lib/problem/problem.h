#pragma once

#include "geometry/vertex_cells.h"
#include "physics/chebyshev.h"
#include "physics/coefficient.h"
#include "physics/double_well.h"
#include "physics/kernel.h"
#include "physics/state_based.h"
#include "problem/level.h"
#include "problem/settings.h"
#include "problem/surface_terms.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace plumbline::problem
{
  /// A field given pointwise, and as a series where it is smooth.
  template <int dim>
  struct Field
  {
    std::function<double(const dealii::Point<dim> &, unsigned int component)> value;
    std::optional<physics::ChebyshevField> series; ///< on the bounding box of Ω
    /// Of a field whose values cost an integral each: the same to 12 digits, by series where they
    /// resolve it. Empty: `value` is cheap, and right wherever it is asked for.
    std::function<double(const dealii::Point<dim> &, unsigned int component)> fast = {};
    bool is_smooth_in_cells = false; ///< without a series: Gauss points of a cell see all of it

    bool is_smooth() const { return series || is_smooth_in_cells; }

    /// In Ω.
    double operator()(const dealii::Point<dim> &x, unsigned int component) const
    {
      return fast ? fast(x, component) : value(x, component);
    }
  };

  /// Where bonds are broken.
  template <int dim>
  struct Damage
  {
    std::vector<std::vector<dealii::Point<dim>>> cracks; ///< lines that break the bonds across them
    std::string outside; ///< an expression that is positive beyond free surfaces; empty: none
    SurfaceTerms surface_terms = SurfaceTerms::published; ///< of a linear peridynamic solid
    dealii::Point<dim> origin = {}; ///< of coordinates, see Problem::origin

    bool is_there() const { return !cracks.empty() || !outside.empty(); }
  };

  /// One boundary-value problem at one level: all that a method needs to know, and nothing of other
  /// levels. It stands either on a lattice or on a mesh with the cells of its nodes.
  template <int dim>
  struct Problem
  {
    std::optional<geometry::Lattice> lattice;
    std::shared_ptr<const geometry::Mesh> mesh;       ///< of Ω and its collar; empty on a lattice
    std::shared_ptr<const geometry::NodeCells> cells; ///< of the nodes; empty on a lattice
    /// Of a body with a free boundary: the lattice of its nodes, which `cells` number by `source`.
    std::optional<geometry::NodeLattice> body;
    std::string mesh_name; ///< for messages
    double h = 0;          ///< of the level [length]
    physics::Kernel<dim> kernel;
    std::optional<physics::Coefficient> coefficient; ///< of the bonds; empty: homogeneous
    std::optional<physics::Dilatation> dilatation;   ///< empty: bonds are all
    unsigned int n_components = 0;
    Field<dim> load;                           ///< b on Ω
    Field<dim> constraint;                    ///< u in the collar
    std::optional<Field<dim>> solution;       ///< the exact nonlocal solution, if known
    std::optional<Field<dim>> local_solution; ///< of the local limit, if known and another
    bool is_load_given = false;          ///< else it is manufactured from the solution
    bool is_homogeneous = true;          ///< no constant of the material varies in space
    bool is_periodic = false;            ///< a torus
    unsigned int dimension = 2;          ///< 1: one row of a lattice's cells, fields of x alone
    bool is_floating = false;            ///< a body of which nothing is fixed
    bool has_collar_dilatation = true;   ///< else the dilatation counts as 0 there
    Damage<dim> damage = {};
    /// λ and μ of a body with a free boundary; give each thread its own copy.
    std::function<physics::Lame(const dealii::Point<dim> &)> lame = {};
    std::optional<physics::DoubleWell> double_well = {}; ///< `kernel` is that of its small strains
    std::function<double(const dealii::Point<dim> &)> boundary_function = {}; ///< ω; empty: 1
    MethodSettings settings = {};
    double mesh_seconds = 0;      ///< what making `mesh` (and a body's `cells`) took [CPU s]
    double cells_seconds = 0;     ///< what making the `cells` of nodes took besides [CPU s]
    dealii::Point<dim> origin = {}; ///< of coordinates: those of domain, cracks, meshes and nodes are relative to it [length]
    double horizon() const { return kernel.horizon(); }
  };
} // namespace plumbline::problem
