#include "scene/checks.h"

#include "base/error.h"
#include "physics/expression.h"
#include "scene/values.h"

#include <algorithm>
#include <set>
#include <sstream>

namespace plumbline::scene
{
  using physics::split_outside_brackets;

  namespace
  {
    /// Beyond this ratio a stencil alone takes gigabytes.
    constexpr double most_ratio = 2000;

    /// Coarse to fine and nothing twice: rates and names rest on it.
    void check_order(const Scene &scene)
    {
      const bool is_h = scene.study.regime != Regime::horizon;
      std::set<std::string> names;
      for (const Series &series : scene.study.series)
      {
        if (!names.insert(series.name).second)
          throw InputError("Study: the series '" + series.name +
                           "' comes twice; give each ratio, horizon or mesh size once");
        for (std::size_t i = 1; i < series.levels.size(); ++i)
          if (!(is_h ? series.levels[i].h < series.levels[i - 1].h
                     : series.levels[i].horizon < series.levels[i - 1].horizon))
            throw InputError(std::string(is_h ? "Study/h" : "Study/horizon") +
                             " must run from large to small without repetition (series '" +
                             series.name + "')");
      }
      std::set<std::string> cases;
      for (const std::string &name : scene.problem.case_names())
        if (!cases.insert(name).second)
          throw InputError("Problem: two cases are called '" + name +
                           "'; write 'name: expression; name: expression' with different names");
    }
  } // namespace

  void check_levels(const Scene &scene)
  {
    check_order(scene);
    for (const Series &series : scene.study.series)
      for (const Level &level : series.levels)
      {
        std::ostringstream message;
        if (!(level.h > 0))
          message << "Study/h = " << level.h << " must be a positive length";
        else if (level.horizon > most_ratio * level.h)
          message << "the horizon " << level.horizon << " is " << level.horizon / level.h
                  << " mesh sizes, more than " << most_ratio
                  << "; choose a larger h or a smaller horizon (Study)";
        else if (level.horizon < level.h * (1 - 1e-12))
          message << "the horizon " << level.horizon << " is smaller than the mesh size " << level.h
                  << " (m = " << level.horizon / level.h
                  << "), so a node has no neighbours; use m = horizon / h >= 1 "
                     "(Study/m, Study/horizon, Study/h)";
        else if (scene.domain.collar &&
                 *scene.domain.collar < scene.reach(level.horizon) * (1 - 1e-12))
          message << "Domain/collar = " << *scene.domain.collar << " is thinner than "
                  << (scene.has_dilatation() ? "twice the horizon, which dilatations need, "
                                             : "the horizon ")
                  << scene.reach(level.horizon)
                  << ", so balls would reach points without data; widen it or write auto";
        else
        {
          if (scene.domain.mesh.is_of_boxes())
            (void)geometry::Lattice(scene.domain.boxes, level.h);
          continue;
        }
        throw InputError(message.str());
      }
  }

