#include "analysis/statics.h"
#include "arrays.h"
#include "bindings.h"
#include "callables.h"
#include "geometry/mesh_input.h"
#include "geometry/node_cells_in_space.h"
#include "geometry/tetrahedral_check.h"
#include "geometry/tetrahedral_domain.h"
#include "method/method.h"
#include "problem/in_space.h"
#include "problem/inside.h"
#include "rule.h"

#include <algorithm>
#include <cmath>
#include <memory>

// Three dimensions: rules on lattices of cubes, problems on boxes, the check of weights.
namespace plumbline::python
{
  using namespace py::literals;
  using physics::Kernel;
  using ProblemInSpace = problem::Problem<3>;

  namespace
  {
    /// Shape (2, 3) of one box, or (n, 2, 3).
    std::vector<geometry::Cuboid> to_cuboids(const py::object &given, const std::string &name)
    {
      if (given.is_none())
        return {};
      const Doubles array = Doubles::ensure(given);
      if (!array)
        PyErr_Clear();
      const py::ssize_t n = array ? array.ndim() : 0;
      if (n < 2 || n > 3 || array.shape(n - 2) != 2 || array.shape(n - 1) != 3)
        throw InputError(name + (array ? " has the shape " + shape_text(array) : " is no array") +
                         "; give the corners ((x0, y0, z0), (x1, y1, z1)) of one box or of a list "
                         "of them");
      std::vector<geometry::Cuboid> boxes;
      for (const double *x = array.data(); x != array.data() + array.size(); x += 6)
      {
        boxes.push_back({{x[0], x[1], x[2]}, {x[3], x[4], x[5]}});
        for (unsigned int d = 0; d < 3; ++d)
          if (!(x[d] < x[d + 3]))
            throw InputError(name + " is empty along its axis " + std::to_string(d) +
                             "; give the lower corner first");
      }
      return boxes;
    }

    struct SolvedInSpace
    {
      std::shared_ptr<const ProblemInSpace> of;
      std::string method;
      analysis::SolutionInSpace solution;
    };

    /// Bonds of the kernel, or a state-based solid whose influence function has its profile.
    /// @param lame  (λ, μ), or None
    ProblemInSpace problem_of(const geometry::CubeLattice &lattice, const Kernel<3> &kernel,
                              const py::object &lame)
    {
      if (lame.is_none())
        return {lattice, kernel};
      const Doubles given = Doubles::ensure(lame);
      if (!given)
        PyErr_Clear();
      if (!given || given.size() != 2)
        throw InputError("lame must be two numbers, (lambda, mu)");
      const physics::Lame solid{given.data()[0], given.data()[1]};
      if (!(solid.mu > 0 && 3 * solid.lambda + 2 * solid.mu > 0 && std::isfinite(solid.lambda)))
        throw InputError("lame = (" + std::to_string(solid.lambda) + ", " +
                         std::to_string(solid.mu) + "): give mu > 0 and lambda > -2 mu / 3");
      if (kernel.structure() != physics::Structure::scalar)
        throw InputError("lame with a bond tensor: the kernel of a state-based solid is its "
                         "influence function; give a scalar one, such as '1/r'");
      const auto influence = physics::influence_function<3>(kernel.profile(), kernel.horizon());
      ProblemInSpace problem{lattice, physics::deviatoric_kernel(influence, solid.mu)};
      if (solid.lambda != solid.mu)
        problem.dilatation = {influence, [solid](const Point<3> &) { return solid; }, false, true};
      return problem;
    }

    geometry::NodeCells<3> cells_of(const std::vector<Point<3>> &nodes,
                                    const geometry::CubeLattice &lattice, double horizon)
    {
      return geometry::voronoi_cells(nodes, lattice, horizon);
    }

    /// Null where it is None.
    std::shared_ptr<const geometry::TetrahedralMesh> to_mesh(const py::object &file, double h,
                                                             double horizon)
    {
      if (file.is_none())
        return nullptr;
      const std::string name = py::str(file);
      const auto mesh = std::make_shared<const geometry::TetrahedralMesh>(
          geometry::read_tetrahedra(name, h, horizon));
      try
      {
        geometry::check_collar(*mesh, horizon);
      }
      catch (const InputError &error)
      {
        throw InputError("mesh file '" + name + "': " + error.what());
      }
      return mesh;
    }

