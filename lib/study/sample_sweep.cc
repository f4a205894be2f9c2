#include "study/sample_sweep.h"

#include "base/error.h"
#include "base/number_text.h"

namespace plumbline::study
{
  namespace
  {
    using dealii::Point;

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

  std::vector<SampleCase> sample_study(const Analysis &analysis, const scene::Scene &scene,
                                       const Methods &available, const base::Communicator &ranks)
  {
    std::vector<SampleCase> cases;
    const Methods methods = analysis.choose_methods(scene, available, 0, 1);
    RunControl control;
    control.ranks = ranks;
    for (const Record &record : run_study(analysis, scene, methods, control).records)
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
      for (const auto &[name, field] : record.fields)
        if (!analysis.sampled.empty() && analysis.is_sampled(name))
          one.field = field_of(field);
      if (const auto field = record.fields.find(analysis.sampled_field);
          field != record.fields.end())
        one.field = last_component(field->second, key.h * key.h);
      if (!one.quantities.empty() || !one.field.values.empty())
        cases.push_back(std::move(one));
    }
    return cases;
  }
} // namespace plumbline::study
