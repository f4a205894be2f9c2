#include "study/sample_sweep.h"

#include "base/error.h"
#include "base/number_text.h"
#include "study/comparison.h"
#include "study/solution_record.h"

namespace plumbline::study
{
  namespace
  {
    using dealii::Point;

    SampleField field_of(const problem::Problem<2> &problem, const Solution &solution,
                         bool is_nodal)
    {
      SampleField field;
      field.n_components = problem.n_components;
      field.values = is_nodal ? solution.nodal : solution.averages;
      const std::vector<Point<2>> places = is_nodal ? solution.nodes : comparison_points(problem);
      const double of_node = node_area(problem, solution);
      for (std::size_t i = 0; i < places.size(); ++i)
      {
        field.x.push_back(places[i][0]);
        field.y.push_back(places[i][1]);
        field.area.push_back(is_nodal ? of_node : cell_area(problem, i));
      }
      return field;
    }

    /// @param area  that each point stands for
    SampleField last_component(const analysis::PointField &field, double area)
    {
      SampleField last;
      for (std::size_t i = 0; i < field.points.size(); ++i)
      {
        last.x.push_back(field.points[i][0]);
        last.y.push_back(field.points[i][1]);
        last.values.push_back(field.values[(i + 1) * field.n_components - 1]);
      }
      last.area.assign(field.points.size(), area);
      return last;
    }

    SampleField field_of(const analysis::PointField &of)
    {
      SampleField field;
      field.n_components = of.n_components;
      field.values = of.values;
      field.area = of.areas;
      for (const Point<2> &point : of.points)
      {
        field.x.push_back(point[0]);
        field.y.push_back(point[1]);
      }
      return field;
    }
  } // namespace

  std::vector<SampleCase> sweep_sample(const scene::Scene &scene, const Methods &methods,
                                       const Methods &available)
  {
    const bool is_nodal =
        scene::quantity(scene.study.decisive_error.norm) == scene::Quantity::nodal;
    std::vector<SampleCase> cases;
    StaticsOptions options;
    options.on_solution =
        [&](const problem::Problem<2> &problem, const Solution &solution, const Record &run)
    {
      SampleCase one;
      one.method = run.key.method;
      one.problem = run.key.problem;
      one.series = run.key.series;
      one.level = run.key.level;
      one.h = run.key.h;
      one.horizon = run.key.horizon;
      one.seconds = run.cost.setup_seconds + run.cost.solve_seconds;
      one.quantities = errors_of(run);
      one.field = field_of(problem, solution, is_nodal);
      cases.push_back(std::move(one));
    };
    RunControl control;
    control.ranks = base::Communicator::all();
    const StudyResults results =
        run_study(statics_analysis(available, options), scene, methods, control);
    for (const Record &run : results.records)
      if (!run.failure.empty())
        throw NumericalError(run.key.method + ", " + run.key.problem + ", " + run.key.series +
                             ": " + run.failure);
    return cases;
  }

  std::vector<SampleCase> sample_study(const Analysis &analysis, const scene::Scene &scene,
                                       const Methods &available)
  {
    std::vector<SampleCase> cases;
    const Methods methods = analysis.choose_methods(scene, available, 0, 1);
    for (const Record &record : run_study(analysis, scene, methods).records)
    {
      const Key &key = record.key;
      if (!record.failure.empty())
        throw NumericalError(key.label() + ", " + key.series + ", h = " + base::to_text(key.h, 4) +
                             ": " + record.failure);
      SampleCase one{key.label(), key.problem, key.series,           key.level,
                     key.h,       key.horizon, record.cost.seconds()};
      for (const auto &[name, scalar] : record.scalars)
        if (analysis.is_sampled(name))
          one.quantities[name] = scalar.value;
      if (one.quantities.empty())
        continue;
      for (const auto &[name, field] : record.fields)
        if (!analysis.sampled.empty() && analysis.is_sampled(name))
          one.field = field_of(field);
      if (const auto field = record.fields.find(analysis.sampled_field);
          field != record.fields.end())
        one.field = last_component(field->second, key.h * key.h);
      cases.push_back(std::move(one));
    }
    return cases;
  }
} // namespace plumbline::study