  void check_kernel_and_problem(const Scene &scene)
  {
    const bool is_tensor = scene.is_vector(), is_state_based = scene.material.is_state_based();
    if (is_state_based &&
        (scene.kernel.structure == physics::Structure::tensor || scene.kernel.limit != "Navier" ||
         !scene.kernel.coefficient.empty() || !scene.kernel.materials.empty()))
      throw InputError("Material/model = " + scene.material.model +
                       " takes Kernel/type as its influence function and its constants from "
                       "Material; write a scalar Kernel/type (1/r, constant, ...), Kernel/limit = "
                       "Navier, and clear Kernel/coefficient and Kernel/materials");
    if (scene.kernel.limit == "Navier" && !is_tensor)
      throw InputError("Kernel/limit = Navier does not fit the scalar kernel '" +
                       scene.kernel.type +
                       "'; choose a bond tensor (Kernel/type) or a Laplace limit");
    if (is_tensor && scene.kernel.limit.find("Laplace") != std::string::npos)
      throw InputError("Kernel/limit = '" + scene.kernel.limit +
                       "' does not fit the bond tensor '" + scene.kernel.type +
                       "'; write Kernel/limit = Navier, or none");
    const unsigned int n_components = is_tensor ? 2 : 1;
    const auto check = [&](const std::string &key, const std::string &expression)
    {
      const physics::Expression parsed(key, expression, {{"delta", 1.}});
      if (parsed.n_components() != n_components)
        throw InputError(key + " = '" + expression + "' has " +
                         std::to_string(parsed.n_components()) + " component(s), but the " +
                         (is_state_based ? "solid"
                          : is_tensor    ? "bond tensor"
                                         : "scalar kernel") +
                         " needs " + std::to_string(n_components) +
                         "; give one expression a component, separated by ','");
    };
    for (const Case &solution : scene.problem.solutions)
      check("Problem/solution", solution.expression);
    for (const Case &load : scene.problem.loads)
      check("Problem/load", load.expression);
    if (scene.problem.constraint != "solution")
      check("Problem/constraint", scene.problem.constraint);
    if (scene.problem.local_solution != "solution" && scene.problem.local_solution != "none" &&
        scene.problem.local_solution != "computed")
      check("Problem/local solution", scene.problem.local_solution);

    if (scene.problem.solutions.empty() && scene.problem.loads.empty())
      throw InputError("Problem/load = manufactured needs Problem/solution; give the solution, or "
                       "the load itself");
    if (scene.problem.solutions.empty() && scene.problem.constraint == "solution")
      throw InputError("Problem/constraint = solution, but Problem/solution is empty; give the "
                       "constraint as an expression");
    if (!scene.problem.loads.empty() && !scene.problem.solutions.empty() &&
        scene.problem.loads.size() != scene.problem.solutions.size())
      throw InputError("Problem/load has " + std::to_string(scene.problem.loads.size()) +
                       " cases and Problem/solution has " +
                       std::to_string(scene.problem.solutions.size()) +
                       "; give one load a solution");
  }

  namespace
  {
    void check_free_body(const Scene &scene)
    {
      const auto needs = [](bool is_good, const std::string &what)
      {
        if (!is_good)
          throw InputError("Domain/boundary = free needs " + what);
      };
      needs(scene.material.model == "variational", "Material/model = variational");
      needs(!scene.domain.mesh.is_lattice() ||
                (scene.domain.boxes.include.size() == 1 && scene.domain.boxes.exclude.empty()),
            "one box (Domain/boxes) without holes where Domain/mesh = lattice; write squares or "
            "triangles for several boxes, a .geo or .msh file for any other shape");
      needs(
          !scene.domain.fixed.empty() || scene.domain.is_floating,
          "a part where u is given, or the body can move as a whole (3 rigid modes in the plane); "
          "give Domain/fixed");
      needs(scene.methods.nodes.kind == "vertices", "Methods/nodes = vertices");
      needs(scene.problem.solutions.empty() && !scene.problem.loads.empty(),
            "Problem/load and Problem/constraint as expressions, Problem/solution empty");
      needs(!scene.domain.collar, "Domain/collar = auto: there is none");
      if (!scene.domain.mesh.is_of_boxes() || !scene.domain.mesh.map.empty())
        return; // fixed boxes may cut the cells
      for (const Series &series : scene.study.series)
        for (const Level &level : series.levels)
        {
          geometry::Domain both = scene.domain.boxes;
          both.include.insert(both.include.end(), scene.domain.fixed.begin(),
                              scene.domain.fixed.end());
          (void)geometry::Lattice(both, level.h);
        }
    }
  } // namespace

