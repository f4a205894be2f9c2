#include "arrays.h"
#include "base/number_text.h"
#include "bindings.h"
#include "check/body.h"
#include "check/in_space.h"
#include "geometry/mesh_input.h"
#include "meshfree/check/bond_values.h"
#include "meshfree/check/nodes_in_space.h"
#include "meshfree/check/row_families.h"
#include "meshfree/check/sizes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

// The check of another code's weights, from arrays. What is found and the words for it are those of
// `plumbline check`; ids and lines are indices into the arrays.
namespace plumbline::python
{
  using namespace py::literals;
  using meshfree::Outlier;

  namespace
  {
    constexpr double rounding = std::numeric_limits<double>::epsilon();

    template <int dim>
    meshfree::GivenNodes<dim> to_nodes(std::vector<Point<dim>> places, const Doubles &volumes)
    {
      require_length(volumes, places.size(), "volumes", "node");
      meshfree::GivenNodes<dim> nodes;
      nodes.file = "nodes";
      double size = 0;
      for (std::size_t k = 0; k < places.size(); ++k)
      {
        const double volume = volumes.data()[k];
        nodes.id.push_back(static_cast<std::int64_t>(k));
        nodes.line.push_back(k);
        nodes.volume.push_back(volume);
        if (!(volume > 0) || !std::isfinite(volume))
          throw InputError("volumes[" + std::to_string(k) + "] = " + std::to_string(volume) +
                           " is not positive; give the " + std::string(meshfree::measure<dim>()) +
                           " of the node's cell");
        for (unsigned int d = 0; d < dim; ++d)
          size = std::max(size, std::abs(places[k][d]));
      }
      nodes.places = std::move(places);
      nodes.rounding = rounding * size;
      nodes.volume_rounding = rounding;
      return nodes;
    }

    /// Arrays of bonds.
    struct GivenBonds
    {
      const Integers &i, &j;
      const Doubles &w;
      const py::object &points; ///< None: kernels are taken at the neighbours
    };

    template <int dim>
    std::vector<meshfree::GivenRow<dim>> to_rows(const GivenBonds &given)
    {
      const auto n = static_cast<std::size_t>(given.w.size());
      require_length(given.w, n, "w", "bond");
      require_length(given.i, n, "i", "bond");
      require_length(given.j, n, "j", "bond");
      std::vector<Point<dim>> points;
      if (!given.points.is_none())
        points = to_points<dim>(given.points.cast<Doubles>(), "points");
      if (!given.points.is_none() && points.size() != n)
        throw InputError("points has " + std::to_string(points.size()) + " rows for " +
                         std::to_string(n) + " bonds; give one for each, relative to node i");
      std::vector<meshfree::GivenRow<dim>> rows(n);
      for (std::size_t k = 0; k < n; ++k)
      {
        rows[k] = {given.i.data()[k], given.j.data()[k], given.w.data()[k], {}, k};
        if (!std::isfinite(rows[k].weight))
          throw InputError("w[" + std::to_string(k) + "] = " + std::to_string(rows[k].weight) +
                           " is no weight; give finite numbers");
        if (points.empty())
          continue;
        rows[k].kernel_point = points[k];
        if (points[k].square() == 0)
          throw InputError("points[" + std::to_string(k) +
                           "] is 0, the position of node i itself, where kernels may be infinite; "
                           "give a point of the neighbour's cell, relative to node i");
      }
      return rows;
    }

    /// Of cells that fill the first box, about as many as it has nodes: volumes may be wrong.
    double usual_h(const geometry::Domain &domain, const std::vector<Point<2>> &places,
                   bool is_periodic)
    {
      const geometry::Box &box = domain.include.front();
      const double width = box.upper[0] - box.lower[0], height = box.upper[1] - box.lower[1],
                   tolerance = 1e-9 * width;
      double n = 0; // nodes on the boundary count half
      for (const Point<2> &x : places)
      {
        double depth = HUGE_VAL; // below 0: outside
        for (unsigned int d = 0; d < 2; ++d)
          depth = std::min({depth, x[d] - box.lower[d], box.upper[d] - x[d]});
        n += depth > tolerance ? 1 : depth < -tolerance ? 0 : is_periodic ? 1 : .5;
      }
      return width / std::max(1., std::round(width / std::sqrt(width * height / std::max(1., n))));
    }

