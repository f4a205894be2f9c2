#pragma once

#include "geometry/cube_lattice.h"
#include "geometry/lattice.h"
#include "physics/coefficient.h"
#include "physics/expression.h"
#include "physics/kernel.h"
#include "physics/state_based.h"
#include "physics/well_potential.h"
#include "scene/choices.h"
#include "scene/vocabulary.h"

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace plumbline::scene
{
  class Keys;
  class MeshFiles;
  class Model;

  // What the sections of a scene file say that pose its problem, named as there. Lengths in the
  // scene's unit of length. `declare` binds members to keys, whose defaults they begin with;
  // `complete` follows when all keys are read: it finds what follows from them, and throws
  // InputError if they do not fit together.

  /// How Ω and its collar are cut into cells.
  struct MeshSource
  {
    std::string name = "lattice"; ///< lattice, squares, triangles, a .msh or .geo file, or a
                                  ///< deal.II generator
    std::string arguments;        ///< of a generator
    std::string inside;           ///< of a generator: an expression, positive in Ω
    std::string map;        ///< of squares and triangles: where their vertices go; empty: they stay
    bool is_curved = false; ///< sides of a file's cells follow its curves

    MeshKind kind() const;
    bool is_lattice() const { return kind() == MeshKind::lattice; }
    bool is_of_boxes() const { return base::from_word<MeshKind>(name).has_value(); }
    bool is_file() const { return kind() == MeshKind::file; }
    bool is_msh() const; ///< a file that says its cells, whatever h is
  };

  struct DomainSection
  {
    /// Values of x and y where coordinates count from: those of boxes, cracks, meshes and nodes are
    /// relative to this point, expressions see the scene's. (0, 0) unless Ω is far from there, see
    /// geometry::local_origin; of a .geo file (0, 0) always. [length]
    dealii::Point<2> origin;
    unsigned int dimension = 2; ///< 1: a line, the first axis of the boxes; 3: space
    geometry::Domain boxes;
    geometry::Solid solid; ///< boxes in space, whose corners have three numbers
    MeshSource mesh;
    std::shared_ptr<MeshFiles> mesh_files; ///< those read so far; copies share them
    std::optional<double> collar;          ///< width; empty: as wide as the ball needs
    /// The boundary is free of traction and families end there; u is given in `fixed` parts of Ω.
    bool is_free_body = false;
    bool is_periodic = false; ///< a torus: what leaves the box on one side comes in on the other
    std::vector<geometry::Box> fixed;
    bool is_floating = false; ///< nothing of it is fixed: it can be measured, not solved for
    /// Lines that break the bonds across them, and an expression that is positive beyond free
    /// surfaces; empty: none.
    std::vector<std::vector<dealii::Point<2>>> cracks;
    std::string outside;

    bool is_in_space() const { return dimension == 3; }
    bool is_damaged() const { return !cracks.empty() || !outside.empty(); }

    /// @pre is_in_space()
    /// @throws InputError  as geometry::CubeLattice
    geometry::CubeLattice cubes(double h) const { return {solid, h}; }

    /// The cells of size h: of a line one row of them, whatever the boxes say of y.
    /// @throws InputError  as geometry::Lattice
    geometry::Lattice lattice(double h) const;

    void declare(Keys &keys);

  private:
    void declare_boundary(Keys &keys);
  };

  /// A named field to solve for, or a named load.
  struct NamedExpression
  {
    std::string name, expression;
  };

  struct GroupCoefficient
  {
    std::string group; ///< of the mesh
    double value = 0;
  };

  struct KernelSection
  {
    std::string type = "linear-decay";
    Limit limit = Limit::half_laplace;
    double bulk_modulus = 1, constant = 1;
    std::vector<double> coefficients; ///< of a polynomial
    unsigned int singularity = 0;     ///< of a polynomial
    std::optional<double> width;      ///< of a Gaussian or an exponential, in horizons
    std::string table_file;           ///< of a table: .csv
    physics::RadialProfile profile;   ///< of the type
    physics::Structure structure = physics::Structure::scalar; ///< of the type
    std::string coefficient;                 ///< an expression; empty: homogeneous, or by materials
    std::vector<GroupCoefficient> materials; ///< a coefficient for each group of the mesh, or empty
    physics::Mean symmetrisation = physics::Mean::arithmetic;

    void declare(Keys &keys);
    void complete(const std::string &folder); ///< that the table file's path begins in
  };

  /// The solid of a state-based model, or the bonds with two wells.
  struct MaterialSection
  {
    const Model *model = nullptr; ///< of models(), see models/model.h
    physics::PlaneState plane = physics::PlaneState::strain;
    std::array<std::array<std::string, 2>, 3> given; ///< E and nu, lambda and mu, k and l
    std::array<std::string, 2> keys;                 ///< of the pair that is not empty
    std::array<std::string, 2> expressions;          ///< in x and y
    bool is_homogeneous = true;                      ///< they do not depend on the place
    physics::Names names = {};                       ///< in them, of what is random
    bool has_collar_dilatation = true; ///< else θ counts as 0 there: wrong, to be shown
    SurfaceTerms surface_terms = SurfaceTerms::automatic; ///< never uncorrected
    double c = 1, beta = 1;           ///< of double wells, > 0: f(s) = c g(beta s)
    physics::WellPotential potential; ///< g of double wells
    std::optional<double> toughness;  ///< G_c of double wells, which with E replaces c and beta
    BoundaryFunction boundary_function = BoundaryFunction::one; ///< ω of double wells
    std::string boundary_expression; ///< in x, y and delta, if boundary_function says so

    /// λ and μ as a function of the place. Copies share nothing: give each thread its own.
    /// @throws InputError  (the function) constants of no solid, naming keys and place
    std::function<physics::Lame(const dealii::Point<2> &)> lame() const;

    /// λ = μ of a solid of bonds with Young's modulus E, in one dimension E itself; empty: E is not
    /// given.
    /// @throws InputError  E is not positive or depends on the place, nu is not that of bonds
    std::optional<double> modulus_of_bonds(unsigned int dimension) const;

    void declare(Keys &keys);
    void complete();
  };

  struct ProblemSection
  {
    std::vector<NamedExpression> solutions; ///< exact nonlocal solutions, empty if not known
    std::vector<NamedExpression> loads;     ///< empty: manufactured from the solutions
    std::optional<std::string> constraint;  ///< an expression; empty: the solution
    LocalSolution local_solution = LocalSolution::solution;
    std::string local_expression;

    /// The names of its cases: of the solutions, or of the loads; "u" of a free motion.
    std::vector<std::string> case_names() const;

    void declare(Keys &keys);
  };
} // namespace plumbline::scene
