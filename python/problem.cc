#include "analysis/statics.h"
#include "bindings.h"
#include "callables.h"
#include "geometry/mesh_input.h"
#include "method/another_operator.h"
#include "method/lattice_discretisation.h"
#include "problem/builder.h"
#include "problem/inside.h"
#include "reading.h"
#include "rule.h"
#include "study/reference_estimate.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace plumbline::python
{
  using namespace py::literals;
  using Case = problem::Case<2>;

  namespace
  {
    /// All that poses a problem, at any h.
    struct Statement
    {
      physics::Kernel<2> kernel;
      double h = 0; ///< 0: that of the mesh
      geometry::Domain boxes = {};
      std::string mesh_file = {};
      std::shared_ptr<const geometry::Mesh> mesh = {}; ///< of arrays
      std::vector<Point<2>> nodes = {};
      bool is_mesh = false, has_triangles = false, nodes_are_vertices = false, is_periodic = false;
      GivenField load, constraint, solution, coefficient;
      physics::Mean mean = physics::Mean::arithmetic;
    };

    /// Where a method on a lattice may have nodes: centres and vertices of cells, in Ω and around.
    std::vector<Point<2>> lattice_points(const geometry::Lattice &lattice, double reach)
    {
      const int n = static_cast<int>(std::ceil(reach / lattice.h())) + 1;
      std::vector<Point<2>> points;
      for (int j = -n; j <= lattice.n_cells()[1] + n; ++j)
        for (int i = -n; i <= lattice.n_cells()[0] + n; ++i)
          for (const double offset : {0., .5})
            points.push_back(lattice.point(i + offset, j + offset));
      return points;
    }

    problem::Domain make_domain(const Statement &given)
    {
      const double reach = given.kernel.horizon();
      if (!given.mesh_file.empty())
      {
        auto domain = problem::mesh_domain(geometry::read_mesh(given.mesh_file, given.h, reach),
                                           given.nodes, reach);
        domain.name = given.mesh_file;
        return domain;
      }
      if (given.mesh)
      {
        auto domain = problem::mesh_domain(*given.mesh, given.nodes, reach);
        domain.name = "mesh";
        return domain;
      }
      if (!given.is_mesh)
        return problem::LatticeDomain{geometry::Lattice(given.boxes, given.h), given.is_periodic};
      auto domain = problem::mesh_domain(
          geometry::lattice_mesh(given.boxes, given.h, reach, given.has_triangles), given.nodes,
          reach);
      domain.name = given.has_triangles ? "triangles" : "squares";
      return domain;
    }

    problem::Problem<2> pose(const Statement &given)
    {
      problem::ProblemBuilder builder(make_domain(given), given.kernel,
                                      given.mesh_file.empty() && !given.mesh ? given.h : 0);
      const std::vector<Point<2>> nodes = builder.lattice() != nullptr
                                              ? lattice_points(*builder.lattice(), builder.reach())
                                              : builder.cells()->nodes;
      const auto field = [&](const GivenField &one)
      { return one.field(given.kernel.n_components(), given.kernel.horizon(), nodes); };
      builder.load = field(given.load);
      builder.constraint = field(given.constraint);
      if (given.solution.is_there())
        builder.solution = field(given.solution);
      if (given.coefficient.is_there())
        builder.coefficient =
            given.coefficient.coefficient(given.kernel.horizon(), nodes, given.mean);
      builder.settings.nodes_are_vertices = given.nodes_are_vertices;
      return builder.build();
    }

    /// Cells of another size fill the same domain, but for a mesh that is not described.
    Case make_case(const Statement &given)
    {
      Case result{"u", pose(given)};
      if (given.mesh)
        return result;
      if (given.mesh_file.empty() || std::filesystem::path(given.mesh_file).extension() == ".geo")
        result.at_h = [given](double h)
        {
          Statement other = given;
          other.h = h;
          other.nodes.clear();
          return pose(other);
        };
      return result;
    }

    /// @param given  (vertices, cells, inside); clockwise cells are turned around
    geometry::Mesh mesh_of_arrays(const py::object &given)
    {
      if (!py::isinstance<py::tuple>(given) || py::len(given) != 3)
        throw InputError("mesh is neither the name of a file nor (vertices, cells, inside); give "
                         "arrays of shapes (n_vertices, 2), (n_cells, 3 or 4), (n_cells,)");
      geometry::Mesh mesh;
      mesh.vertices = to_points(given[py::int_(0)].cast<Doubles>(), "mesh: vertices");
      const auto cells = given[py::int_(1)].cast<Integers>();
      const auto inside = given[py::int_(2)].cast<py::array_t<bool, py::array::forcecast>>();
      if (cells.ndim() != 2 || (cells.shape(1) != 3 && cells.shape(1) != 4))
        throw InputError("mesh: cells has the shape " + shape_text(cells) +
                         "; give three or four vertices of each, shape (n_cells, 3 or 4)");
      require_length(inside, static_cast<std::size_t>(cells.shape(0)), "mesh: inside", "cell");
      const auto n_vertices = static_cast<unsigned int>(cells.shape(1));
      for (py::ssize_t c = 0; c < cells.shape(0); ++c)
      {
        geometry::MeshCell cell{{}, n_vertices, inside.at(c)};
        for (unsigned int v = 0; v < n_vertices; ++v)
        {
          const std::int64_t index = cells.at(c, v);
          if (index < 0 || index >= static_cast<std::int64_t>(mesh.vertices.size()))
            throw InputError("mesh: cells[" + std::to_string(c) + ", " + std::to_string(v) +
                             "] = " + std::to_string(index) + " is no vertex; there are " +
                             std::to_string(mesh.vertices.size()) + ", counted from 0");
          cell.vertex[v] = static_cast<unsigned int>(index);
        }
        const auto x = [&](unsigned int v) { return mesh.vertices[cell.vertex[v]]; };
        const auto a = x(2) - x(0), b = x(n_vertices - 1) - x(n_vertices == 3 ? 0 : 1);
        const double turn = n_vertices == 3 ? (x(1) - x(0))[0] * a[1] - (x(1) - x(0))[1] * a[0]
                                            : a[0] * b[1] - a[1] * b[0];
        if (turn < 0)
          std::reverse(cell.vertex.begin(), cell.vertex.begin() + n_vertices);
        mesh.cells.push_back(cell);
      }
      return mesh;
    }

    std::shared_ptr<const Case> make_problem(const physics::Kernel<2> &kernel, double h,
                                             const py::object &boxes, const py::object &exclude,
                                             const py::object &mesh, const py::object &nodes,
                                             const std::string &cells, bool vertices, bool periodic,
                                             const py::object &load, const py::object &constraint,
                                             const py::object &solution,
                                             const py::object &coefficient, const std::string &mean)
    {
      Statement given{kernel,
                      h,
                      to_domain(boxes, exclude),
                      {},
                      {},
                      {},
                      cells != "lattice" || !nodes.is_none() || !coefficient.is_none(),
                      cells == "triangles",
                      vertices,
                      periodic,
                      {"load", load},
                      {"constraint", constraint},
                      {"solution", solution},
                      {"coefficient", coefficient},
                      mean == "harmonic" ? physics::Mean::harmonic : physics::Mean::arithmetic};
      if (cells != "lattice" && cells != "squares" && cells != "triangles")
        throw InputError("cells = '" + cells + "'; choose one of lattice, squares, triangles");
      if (mean != "harmonic" && mean != "arithmetic")
        throw InputError("mean = '" + mean + "'; choose one of arithmetic, harmonic");
      const bool is_array = !py::isinstance<py::str>(mesh);
      if (!is_array)
        given.mesh_file = mesh.cast<std::string>();
      const bool has_mesh = is_array || !given.mesh_file.empty();
      if (given.boxes.include.empty() != has_mesh)
        throw InputError("Problem: give the domain either by boxes with h, or by a mesh file or "
                         "arrays");
      if (!has_mesh && !(h > 0))
        throw InputError("h = " + std::to_string(h) +
                         "; boxes are made of cells of this size, give a length above 0");
      if (is_array)
        given.mesh = std::make_shared<const geometry::Mesh>(mesh_of_arrays(mesh));
      if (!nodes.is_none())
        given.nodes = to_points(nodes.cast<Doubles>(), "nodes");
      const py::gil_scoped_release others;
      return std::make_shared<const Case>(make_case(given));
    }

    std::shared_ptr<const Case> case_of_scene(const std::string &text,
                                              const std::vector<scene::Override> &overrides,
                                              unsigned int index, unsigned int series,
                                              unsigned int level)
    {
      const py::gil_scoped_release others;
      const scene::Scene scene = scene_of(text, overrides);
      const auto n_cases = scene.problem.case_names().size();
      if (index >= n_cases || series >= scene.study.series.size() ||
          level >= scene.study.series[series].levels.size())
        throw InputError("scene '" + scene.name + "' has no case " + std::to_string(index) +
                         ", series " + std::to_string(series) + ", level " + std::to_string(level) +
                         "; count from 0");
      return std::make_shared<const Case>(
          scene::make_case(scene, index, scene.study.series[series].levels[level]));
    }

    /// A solution, with the problem that its field may refer to.
    struct Solved
    {
      std::shared_ptr<const Case> of;
      std::string method;
      analysis::Solution solution;
      std::optional<study::ErrorEstimate> estimate = {};

      const problem::Problem<2> &problem() const { return of->problem; }
      unsigned int n_components() const { return of->problem.n_components; }
    };

    Solved solve(std::shared_ptr<const Case> of, const py::object &method)
    {
      const auto found = to_method(method);
      const py::gil_scoped_release others;
      refuse_unless_able(*found, of->problem);
      return {of, found->name(), analysis::solve(*found, of->problem)};
    }

    /// In the problem's own coordinates.
    /// @throws InputError  a point outside
    std::vector<Point<2>> to_inner_points(const problem::Problem<2> &problem, const Doubles &at);

    /// @param points  where the error is estimated as well, or None
    Solved reference(std::shared_ptr<const Case> of, const py::object &method, bool estimate,
                     const py::object &at)
    {
      std::vector<Point<2>> points;
      if (!at.is_none())
        points = to_inner_points(of->problem, at.cast<Doubles>());
      if (!estimate && !points.empty())
        throw InputError(
            "reference: points are given, but estimate = False; write estimate = True, "
            "or omit points");
      const auto *mesh = of->problem.mesh().get();
      const auto found = to_method(
          method.is_none() ? py::str(mesh != nullptr && mesh->is_triangles() ? "P2" : "Q2")
                           : method);
      if (found->family() != method::MethodFamily::reference)
        throw InputError("method = '" + found->name() +
                         "' is no Galerkin method, which references are made by; choose one "
                         "(plumbline.methods())");
      if (const auto *other = method::of_another_operator(*found))
        throw InputError("method = '" + found->name() + "' " + other->what_it_does() +
                         "; choose Q2 or another Galerkin method (plumbline.methods())");
      const py::gil_scoped_release others;
      refuse_unless_able(*found, of->problem);
      Solved result{of, found->name(), analysis::solve(*found, of->problem)};
      if (estimate)
        result.estimate = study::estimate_error(*of, *found, result.solution, false, points);
      return result;
    }

    void require_inside(const problem::Problem<2> &problem, const std::vector<Point<2>> &points)
    {
      const auto is_inside = problem::inside(problem);
      for (std::size_t k = 0; k < points.size(); ++k)
        if (!is_inside(points[k]))
          throw InputError("points[" + std::to_string(k) + "] = (" + std::to_string(points[k][0]) +
                           ", " + std::to_string(points[k][1]) +
                           ") lies outside of the domain; take it out");
    }

    std::vector<Point<2>> to_inner_points(const problem::Problem<2> &problem, const Doubles &at)
    {
      std::vector<Point<2>> points = to_points(at, "points");
      const py::gil_scoped_release others;
      for (Point<2> &x : points)
        x -= problem.origin - Point<2>();
      require_inside(problem, points);
      return points;
    }

    py::array gradients_at(const Solved &solved, const Doubles &at)
    {
      const std::vector<Point<2>> points = to_inner_points(solved.problem(), at);
      return gradients<2>(solved.solution.gradient, points, solved.n_components(), solved.method);
    }

    py::array values_at(const Solved &solved, const Doubles &at)
    {
      const std::vector<Point<2>> points = to_inner_points(solved.problem(), at);
      std::vector<double> values;
      {
        const py::gil_scoped_release others;
        for (const Point<2> &x : points)
          for (unsigned int c = 0; c < solved.n_components(); ++c)
            values.push_back(solved.solution.value(x, c));
      }
      return to_components(std::move(values), solved.n_components());
    }

    std::vector<Point<2>> in_user_coordinates(std::vector<Point<2>> points,
                                              const problem::Problem<2> &problem)
    {
      for (Point<2> &x : points)
        x += problem.origin - Point<2>();
      return points;
    }

    /// Of the cells that averages are over.
    std::vector<Point<2>> centres(const problem::Problem<2> &problem)
    {
      if (const geometry::Lattice *lattice = problem.lattice())
        return method::free_points(*lattice, method::comparison_nodes(problem, 1));
      const geometry::NodeCells<2> &cells = *problem.cells();
      return {cells.centroid.begin(),
              cells.centroid.begin() + static_cast<std::ptrdiff_t>(cells.n_free)};
    }

    py::dict to_dict(const base::Cost &cost)
    {
      return py::dict("setup_seconds"_a = cost.setup_seconds,
                      "solve_seconds"_a = cost.solve_seconds, "peak_bytes"_a = cost.peak_bytes,
                      "n_unknowns"_a = cost.n_unknowns, "n_bonds"_a = cost.n_bonds,
                      "n_iterations"_a = cost.n_iterations);
    }

    py::dict to_dict(const method::Diagnostics &said)
    {
      return py::dict(
          "n_neighbours"_a = said.n_neighbours, "n_negative_weights"_a = said.n_negative_weights,
          "relative_residual"_a = said.relative_residual,
          "operator_backend"_a = said.operator_backend, "limit"_a = base::word(said.limit.answer),
          "second_moment_defect"_a = said.limit.defect, "reason"_a = said.limit.reason,
          "notes"_a = said.notes);
    }

    py::object to_dict(const std::optional<study::ErrorEstimate> &estimate)
    {
      if (!estimate)
        return py::none();
      const py::object at_points =
          estimate->at_points.empty() ? py::object(py::none()) : to_array(estimate->at_points);
      return py::dict("averages"_a = estimate->estimate, "field"_a = estimate->field_estimate,
                      "at_points"_a = at_points, "certified_digits"_a = estimate->certified_digits,
                      "h_change"_a = estimate->h_change, "p_change"_a = estimate->p_change,
                      "outer_change"_a = estimate->outer_change,
                      "is_of_polygon"_a = estimate->is_of_polygon);
    }

    void add_solution(py::module_ &module)
    {
      py::class_<Solved>(module, "Solution",
                         "What solve() and reference() return. Of two components all values have a "
                         "last axis of length 2.")
          .def_readonly("method", &Solved::method)
          .def_property_readonly(
              "nodes",
              [](const Solved &one)
              { return to_array(in_user_coordinates(one.solution.nodes, one.problem())); },
              "The method's own free nodes, shape (n, 2) [length].")
          .def_property_readonly(
              "values",
              [](const Solved &one)
              { return to_components(one.solution.nodal, one.n_components()); },
              "u at the nodes, shape (n,).")
          .def_property_readonly(
              "cells",
              [](const Solved &one)
              { return to_array(in_user_coordinates(centres(one.problem()), one.problem())); },
              "Centres of the cells of averages, the same of all methods, shape (n_cells, 2).")
          .def_property_readonly(
              "averages",
              [](const Solved &one)
              { return to_components(one.solution.averages, one.n_components()); },
              "u averaged over the cells, shape (n_cells,).")
          .def("__call__", values_at, "points"_a,
               "u at points in the domain, shape (n, 2) [length]: shape (n,). Of meshfree methods "
               "the value of the cell that holds the point.")
          .def(
              "gradient", gradients_at, "points"_a,
              "Gradient of u at points in the domain, shape (n, 2) [length]: shape (n, 2), of two "
              "components (n, 2, 2) with du_c/dx_d at [:, c, d] [u/length]. Exact in the cell that "
              "holds the point; for continuous Galerkin spaces only.")
          .def_property_readonly(
              "cost", [](const Solved &one) { return to_dict(one.solution.cost); },
              "setup_seconds, solve_seconds [CPU s], peak_bytes, n_unknowns, n_bonds, "
              "n_iterations.")
          .def_property_readonly(
              "diagnostics", [](const Solved &one) { return to_dict(one.solution.diagnostics); },
              "What the method says of itself: neighbours, negative weights, moments.")
          .def_property_readonly(
              "estimate", [](const Solved &one) { return to_dict(one.estimate); },
              "Of reference(), bounds in practice (not proven). averages, field: of their L2 "
              "errors; "
              "at_points: of the errors at the points given, shape (n_points,), or None; "
              "certified_digits: digits of the averages that the bound leaves certain.")
          .def(
              "write_vtu",
              [](const Solved &one, const std::string &file) { one.solution.write_vtu(file); },
              "file"_a);
    }
  } // namespace

  void add_problem(py::module_ &module)
  {
    py::class_<Case, std::shared_ptr<Case>>(
        module, "Problem",
        R"doc(One boundary-value problem: L u = load in the domain, u = constraint around it.

Problem(kernel, *, boxes, h)              a lattice of cells of side h
Problem(kernel, *, boxes, h, nodes=X)     nodes anywhere, with Voronoi cells
Problem(kernel, *, mesh="plate.msh")      of gmsh: surfaces omega... and collar...; .geo with h
Problem(kernel, *, mesh=(vertices, cells, inside))   a mesh in arrays

boxes       corners ((x0, y0), (x1, y1)), or a list of them [length]; exclude: taken out of these
mesh        a file, or arrays: vertices of shape (n_vertices, 2) [length], cells of shape
            (n_cells, 3) or (n_cells, 4) (indices from 0), inside of shape (n_cells,): true in the
            domain, false in the interaction domain around it
nodes       shape (n, 2), in the domain and in the interaction domain around it
cells       "lattice", "squares" or "triangles": what the boxes are made of
vertices    nodes of lattices stand on vertices, not at centres
periodic    the boxes close to a torus
load, constraint, solution, coefficient
            each an expression in x and y ("sin(3*x)"; "x*y, 0" of two components), a number, or a
            function f(x, y) of arrays of shape (n,) that returns an array of shape (n,), of two
            components a pair of them. Functions are called with all nodes at once, elsewhere point
            by point. Without a load: that of the solution; without a constraint: the solution.
            coefficient: a > 0 of a kernel mean(a(x), a(y)) C, with mean="arithmetic" or
            "harmonic")doc")
        .def(py::init(
                 [](const physics::Kernel<2> &kernel, double h, const py::object &boxes,
                    const py::object &exclude, const py::object &mesh, const py::object &nodes,
                    const std::string &cells, bool vertices, bool periodic, const py::object &load,
                    const py::object &constraint, const py::object &solution,
                    const py::object &coefficient, const std::string &mean)
                 {
                   return std::const_pointer_cast<Case>(
                       make_problem(kernel, h, boxes, exclude, mesh, nodes, cells, vertices,
                                    periodic, load, constraint, solution, coefficient, mean));
                 }),
             "kernel"_a, py::kw_only(), "h"_a = 0., "boxes"_a = py::none(),
             "exclude"_a = py::none(), "mesh"_a = "", "nodes"_a = py::none(), "cells"_a = "lattice",
             "vertices"_a = false, "periodic"_a = false, "load"_a = py::none(),
             "constraint"_a = py::none(), "solution"_a = py::none(), "coefficient"_a = py::none(),
             "mean"_a = "arithmetic")
        .def_static(
            "of_scene",
            [](const std::string &text, const py::dict &set, unsigned int index,
               unsigned int series, unsigned int level)
            {
              return std::const_pointer_cast<Case>(
                  case_of_scene(text, to_overrides(set), index, series, level));
            },
            "scene"_a, "set"_a = py::dict(), "case"_a = 0, "series"_a = 0, "level"_a = 0,
            "The problem of a scene (a file or its text) at one level, all counted from 0.")
        .def_property_readonly(
            "h", [](const Case &one) { return one.problem.h; }, "[length]")
        .def_property_readonly(
            "horizon", [](const Case &one) { return one.problem.horizon(); }, "[length]")
        .def_property_readonly("n_components",
                               [](const Case &one) { return one.problem.n_components; });
    add_solution(module);
    module.def(
        "solve",
        [](std::shared_ptr<Case> problem, const py::object &method)
        { return solve(std::move(problem), method); },
        "problem"_a.none(false), "method"_a,
        "Solve a problem by a method's name or a plumbline.Rule: a Solution. Other threads "
        "of Python run meanwhile.");
    module.def(
        "reference",
        [](std::shared_ptr<Case> problem, const py::object &method, bool estimate,
           const py::object &points)
        { return reference(std::move(problem), method, estimate, points); },
        "problem"_a.none(false), "method"_a = py::none(), "estimate"_a = true,
        "points"_a = py::none(),
        "A Galerkin solution (default: Q2, on triangles P2) with an estimate of its error, "
        "which takes about 20 times as long as the solution alone. At points in the domain, shape "
        "(n, 2) [length], the error is estimated as well: estimate[\"at_points\"].");
  }
} // namespace plumbline::python
