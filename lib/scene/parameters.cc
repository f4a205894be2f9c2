#include "scene/parameters.h"

#include "base/error.h"
#include "base/text_file.h"

#include <algorithm>
#include <limits>
#include <sstream>

namespace plumbline::scene
{
  namespace
  {
    namespace Patterns = dealii::Patterns;

    /// What a key may be, for deal.II and in words.
    struct Allowed
    {
      std::shared_ptr<Patterns::PatternBase> pattern;
      std::string words;
    };

    struct Key
    {
      std::string section, name, value;
      Allowed allowed;
      std::string help;
    };

    std::string in_words(double value)
    {
      std::ostringstream text;
      text << value;
      return text.str();
    }

    Allowed text()
    {
      return {std::make_shared<Patterns::Anything>(), "any text"};
    }
    Allowed one_of(const std::string &names)
    {
      std::string list;
      for (const char c : names)
        list += c == '|' ? std::string(", ") : std::string(1, c);
      return {std::make_shared<Patterns::Selection>(names), "one of " + list};
    }
    Allowed yes_or_no()
    {
      return {std::make_shared<Patterns::Bool>(), "true or false"};
    }
    Allowed count(int lowest, int highest = std::numeric_limits<int>::max())
    {
      return {std::make_shared<Patterns::Integer>(lowest, highest),
              "a whole number from " + std::to_string(lowest) + " to " + std::to_string(highest)};
    }
    Allowed number()
    {
      return {std::make_shared<Patterns::Double>(), "a number such as 0.5 or 1e-3"};
    }
    Allowed positive()
    {
      return {std::make_shared<Patterns::Double>(1e-300), "a number above 0 such as 0.5 or 1e-3"};
    }
    Allowed between(double lowest, double highest)
    {
      return {std::make_shared<Patterns::Double>(lowest, highest),
              "a number from " + in_words(lowest) + " to " + in_words(highest)};
    }

    std::string kernel_names()
    {
      std::string names;
      for (const physics::KernelType &type : physics::kernel_types())
        names += (names.empty() ? "" : "|") + type.name;
      return names;
    }

