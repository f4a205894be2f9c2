#include "rule.h"

#include "bindings.h"
#include "driver/methods.h"
#include "geometry/mesh_input.h"
#include "meshfree/rules/families.h"
#include "problem/needs.h"
#include "scene/values.h"
#include "study/preflight.h"

#include <cmath>

namespace plumbline::python
{
  using namespace py::literals;
  using meshfree::Bond;
  using meshfree::Family;
  using physics::Kernel;

  namespace
  {
    /// @return  weights and, where the function gives them, kernel points
    std::pair<Doubles, std::optional<Doubles>>
    call(const std::string &name, const py::function &function, const Family<2> &family)
    {
      std::vector<Point<2>> xi;
      std::vector<double> area;
      for (const Bond<2> &bond : family.bonds)
      {
        xi.push_back(bond.xi);
        area.push_back(bond.area);
      }
      const py::object given = function(to_array(xi), to_array(std::move(area)));
      const bool has_points = py::isinstance<py::tuple>(given) && py::len(given) == 2;
      const auto array = [](const py::object &one)
      {
        const Doubles result = Doubles::ensure(one);
        if (!result)
          throw py::error_already_set();
        return result;
      };
      const Doubles weights = array(has_points ? py::object(given[py::int_(0)]) : given);
      require_length(weights, family.bonds.size(), "rule '" + name + "': the array of weights",
                     "bond");
      if (!has_points)
        return {weights, {}};
      const Doubles points = array(given[py::int_(1)]);
      if (points.ndim() != 2 || points.shape(1) != 2 || points.shape(0) != weights.shape(0))
        throw InputError("rule '" + name + "': the array of kernel points has the shape " +
                         shape_text(points) + "; give one row for each bond, shape (" +
                         std::to_string(family.bonds.size()) + ", 2)");
      return {weights, points};
    }

    void adjust(const std::string &name, const py::function &function, Family<2> &family)
    {
      const py::gil_scoped_acquire lock;
      const auto [weights, points] = call(name, function, family);
      Family<2> kept;
      for (std::size_t k = 0; k < family.bonds.size(); ++k)
      {
        Bond<2> bond = family.bonds[k];
        bond.weight = weights.data()[k];
        if (points)
          bond.kernel_point = Point<2>(points->data()[2 * k], points->data()[2 * k + 1]);
        if (!std::isfinite(bond.weight) || !(bond.kernel_point.square() > 0))
          throw InputError("rule '" + name + "': the bond xi = (" + std::to_string(bond.xi[0]) +
                           ", " + std::to_string(bond.xi[1]) + ") has the weight " +
                           std::to_string(bond.weight) + " and the kernel point (" +
                           std::to_string(bond.kernel_point[0]) + ", " +
                           std::to_string(bond.kernel_point[1]) +
                           "); give finite weights, and points other than 0");
        if (bond.weight == 0)
          continue;
        kept.bonds.push_back(bond);
        if (!family.neighbours.empty())
          kept.neighbours.push_back(family.neighbours[k]);
      }
      family.bonds = std::move(kept.bonds);
      family.neighbours = std::move(kept.neighbours);
    }

    Bond<2> whole_cell(const Kernel<2> &kernel, const meshfree::Candidate<2> &candidate)
    {
      return meshfree::full_area_bond(kernel, candidate);
    }

    /// Area and centroid of ball ∩ cell.
    Bond<2> part_of_cell(const Kernel<2> &kernel, const meshfree::Candidate<2> &candidate)
    {
      Bond<2> bond = meshfree::centroid_bond(kernel, candidate);
      bond.area = bond.weight;
      return bond;
    }

    template <int dim>
    meshfree::NeighbourhoodQuadrature<dim> quadrature(const meshfree::Rule &rule,
                                                      const Kernel<dim> &kernel)
    {
      if constexpr (dim == 2)
        return rule.in_plane(kernel);
      else
      {
        if (!rule.in_space)
          throw InputError("rule '" + rule.name +
                           "' is made for the plane; choose one of the library's rules");
        return rule.in_space(kernel);
      }
    }

    template <int dim>
    py::dict lattice_weights(const py::object &rule, const Kernel<dim> &kernel, double h)
    {
      const meshfree::Rule found = to_rule(rule);
      if (!(h > 0) || !std::isfinite(h))
        throw InputError("h = " + std::to_string(h) + "; give the spacing of the nodes, above 0");
      meshfree::Bonds<dim> bonds;
      {
        const py::gil_scoped_release others;
        bonds =
            meshfree::lattice_bonds(quadrature(found, kernel), kernel, h, geometry::Backend::fast);
      }
      std::vector<std::int64_t> offsets;
      std::vector<double> weights, areas;
      std::vector<Point<dim>> xi, points;
      for (const meshfree::Bond<dim> &bond : bonds.family)
      {
        for (unsigned int d = 0; d < dim; ++d)
          offsets.push_back(std::llround(bond.xi[d] / h));
        weights.push_back(bond.weight);
        areas.push_back(bond.area);
        xi.push_back(bond.xi);
        points.push_back(bond.kernel_point);
      }
      const auto n = static_cast<py::ssize_t>(weights.size());
      return py::dict("offsets"_a = to_array(std::move(offsets), {n, dim}),
                      "w"_a = to_array(std::move(weights)), "points"_a = to_array(points),
                      "xi"_a = to_array(xi), "area"_a = to_array(std::move(areas)),
                      "notes"_a = bonds.notes);
    }

