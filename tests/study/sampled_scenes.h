#pragma once

#include "study/sampling.h"

/// Records of samples that are exact, and scenes that ask for them.
namespace sampled_scenes
{
  using namespace plumbline;
  using study::CaseStatistics;
  using study::make_sampling_plan;
  using study::SampleCase;
  using study::SampleRecord;
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
  inline SampleRecord
  exact_record(const SamplingPlan &plan, std::size_t sample,
               const std::function<double(const std::vector<double> &)> &quantity)
  {
    const std::vector<double> &values = plan.values[sample];
    SampleCase one;
    one.method = "PA-AC";
    one.problem = "u";
    one.series = "m = 3";
    one.h = .25;
    one.horizon = .75;
    one.seconds = 1;
    one.quantities["q"] = quantity(values);
    one.field.x = {.1, .4, .6, .9};
    one.field.y = {.1, .1, .9, .9};
    one.field.area.assign(4, .25);
    for (const double x : one.field.x)
      one.field.values.push_back((1 + values[0]) * x);
    return {sample, "", {one}};
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