    const std::vector<Key> &keys()
    {
      static const std::vector<Key> table = {
          {"", "Purpose", "", text(), "What the scene is for, in one line."},

          {"Domain", "boxes", "0, 0 : 1, 1", text(),
           "The domain Omega: boxes 'x0, y0 : x1, y1' separated by ';'. Every side must be a "
           "multiple "
           "of each mesh size from the others. [length]"},
          {"Domain", "holes", "", text(), "Boxes to take out again, written like boxes. [length]"},
          {"Domain", "mesh", "lattice", text(),
           "lattice: the boxes in uniform squares, one stencil for all. squares, triangles: the "
           "same "
           "as a mesh with entries of its own. A file .msh, or .geo with the constants h and "
           "delta, "
           "and physical surfaces omega... and collar...; or one of deal.II's generators by name, "
           "e.g. hyper_ball_balanced. gmsh meshes .geo files as a process of its own with limits "
           "(120 CPU seconds, 4 GiB; the environment's PLUMBLINE_GMSH_SECONDS and "
           "PLUMBLINE_GMSH_GIBIBYTES change them); commands that start programs or write files "
           "(SystemCall, Save, Print, Plugin, ...) are refused."},
          {"Domain", "arguments", "", text(),
           "Of a generator, as deal.II takes them, e.g. '0, 0 : 1'. Its cells must reach over the "
           "collar."},
          {"Domain", "inside", "", text(),
           "Of a generator: an expression in x, y and delta that is positive in Omega, e.g. "
           "'(1 - delta)^2 - x^2 - y^2'."},
          {"Domain", "map", "", text(),
           "Of squares and triangles: where their vertices go, 'x, y' as expressions; e.g. "
           "'sign(x)*abs(x)^1.5, y' grades the mesh. Empty: they stay."},
          {"Domain", "collar", "auto", text(),
           "Width of the interaction collar where the volume constraint gives u: auto, or a width "
           "of "
           "at least the largest horizon. [length]"},

          {"Domain", "boundary", "constrained", one_of("constrained|free"),
           "constrained: u is given all around Omega, in its collar. free: no collar; families end "
           "at the boundary, and u is given in Domain/fixed (Material/model = variational). The "
           "body is one box (Domain/mesh = lattice), or whatever the cells of a mesh cover; they "
           "cut the squares about the nodes, which are hZ^2 where no boxes set them."},
          {"Domain", "fixed", "", text(),
           "Boxes where u is given in a free body, written like boxes: of nodes whose cell shares "
           "area with them, of mesh cells whose centroid is in them. none: the "
           "body can move as a whole; 'plumbline stability' measures it, and run refuses it. "
           "[length]"},
          {"Domain", "cracks", "", text(),
           "Cracks as lines 'x0, y0 : x1, y1', with more points where they bend, separated by ';'. "
           "Bonds across them are broken, their faces free of traction (Material/model = LPS). "
           "[length]"},
          {"Domain", "outside", "", text(),
           "An expression in x, y and delta that is positive beyond free surfaces: nodes of the "
           "collar there carry no data (Material/model = LPS)."},

          {"Kernel", "type", "linear-decay", one_of(kernel_names()),
           "Radial profile of the kernel, scalar or bond tensor; see 'plumbline list kernels'."},
          {"Kernel", "limit", "-1/2 Laplace", one_of("-1/2 Laplace|-Laplace|Navier|none"),
           "The local operator that the kernel is scaled to as the horizon tends to 0: -1/2 "
           "Laplace "
           "(the moment of xi_1^2 is 1), -Laplace, Navier with 'bulk modulus' (bond tensors), or "
           "none: "
           "'constant' is taken as it is."},
          {"Kernel", "bulk modulus", "1", positive(),
           "kappa of bond tensors; lambda = mu = 3 kappa / 5 (plane strain). [force/length^2]"},
          {"Kernel", "constant", "1", number(), "The factor c where limit = none."},
          {"Kernel", "coefficients", "", text(),
           "a_0, a_1, ... of the profile p(t) = a_0 + a_1 t + ..., t = r / horizon, of polynomial "
           "kernels."},
          {"Kernel", "singularity", "0", count(0, 1), "a of the polynomial profile p(t) / t^a."},
          {"Kernel", "coefficient", "", text(),
           "a > 0 of a kernel a C: an expression in x and y. Empty: homogeneous. Needs a mesh."},
          {"Kernel", "materials", "", text(),
           "The same by the physical surfaces of a gmsh file: 'omega_steel: 5; omega_resin: 1; "
           "collar: "
           "1', a positive number for each."},
          {"Kernel", "symmetrisation", "arithmetic", one_of("arithmetic|harmonic"),
           "The mean of the coefficients at both ends of a bond."},

          {"Material", "model", "bond-based", one_of("bond-based|LPS|variational"),
           "bond-based: the kernel is all. LPS: the linear peridynamic solid, with harmonic means "
           "of lambda and of mu at both ends of a bond. variational: constants at one point. Both "
           "take Kernel/type as their influence function, with Kernel/limit = Navier."},
          {"Material", "plane", "strain", one_of("strain|stress"),
           "Plane strain or plane stress, for E and nu."},
          {"Material", "E", "", text(),
           "Young's modulus > 0, an expression in x and y. [force/length^2]"},
          {"Material", "nu", "", text(), "Poisson's ratio, -1 < nu < 1/2, given with E."},
          {"Material", "lambda", "", text(),
           "Lame's first constant in the plane, instead of E and nu. [force/length^2]"},
          {"Material", "mu", "", text(),
           "The shear modulus > 0, given with lambda, which is > -mu. [force/length^2]"},
          {"Material", "collar dilatation", "from data", one_of("from data|zero"),
           "theta in the collar, of state-based solids on scattered nodes: from data, or zero, "
           "which is wrong and there to show by how much."},
          {"Material", "k", "", text(),
           "lambda + mu > 0 of the variational model, instead. [force/length^2]"},
          {"Material", "l", "", text(), "8 mu > 0, given with k. [force/length^2]"},

          {"Problem", "solution", "", text(),
           "The exact nonlocal solution: a muParser expression in x, y and delta (the horizon), "
           "components separated by ','; several cases as 'name: expression; name: expression'. "
           "Empty: not known."},
          {"Problem", "load", "manufactured", text(),
           "The body load b: manufactured (the nonlocal operator applied to the solution), or "
           "expressions written like the solution."},
          {"Problem", "constraint", "solution", text(),
           "u in the collar: solution, or an expression. Taken at nodes: DGQ0 and DGP0 hold its "
           "value "
           "at the centre of each cell, as one-point rules do, not its average."},
          {"Problem", "local solution", "solution", text(),
           "The solution of the local limit: solution (where it does not depend on the horizon), "
           "none, computed (by classical finite elements; needs a mesh), or an expression."},

          {"Methods", "names", "", text(),
           "Methods to compare, separated by ','; 'all' takes those that can do the scene. See "
           "'plumbline list methods'."},
          {"Methods", "nodes", "centres", text(),
           "Meshfree nodes: centres of lattice cells, vertices (of a lattice, the boundary among "
           "the "
           "data), mesh (centroids of its cells), or a file .csv with columns x and y. On meshes "
           "their cells are Voronoi cells."},
          {"Methods", "perturbation", "0", between(0, .49),
           "Centres are moved at random by up to so many h in x and in y (Geometry/seed). Needs a "
           "mesh."},

          {"Methods", "load", "nodes", one_of("nodes|cells"),
           "Meshfree right-hand sides: the load at the nodes, or its averages over their cells."},

          {"Study", "regime", "delta", one_of("m|delta|delta-m|horizon"),
           "m: horizon fixed, h to 0. delta: m = horizon / h fixed, h to 0 (decides asymptotic "
           "compatibility). delta-m: pairs of h and m. horizon: h fixed, horizon varies."},
          {"Study", "h", "0.1, 0.05, 0.025, 0.0125", text(),
           "Mesh sizes, separated by ',', coarse to fine. [length]"},
          {"Study", "m", "3", text(), "Ratios horizon / h, real numbers >= 1 (delta, delta-m)."},
          {"Study", "horizon", "0.4", text(), "Horizons (m, horizon). [length]"},
          {"Study", "norms", "nodal Linf, averages L2, field L2", text(),
           "Of nodal Linf, nodal L2 (at the method's own nodes, which all count alike: "
           "sqrt(area * mean e^2)), averages Linf, averages L2 (cell averages of the solution; "
           "each "
           "counts by its area), field Linf, field L2 (of the function), separated by ','."},
          {"Study", "decisive error", "nodal Linf | exact", text(),
           "The 'norm | target' that verdicts rest on; targets: exact, local, reference."},

          {"Reference", "method", "none", text(),
           "Galerkin method whose cell averages are the reference: none, Q1, Q2, Q3, ..."},
          {"Reference", "estimate", "automatic", one_of("automatic|every|reference|none"),
           "Whose error is estimated by outer quadrature, h/2, 2h and degree p+1: of the "
           "reference, of "
           "every Galerkin solution, or of none. automatic: of the reference, and where there is "
           "neither one nor an exact solution of every Galerkin solution."},
          {"Reference", "tolerance", "0", between(0, 1),
           "Largest estimate of the reference's own error, relative to the solution; where it is "
           "not "
           "met the run ends with exit code 3. 0: the estimate is only reported."},

          {"Quadrature", "rectangles", "correlation", one_of("correlation|quadrature"),
           "Entries of axis-aligned rectangles of a mesh: exact by correlation, or by quadrature "
           "as "
           "all other cells."},
          {"Quadrature", "tolerance", "1e-4", between(0, 1),
           "Outer quadrature on meshes is refined until the solution changes by less, relative to "
           "it. 0: the first rule is taken as it is, and nothing is known of its error."},
          {"Quadrature", "max refinements", "4", count(0, 8),
           "Most refinements; where the tolerance is not met by then the run ends with exit code "
           "3."},

          {"Geometry", "backend", "fast", one_of("fast|cgal"),
           "Who intersects balls and cells: fast (double precision) or cgal (exact circular "
           "kernel)."},
          {"Geometry", "checks", "24", count(0, 100000),
           "Cut cells of each reference that are recomputed with the exact backend, some 0.1 ms "
           "each."},
          {"Geometry", "seed", "1", count(0), "Seed of the sample of checked cells."},

          {"Solver", "operator", "automatic", one_of("automatic|fft|direct|sparse"),
           "How the operator is applied: by Fourier transforms, by the shared stencil, by a sparse "
           "Trilinos matrix, or whichever of the first two is faster."},
          {"Solver", "model", "smallest", one_of("smallest|full"),
           "smallest: no more than the scene needs. full: a mesh and sparse matrices where a "
           "lattice and a stencil would do, the dilatation also where lambda = mu; same numbers, "
           "to show that nothing is missed."},
          {"Solver", "linear solver", "automatic", one_of("automatic|direct|amg|jacobi"),
           "Of sparse systems, on meshes and scattered nodes: direct, or iterations with algebraic "
           "multigrid or Jacobi."},
          {"Solver", "iteration", "automatic", one_of("automatic|cg|gmres|bicgstab"),
           "What iterates: automatic (cg where the operator is symmetric, else gmres), cg "
           "(conjugate gradients, refused where it is not), gmres or bicgstab (for sparse "
           "systems)."},
          {"Solver", "dilatation", "eliminated", one_of("eliminated|kept"),
           "Of state-based solids on scattered nodes: eliminated, or kept as unknowns besides u, "
           "for half the memory; amg is multigrid of the rest of the system then. Both yield the "
           "same u."},
          {"Solver", "tolerance", "1e-12", between(1e-15, 1e-3),
           "Relative residual of the linear system."},
          {"Solver", "max iterations", "1000", count(1), "Most iterations."},

          {"Output", "fields", "false", yes_or_no(),
           "Write the solutions of the finest levels as VTU files."},

          {"Expected", "verdicts", "", text(),
           "'method[, case][, series]: verdict' separated by ';', e.g. 'IPA-AC: not AC; Q1: AC'."},
          {"Expected", "errors", "", text(),
           "'method[, case][, series]: e0 e1 ...', the decisive error at each level."},
          {"Expected", "error tolerance", "5e-4", positive(), "Relative, of Expected/errors."},
          {"Expected", "rates", "", text(),
           "'method[, case][, series]: p', the observed rate between the two finest levels."},
          {"Expected", "rate tolerance", "0.1", positive(), "Absolute, of Expected/rates."},
          {"Expected", "bounds", "", text(),
           "'method[, case][, series]: e', the decisive error stays below e at every level."},
          {"Expected", "monotone", "", text(),
           "'method[, case][, series]: yes' or 'no', whether the decisive error falls from every "
           "level to the next."},
          {"Expected", "jitter", "", text(),
           "'method[, case][, series]: least most', bounds of the sum of all rises of the decisive "
           "error from a level to the next, over its first value; 0 where it falls throughout."},
          {"Expected", "stability", "", text(),
           "'method: stable', 'conditionally stable' or 'unstable', of 'plumbline stability'."},
      };
      return table;
    }