  void check_mesh_and_nodes(const Scene &scene)
  {
    const MeshSource &mesh = scene.domain.mesh;
    const auto needs = [&](bool is_good, const std::string &what, const std::string &remedy)
    {
      if (!is_good)
        throw InputError(what + " with Domain/mesh = " + mesh.kind + ": " + remedy);
    };
    const std::string mesh_remedy = "a lattice is uniform; write Domain/mesh = squares, triangles, "
                                    "a .msh or .geo file, or a generator";
    const bool is_generator = !mesh.is_of_boxes() && !mesh.is_file();
    needs(mesh.map.empty() || mesh.kind == "squares" || mesh.kind == "triangles",
          "Domain/map is given", "maps move squares and triangles; clear it or choose one of them");
    needs(is_generator || (mesh.arguments.empty() && mesh.inside.empty()),
          "Domain/arguments or Domain/inside is given",
          "they belong to deal.II's generators; clear them");
    needs(
        !is_generator || !mesh.inside.empty() || scene.domain.is_free_body,
        "Domain/inside is empty",
        "lattice, squares, triangles and files .msh or .geo do without, any other name is a "
        "generator of deal.II; tell which of its cells are in Omega, the others being the collar, "
        "by an expression that is positive there");
    needs(!mesh.is_lattice() || scene.kernel.coefficient.empty(),
          "Kernel/coefficient = '" + scene.kernel.coefficient + "'", mesh_remedy);
    needs(!mesh.is_lattice() || scene.domain.is_free_body || scene.material.is_homogeneous,
          "Material/" + scene.material.keys[0] + " or " + scene.material.keys[1] +
              " varies in space",
          mesh_remedy);
    needs(!mesh.is_lattice() || scene.methods.nodes.perturbation == 0, "Methods/perturbation > 0",
          mesh_remedy);
    needs(!mesh.is_lattice() || scene.problem.local_solution != "computed",
          "Problem/local solution = computed", mesh_remedy);
    if (scene.problem.local_solution == "computed" &&
        (scene.domain.is_free_body || scene.domain.is_damaged()))
      throw InputError("Problem/local solution = computed needs u all around a domain without "
                       "cracks and free surfaces; write none, or an expression");
    needs(mesh.is_lattice() || !scene.domain.collar, "Domain/collar is given",
          "a mesh has the collar it has, and is checked; write Domain/collar = auto");
    needs(mesh.is_lattice() || scene.domain.is_free_body ||
              scene.solver.operator_backend == "automatic",
          "Solver/operator = " + scene.solver.operator_backend,
          "operators on meshes are sparse matrices; write automatic");
    needs(mesh.is_of_boxes() || scene.domain.boxes.exclude.empty(), "Domain/holes is given",
          "holes are for boxes; cut them out of the mesh itself");
    if (scene.domain.is_free_body)
      check_free_body(scene);
    else if (!scene.domain.fixed.empty() || scene.domain.is_floating)
      throw InputError("Domain/fixed is given, but u is given in the collar all around; write "
                       "Domain/boundary = free, or clear it");
    if (!scene.material.has_collar_dilatation &&
        (!scene.has_dilatation() || mesh.is_lattice() || scene.domain.is_free_body))
      throw InputError("Material/collar dilatation = zero needs a state-based solid with lambda != "
                       "mu on scattered nodes with a collar; write from data, or Material/model = "
                       "LPS with Domain/mesh = squares");
    if (scene.domain.is_damaged() && scene.material.model != "LPS")
      throw InputError("Domain/cracks and Domain/outside need Material/model = LPS, whose free "
                       "surfaces they make; choose it, or clear them");
    needs(!mesh.is_lattice() || !scene.domain.is_damaged(),
          "Domain/cracks or Domain/outside is given", mesh_remedy);
    if (scene.methods.loads_are_averages && !scene.domain.is_free_body)
      throw InputError("Methods/load = cells is for free bodies; write nodes, or Domain/boundary = "
                       "free");
    const std::string &nodes = scene.methods.nodes.kind;
    const bool is_csv = nodes.size() > 4 && nodes.substr(nodes.size() - 4) == ".csv";
    if (nodes != "centres" && nodes != "vertices" && nodes != "mesh" && !is_csv)
      throw InputError("Methods/nodes = '" + nodes +
                       "' is not known; write centres, vertices, mesh, or a file .csv");
    needs(!mesh.is_lattice() || nodes == "centres" || nodes == "vertices",
          "Methods/nodes = " + nodes, mesh_remedy);
    needs((mesh.is_of_boxes() && mesh.map.empty()) || scene.domain.is_free_body ||
              nodes != "vertices",
          "Methods/nodes = vertices",
          "vertices are those of the boxes; write centres, mesh, or a file .csv");
    if (scene.methods.nodes.perturbation > 0 && nodes != "centres")
      throw InputError("Methods/perturbation moves centres, but Methods/nodes = " + nodes +
                       "; write Methods/nodes = centres, or set the perturbation to 0");
    const auto expression = [&](const std::string &key, const std::string &text, unsigned int n)
    {
      const physics::Expression parsed(key, text, {{"delta", 1.}});
      if (!text.empty() && parsed.n_components() != n)
        throw InputError(key + " = '" + text + "' has " + std::to_string(parsed.n_components()) +
                         " component(s), not " + std::to_string(n));
    };
    needs(scene.kernel.materials.empty() || mesh.is_file(), "Kernel/materials is given",
          "materials are the physical surfaces of a .msh or .geo file; write Kernel/coefficient");
    if (!scene.kernel.materials.empty() && !scene.kernel.coefficient.empty())
      throw InputError("Kernel/materials and Kernel/coefficient are both given; clear one of them");
    if (!scene.kernel.coefficient.empty())
      expression("Kernel/coefficient", scene.kernel.coefficient, 1);
    if (!mesh.inside.empty())
      expression("Domain/inside", mesh.inside, 1);
    if (!scene.domain.outside.empty())
      expression("Domain/outside", scene.domain.outside, 1);
    if (!mesh.map.empty())
      expression("Domain/map", mesh.map, 2);
  }