    /// @param volumes  the areas of cells where it is None
    py::dict node_weights(const py::object &rule, const Kernel<2> &kernel, const Doubles &nodes,
                          const py::object &volumes, const py::object &boxes,
                          const py::object &exclude, double h)
    {
      const geometry::Domain domain = to_domain(boxes, exclude);
      const meshfree::Rule found = to_rule(rule);
      const std::vector<Point<2>> places = to_points(nodes, "nodes");
      const std::vector<double> own = to_volumes(volumes, places.size());
      return weights_on<2>(found.in_plane(kernel), kernel, own,
                           [&]
                           {
                             return geometry::voronoi_cells(
                                 places,
                                 geometry::lattice_mesh(domain, h, kernel.horizon(), false));
                           });
    }

    py::list all_methods_as_dicts()
    {
      py::list result;
      for (const auto &method : driver::all_methods())
        result.append(py::dict("name"_a = method->name(), "family"_a = base::word(method->family()),
                               "help"_a = method->help(), "in_all"_a = method->is_in_all()));
      return result;
    }
  } // namespace

  std::vector<double> to_volumes(const py::object &given, std::size_t n_nodes)
  {
    if (given.is_none())
      return {};
    const auto array = given.cast<Doubles>();
    require_length(array, n_nodes, "volumes", "node");
    for (std::size_t k = 0; k < n_nodes; ++k)
      if (!(array.data()[k] > 0) || !std::isfinite(array.data()[k]))
        throw InputError("volumes[" + std::to_string(k) + "] = " + std::to_string(array.data()[k]) +
                         " is not positive; give the size of the node's cell");
    return {array.data(), array.data() + array.size()};
  }

  template <int dim>
  py::dict weights_on(const meshfree::NeighbourhoodQuadrature<dim> &rule, const Kernel<dim> &kernel,
                      const std::vector<double> &volumes,
                      const std::function<geometry::NodeCells<dim>()> &make_cells)
  {
    std::vector<std::int64_t> from, to;
    std::vector<double> weights, areas;
    std::vector<Point<dim>> xi, points;
    {
      const py::gil_scoped_release others;
      geometry::NodeCells<dim> cells = make_cells();
      for (std::size_t k = 0; k < cells.size() && !volumes.empty(); ++k)
        cells.area[k] = volumes[cells.source[k]];
      const meshfree::Families<dim> families(rule, kernel, cells, geometry::Backend::fast);
      Family<dim> family;
      for (std::size_t k = 0; k < families.size(); ++k)
      {
        families.make(k, family);
        for (std::size_t b = 0; b < family.bonds.size(); ++b)
        {
          from.push_back(static_cast<std::int64_t>(cells.source[k]));
          to.push_back(static_cast<std::int64_t>(cells.source[family.neighbours[b]]));
          weights.push_back(family.bonds[b].weight);
          areas.push_back(family.bonds[b].area);
          xi.push_back(family.bonds[b].xi);
          points.push_back(family.bonds[b].kernel_point);
        }
      }
    }
    return py::dict("i"_a = to_array(std::move(from)), "j"_a = to_array(std::move(to)),
                    "w"_a = to_array(std::move(weights)), "points"_a = to_array(points),
                    "xi"_a = to_array(xi), "area"_a = to_array(std::move(areas)));
  }

  template py::dict weights_on(const meshfree::NeighbourhoodQuadrature<2> &, const Kernel<2> &,
                               const std::vector<double> &,
                               const std::function<geometry::NodeCells<2>()> &);
  template py::dict weights_on(const meshfree::NeighbourhoodQuadrature<3> &, const Kernel<3> &,
                               const std::vector<double> &,
                               const std::function<geometry::NodeCells<3>()> &);

  meshfree::Rule PythonRule::rule() const
  {
    return {name, help,
            [name = name, function = function, is_partial = is_partial](const Kernel<2> &)
            {
              return meshfree::NeighbourhoodQuadrature<2>{is_partial ? part_of_cell : whole_cell,
                                                          [=](Family<2> &family)
                                                          { adjust(name, *function, family); }};
            }};
  }