    check::Findings<2> find(meshfree::GivenNodes<2> nodes,
                            const std::vector<meshfree::GivenRow<2>> &rows,
                            const physics::Kernel<2> &kernel, const geometry::Domain &domain,
                            double h, bool boundary_is_data, const std::vector<std::string> &meant,
                            meshfree::BondValues values, check::GivenBody body)
    {
      check::take_into_box(body, domain, nodes);
      const bool is_free = body.is_free(), has_data = boundary_is_data && !body.is_periodic();
      const problem::Level level{h, kernel.horizon()};
      const geometry::Mesh mesh = geometry::lattice_mesh(domain, h, body.collar(level), false);
      if (is_free)
        body.parts = geometry::convex_parts(domain);
      check::add_images(mesh, level, nodes);
      meshfree::check_places(nodes, mesh, "h = " + base::to_text(h, 6));
      meshfree::GivenCells<2> cells = meshfree::given_cells(nodes, mesh, has_data && !is_free);
      check::Findings<2> found;
      found.level = {level, "given", meshfree::node_spacing(nodes, mesh)};
      found.n_on_boundary = boundary_is_data || is_free ? 0 : cells.n_on_boundary;
      meshfree::GivenWeights<2> weights;
      weights.cells = std::make_shared<const geometry::NodeCells<2>>(std::move(cells.cells));
      weights.given = meshfree::families_of_rows(rows, nodes, *weights.cells, {"bonds", "index"});
      weights.given.weight_rounding = rounding;
      weights.nodes = std::move(nodes);
      problem::Problem<2> problem = check::problem_on(mesh, weights.cells, kernel, h);
      check::find_defects(body, "cracks", values, std::move(weights), cells.uncut_areas,
                          std::move(problem), meant, found);
      return found;
    }

    /// Words of the command, whose lines are indices here, and whose options are arguments.
    std::string in_arrays(std::string text)
    {
      const std::vector<std::pair<std::string, std::string>> words = {
          {"(line ", "(index "},
          {check::where_lengths_are_given, ""},
          {"--bonds-are stiffness", "bonds_are=\"stiffness\""},
          {"--bonds-are 'force constants'", "bonds_are=\"force constants\""},
          {"though Methods/names has that rule and not FA",
           "though rule names that one and not FA"},
          {"name the rule that is meant in Methods/names", "give rule, the one that is meant"},
          {"write Methods/nodes = vertices", "give boundary_is_data=True"}};
      for (const auto &[of_command, of_arrays] : words)
        for (std::size_t at = 0; (at = text.find(of_command, at)) != std::string::npos;
             at += of_arrays.size())
          text.replace(at, of_command.size(), of_arrays);
      return text;
    }

    py::list in_arrays(const std::vector<std::string> &texts)
    {
      py::list result;
      for (const std::string &one : texts)
        result.append(in_arrays(one));
      return result;
    }

    template <int dim>
    py::dict to_dict(const meshfree::Worst &worst, const check::Findings<dim> &found)
    {
      return py::dict("value"_a = worst.value, "node"_a = found.ids[worst.node]);
    }

    template <int dim>
    py::list outliers(const check::Findings<dim> &found)
    {
      py::list result;
      for (const Outlier<dim> &o : found.outliers)
      {
        const bool has_row = o.bond != Outlier<dim>::none;
        result.append(py::dict("node"_a = found.ids[o.node],
                               "neighbour"_a = o.neighbour == Outlier<dim>::none
                                                   ? py::object(py::none())
                                                   : py::cast(found.ids[o.neighbour]),
                               "index"_a = has_row ? py::cast(found.given.lines[o.node][o.bond])
                                                   : py::object(py::none()),
                               "found"_a = o.found, "expected"_a = o.expected,
                               "text"_a = in_arrays(check::text(o, found))));
      }
      return result;
    }

