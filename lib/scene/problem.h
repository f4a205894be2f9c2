#pragma once

#include "geometry/vertex_cells.h"
#include "physics/chebyshev.h"
#include "physics/coefficient.h"
#include "physics/kernel.h"
#include "scene/scene.h"

#include <functional>
#include <memory>
#include <optional>

namespace plumbline::scene
{
  /// A field given pointwise, and as a series where it is smooth.
  struct Field
  {
    std::function<double(const dealii::Point<2> &, unsigned int component)> value;
    std::optional<physics::ChebyshevField> series; ///< on the bounding box of Ω
    /// Of a field whose values cost an integral each: the same to 12 digits, by series where they
    /// resolve it. Empty: `value` is cheap, and right wherever it is asked for.
    std::function<double(const dealii::Point<2> &, unsigned int component)> fast = {};
    bool is_smooth_in_cells = false; ///< without a series: Gauss points of a cell see all of it

    bool is_smooth() const { return series || is_smooth_in_cells; }

    /// In Ω.
    double operator()(const dealii::Point<2> &x, unsigned int component) const
    {
      return fast ? fast(x, component) : value(x, component);
    }
  };

  /// Where bonds are broken.
  struct Damage
  {
    std::vector<std::vector<dealii::Point<2>>> cracks; ///< lines that break the bonds across them
    std::string outside; ///< an expression that is positive beyond free surfaces; empty: none
    SurfaceTerms surface_terms = SurfaceTerms::published; ///< of a linear peridynamic solid
    dealii::Point<2> origin = {}; ///< of coordinates, see DomainSection

    bool is_there() const { return !cracks.empty() || !outside.empty(); }
  };

  /// What a scene asks of methods besides its problem.
  struct MethodSettings
  {
    bool nodes_are_vertices = false;   ///< of lattices, with their comparison cells; else centres
    bool loads_are_averages = false;   ///< of meshfree methods: over the cells, not at the nodes
    bool tends_to_local_limit = false; ///< horizon and mesh are refined together, m held fixed
    /// Where m grows from level to level: up to which order the moments of weights must tend to
    /// those of the ball; 0 elsewhere.
    unsigned int ball_order = 0;
    QuadratureSection quadrature = {};
    GeometrySection geometry = {};
    SolverSection solver = {};
  };

  /// One case of a scene at one level: all that a method needs to know, and nothing of other
  /// levels. It stands either on a lattice or on a mesh with the cells of its nodes.
  struct Problem
  {
    std::optional<geometry::Lattice> lattice;
    std::shared_ptr<const geometry::Mesh> mesh;       ///< of Ω and its collar; empty on a lattice
    std::shared_ptr<const geometry::NodeCells> cells; ///< of the nodes; empty on a lattice
    /// Of a body with a free boundary: the lattice of its nodes, which `cells` number by `source`.
    std::optional<geometry::NodeLattice> body;
    std::string mesh_name; ///< as the scene has it, for messages
    double h = 0;          ///< of the level [length]
    physics::Kernel<2> kernel;
    std::optional<physics::Coefficient> coefficient; ///< of the bonds; empty: homogeneous
    std::optional<physics::Dilatation> dilatation;   ///< empty: bonds are all
    unsigned int n_components = 0;
    Field load;                          ///< b on Ω
    Field constraint;                    ///< u in the collar
    std::optional<Field> solution;       ///< the exact nonlocal solution, if known
    std::optional<Field> local_solution; ///< of the local limit, if known and another
    bool is_load_given = false;          ///< else it is manufactured from the solution
    bool is_homogeneous = true;          ///< no constant of the material varies in space
    bool is_periodic = false;            ///< a torus
    unsigned int dimension = 2;          ///< 1: one row of a lattice's cells, fields of x alone
    bool is_floating = false;            ///< a body of which nothing is fixed
    bool has_collar_dilatation = true;   ///< else the dilatation counts as 0 there
    Damage damage = {};
    /// λ and μ of a body with a free boundary; give each thread its own copy.
    std::function<physics::Lame(const dealii::Point<2> &)> lame = {};
    std::optional<physics::DoubleWell> double_well = {}; ///< `kernel` is that of its small strains
    std::function<double(const dealii::Point<2> &)> boundary_function = {}; ///< ω; empty: 1
    MethodSettings settings = {};
    double mesh_seconds = 0;      ///< what making `mesh` (and a body's `cells`) took [CPU s]
    double cells_seconds = 0;     ///< what making the `cells` of nodes took besides [CPU s]
    dealii::Point<2> origin = {}; ///< of coordinates, see DomainSection
    double horizon() const { return kernel.horizon(); }
  };

  /// @param case_index  into ProblemSection::case_names()
  /// @param t           of a scene that moves: its state at this time, the load being the static
  /// one, -F(u) of a manufactured u
  /// @param known_load  of the same case, horizon and time on another level, dear to make again
  /// @param same_place  a problem of the same level: its mesh, nodes and cells are taken, which
  /// would come out the same
  /// @throws InputError  an expression that is not finite somewhere in Ω or its collar, a mesh or
  /// nodes that cannot be used
  Problem make_problem(const Scene &scene, unsigned int case_index, const Level &level,
                       double t = 0, const Field *known_load = nullptr,
                       const Problem *same_place = nullptr);

  /// A problem with the scene that poses it, for whatever makes it again: on other cells, by the
  /// full model.
  struct Case
  {
    const Scene &scene;     ///< outlives it
    unsigned int index = 0; ///< into ProblemSection::case_names()
    Problem problem;

    std::string name() const { return scene.problem.case_names()[index]; }
    Level level() const { return {problem.h, problem.horizon()}; }
  };

  /// @throws as make_problem
  Case make_case(const Scene &scene, unsigned int case_index, const Level &level);

  /// L u of the scene's solution: what its load would be if it were not given.
  /// @pre the case has a solution
  /// @throws NumericalError  when called, as physics::ManufacturedLoad
  std::function<double(const dealii::Point<2> &, unsigned int component)>
  operator_on_solution(const Case &one);
} // namespace plumbline::scene