    std::string path(const Key &key)
    {
      return key.section.empty() ? key.name : key.section + "/" + key.name;
    }

    const Key &find(const std::string &name)
    {
      for (const Key &key : keys())
        if (path(key) == name)
          return key;
      const std::string section = name.substr(0, name.find('/'));
      std::string similar, every;
      for (const Key &key : keys())
      {
        every += (every.empty() ? "" : ", ") + path(key);
        if (key.section == section || key.name == name)
          similar += (similar.empty() ? "" : ", ") + path(key);
      }
      throw InputError("key '" + name +
                       "' is not known; write one of: " + (similar.empty() ? every : similar));
    }

    std::string help_of(const Key &key)
    {
      return path(key) + "\n  " + key.help +
             "\n  default: " + (key.value.empty() ? "(empty)" : key.value) +
             "\n  allowed: " + key.allowed.words + "\n";
    }
  } // namespace

  void declare(dealii::ParameterHandler &parameters)
  {
    for (const Key &key : keys())
    {
      if (!key.section.empty())
        parameters.enter_subsection(key.section);
      parameters.declare_entry(key.name, key.value, *key.allowed.pattern, key.help);
      if (!key.section.empty())
        parameters.leave_subsection();
    }
  }

  std::string get(dealii::ParameterHandler &parameters, const std::string &name)
  {
    const Key &key = find(name);
    if (key.section.empty())
      return parameters.get(key.name);
    return parameters.get({key.section}, key.name);
  }

  void set(dealii::ParameterHandler &parameters, const std::string &name, const std::string &value)
  {
    const Key &key = find(name);
    const bool is_text =
        std::none_of(value.begin(), value.end(),
                     [](unsigned char c) { return c == '#' || c == 127 || (c < 32 && c != '\t'); });
    if (!is_text || (!value.empty() && value.back() == '\\'))
      throw InputError(
          name + " = '" + base::shown(value) +
          "' cannot be written in a scene: '#' begins a comment, a '\\' at the end "
          "continues the line; take them, line breaks and other control characters out");
    if (!key.allowed.pattern->match(value))
      throw InputError(name + " = '" + base::shown(value) + "' is not allowed; write " +
                       key.allowed.words + ", or take the key out: its default is '" + key.value +
                       "'");
    if (!key.section.empty())
      parameters.enter_subsection(key.section);
    parameters.set(key.name, value);
    if (!key.section.empty())
      parameters.leave_subsection();
  }

  std::string describe(const std::string &name)
  {
    std::string result;
    for (const Key &key : keys())
      if (key.section == name)
        result += help_of(key);
    return result.empty() ? help_of(find(name)) : result;
  }
} // namespace plumbline::scene
