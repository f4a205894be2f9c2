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
  class MeshFiles;

  /// How a sweep refines.
  enum class Regime
  {
    m,       ///< horizon fixed, h → 0: towards the nonlocal solution
    delta,   ///< m = horizon / h fixed, h → 0: towards the local limit; decides asymptotic
             ///< compatibility
    delta_m, ///< horizon → 0 and m → ∞ together
    horizon  ///< h fixed, horizon varies: how errors depend on the horizon
  };

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

  /// Where meshfree nodes are.
  struct NodeSource
  {
    std::string kind;        ///< centres, vertices, mesh (centroids of its cells), or a .csv file
    double perturbation = 0; ///< of centres, by up to so many h in x and in y
  };

  /// The solid of a state-based model.
  struct Material
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

  /// A named field to solve for, or a named load.
  struct Case
  {
    std::string name, expression;
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

  /// One expectation: which method (and case, and series, if given), and what is expected of it.
  struct Expected
  {
    std::string method, problem, series; ///< empty: all
    std::string text;                    ///< as in the scene, for reports
    std::vector<double> values;
    std::string verdict;
  };

  /// Everything a scene file says, checked. Lengths in the scene's unit of length. Numbers, choices
  /// and switches begin as the keys' defaults.
  struct Scene
  {
    std::string name, purpose;
    std::string text; ///< all keys and values; parses to the same scene

    std::string folder; ///< of the scene's file: other files are named from there

    geometry::Domain domain;
    MeshSource mesh;
    std::shared_ptr<MeshFiles> mesh_files; ///< those read so far; copies share them
    std::optional<double> collar;          ///< width; empty: as wide as the ball needs
    /// The boundary is free of traction and families end there; u is given in `fixed` parts of Ω.
    bool is_free_body = false;
    std::vector<geometry::Box> fixed;
    bool is_unheld = false; ///< nothing of it is fixed: it can be measured, not solved for
    /// Lines that break the bonds across them, and an expression that is positive beyond free
    /// surfaces; empty: none.
    std::vector<std::vector<dealii::Point<2>>> cracks;
    std::string outside;
    bool is_damaged() const { return !cracks.empty() || !outside.empty(); }

    std::string kernel_type, limit;
    std::vector<physics::PowerTerm> profile;
    physics::Structure structure = physics::Structure::scalar;
    double bulk_modulus = 1, kernel_constant = 1;
    std::string coefficient;     ///< an expression; empty: homogeneous, or by materials
    std::vector<Case> materials; ///< a coefficient for each group of the mesh, or empty
    Material material;
    bool is_full_model = false; ///< see full_model()
    bool is_homogeneous() const
    {
      return coefficient.empty() && materials.empty() && material.is_homogeneous;
    }
    bool is_vector() const ///< two components
    {
      return structure == physics::Structure::tensor || material.is_state_based();
    }

    /// λ = μ leaves a state-based solid its bonds alone.
    bool has_dilatation() const;

    /// How far from Ω the constraint is needed: the horizon, or twice as far where dilatations of
    /// neighbours count.
    double reach(double horizon) const { return has_dilatation() ? 2 * horizon : horizon; }
    physics::Mean symmetrisation = physics::Mean::arithmetic;

    std::vector<Case> solutions; ///< exact nonlocal solutions, empty if not known
    std::vector<Case> loads;     ///< empty: manufactured from the solutions
    std::string constraint;      ///< "solution" or an expression
    std::string local_solution;  ///< "solution", "none", "computed" or an expression

    std::vector<std::string> methods;
    NodeSource nodes;
    bool loads_are_averages = false; ///< meshfree: over the cells, not at the nodes
    bool nodes_at_vertices() const { return nodes.kind == "vertices"; }

    Regime regime = Regime::delta;
    std::vector<Series> series;
    std::vector<std::string> norms;
    std::string decisive_error; ///< "norm | target"

    std::string reference; ///< a method's name, or "none"
    std::string estimate;  ///< automatic, every, reference or none: which solutions get one
    double reference_tolerance = 0; ///< relative; 0: only reported

    bool exact_rectangles = true;  ///< axis-aligned rectangles by correlation, not by quadrature
    double outer_tolerance = 1e-4; ///< relative, of the solution
    unsigned int max_refinements = 4;

    geometry::Backend backend = geometry::Backend::fast;
    unsigned int n_geometry_checks = 24, seed = 1;

    std::string operator_backend, linear_solver, iteration;
    bool keeps_dilatation = false; ///< as an unknown of each scattered node
    double tolerance = 1e-12;
    unsigned int max_iterations = 1000;

    bool write_fields = false;

    std::vector<Expected> expected_verdicts, expected_errors, expected_rates, expected_bounds;
    std::vector<Expected> expected_monotone;  ///< verdicts: yes or no
    std::vector<Expected> expected_jitter;    ///< values: least, most
    std::vector<Expected> expected_stability; ///< of `plumbline stability`
    double error_tolerance = 5e-4, rate_tolerance = .1;

    /// The names of its cases: of the solutions, or of the loads.
    std::vector<std::string> case_names() const;

    physics::Kernel<2> kernel(double horizon) const;
  };

  /// The same scene with nothing left out, to show that what is left out is not missed.
  Scene full_model(Scene scene);

  /// Section/key = value, given on the command line after the file was read.
  struct Override
  {
    std::string key, value;
  };

  /// @param file  .prm or .json
  /// @throws InputError  file not readable, unknown key, wrong type, or values that do not fit
  /// together
  Scene read_scene(const std::string &file, const std::vector<Override> &overrides = {});

  /// The same from a text in .prm syntax.
  Scene parse_scene(const std::string &name, const std::string &text,
                    const std::vector<Override> &overrides = {});

  /// A whole scene with every key, its default and its meaning, for a model: "scalar", "tensor",
  /// "LPS" or "variational".
  std::string scene_template(const std::string &model);

  /// What a key means, its default and what it allows; for "Section" all its keys.
  /// @throws InputError  unknown key; the message names similar ones
  std::string describe(const std::string &key);
} // namespace plumbline::scene
