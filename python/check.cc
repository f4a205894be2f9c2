#include "arrays.h"
#include "base/number_text.h"
#include "bindings.h"
#include "check/body.h"
#include "geometry/mesh_input.h"
#include "meshfree/check/bond_values.h"
#include "meshfree/check/row_families.h"

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

    meshfree::GivenNodes to_nodes(std::vector<Point<2>> places, const double *volumes)
    {
      meshfree::GivenNodes nodes;
      nodes.file = "nodes";
      double size = 0;
      for (std::size_t k = 0; k < places.size(); ++k)
      {
        nodes.id.push_back(static_cast<std::int64_t>(k));
        nodes.line.push_back(k);
        nodes.volume.push_back(volumes[k]);
        if (!(volumes[k] > 0) || !std::isfinite(volumes[k]))
          throw InputError("volumes[" + std::to_string(k) + "] = " + std::to_string(volumes[k]) +
                           " is not positive; give the area of the node's cell");
        size = std::max({size, std::abs(places[k][0]), std::abs(places[k][1])});
      }
      nodes.places = std::move(places);
      nodes.rounding = rounding * size;
      nodes.volume_rounding = rounding;
      return nodes;
    }

    /// @param points  empty: kernels are taken at the neighbours
    std::vector<meshfree::GivenRow> to_rows(const Integers &i, const Integers &j, const Doubles &w,
                                            const std::vector<Point<2>> &points)
    {
      const auto n = static_cast<std::size_t>(w.size());
      std::vector<meshfree::GivenRow> rows(n);
      for (std::size_t k = 0; k < n; ++k)
      {
        rows[k] = {i.data()[k], j.data()[k], w.data()[k], {}, k};
        if (!std::isfinite(rows[k].weight))
          throw InputError("w[" + std::to_string(k) + "] = " + std::to_string(rows[k].weight) +
                           " is no weight; give finite numbers");
        if (points.empty())
          continue;
        rows[k].kernel_point = points[k];
        if (points[k].square() == 0)
          throw InputError("points[" + std::to_string(k) +
                           "] is 0, the place of node i itself, where kernels may be infinite; "
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

    check::Findings find(meshfree::GivenNodes nodes, const std::vector<meshfree::GivenRow> &rows,
                         const physics::Kernel<2> &kernel, const geometry::Domain &domain, double h,
                         bool boundary_is_data, const std::vector<std::string> &meant,
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
      meshfree::GivenCells cells = meshfree::given_cells(nodes, mesh, has_data && !is_free);
      check::Findings found;
      found.level = {level, "given", meshfree::node_spacing(nodes, mesh)};
      found.n_on_boundary = boundary_is_data || is_free ? 0 : cells.n_on_boundary;
      meshfree::GivenWeights weights;
      weights.cells = std::make_shared<const geometry::NodeCells<2>>(std::move(cells.cells));
      weights.given = meshfree::families_of_rows(rows, nodes, *weights.cells, {"bonds", "index"});
      weights.given.weight_rounding = rounding;
      weights.nodes = std::move(nodes);
      problem::Problem<2> problem = check::problem_on(mesh, weights.cells, kernel, h);
      check::find_defects(body, "cracks", values, std::move(weights), cells.uncut_areas,
                          std::move(problem), meant, found);
      return found;
    }

    /// Words of the command, whose lines are indices here.
    std::string in_arrays(std::string text)
    {
      for (std::size_t at = 0; (at = text.find("(line ", at)) != std::string::npos; at += 7)
        text.replace(at, 6, "(index ");
      const std::string of_scenes = check::where_lengths_are_given;
      if (const std::size_t at = text.find(of_scenes); at != std::string::npos)
        text.erase(at, of_scenes.size());
      return text;
    }

    py::list in_arrays(const std::vector<std::string> &texts)
    {
      py::list result;
      for (const std::string &one : texts)
        result.append(in_arrays(one));
      return result;
    }

    py::dict to_dict(const meshfree::Worst &worst, const check::Findings &found)
    {
      return py::dict("value"_a = worst.value, "node"_a = found.ids[worst.node]);
    }

    py::list outliers(const check::Findings &found)
    {
      py::list result;
      for (const Outlier &o : found.outliers)
      {
        const bool has_row = o.bond != Outlier::none;
        result.append(py::dict("node"_a = found.ids[o.node],
                               "neighbour"_a = o.neighbour == Outlier::none
                                                   ? py::object(py::none())
                                                   : py::cast(found.ids[o.neighbour]),
                               "index"_a = has_row ? py::cast(found.given.lines[o.node][o.bond])
                                                   : py::object(py::none()),
                               "found"_a = o.found, "expected"_a = o.expected,
                               "text"_a = in_arrays(check::text(o, found))));
      }
      return result;
    }

    py::list causes(const check::Findings &found)
    {
      py::list result;
      for (const meshfree::Cause &cause : found.causes)
        result.append(py::dict("name"_a = cause.name, "text"_a = cause.text,
                               "factor"_a = cause.factor, "defect_before"_a = cause.before,
                               "defect_after"_a = cause.after));
      return result;
    }

    py::dict moments(const check::Findings &found)
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

    py::dict to_dict(const check::Findings &found, const check::Requirements &required)
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
      result["matrix"] = py::dict("n_negative_eigenvalues"_a = found.matrix.n_negative_eigenvalues,
                                  "smallest_eigenvalue"_a = found.matrix.smallest_eigenvalue,
                                  "n_rows_with_positive_entries"_a = found.matrix.n_positive,
                                  "n_rows_not_dominant"_a = found.matrix.n_weak,
                                  "failure"_a = found.matrix_failure);
      result["volume_factor"] = found.volume_factor;
      result["volume_defect"] = found.volume_defect;
      result["n_free"] = found.body ? found.body->n_families : found.cells->n_free;
      result["n_ignored_bonds"] = found.given.n_ignored;
      result["body"] = py::none();
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
      std::vector<Point<2>> places = to_points(nodes, "nodes");
      require_length(volumes, places.size(), "volumes", "node");
      const auto n = static_cast<std::size_t>(w.size());
      require_length(w, n, "w", "bond");
      require_length(i, n, "i", "bond");
      require_length(j, n, "j", "bond");
      std::vector<Point<2>> kernel_points;
      if (!points.is_none())
        kernel_points = to_points(points.cast<Doubles>(), "points");
      if (!points.is_none() && kernel_points.size() != n)
        throw InputError("points has " + std::to_string(kernel_points.size()) + " rows for " +
                         std::to_string(n) + " bonds; give one for each, relative to node i");
      const geometry::Domain domain = to_domain(boxes, exclude);
      if (domain.include.empty())
        throw InputError("boxes is empty; give the domain whose nodes are free, e.g. ((0, 0), (1, "
                         "1))");
      check::Findings found;
      {
        const py::gil_scoped_release others;
        meshfree::GivenNodes given = to_nodes(std::move(places), volumes.data());
        const double size = h > 0 ? h : usual_h(domain, given.places, body.is_periodic());
        found = find(std::move(given), to_rows(i, j, w, kernel_points), kernel, domain, size,
                     boundary_is_data, meant, values, std::move(body));
      }
      return to_dict(found, required);
    }
  } // namespace

  void add_check(py::module_ &module)
  {
    module.def("check_arrays", check, "nodes"_a, "volumes"_a, "i"_a, "j"_a, "w"_a, "kernel"_a,
               "boxes"_a, "exclude"_a, "points"_a, "h"_a, "boundary_is_data"_a, "meant"_a,
               "require"_a, "bonds_are"_a, "boundary"_a, "cracks"_a);
  }
} // namespace plumbline::python
