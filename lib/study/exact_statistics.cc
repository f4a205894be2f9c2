#include "study/exact_statistics.h"

#include "base/error.h"
#include "physics/expression.h"
#include "study/comparison.h"
#include "study/self_convergence.h"

#include <algorithm>
#include <cmath>

namespace plumbline::study
{
  using analysis::PointField;

  namespace
  {
    using dealii::Point;
    using uq::SamplePoints;

    constexpr std::array<unsigned int, 3> n_gauss = {60, 32, 12}; ///< of 1, 2, 3 variables

    /// The key and text of what errors are against, if it is an expression.
    std::optional<std::pair<std::string, std::string>> target_text(const scene::Scene &scene,
                                                                   std::size_t case_index)
    {
      const scene::ProblemSection &problem = scene.problem;
      const scene::Target target = scene.study.decisive_error.target;
      const bool is_local = target == scene::Target::local &&
                            problem.local_solution == scene::LocalSolution::expression;
      if (is_local)
        return std::pair("Problem/local solution", problem.local_expression);
      if (target == scene::Target::exact && case_index < problem.solutions.size())
        return std::pair("Problem/solution", problem.solutions[case_index].expression);
      return {};
    }

    /// Values of the target at places, at a sample.
    using Evaluate = std::function<std::vector<double>(const scene::Scene &)>;

    Evaluate evaluate_at(const std::pair<std::string, std::string> &target, const Record &one,
                         std::size_t stride)
    {
      return [=, places = sampled_field(one), horizon = one.key.horizon](const scene::Scene &scene)
      {
        const physics::Expression u(target.first, target.second,
                                    scene.names(horizon, scene.time.final_time));
        std::vector<double> values;
        for (std::size_t i = 0; i < places.points.size(); i += stride)
          for (unsigned int c = 0; c < places.n_components; ++c)
            values.push_back(u(places.points[i], c));
        return values;
      };
    }

    /// The same of averages over the comparison cells.
    Evaluate averages_at(const scene::Scene &scene, std::size_t case_index, const Record &one)
    {
      const problem::Field<2> nothing{[](const Point<2> &, unsigned int) { return 0.; },
                                      std::nullopt};
      const problem::Level level{one.key.h, one.key.horizon};
      const auto place = std::make_shared<const problem::Problem<2>>(
          make_problem(scene, static_cast<unsigned int>(case_index), level, 0, &nothing));
      const bool is_local = scene.study.decisive_error.target == scene::Target::local;
      return [=](const scene::Scene &at)
      {
        const problem::Problem<2> problem = make_problem(at, static_cast<unsigned int>(case_index),
                                                         level, 0, &nothing, place.get());
        return cell_averages(is_local && problem.local_solution ? *problem.local_solution
                                                                : *problem.solution,
                             *place);
      };
    }

    std::pair<std::vector<double>, std::vector<double>>
    moments(const scene::Scene &scene, const SamplePoints &rule, const Evaluate &evaluate)
    {
      uq::FieldSums sums;
      for (std::size_t i = 0; i < rule.points.size(); ++i)
      {
        std::vector<double> values;
        for (std::size_t d = 0; d < rule.points[i].size(); ++d)
          values.push_back(d < scene.random.variables.size()
                               ? scene.random.variables[d].at(rule.points[i][d])
                               : rule.points[i][d]);
        sums.add(evaluate(at_sample(scene, values, 1)), rule.weights[i]);
      }
      return {sums.mean(), sums.deviation()};
    }
  } // namespace

  std::optional<ExactStatistics> exact_statistics(const scene::Scene &scene, const Record &one)
  {
    const PointField &places = sampled_field(one);
    const std::vector<uq::Law> laws = scene.random.laws();
    const bool is_drawn = scene.random.field != scene::FieldKind::none;
    const std::vector<std::string> cases = scene.problem.case_names();
    const auto case_index = static_cast<std::size_t>(
        std::find(cases.begin(), cases.end(), one.key.problem) - cases.begin());
    const auto target = target_text(scene, case_index);
    if (!target || laws.empty() || laws.size() > n_gauss.size() || is_drawn ||
        places.values.empty())
      return {};
    const bool is_nodal =
        scene.time.is_dynamic() ||
        scene::quantity(scene.study.decisive_error.norm) == scene::Quantity::nodal;
    const unsigned int n = n_gauss[laws.size() - 1];
    const SamplePoints rule = tensor_points(laws, n);
    ExactStatistics result;
    std::tie(result.mean, result.deviation) = moments(
        scene, rule, is_nodal ? evaluate_at(*target, one, 1) : averages_at(scene, case_index, one));
    // by fewer points, of values at some places, from which averages differ little
    constexpr std::size_t n_places = 40;
    const std::size_t stride = std::max<std::size_t>(1, places.points.size() / n_places);
    const Evaluate some = evaluate_at(*target, one, stride);
    const auto fine = moments(scene, rule, some),
               coarse = moments(scene, tensor_points(laws, 3 * n / 4), some);
    double area = 0;
    for (const double part : places.areas)
      area += part;
    const auto change = [&](const std::vector<double> &a, const std::vector<double> &b)
    {
      double largest = 0;
      for (std::size_t i = 0; i < a.size(); ++i)
        largest = std::max(largest, std::abs(a[i] - b[i]));
      return largest * std::sqrt(area);
    };
    result.mean_uncertainty = change(fine.first, coarse.first);
    result.deviation_uncertainty = change(fine.second, coarse.second);
    return result;
  }

  ExactStatistics at_places(const ExactStatistics &statistics, const PointField &from,
                            const PointField &to)
  {
    if (from.points == to.points)
      return statistics;
    for (const PointField *const field : {&from, &to})
      if (const auto [least, most] = std::minmax_element(field->areas.begin(), field->areas.end());
          *most > (1 + 1e-12) * *least)
        throw InputError("levels are held against each other by averages over squares; take nodes "
                         "of lattices (Methods/nodes), or one level (Study/h)");
    const auto squares = [](const PointField &field)
    {
      CellPieces cells;
      for (std::size_t i = 0; i < field.points.size(); ++i)
      {
        const double r = .5 * std::sqrt(field.areas[i]), x = field.points[i][0],
                     y = field.points[i][1];
        cells.cell.push_back(i);
        cells.area.push_back(field.areas[i]);
        cells.pieces.push_back({{x - r, y - r}, {x + r, y - r}, {x + r, y + r}, {x - r, y + r}});
      }
      return cells;
    };
    const CellPieces others = squares(from), cells = squares(to);
    ExactStatistics result;
    result.mean = transferred_averages(others, statistics.mean, cells, to.n_components);
    if (!statistics.deviation.empty())
      result.deviation = transferred_averages(others, statistics.deviation, cells, to.n_components);
    return result;
  }
} // namespace plumbline::study
