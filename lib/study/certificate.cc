#include "study/certificate.h"

#include "base/choice.h"
#include "base/error.h"
#include "study/comparison.h"
#include "study/grid_convergence.h"
#include "study/nodal_fit.h"
#include "study/reference_estimate.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace plumbline::study
{
  namespace
  {
    using dealii::Point;
    using Points = std::vector<Point<2>>;

    constexpr std::size_t n_levels = 3;  ///< that an observed order needs
    constexpr double order_of_rules = 2; ///< at a fixed horizon, of smooth fields, at most
    constexpr double safety = 2; ///< of extrapolation from coarser levels, see estimate_error()
    constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

    /// What one way finds; each list has the values at the points, then the mean if it is known.
    struct Found
    {
      CertifiedWay way;
      std::vector<double> values; ///< shape (n_points + 1 or n_points, n_components)
      std::vector<double> bounds;
    };

    /// Of a piecewise field by its averages over the comparison cells, component by component.
    std::vector<double> mean_of(const problem::Problem<2> &problem,
                                const std::vector<double> &averages)
    {
      const unsigned int n = problem.n_components;
      std::vector<double> sums(n);
      double area = 0;
      for (std::size_t cell = 0; cell * n < averages.size(); ++cell)
      {
        const double of_cell = cell_area(problem, cell);
        area += of_cell;
        for (unsigned int c = 0; c < n; ++c)
          sums[c] += of_cell * averages[cell * n + c];
      }
      for (double &sum : sums)
        sum /= area;
      return sums;
    }

    double area_of_cells(const problem::Problem<2> &problem, std::size_t n_averages)
    {
      double area = 0;
      for (std::size_t cell = 0; cell * problem.n_components < n_averages; ++cell)
        area += cell_area(problem, cell);
      return area;
    }

    double largest_error(const problem::Problem<2> &problem, const Points &points,
                         const std::vector<double> &values)
    {
      if (!problem.solution)
        return not_known;
      double largest = 0;
      for (std::size_t i = 0; i < points.size(); ++i)
        for (unsigned int c = 0; c < problem.n_components; ++c)
          largest = std::max(largest, std::abs(values[i * problem.n_components + c] -
                                               problem.solution->value(points[i], c)));
      return largest;
    }

    /// Values at points.
    std::vector<double> values_of(const Solution &solution, const Points &points,
                                  unsigned int n_components)
    {
      std::vector<double> values;
      for (const Point<2> &x : points)
        for (unsigned int c = 0; c < n_components; ++c)
          values.push_back(solution.value(x, c));
      return values;
    }

    Found by_galerkin(const scene::Case &one, const method::Method &method, const Points &points)
    {
      const problem::Problem<2> &problem = one.problem;
      const Solution solution = analysis::solve(method, problem);
      const ErrorEstimate estimate = estimate_error(one, method, solution, false, points);
      Found found{{method.name(), {problem.h}, estimate.field_rate},
                  values_of(solution, points, problem.n_components),
                  estimate.at_points};
      found.way.error = largest_error(problem, points, found.values);
      if (!solution.diagnostics.is_outer_error_known) // the estimate is not of all errors
        found.bounds.assign(points.size(), not_known);
      const std::vector<double> mean = mean_of(problem, solution.averages);
      found.values.insert(found.values.end(), mean.begin(), mean.end());
      found.bounds.push_back(solution.diagnostics.is_outer_error_known
                                 ? estimate.estimate /
                                       std::sqrt(area_of_cells(problem, solution.averages.size()))
                                 : not_known);
      return found;
    }

    /// Twice the extrapolated error at each place; NaN where nothing can be extrapolated.
    /// @param round_off  changes up to it are none
    std::vector<double> bounds_by_changes(const GridConvergence &convergence, std::size_t n_places,
                                          unsigned int n_components, double round_off)
    {
      if (!convergence.is_known())
        return std::vector<double>(n_places,
                                   convergence.last_change <= round_off ? round_off : not_known);
      std::vector<double> bounds(n_places);
      for (std::size_t i = 0; i < n_places; ++i)
        for (unsigned int c = 0; c < n_components; ++c)
          bounds[i] =
              std::max(bounds[i], safety * std::abs(convergence.correction[i * n_components + c]));
      const double of_mean = bounds.back();
      bounds.pop_back();
      raise_to_mean(bounds, round_off);
      bounds.push_back(std::max(of_mean + round_off, root_mean_square(bounds)));
      return bounds;
    }

    Found by_meshfree(const scene::Scene &scene, const method::Method &method,
                      const std::function<Points(const problem::Problem<2> &)> &points)
    {
      Found found;
      found.way.method = method.name();
      std::vector<std::vector<double>> values;
      const auto &levels = scene.study.series.front().levels;
      double size = 0, tolerance = 0;
      unsigned int n_components = 1;
      for (std::size_t level = levels.size() - n_levels; level < levels.size(); ++level)
      {
        const problem::Problem<2> problem = make_problem(scene, 0, levels[level]);
        const Solution solution = analysis::solve(method, problem);
        const Points places = points(problem);
        n_components = problem.n_components;
        values.push_back(values_by_fit(places, solution.nodes, solution.nodal, n_components));
        found.way.error = largest_error(problem, places, values.back());
        const std::vector<double> mean = mean_of(problem, solution.averages);
        values.back().insert(values.back().end(), mean.begin(), mean.end());
        found.way.h.push_back(problem.h);
        tolerance = problem.settings.solver.tolerance;
      }
      for (const double u : values.back())
        size = std::max(size, std::abs(u));
      const GridConvergence convergence = grid_convergence(found.way.h, values, order_of_rules);
      found.way.order = convergence.order;
      found.values = values.back();
      found.bounds = bounds_by_changes(convergence, found.values.size() / n_components,
                                       n_components, solver_error(tolerance, size));
      return found;
    }

    CertifiedValue value_of(const Found &galerkin, const Found &meshfree, std::size_t place,
                            unsigned int n_components)
    {
      const auto part = [&](const std::vector<double> &values)
      {
        const auto first = values.begin() + static_cast<std::ptrdiff_t>(place * n_components);
        return std::vector<double>(first, first + n_components);
      };
      CertifiedValue value;
      value.value = part(galerkin.values);
      value.bound = galerkin.bounds[place];
      value.other = part(meshfree.values);
      value.other_bound = meshfree.bounds[place];
      return value;
    }
  } // namespace

  namespace
  {
    /// The largest of a component; NaN if one of them is not finite.
    double largest_difference(const std::vector<double> &a, const std::vector<double> &b)
    {
      double largest = 0;
      for (std::size_t c = 0; c < a.size(); ++c)
        if (const double one = std::abs(a[c] - b[c]); !(one <= largest)) // NaN stays
          largest = one;
      return largest;
    }
  } // namespace

  double CertifiedValue::difference() const
  {
    return largest_difference(value, other);
  }

  double CertifiedValue::error() const
  {
    return exact.empty() ? not_known : largest_difference(value, exact);
  }

  bool CertifiedValue::has_bounds() const
  {
    return std::isfinite(bound) && std::isfinite(other_bound);
  }

  bool CertifiedValue::is_certain() const
  {
    return has_bounds() && difference() <= bound + other_bound &&
           (exact.empty() || error() <= bound);
  }

  std::vector<const CertifiedValue *> Certificate::refused() const
  {
    std::vector<const CertifiedValue *> result;
    for (const CertifiedValue &one : points)
      if (!one.is_certain())
        result.push_back(&one);
    if (mean && !mean->is_certain())
      result.push_back(&*mean);
    return result;
  }

  unsigned int Certificate::least_digits() const
  {
    unsigned int least = std::numeric_limits<unsigned int>::max();
    for (const CertifiedValue &one : points)
      least = std::min(least, one.digits);
    return least;
  }

  unsigned int Certificate::confirmed_digits() const
  {
    double largest = 0;
    for (const CertifiedValue &one : points)
      largest = std::max({largest, one.difference(), one.other_bound});
    return certified_digits(largest, size);
  }

  Certificate certify(const scene::Scene &scene, const method::Method &galerkin,
                      const method::Method &meshfree, std::size_t galerkin_level,
                      const std::function<Points(const problem::Problem<2> &)> &points)
  {
    const auto &levels = scene.study.series.front().levels;
    const scene::Case one = make_case(scene, 0, levels[galerkin_level]);
    const Points places = points(one.problem);
    const unsigned int n = one.problem.n_components;
    const Found by_first = by_galerkin(one, galerkin, places),
                by_second = by_meshfree(scene, meshfree, points);
    Certificate certificate;
    certificate.name = scene.name;
    certificate.purpose = scene.purpose;
    certificate.scene_text = scene.text;
    certificate.horizon = one.problem.horizon();
    certificate.n_components = n;
    certificate.galerkin = by_first.way;
    certificate.meshfree = by_second.way;
    certificate.size = std::sqrt(static_cast<double>(n)) *
                       root_mean_square({by_first.values.begin(),
                                         by_first.values.begin() +
                                             static_cast<std::ptrdiff_t>(places.size() * n)});
    for (std::size_t i = 0; i <= places.size(); ++i)
    {
      CertifiedValue value = value_of(by_first, by_second, i, n);
      value.digits = certified_digits(value.bound, certificate.size);
      if (i == places.size())
      {
        if (!scene.methods.nodes.are_vertices())
          certificate.mean = value;
        break;
      }
      if (one.problem.solution)
        for (unsigned int c = 0; c < n; ++c)
          value.exact.push_back(one.problem.solution->value(places[i], c));
      const dealii::Tensor<1, 2> x = places[i] + (one.problem.origin - Point<2>());
      value.x = {x[0], x[1]};
      certificate.points.push_back(value);
    }
    return certificate;
  }

  void check_certifiable(const scene::Scene &scene)
  {
    const auto refuse = [&](const std::string &what)
    { throw InputError("scene '" + scene.name + "': " + what); };
    if (scene.is_no_problem())
      refuse("a certificate is of a static problem; leave out Time, Crack, Fracture and Strip");
    if (scene.domain.is_in_space())
      refuse("Domain/dimension = 3: a certificate is of a problem in two dimensions");
    if (const auto cases = scene.problem.case_names(); cases.size() != 1)
      refuse("Problem/solution and load pose " + std::to_string(cases.size()) +
             " cases; a certificate is of one: leave one in");
    if (scene.output.points.empty())
      refuse("Output/points is empty; name a CSV file with the columns x,y, at whose points the "
             "solution is to be certified");
    if (!scene.reference.method)
      refuse("Reference/method = none; name the Galerkin method whose values are certified, "
             "e.g. Q2 on a lattice or P2 on triangles");
    if (scene.domain.is_damaged())
      refuse("Domain/cracks and outside: values at nodes are not fitted across cracks and free "
             "surfaces, so that the two ways cannot be compared at points; leave them out");
    if (scene.reference.estimate == scene::Estimate::none)
      refuse(
          "Reference/estimate = none, but a certificate needs the estimated error; leave it out");
    if (scene.study.regime != scene::Regime::m || scene.study.series.size() != 1)
      refuse("Study/regime must be m with one horizon: a certificate is of one nonlocal problem, "
             "on finer and finer meshes");
    if (const std::size_t n = scene.study.series.front().levels.size(); n < n_levels)
      refuse("Study/h has " + std::to_string(n) +
             " mesh sizes; the bound of the meshfree rule "
             "needs three at least");
  }
} // namespace plumbline::study
