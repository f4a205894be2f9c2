#include "study/certificate.h"

#include "base/choice.h"
#include "base/error.h"
#include "scene/on_line.h"
#include "study/comparison.h"
#include "study/estimate_in_space.h"
#include "study/estimate_on_line.h"
#include "study/grade.h"
#include "study/grid_convergence.h"
#include "study/nodal_fit.h"
#include "study/preflight.h"
#include "study/reference_estimate.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace plumbline::study
{
  namespace
  {
    using dealii::Point;
    template <int dim>
    using Points = std::vector<Point<dim>>;
    template <int dim>
    using PointsOf = std::function<Points<dim>(const problem::Problem<dim> &)>;

    constexpr std::size_t n_levels = 3;  ///< that an observed order needs
    constexpr double order_of_rules = 2; ///< at a fixed horizon, of smooth fields, at most
    constexpr double safety = 2; ///< of extrapolation from coarser levels, see estimate_error()
    constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

    /// In space and on a line there is nothing but the problem.
    template <int dim>
    struct BareCase
    {
      problem::Problem<dim> problem;
    };

    /// A solution on intervals with the members that others have.
    struct SolvedOnLine : SolutionOnLine
    {
      std::vector<Point<1>> nodes; ///< in place of their coordinates

      double value(const Point<1> &x, unsigned int /*component*/) const
      {
        return SolutionOnLine::value(x[0]);
      }
    };

    template <int dim>
    auto case_of(const scene::Scene &scene, const problem::Level &level)
    {
      if constexpr (dim == 2)
        return make_case(scene, 0, level);
      else if constexpr (dim == 1)
        return BareCase<1>{make_problem_on_line(scene, 0, level)};
      else
        return BareCase<3>{make_problem_in_space(scene, 0, level)};
    }

    template <int dim>
    auto solve(const method::Method &method, const problem::Problem<dim> &problem)
    {
      return analysis::solve(method, problem);
    }

    SolvedOnLine solve(const method::Method &method, const problem::Problem<1> &problem)
    {
      SolvedOnLine solved{solve_on_line(method, problem), {}};
      for (const double x : solved.SolutionOnLine::nodes)
        solved.nodes.emplace_back(x);
      return solved;
    }

    ErrorEstimate estimate_of(const scene::Case &one, const method::Method &method,
                              const Solution &solution, const Points<2> &points)
    {
      return estimate_error(one, method, solution, false, points);
    }

    ErrorEstimate estimate_of(const BareCase<1> &one, const method::Method &method,
                              const SolvedOnLine &solution, const Points<1> &points)
    {
      return estimate_on_line(method, one.problem, solution, points);
    }

    /// Of its field no rate is known.
    ErrorEstimate estimate_of(const BareCase<3> &one, const method::Method &method,
                              const analysis::SolutionInSpace &solution, const Points<3> &points)
    {
      ErrorEstimate estimate =
          estimate_in_space(method, one.problem, solution, base::Communicator::alone(), points);
      estimate.field_rate = estimate.rate;
      return estimate;
    }

    /// NaN if one of them is.
    double larger(double a, double b)
    {
      return std::isnan(a) || a > b ? a : b;
    }

    double spacing(const problem::Problem<1> &problem)
    {
      return problem.h();
    }
    double spacing(const problem::Problem<2> &problem)
    {
      return problem.h;
    }
    double spacing(const problem::Problem<3> &problem)
    {
      return problem.h();
    }

    double measure(const problem::Problem<1> &problem, std::size_t /*cell*/)
    {
      return problem.h();
    }
    double measure(const problem::Problem<2> &problem, std::size_t cell)
    {
      return cell_area(problem, cell);
    }
    double measure(const problem::Problem<3> &problem, std::size_t /*cell*/)
    {
      return cell_volume(problem);
    }

    /// Of the scene, from which problems in the plane are shifted.
    std::vector<double> coordinates(const problem::Problem<2> &problem, const Point<2> &x)
    {
      const dealii::Tensor<1, 2> of_scene = x + (problem.origin - Point<2>());
      return {of_scene[0], of_scene[1]};
    }
    std::vector<double> coordinates(const problem::Problem<1> & /*problem*/, const Point<1> &x)
    {
      return {x[0]};
    }
    std::vector<double> coordinates(const problem::Problem<3> & /*problem*/, const Point<3> &x)
    {
      return {x[0], x[1], x[2]};
    }

    /// What one way finds; each list has the values at the points, then the mean if it is known.
    struct Found
    {
      CertifiedWay way;
      std::vector<double> values; ///< shape (n_points + 1 or n_points, n_components)
      std::vector<double> bounds;
    };

    /// Of a piecewise field by its averages over the comparison cells, component by component.
    template <int dim>
    std::vector<double> mean_of(const problem::Problem<dim> &problem,
                                const std::vector<double> &averages)
    {
      const unsigned int n = problem.n_components;
      std::vector<double> sums(n);
      double area = 0;
      for (std::size_t cell = 0; cell * n < averages.size(); ++cell)
      {
        const double of_cell = measure(problem, cell);
        area += of_cell;
        for (unsigned int c = 0; c < n; ++c)
          sums[c] += of_cell * averages[cell * n + c];
      }
      for (double &sum : sums)
        sum /= area;
      return sums;
    }

    template <int dim>
    double size_of_cells(const problem::Problem<dim> &problem, std::size_t n_averages)
    {
      double area = 0;
      for (std::size_t cell = 0; cell * problem.n_components < n_averages; ++cell)
        area += measure(problem, cell);
      return area;
    }

    template <int dim>
    double largest_error(const problem::Problem<dim> &problem, const Points<dim> &points,
                         const std::vector<double> &values)
    {
      if (!problem.solution)
        return not_known;
      double largest = 0;
      for (std::size_t i = 0; i < points.size(); ++i)
        for (unsigned int c = 0; c < problem.n_components; ++c)
          largest = larger(largest, std::abs(values[i * problem.n_components + c] -
                                             problem.solution->value(points[i], c)));
      return largest;
    }

    /// Values at points.
    template <int dim, class Solution>
    std::vector<double> values_of(const Solution &solution, const Points<dim> &points,
                                  unsigned int n_components)
    {
      std::vector<double> values;
      for (const Point<dim> &x : points)
        for (unsigned int c = 0; c < n_components; ++c)
          values.push_back(solution.value(x, c));
      return values;
    }

    template <int dim, class Case>
    Found by_galerkin(const Case &one, const method::Method &method, const Points<dim> &points)
    {
      const problem::Problem<dim> &problem = one.problem;
      const auto solution = solve(method, problem);
      const ErrorEstimate estimate = estimate_of(one, method, solution, points);
      Found found{{method.name(), {spacing(problem)}, estimate.field_rate},
                  values_of<dim>(solution, points, problem.n_components),
                  estimate.at_points};
      found.way.error = largest_error<dim>(problem, points, found.values);
      if (!solution.diagnostics.is_outer_error_known) // the estimate is not of all errors
        found.bounds.assign(points.size(), not_known);
      const std::vector<double> mean = mean_of(problem, solution.averages);
      found.values.insert(found.values.end(), mean.begin(), mean.end());
      found.bounds.push_back(solution.diagnostics.is_outer_error_known
                                 ? estimate.estimate /
                                       std::sqrt(size_of_cells(problem, solution.averages.size()))
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
              larger(bounds[i], safety * std::abs(convergence.correction[i * n_components + c]));
      const double of_mean = bounds.back();
      bounds.pop_back();
      raise_to_mean(bounds, round_off);
      bounds.push_back(std::max(of_mean + round_off, root_mean_square(bounds)));
      return bounds;
    }

    /// Values at the points and the mean by a rule on each of the finest levels.
    struct RuleValues
    {
      std::vector<double> h;
      std::vector<std::vector<double>> values; ///< shape (n_levels, n_points + 1, n_components)
      double tolerance = 0;                    ///< of the solver
      double error = not_known;                ///< the largest on the finest level
    };

    /// Of each rule.
    template <int dim>
    std::vector<RuleValues> values_by_rules(const scene::Scene &scene, const method::Methods &rules,
                                            const PointsOf<dim> &points)
    {
      std::vector<RuleValues> found(rules.size());
      const auto &levels = scene.study.series.front().levels;
      for (std::size_t level = levels.size() - n_levels; level < levels.size(); ++level)
      {
        const auto one = case_of<dim>(scene, levels[level]);
        const problem::Problem<dim> &problem = one.problem;
        const Points<dim> places = points(problem);
        for (std::size_t k = 0; k < rules.size(); ++k)
        {
          const auto solution = solve(*rules[k], problem);
          std::vector<double> values =
              values_by_fit(places, solution.nodes, solution.nodal, problem.n_components);
          found[k].error = largest_error<dim>(problem, places, values);
          const std::vector<double> mean = mean_of(problem, solution.averages);
          values.insert(values.end(), mean.begin(), mean.end());
          found[k].values.push_back(std::move(values));
          found[k].h.push_back(spacing(problem));
          found[k].tolerance = problem.settings.solver.tolerance;
        }
      }
      return found;
    }

    Found by_meshfree(const RuleValues &rule, const std::string &name, unsigned int n_components)
    {
      double size = 0;
      for (const double u : rule.values.back())
        size = std::max(size, std::abs(u));
      const GridConvergence convergence = grid_convergence(rule.h, rule.values, order_of_rules);
      Found found;
      found.way = {name, rule.h, convergence.order, rule.error};
      found.values = rule.values.back();
      found.bounds = bounds_by_changes(convergence, found.values.size() / n_components,
                                       n_components, solver_error(rule.tolerance, size));
      return found;
    }

    /// How far a rule's values are from the certified ones.
    CertifiedRule rule_of(const Certificate &certificate, const std::string &name,
                          const RuleValues &found)
    {
      std::vector<GivenValues> given;
      const std::size_t n_values = certificate.points.size() * certificate.n_components;
      for (const std::vector<double> &values : found.values) // without the mean
        given.push_back(
            {name, {values.begin(), values.begin() + static_cast<std::ptrdiff_t>(n_values)}});
      const SeriesGrade series = grade(certificate, given, found.h);
      CertifiedRule rule{name, found.h, {}, {}, {}, series.order.value};
      for (const Grade &one : series.grades)
      {
        rule.largest.push_back(one.largest);
        rule.root_mean_square.push_back(one.root_mean_square);
        rule.digits.push_back(one.digits);
      }
      return rule;
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
        largest = larger(largest, std::abs(a[c] - b[c]));
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

  namespace
  {
    template <int dim>
    Certificate certify_in(const scene::Scene &scene, const method::Method &galerkin,
                           const method::Methods &rules, std::size_t galerkin_level,
                           const PointsOf<dim> &points)
    {
      const auto &levels = scene.study.series.front().levels;
      const auto one = case_of<dim>(scene, levels[galerkin_level]);
      const Points<dim> places = points(one.problem);
      const unsigned int n = one.problem.n_components;
      const std::vector<RuleValues> of_rules = values_by_rules<dim>(scene, rules, points);
      const Found by_first = by_galerkin<dim>(one, galerkin, places),
                  by_second = by_meshfree(of_rules.front(), rules.front()->name(), n);
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
          if (!scene.methods.nodes.are_vertices() &&
              !(scene.domain.is_in_space() && scene.domain.mesh.is_file()))
            certificate.mean = value;
          break;
        }
        if (one.problem.solution)
          for (unsigned int c = 0; c < n; ++c)
            value.exact.push_back(one.problem.solution->value(places[i], c));
        value.x = coordinates(one.problem, places[i]);
        certificate.points.push_back(value);
      }
      for (std::size_t k = 0; k < rules.size(); ++k)
        certificate.rules.push_back(rule_of(certificate, rules[k]->name(), of_rules[k]));
      return certificate;
    }
  } // namespace

  Certificate certify(const scene::Scene &scene, const method::Method &galerkin,
                      const method::Methods &rules, std::size_t galerkin_level,
                      const PointsOf<2> &points)
  {
    return certify_in<2>(scene, galerkin, rules, galerkin_level, points);
  }

  Certificate certify(const scene::Scene &scene, const method::Method &galerkin,
                      const method::Methods &rules, std::size_t galerkin_level,
                      const PointsOf<3> &points)
  {
    return certify_in<3>(scene, galerkin, rules, galerkin_level, points);
  }

  Certificate certify(const scene::Scene &scene, const method::Method &galerkin,
                      const method::Methods &rules, std::size_t galerkin_level,
                      const PointsOf<1> &points)
  {
    return certify_in<1>(scene, galerkin, rules, galerkin_level, points);
  }

  void check_certifiable(const scene::Scene &scene)
  {
    const auto refuse = [&](const std::string &what)
    { throw InputError("scene '" + scene.name + "': " + what); };
    if (scene.is_no_problem())
      refuse("a certificate is of a static problem; leave out Time, Crack, Fracture and Strip");
    if (const auto cases = scene.problem.case_names(); cases.size() != 1)
      refuse("Problem/solution and load pose " + std::to_string(cases.size()) +
             " cases; a certificate is of one: leave one in");
    if (scene.output.points.empty())
      refuse("Output/points is empty; name a CSV file with the columns x,y (x in one dimension, "
             "x,y,z in three): the points at which the solution is to be certified");
    if (!scene.reference.method)
      refuse("Reference/method = none; name the Galerkin method whose values are certified, "
             "e.g. Q2 on a lattice or P2 on triangles");
    if (scene.reference.h != 0)
      refuse("Reference/mesh size: values are certified on the mesh of each level; leave it out");
    if (scene.domain.is_damaged())
      refuse("Domain/cracks and outside: values at nodes are not fitted across cracks and free "
             "surfaces, so that the two ways cannot be compared at points; leave them out");
    if (scene.reference.estimate == scene::Estimate::none)
      refuse(
          "Reference/estimate = none, but a certificate needs the estimated error; leave it out");
    if (scene.study.regime != scene::Regime::m || scene.study.series.size() != 1)
      refuse("Study/regime must be m with one horizon, e.g. Study/horizon = 0.2: a certificate is "
             "for one nonlocal problem, "
             "on finer and finer meshes");
    if (const std::size_t n = scene.study.series.front().levels.size(); n < n_levels)
      refuse("Study/h has " + std::to_string(n) +
             " mesh sizes; the bound of the meshfree rule "
             "needs three at least");
  }

  namespace
  {
    /// The meshfree rules that the scene names, of which the first one confirms.
    Methods rules_of(const scene::Scene &scene, const Methods &methods)
    {
      Methods rules;
      for (const auto &one : choose_methods(scene, methods))
        if (one->family() == method::MethodFamily::meshfree)
          rules.push_back(one);
      if (!rules.empty())
        return rules;
      throw InputError("scene '" + scene.name +
                       "': Methods/names has no meshfree rule to confirm the values; add "
                       "one, e.g. IPA-AC-R2");
    }

    /// The reference, which can do the scene.
    std::shared_ptr<const Method> reference_of(const scene::Scene &scene, const Methods &methods)
    {
      const auto method = find_method(methods, *scene.reference.method, "Reference/method");
      if (method->family() != method::MethodFamily::reference)
        throw InputError(
            "scene '" + scene.name + "': Reference/method = " + method->name() +
            " is not a Galerkin method of the nonlocal problem; name one, e.g. Q2 or P2");
      return method;
    }
  } // namespace

  CertifiedWays certified_ways(const scene::Scene &scene, const Methods &available,
                               unsigned int reference_level)
  {
    CertifiedWays ways{reference_of(scene, available), rules_of(scene, available)};
    const auto n_levels = static_cast<unsigned int>(scene.study.series.front().levels.size());
    const unsigned int level = reference_level == 0 ? n_levels : reference_level;
    if (level > n_levels)
      throw InputError("--reference-level = " + std::to_string(level) + ", but Study/h has " +
                       std::to_string(n_levels) + " mesh sizes");
    check_memory(scene, {ways.galerkin}, available, level);
    check_memory(without_reference(scene), ways.rules, available, 0);
    ways.level = level - 1;
    return ways;
  }
} // namespace plumbline::study