    template <int dim>
    py::list causes(const check::Findings<dim> &found)
    {
      py::list result;
      for (const meshfree::Cause &cause : found.causes)
        result.append(py::dict("name"_a = cause.name, "text"_a = in_arrays(cause.text),
                               "factor"_a = cause.factor, "defect_before"_a = cause.before,
                               "defect_after"_a = cause.after));
      return result;
    }

    template <int dim>
    py::dict moments(const check::Findings<dim> &found)
    {
      py::list degrees;
      for (const meshfree::MomentDefect &defect : found.moments.defects)
        degrees.append(py::dict("degree"_a = defect.degree,
                                "worst"_a = to_dict(defect.worst, found),
                                "median"_a = defect.median, "defects"_a = to_array(defect.values)));
      std::vector<std::int64_t> nodes(
          found.ids.begin(), found.ids.begin() + static_cast<std::ptrdiff_t>(found.cells->n_free));
      return py::dict("degrees"_a = degrees, "nodes"_a = to_array(std::move(nodes)),
                      "exact_degree"_a = found.moments.exact_degree,
                      "mean_ratio"_a = found.moments.mean_ratio,
                      "second"_a = to_dict(found.moments.second, found));
    }

    template <int dim>
    py::dict to_dict(const check::Findings<dim> &found, const check::Requirements &required)
    {
      const std::vector<std::string> wrong = check::complaints(found, required);
      py::dict result("passed"_a = wrong.empty(), "complaints"_a = in_arrays(wrong),
                      "verdicts"_a = in_arrays(check::verdicts(found)), "rule"_a = found.rule,
                      "rule_factor"_a = found.rule_factor, "rule_remark"_a = found.rule_remark);
      result["causes"] = causes(found);
      result["outliers"] = outliers(found);
      result["moments"] = moments(found);
      result["weights"] =
          py::dict("n_bonds"_a = found.weights.n_bonds, "n_negative"_a = found.weights.n_negative,
                   "largest_family"_a = found.weights.largest_family,
                   "smallest_ratio"_a = found.weights.smallest_ratio,
                   "largest_ratio"_a = found.weights.largest_ratio,
                   "area_defect"_a = to_dict(found.weights.area, found));
      result["symmetry"] = py::dict("asymmetry"_a = found.symmetry.asymmetry,
                                    "imbalance"_a = found.symmetry.imbalance,
                                    "n_unpaired"_a = found.symmetry.n_unpaired);
      result["matrix"] = py::none();
      if (found.has_matrix)
        result["matrix"] = py::dict(
            "n_negative_eigenvalues"_a = found.matrix.n_negative_eigenvalues,
            "smallest_eigenvalue"_a = found.matrix.smallest_eigenvalue,
            "n_rows_with_positive_entries"_a = found.matrix.n_positive,
            "n_rows_not_dominant"_a = found.matrix.n_weak, "failure"_a = found.matrix_failure);
      result["volume_factor"] = found.volume_factor;
      result["volume_defect"] = found.volume_defect;
      py::dict elastic;
      for (const meshfree::ElasticRange &one : found.elastic)
        elastic[one.name.c_str()] = py::make_tuple(one.least, one.median, one.largest);
      result["elastic"] = elastic;
      result["spacing"] = found.level.node_size;
      result["n_free"] = found.body ? found.body->n_families : found.cells->n_free;
      result["n_ignored_bonds"] = found.given.n_ignored;
      result["body"] = py::none();
      if constexpr (dim == 2)
        if (found.body)
          result["body"] = py::module_::import("json").attr("loads")(check::body_json(found));
      return result;
    }