    std::shared_ptr<const ProblemInSpace>
    pose(const Kernel<3> &kernel, const py::object &lame, const py::object &box,
         const py::object &exclude, const py::object &mesh, double h, const py::object &nodes,
         const py::object &load, const py::object &constraint, const py::object &solution)
    {
      const GivenField given_load("load", load), given_constraint("constraint", constraint),
          given_solution("solution", solution);
      if (box.is_none() == mesh.is_none() || !(mesh.is_none() || exclude.is_none()))
        throw InputError("Problem: give the domain either by box (and exclude), or by mesh, the "
                         "name of a gmsh file of tetrahedra or hexahedra");
      const auto tetrahedra = to_mesh(mesh, h, kernel.horizon());
      const geometry::CubeLattice lattice =
          tetrahedra
              ? geometry::cubes_within(*tetrahedra, h)
              : geometry::CubeLattice({to_cuboids(box, "box"), to_cuboids(exclude, "exclude")}, h);
      ProblemInSpace problem = problem_of(lattice, kernel, lame);
      problem.mesh = tetrahedra;
      if (tetrahedra && (!nodes.is_none() || !lame.is_none()))
        throw InputError("mesh cannot be combined with nodes or lame: on a mesh nodes are the "
                         "centroids of its cells, and models are bond-based; omit these");
      if (tetrahedra)
        problem.cells =
            std::make_shared<const geometry::NodeCells<3>>(geometry::centroid_nodes(*tetrahedra));
      if (!nodes.is_none() && problem.dilatation)
        throw InputError(
            "nodes cannot be combined with lame: scattered nodes in three dimensions "
            "support bond-based models only; omit one of the two, or give lambda = mu");
      std::vector<Point<3>> places;
      if (!nodes.is_none())
        places = to_points<3>(nodes.cast<Doubles>(), "nodes");
      const py::gil_scoped_release others;
      if (!nodes.is_none())
        problem.cells = std::make_shared<const geometry::NodeCells<3>>(
            cells_of(places, lattice, kernel.horizon()));
      const auto field = [&](const GivenField &one)
      { return one.field_in_space(problem.n_components, kernel.horizon()); };
      problem.load = field(given_load);
      problem.constraint = field(given_constraint);
      if (given_solution.is_there())
        problem.solution = field(given_solution);
      return std::make_shared<const ProblemInSpace>(problem::complete(std::move(problem)));
    }

    /// @param volumes  those of Voronoi cells where it is None
    py::dict node_weights(const std::string &rule, const Kernel<3> &kernel, const Doubles &nodes,
                          const py::object &volumes, const py::object &box,
                          const py::object &exclude, double h)
    {
      const geometry::CubeLattice lattice({to_cuboids(box, "box"), to_cuboids(exclude, "exclude")},
                                          h);
      const meshfree::Rule found = to_rule(py::str(rule));
      if (!found.in_space)
        throw InputError("rule '" + rule + "' is available in two dimensions only; choose another");
      const std::vector<Point<3>> places = to_points<3>(nodes, "nodes");
      return weights_on<3>(found.in_space(kernel), kernel, to_volumes(volumes, places.size()),
                           [&] { return cells_of(places, lattice, kernel.horizon()); });
    }

    SolvedInSpace solve(std::shared_ptr<const ProblemInSpace> of, const std::string &name)
    {
      const auto method = to_method_in_space(name, *of);
      const py::gil_scoped_release others;
      return {of, name, analysis::solve(*method, *of)};
    }

    std::vector<Point<3>> to_inner_points(const ProblemInSpace &problem, const Doubles &at)
    {
      std::vector<Point<3>> points = to_points<3>(at, "points");
      const auto is_inside = problem::inside(problem);
      for (std::size_t k = 0; k < points.size(); ++k)
        if (!is_inside(points[k]))
          throw InputError("points[" + std::to_string(k) + "] = (" + std::to_string(points[k][0]) +
                           ", " + std::to_string(points[k][1]) + ", " +
                           std::to_string(points[k][2]) +
                           ") lies outside of the domain; take it out");
      return points;
    }

    py::array values_at(const SolvedInSpace &solved, const Doubles &at)
    {
      const std::vector<Point<3>> points = to_inner_points(*solved.of, at);
      std::vector<double> values;
      {
        const py::gil_scoped_release others;
        for (const Point<3> &x : points)
          for (unsigned int c = 0; c < solved.of->n_components; ++c)
            values.push_back(solved.solution.value(x, c));
      }
      return to_components(std::move(values), solved.of->n_components);
    }

    std::vector<Point<3>> centres(const ProblemInSpace &problem)
    {
      std::vector<Point<3>> points;
      const geometry::CubeLattice &lattice = problem.lattice;
      lattice.for_each_cell(
          [&](const std::array<int, 3> &cell)
          {
            points.emplace_back(lattice.coordinate(0, cell[0] + .5),
                                lattice.coordinate(1, cell[1] + .5),
                                lattice.coordinate(2, cell[2] + .5));
          });
      return points;
    }

