#include "report/dynamics_page.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace plumbline::report
{
  namespace
  {
    using Json = nlohmann::ordered_json;

    Json known_number(double value)
    {
      return std::isfinite(value) ? Json(value) : Json();
    }

    Json energies_json(const study::MotionRun &run)
    {
      Json json = {{"t", Json::array()},
                   {"kinetic", Json::array()},
                   {"bond", Json::array()},
                   {"work", Json::array()},
                   {"dissipated", Json::array()}};
      for (const analysis::Energies &now : run.energies)
      {
        json["t"].push_back(now.t);
        json["kinetic"].push_back(known_number(now.kinetic));
        json["bond"].push_back(known_number(now.bond));
        json["work"].push_back(known_number(now.work));
        json["dissipated"].push_back(known_number(now.dissipated));
      }
      if (!run.history.empty())
      {
        json["error"] = Json::array();
        for (const double error : run.history)
          json["error"].push_back(known_number(error));
      }
      return json;
    }

    Json run_json(const study::MotionRun &run)
    {
      Json json = {{"method", run.method},
                   {"family", base::word(run.side)},
                   {"case", run.problem},
                   {"series", run.series},
                   {"level", run.level},
                   {"h", run.h},
                   {"horizon", run.horizon},
                   {"scheme", run.scheme},
                   {"steps", run.steps},
                   {"dt", run.step},
                   {"critical_step", known_number(run.critical_step)},
                   {"failure", run.failure},
                   {"n_steps", run.counts.n_steps},
                   {"n_forces", run.counts.n_accelerations},
                   {"n_tangents", run.counts.n_tangents},
                   {"n_newton", run.counts.n_newton},
                   {"setup_seconds", run.cost.setup_seconds},
                   {"solve_seconds", run.cost.solve_seconds},
                   {"size", run.size},
                   {"errors", Json::object()},
                   {"energy_imbalance", known_number(run.imbalance)},
                   {"facts", run.facts}};
      for (const auto &[name, error] : run.errors)
        json["errors"][name] = known_number(error);
      json["history"] = energies_json(run);
      return json;
    }

    Json trend_json(const study::MotionTrend &t)
    {
      return {{"method", t.method},
              {"case", t.problem},
              {"series", t.series},
              {"scheme", t.scheme},
              {"steps", t.steps},
              {"error", t.error},
              {base::word(t.axis), t.x},
              {"errors", t.values},
              {"rates", t.rates},
              {"rate", known_number(t.rate)},
              {"rate_uncertainty", known_number(t.rate_uncertainty)},
              {"verdict", t.verdict},
              {"reason", t.reason}};
    }
  } // namespace

  std::string motion_line(const study::MotionRun &run)
  {
    return run_json(run).dump() + "\n";
  }

  std::string dynamics_json(const study::DynamicResults &results)
  {
    Json json = {{"scene", results.scene_name},      {"purpose", results.purpose},
                 {"regime", results.regime},         {"is_complete", results.is_complete},
                 {"provenance", results.provenance}, {"decisive_error", results.decisive_error},
                 {"final_time", results.final_time}, {"density", results.density},
                 {"damping", results.damping},       {"facts", Json::object()}};
    for (const auto &[what, value] : results.facts)
      json["facts"][what] = value;
    const auto add = [&](const char *name, const auto &list, const auto &to_json)
    {
      json[name] = Json::array();
      for (const auto &one : list)
        json[name].push_back(to_json(one));
    };
    add("runs", results.runs, run_json);
    add("trends", results.trends, trend_json);
    add("orders", results.orders, trend_json);
    add("references", results.references,
        [](const study::TorusEstimate &one)
        {
          return Json{{"case", one.problem},
                      {"horizon", one.horizon},
                      {"n_points", one.n_points},
                      {"estimate", one.estimate},
                      {"seconds", one.seconds}};
        });
    add("omissions", results.omissions,
        [](const study::Omission &one) {
          return Json{{"what", one.what}, {"why", one.why}, {"saving", one.saving}};
        });
    add("expectations", results.expectations,
        [](const study::Expectation &one)
        {
          return Json{{"subject", one.subject},
                      {"expected", one.expected},
                      {"found", one.found},
                      {"holds", one.holds}};
        });
    json["scene_text"] = results.scene_text;
    return json.dump(2) + "\n";
  }
} // namespace plumbline::report