    py::dict check(const Doubles &nodes, const Doubles &volumes, const Integers &i,
                   const Integers &j, const Doubles &w, const physics::Kernel<2> &kernel,
                   const py::object &boxes, const py::object &exclude, const py::object &points,
                   double h, bool boundary_is_data, const std::vector<std::string> &meant,
                   const std::vector<std::string> &require, const std::string &bonds_are,
                   const std::string &boundary, const std::vector<Doubles> &cracks)
    {
      check::GivenBody body;
      body.boundary = check::to_boundary(boundary, "boundary");
      for (std::size_t c = 0; c < cracks.size(); ++c)
        body.cracks.push_back(to_points(cracks[c], "cracks[" + std::to_string(c) + "]"));
      const check::Requirements required = check::parse_requirements(require);
      const auto values = meshfree::to_bond_values(bonds_are, "bonds_are");
      meshfree::GivenNodes<2> given = to_nodes<2>(to_points(nodes, "nodes"), volumes);
      const auto rows = to_rows<2>({i, j, w, points});
      const geometry::Domain domain = to_domain(boxes, exclude);
      if (domain.include.empty())
        throw InputError("boxes is empty; give the domain whose nodes are free, e.g. ((0, 0), (1, "
                         "1))");
      check::Findings<2> found;
      {
        const py::gil_scoped_release others;
        const double size = h > 0 ? h : usual_h(domain, given.places, body.is_periodic());
        found = find(std::move(given), rows, kernel, domain, size, boundary_is_data, meant, values,
                     std::move(body));
      }
      return to_dict(found, required);
    }

    py::dict check_in_space(const Doubles &nodes, const Doubles &volumes, const Integers &i,
                            const Integers &j, const Doubles &w, const physics::Kernel<3> &kernel,
                            const py::object &boxes, const py::object &points, double h,
                            const std::vector<std::string> &meant,
                            const std::vector<std::string> &require, const std::string &bonds_are,
                            const std::string &boundary)
    {
      const geometry::Cuboid omega = to_cuboid(boxes);
      const check::Requirements required = check::parse_requirements(require);
      const auto values = meshfree::to_bond_values(bonds_are, "bonds_are");
      const scene::Boundary known = check::to_boundary(boundary, "boundary");
      if (known == scene::Boundary::free)
        throw InputError("boundary = 'free' is available in plumbline.check, in two dimensions, "
                         "only; give 'constrained' or 'periodic'");
      const bool is_periodic = known == scene::Boundary::periodic;
      meshfree::GivenNodes<3> given = to_nodes<3>(to_points<3>(nodes, "nodes"), volumes);
      const auto rows = to_rows<3>({i, j, w, points});
      check::Findings<3> found;
      {
        const py::gil_scoped_release others;
        if (is_periodic)
          given.box = {omega.lower, omega.upper};
        const double spacing = meshfree::node_spacing(given, omega);
        found.level = {{h > 0 ? h : spacing, kernel.horizon()}, "given", spacing};
        meshfree::GivenWeights<3> weights =
            check::with_cells(std::move(given), omega, is_periodic, found.level.level);
        weights.given =
            meshfree::families_of_rows(rows, weights.nodes, *weights.cells, {"bonds", "index"});
        weights.given.weight_rounding = rounding;
        check::find_defects(values, std::move(weights), kernel, meant, found);
      }
      return to_dict(found, required);
    }
  } // namespace

  void add_check(py::module_ &module)
  {
    module.def("check_arrays", check, "nodes"_a, "volumes"_a, "i"_a, "j"_a, "w"_a, "kernel"_a,
               "boxes"_a, "exclude"_a, "points"_a, "h"_a, "boundary_is_data"_a, "meant"_a,
               "require"_a, "bonds_are"_a, "boundary"_a, "cracks"_a);
    module.def("check_in_space", check_in_space, "nodes"_a, "volumes"_a, "i"_a, "j"_a, "w"_a,
               "kernel"_a, "boxes"_a, "points"_a, "h"_a, "rule"_a, "require"_a, "bonds_are"_a,
               "boundary"_a);
  }
} // namespace plumbline::python
