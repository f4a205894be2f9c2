#include "report/sampling_page.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace plumbline::report
{
  namespace
  {
    using Json = nlohmann::ordered_json;
    using study::CaseStatistics;
    using study::SamplingResults;
    using study::SetStatistics;

    Json known(double value)
    {
      return std::isfinite(value) ? Json(value) : Json();
    }

    Json known(const std::optional<double> &value)
    {
      return value ? known(*value) : Json();
    }

    /// Of the mean.
    Json interval(const uq::Statistics &s)
    {
      return s.confidence > 0
                 ? Json::array({known(s.mean - s.confidence), known(s.mean + s.confidence)})
                 : Json();
    }

    Json to_json(const SetStatistics &set)
    {
      Json json{{"rule", base::word(set.rule)},
                {"count", set.count},
                {"modes", set.n_modes},
                {"samples", set.n_samples},
                {"missing", set.n_missing},
                {"sum_of_sizes", set.sum_of_sizes},
                {"noise", set.noise},
                {"seconds", set.seconds},
                {"mean_size", set.mean_size},
                {"deviation_size", known(set.deviation_size)},
                {"standard_error", set.standard_error},
                {"negative_variance_part", set.negative_part},
                {"mean_error", known(set.mean_error)},
                {"deviation_error", known(set.deviation_error)},
                {"mean_uncertainty", set.mean_uncertainty},
                {"deviation_uncertainty", set.deviation_uncertainty},
                {"interpolation_error", known(set.interpolation_error)},
                {"lebesgue", known(set.lebesgue)},
                {"lebesgue_bound", known(set.lebesgue_bound)},
                {"quantities", Json::object()}};
      for (const auto &[name, s] : set.quantities)
        json["quantities"][name] = {{"mean", known(s.mean)},
                                    {"variance", known(s.variance)},
                                    {"deviation", known(s.deviation())},
                                    {"standard_error", known(s.standard_error)},
                                    {"confidence_interval", interval(s)},
                                    {"least", known(s.least)},
                                    {"largest", known(s.largest)}};
      return json;
    }
  } // namespace

  std::string sampling_json(const SamplingResults &r)
  {
    const bool has_field = r.random.field != scene::FieldKind::none;
    Json json{{"schema", sampling_schema},
              {"scene", r.scene_name},
              {"rule", r.sampling.rule_words()},
              {"growth", base::word(r.sampling.growth)},
              {"seed", r.sampling.seed},
              {"field_seed", has_field ? Json(r.random.seed) : Json()},
              {"target", r.target},
              {"n_samples", r.n_samples},
              {"variance_kept", r.spectrum ? Json(r.spectrum->variance_kept()) : Json()},
              {"spectrum", r.spectrum ? Json(r.spectrum->share) : Json::array()},
              {"is_complete", r.is_complete},
              {"findings", r.findings},
              {"failures", Json::array()},
              {"cheapest", Json::array()},
              {"balance", Json::array()},
              {"comparisons", Json::array()},
              {"cases", Json::array()},
              {"scene_text", r.scene_text}};
    for (const auto &failure : r.failures)
      json["failures"].push_back(
          {{"sample", failure.sample}, {"values", failure.values}, {"reason", failure.reason}});
    for (const auto &pair : r.cheapest)
      json["cheapest"].push_back({{"target", pair.target},
                                  {"method", pair.method},
                                  {"problem", pair.problem},
                                  {"series", pair.series},
                                  {"h", pair.h},
                                  {"rule", base::word(pair.rule)},
                                  {"count", pair.count},
                                  {"modes", pair.n_modes},
                                  {"error", pair.error},
                                  {"seconds", pair.seconds}});
    for (const study::SamplingBalance &one : r.balance)
      json["balance"].push_back({{"method", one.method},
                                 {"problem", one.problem},
                                 {"series", one.series},
                                 {"h", one.h},
                                 {"rule", base::word(one.rule)},
                                 {"modes", one.n_modes},
                                 {"enough", one.enough ? Json(*one.enough) : Json()},
                                 {"largest", one.largest},
                                 {"error", one.error}});
    for (const study::RuleComparison &one : r.comparisons)
    {
      Json entry{{"method", one.method},     {"problem", one.problem},
                 {"series", one.series},     {"h", one.h},
                 {"quantity", one.quantity}, {"error", one.error},
                 {"samples", Json::object()}};
      for (const study::RuleComparison::Need &need : one.needs)
        entry["samples"][base::word(need.rule)] = need.n_samples;
      json["comparisons"].push_back(std::move(entry));
    }
    for (const CaseStatistics &one : r.cases)
    {
      Json entry{{"method", one.of.method}, {"problem", one.of.problem},
                 {"series", one.of.series}, {"level", one.of.level},
                 {"h", one.of.h},           {"horizon", one.of.horizon},
                 {"sets", Json::array()}};
      for (const SetStatistics &set : one.sets)
        entry["sets"].push_back(to_json(set));
      json["cases"].push_back(std::move(entry));
    }
    return json.dump(2) + "\n";
  }
} // namespace plumbline::report
