#include "study/sample_sweep.h"

#include "base/error.h"
#include "base/number_text.h"

namespace plumbline::study
{
  namespace
  {
    /// @param area  that each point stands for
    analysis::PointField last_component(const analysis::PointField &field, double area)
    {
      analysis::PointField last;
      last.points = field.points;
      for (std::size_t i = 0; i < field.points.size(); ++i)
        last.values.push_back(field.values[(i + 1) * field.n_components - 1]);
      last.areas.assign(field.points.size(), area);
      return last;
    }
  } // namespace

  Records sample_study(const Analysis &analysis, const scene::Scene &scene,
                       const Methods &available, const base::Communicator &ranks)
  {
    Records sampled;
    const Methods methods = analysis.choose_methods(scene, available, 0, 1);
    RunControl control;
    control.ranks = ranks;
    for (const Record &record : run_study(analysis, scene, methods, control).records)
    {
      const Key &key = record.key;
      if (!record.failure.empty())
        throw NumericalError(key.label() + ", " + key.series + ", h = " + base::to_text(key.h, 4) +
                             ": " + record.failure);
      Record one;
      one.key = key;
      one.key.method = key.label();
      one.key.variant.clear();
      one.cost = record.cost;
      for (const auto &scalar : record.scalars)
        if (analysis.is_sampled(scalar.first))
          one.scalars.insert(scalar);
      for (const auto &field : record.fields)
        if (!analysis.sampled.empty() && analysis.is_sampled(field.first))
          one.fields = {field};
      if (const auto field = record.fields.find(analysis.sampled_field);
          field != record.fields.end())
        one.fields = {{field->first, last_component(field->second, key.h * key.h)}};
      if (!one.scalars.empty() || !sampled_field(one).values.empty())
        sampled.push_back(std::move(one));
    }
    return sampled;
  }
} // namespace plumbline::study