    void add_solution(py::module_ &module)
    {
      py::class_<SolvedInSpace>(module, "SpaceSolution",
                                "What space.solve() returns. Of three components all values have a "
                                "last axis of length 3.")
          .def_readonly("method", &SolvedInSpace::method)
          .def_property_readonly(
              "nodes", [](const SolvedInSpace &one) { return to_array(one.solution.nodes); },
              "The method's own free nodes, shape (n, 3) [length].")
          .def_property_readonly(
              "values",
              [](const SolvedInSpace &one)
              { return to_components(one.solution.nodal, one.of->n_components); },
              "u at the nodes, shape (n,).")
          .def_property_readonly(
              "cells", [](const SolvedInSpace &one) { return to_array(centres(*one.of)); },
              "Centres of the domain's cubes, x fastest, shape (n_cells, 3) [length].")
          .def_property_readonly(
              "h", [](const SolvedInSpace &one) { return one.of->h(); },
              "Side of the cubes [length].")
          .def_property_readonly(
              "averages",
              [](const SolvedInSpace &one)
              { return to_components(one.solution.averages, one.of->n_components); },
              "u averaged over the cells, shape (n_cells,).")
          .def("__call__", values_at, "points"_a,
               "u at points in the domain, shape (n, 3) [length]: shape (n,). Of meshfree methods "
               "and DGQ0 the value of the cell that holds the point.")
          .def(
              "gradient",
              [](const SolvedInSpace &one, const Doubles &points)
              {
                return gradients<3>(one.solution.gradient, to_inner_points(*one.of, points),
                                    one.of->n_components, one.method);
              },
              "points"_a,
              "Gradient of u at points in the domain, shape (n, 3) [length]: shape (n, 3), of "
              "three "
              "components (n, 3, 3) with du_c/dx_d at [:, c, d] [u/length]. Exact in the cell that "
              "holds the point; for Q1, Q2 and P1 only.")
          .def_property_readonly(
              "cost",
              [](const SolvedInSpace &one)
              {
                const base::Cost &cost = one.solution.cost;
                return py::dict("setup_seconds"_a = cost.setup_seconds,
                                "solve_seconds"_a = cost.solve_seconds,
                                "peak_bytes"_a = cost.peak_bytes, "n_unknowns"_a = cost.n_unknowns,
                                "n_bonds"_a = cost.n_bonds, "n_iterations"_a = cost.n_iterations);
              },
              "setup_seconds, solve_seconds [CPU s], peak_bytes, n_unknowns, n_bonds, "
              "n_iterations.");
    }
  } // namespace

  geometry::Cuboid to_cuboid(const py::object &given)
  {
    const auto boxes = to_cuboids(given, "boxes");
    if (boxes.size() != 1)
      throw InputError("boxes contains " + std::to_string(boxes.size()) + " boxes; give one");
    return boxes.front();
  }

  void add_space(py::module_ &module)
  {
    py::class_<ProblemInSpace, std::shared_ptr<ProblemInSpace>>(
        module, "SpaceProblem",
        R"doc(One boundary-value problem on boxes of cubes: L u = load in them, u = constraint around them.

Problem(kernel, *, box, h, nodes=None, exclude=None, load=None, constraint=None, solution=None,
        lame=None)
Problem(kernel, *, mesh="ball.msh", h, ...)   tetrahedra or hexahedra of gmsh, for P1, DGP0, DGP1 and
                                              meshfree rules, on hexahedra also Q1, DGQ0

kernel      of the bonds; with lame, the influence function (only its profile and horizon are used)
box         corners ((x0, y0, z0), (x1, y1, z1)), or a list of such boxes [length]; exclude: boxes to remove from
            these
h           side of the cubes, which divides the distances between parallel sides [length]
mesh        a file .msh or .geo (its constants h and delta are set) with physical volumes omega... (the domain) and
            collar... (at least one horizon around it). Nodes of meshfree rules are the centroids of its cells;
            averages are over the cubes of side h that lie in the domain
nodes       scattered nodes of meshfree rules, shape (n, 3) [length], free in the boxes and constrained in a layer
            at least one horizon wide around them; default: the centres of the cubes
load, constraint, solution
            each an expression in x, y and z ("sin(3*x)*z"; three components separated by commas), a
            number, or a function f(x, y, z) of arrays, which is called point by point and slower.
            Without a load: that of the solution; without a constraint: the solution
lame        (lambda, mu) of the linear peridynamic solid [force/length^2]; u is then prescribed within two
            horizons of the boxes (one if lambda = mu))doc")
        .def(py::init(
                 [](const Kernel<3> &kernel, const py::object &box, double h,
                    const py::object &nodes, const py::object &exclude, const py::object &mesh,
                    const py::object &load, const py::object &constraint,
                    const py::object &solution, const py::object &lame)
                 {
                   return std::const_pointer_cast<ProblemInSpace>(pose(
                       kernel, lame, box, exclude, mesh, h, nodes, load, constraint, solution));
                 }),
             "kernel"_a, py::kw_only(), "box"_a = py::none(), "h"_a, "nodes"_a = py::none(),
             "exclude"_a = py::none(), "mesh"_a = py::none(), "load"_a = py::none(),
             "constraint"_a = py::none(), "solution"_a = py::none(), "lame"_a = py::none())
        .def_property_readonly("h", &ProblemInSpace::h, "[length]")
        .def_property_readonly("horizon", &ProblemInSpace::horizon, "[length]");
    add_solution(module);
    module.def(
        "solve_in_space",
        [](std::shared_ptr<ProblemInSpace> problem, const std::string &method)
        { return solve(std::move(problem), method); },
        "problem"_a.none(false), "method"_a);
    module.def("node_weights_in_space", node_weights, "rule"_a, "kernel"_a, "nodes"_a, "volumes"_a,
               "box"_a, "exclude"_a, "h"_a);
  }
} // namespace plumbline::python