  void check_norms(const Scene &scene)
  {
    static const std::vector<std::string> known = {"nodal Linf",  "nodal L2",   "averages Linf",
                                                   "averages L2", "field Linf", "field L2"};
    for (const std::string &norm : scene.study.norms)
      if (std::find(known.begin(), known.end(), norm) == known.end())
        throw InputError("Study/norms: '" + norm +
                         "' is not a norm; choose of nodal Linf, nodal L2, averages Linf, "
                         "averages L2, field Linf, field L2");
    const auto parts = split_outside_brackets(scene.study.decisive_error, '|');
    const bool is_known_target = parts.size() == 2 && (parts[1] == "exact" || parts[1] == "local" ||
                                                       parts[1] == "reference");
    if (!is_known_target || std::find(scene.study.norms.begin(), scene.study.norms.end(),
                                      parts[0]) == scene.study.norms.end())
      throw InputError("Study/decisive error = '" + scene.study.decisive_error +
                       "' must be 'norm | target' with a norm of Study/norms (add it there) and a "
                       "target of exact, local, reference");
    if (parts[1] == "exact" && scene.problem.solutions.empty())
      throw InputError("Study/decisive error = '" + scene.study.decisive_error +
                       "' needs Problem/solution, which is empty; use the target reference");
    if (parts[1] == "local" && scene.problem.local_solution == "computed" &&
        parts[0].compare(0, 8, "averages") != 0)
      throw InputError("Study/decisive error = '" + scene.study.decisive_error +
                       "': a computed local solution is compared by cell averages; use averages L2 "
                       "or averages Linf");
    if (parts[1] == "local" &&
        (scene.problem.local_solution == "solution" || scene.problem.local_solution == "none"))
      throw InputError(
          "Study/decisive error = '" + scene.study.decisive_error +
          "' needs Problem/local solution as an expression; where it is the solution itself, "
          "take the target exact");
    if (parts[1] == "reference" && scene.reference.method == "none")
      throw InputError("Study/decisive error = '" + scene.study.decisive_error +
                       "' needs Reference/method, which is none");
    if (parts[1] == "reference" && parts[0].compare(0, 8, "averages") != 0)
      throw InputError("Study/decisive error = '" + scene.study.decisive_error +
                       "': solutions are held against a reference by cell averages; use averages "
                       "L2 or averages Linf");
    if (scene.reference.tolerance > 0 &&
        (scene.reference.method == "none" || scene.reference.estimate == "none"))
      throw InputError(
          "Reference/tolerance = " + short_number(scene.reference.tolerance) +
          " needs a reference and the estimate of its error; give Reference/method and "
          "write Reference/estimate = automatic, or set the tolerance to 0");
  }
} // namespace plumbline::scene
