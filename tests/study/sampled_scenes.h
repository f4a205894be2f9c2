#pragma once

#include "study/sampling.h"

#include <cmath>

/// Records of samples that are exact, and scenes that ask for them.
namespace sampled_scenes
{
  using namespace plumbline;
  using study::CaseStatistics;
  using study::make_sampling_plan;
  using study::Record;
  using study::Records;
  using study::SamplingPlan;
  using study::SamplingResults;
  using study::SetStatistics;

  using Settings = std::vector<scene::Override>;

  /// u = (1 + c) x on the unit square, c ~ N(0, .2²), and d uniform on (2, 4).
  inline scene::Scene random_scene(const Settings &settings)
  {
    Settings all = {{"Random/variables", "c: normal 0 0.2; d: uniform 2 4"},
                    {"Sampling/rule", "tensor"},
                    {"Sampling/counts", "1, 2"},
                    {"Problem/solution", "(1 + c)*x"},
                    {"Methods/names", "PA-AC"},
                    {"Study/h", "0.25"}};
    all.insert(all.end(), settings.begin(), settings.end());
    return scene::parse_scene("random", "", all);
  }

  /// A sample whose field at four places is the exact one, and whose quantity is a given function
  /// of the variables.
  inline Records exact_record(const SamplingPlan &plan, std::size_t sample,
                              const std::function<double(const std::vector<double> &)> &quantity)
  {
    const std::vector<double> &values = plan.values[sample];
    Record one;
    one.key.method = "PA-AC";
    one.key.problem = "u";
    one.key.series = "m = 3";
    one.key.h = .25;
    one.key.horizon = .75;
    one.cost.solve_seconds = 1;
    one.set("q", quantity(values));
    analysis::PointField &field = one.fields["u"];
    field.points = {{.1, .1}, {.4, .1}, {.6, .9}, {.9, .9}};
    field.areas.assign(4, .25);
    for (const auto &point : field.points)
      field.values.push_back((1 + values[0]) * point[0]);
    return {one};
  }

  /// Of a method at one of two levels, a field of the averages over squares of the unit square.
  /// @param value  at their centres
  inline Record averages_record(unsigned int level,
                                const std::function<double(const dealii::Point<2> &)> &value)
  {
    const int n = level == 0 ? 2 : 4;
    Record one;
    one.key.method = "PA-AC";
    one.key.series = "m = 3";
    one.key.level = level;
    one.key.h = 1. / n;
    analysis::PointField &field = one.fields["u"];
    for (int i = 0; i < n * n; ++i)
    {
      field.points.emplace_back((i % n + .5) / n, (std::floor(i / n) + .5) / n);
      field.areas.push_back(one.key.h * one.key.h);
      field.values.push_back(value(field.points.back()));
    }
    return one;
  }

  inline Records failed_record(const std::string &reason)
  {
    Record failed;
    failed.failure = reason;
    return {failed};
  }

  inline double first(const std::vector<double> &values)
  {
    return values[0];
  }

  inline SamplingResults
  conclude(const scene::Scene &scene, const SamplingPlan &plan,
           const std::function<double(const std::vector<double> &)> &quantity)
  {
    return conclude_samples(scene, plan,
                            [&](std::size_t i) { return exact_record(plan, i, quantity); });
  }
} // namespace sampled_scenes