  meshfree::Rule to_rule(const py::object &given)
  {
    if (py::isinstance<PythonRule>(given))
      return given.cast<PythonRule>().rule();
    if (!py::isinstance<py::str>(given))
      throw InputError("rule = " + py::repr(given).cast<std::string>() +
                       " is no rule; give a name (plumbline.methods()) or a plumbline.Rule");
    return meshfree::find_rule(scene::method_name(given.cast<std::string>()), "rule =");
  }

  std::shared_ptr<const method::Method> to_method(const py::object &given)
  {
    if (py::isinstance<PythonRule>(given))
      return meshfree::make_method(given.cast<PythonRule>().rule());
    if (!py::isinstance<py::str>(given))
      throw InputError("method = " + py::repr(given).cast<std::string>() +
                       " is no method; give a name (plumbline.methods()) or a plumbline.Rule");
    return study::find_method(driver::all_methods(), scene::method_name(given.cast<std::string>()),
                              "method");
  }

  void refuse_unless_able(const method::Method &method, const problem::Problem<2> &problem)
  {
    std::string missing;
    const method::Capabilities can = method.can();
    for (const auto need : problem::needs(problem))
      if (can.count(need) == 0)
        missing += (missing.empty() ? "" : ", ") + base::word(need);
    const std::string why =
        missing.empty() ? method.why_not(problem) : "it does not support: " + missing;
    if (!why.empty())
      throw InputError("method '" + method.name() + "' cannot solve this problem: " + why +
                       "; choose another one (plumbline.methods())");
  }

  std::shared_ptr<const method::Method> to_method_in_space(const std::string &name,
                                                           const problem::Problem<3> &problem)
  {
    auto method = to_method(py::str(name));
    if (method->can().count(method::Capability::space) == 0)
      throw InputError("method '" + name +
                       "' is for two dimensions only; choose a meshfree rule, Q1, Q2, DGQ0, "
                       "DGQ1 or DGQ2, or P1, DGP0 or DGP1 on tetrahedra");
    if (!problem.mesh)
      return method;
    const method::Capabilities can = method->can_in_space();
    if (can.count(method::Capability::triangles) == 0 &&
        (problem.mesh->hexahedra.empty() || can.count(method::Capability::quadrilaterals) == 0))
      throw InputError("method '" + name + "' is for lattices of cubes" +
                       (problem.mesh->hexahedra.empty()
                            ? " or hexahedra, and this problem is on a mesh of tetrahedra; choose "
                            : ", and this problem is on a mesh of hexahedra; choose Q1, DGQ0, ") +
                       "P1, DGP0, DGP1 or a meshfree rule");
    if (const std::string why = method->why_not_in_space(problem.kernel, false, true); !why.empty())
      throw InputError("method '" + name + "': " + why);
    return method;
  }

  void add_rules(py::module_ &module)
  {
    py::class_<PythonRule>(module, "Rule", R"(A rule of quadrature that is written in Python.

Rule(name, function, partial=False, help="")

function(xi, area) -> w or (w, points) is called once for each family of bonds:
  xi      from the node to its neighbours, shape (n, 2) [length]
  area    of the neighbours' cells, shape (n,) [length^2]; with partial=True of ball and cell,
          also of cells whose node lies outside of the ball
  w       weights, shape (n,) [length^2]; 0: no bond
  points  where the kernel is taken, relative to the node, shape (n, 2) [length]; without them at
          the neighbour's node, with partial=True at the centroid of ball and cell
solve(), weights() and run() take it wherever they take the name of a rule.)")
        .def(py::init(
                 [](std::string name, py::function function, bool partial, std::string help)
                 {
                   if (name.empty() || name.find_first_of(",;:\n") != std::string::npos)
                     throw InputError("Rule: the name '" + name +
                                      "' is empty or has one of , ; : in it; choose another");
                   return PythonRule{std::move(name), std::move(help), share(std::move(function)),
                                     partial};
                 }),
             "name"_a, "function"_a, "partial"_a = false, "help"_a = "")
        .def_readonly("name", &PythonRule::name)
        .def_readonly("help", &PythonRule::help)
        .def("__repr__", [](const PythonRule &rule) { return "Rule('" + rule.name + "')"; });
    module.def("lattice_weights", lattice_weights<2>, "rule"_a, "kernel"_a, "h"_a);
    module.def("lattice_weights", lattice_weights<3>, "rule"_a, "kernel"_a, "h"_a);
    module.def("node_weights", node_weights, "rule"_a, "kernel"_a, "nodes"_a, "volumes"_a,
               "boxes"_a, "exclude"_a, "h"_a);
    module.def("methods", all_methods_as_dicts,
               R"(All methods: a list of dicts with name, family, help and in_all.)");
  }
} // namespace plumbline::python
