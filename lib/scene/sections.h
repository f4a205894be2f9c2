#pragma once

#include "geometry/ball_cell.h"
#include "geometry/lattice.h"
#include "physics/coefficient.h"
#include "physics/kernel.h"
#include "physics/state_based.h"

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace plumbline::scene
{
  // What the sections of a scene file say, named as there. Lengths in the scene's unit of length.

  class MeshFiles;

  /// How Ω and its collar are cut into cells.
  struct MeshSource
  {
    std::string kind; ///< lattice, squares, triangles, a .msh or .geo file, or a deal.II generator
    std::string arguments; ///< of a generator
    std::string inside;    ///< of a generator: an expression, positive in Ω
    std::string map;       ///< of squares and triangles: where their vertices go; empty: they stay

    bool is_lattice() const { return kind == "lattice"; }
    bool is_of_boxes() const { return is_lattice() || kind == "squares" || kind == "triangles"; }
    bool is_file() const;
  };

  struct DomainSection
  {
    geometry::Domain boxes;
    MeshSource mesh;
    std::shared_ptr<MeshFiles> mesh_files; ///< those read so far; copies share them
    std::optional<double> collar;          ///< width; empty: as wide as the ball needs
    /// The boundary is free of traction and families end there; u is given in `fixed` parts of Ω.
    bool is_free_body = false;
    std::vector<geometry::Box> fixed;
    bool is_floating = false; ///< nothing of it is fixed: it can be measured, not solved for
    /// Lines that break the bonds across them, and an expression that is positive beyond free
    /// surfaces; empty: none.
    std::vector<std::vector<dealii::Point<2>>> cracks;
    std::string outside;

    bool is_damaged() const { return !cracks.empty() || !outside.empty(); }
  };

  /// A named field to solve for, or a named load.
  struct Case
  {
    std::string name, expression;
  };

  struct KernelSection
  {
    std::string type, limit;
    std::vector<physics::PowerTerm> profile;
    physics::Structure structure = physics::Structure::scalar;
    double bulk_modulus = 1, constant = 1;
    std::string coefficient;     ///< an expression; empty: homogeneous, or by materials
    std::vector<Case> materials; ///< a coefficient for each group of the mesh, or empty
    physics::Mean symmetrisation = physics::Mean::arithmetic;
  };

  /// The solid of a state-based model.
  struct MaterialSection
  {
    std::string model = "bond-based"; ///< bond-based (none of its own), LPS or variational
    physics::PlaneState plane = physics::PlaneState::strain;
    std::array<std::string, 2> keys;        ///< E and nu, lambda and mu, or k and l
    std::array<std::string, 2> expressions; ///< in x and y
    bool is_homogeneous = true;             ///< neither x nor y is in them
    bool has_collar_dilatation = true;      ///< else θ counts as 0 there: wrong, to be shown

    bool is_state_based() const { return model != "bond-based"; }

    /// λ and μ as a function of the place. Copies share nothing: give each thread its own.
    /// @throws InputError  (the function) constants of no solid, naming keys and place
    std::function<physics::Lame(const dealii::Point<2> &)> lame() const;
  };

  struct ProblemSection
  {
    std::vector<Case> solutions; ///< exact nonlocal solutions, empty if not known
    std::vector<Case> loads;     ///< empty: manufactured from the solutions
    std::string constraint;      ///< "solution" or an expression
    std::string local_solution;  ///< "solution", "none", "computed" or an expression

    /// The names of its cases: of the solutions, or of the loads.
    std::vector<std::string> case_names() const;
  };

  /// Where meshfree nodes are.
  struct NodeSource
  {
    std::string kind;        ///< centres, vertices, mesh (centroids of its cells), or a .csv file
    double perturbation = 0; ///< of centres, by up to so many h in x and in y

    bool are_vertices() const { return kind == "vertices"; }
  };

  struct MethodsSection
  {
    std::vector<std::string> names;
    NodeSource nodes;
    bool loads_are_averages = false; ///< meshfree: over the cells, not at the nodes
  };

  /// How a sweep refines.
  enum class Regime
  {
    m,       ///< horizon fixed, h → 0: towards the nonlocal solution
    delta,   ///< m = horizon / h fixed, h → 0: towards the local limit; decides asymptotic
             ///< compatibility
    delta_m, ///< horizon → 0 and m → ∞ together
    horizon  ///< h fixed, horizon varies: how errors depend on the horizon
  };

  struct Level
  {
    double h = 0, horizon = 0; ///< [length]
  };

  /// Levels from coarse to fine with what is held fixed as name, e.g. "m = 3".
  struct Series
  {
    std::string name;
    std::vector<Level> levels;
  };

  struct StudySection
  {
    Regime regime = Regime::delta;
    std::vector<Series> series;
    std::vector<std::string> norms;
    std::string decisive_error; ///< "norm | target"
  };

  struct ReferenceSection
  {
    std::string method;   ///< its name, or "none"
    std::string estimate; ///< automatic, every, reference or none: which solutions get one
    double tolerance = 0; ///< relative; 0: only reported
  };

  struct QuadratureSection
  {
    bool exact_rectangles = true; ///< axis-aligned rectangles by correlation, not by quadrature
    double tolerance = 1e-4;      ///< relative, of the solution
    unsigned int max_refinements = 4;
  };

  struct GeometrySection
  {
    geometry::Backend backend = geometry::Backend::fast;
    unsigned int n_checks = 24, seed = 1;
  };

  struct SolverSection
  {
    std::string operator_backend, linear_solver, iteration;
    bool is_full_model = false; ///< see full_model()
    bool is_mixed = false;      ///< dilatations are unknowns of the scattered nodes besides u
    double tolerance = 1e-12;
    unsigned int max_iterations = 1000;
  };

  struct OutputSection
  {
    bool fields = false;
  };

  /// One expectation: which method (and case, and series, if given), and what is expected of it.
  struct Expected
  {
    std::string method, problem, series; ///< empty: all
    std::string text;                    ///< as in the scene, for reports
    std::vector<double> values;
    std::string verdict;
  };

  struct ExpectedSection
  {
    std::vector<Expected> verdicts, errors, rates, bounds;
    std::vector<Expected> monotone;  ///< verdicts: yes or no
    std::vector<Expected> jitter;    ///< values: least, most
    std::vector<Expected> stability; ///< of `plumbline stability`
    double error_tolerance = 5e-4, rate_tolerance = .1;
  };
} // namespace plumbline::scene
