#include "report/dynamics_page.h"
#include "report/motion_json.h"

namespace plumbline::report
{
  namespace
  {
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
              {"proven", t.proven},
              {"verdict", t.verdict},
              {"reason", t.reason}};
    }
  } // namespace

  std::string dynamics_json(const study::DynamicResults &results)
  {
    Json json = {{"scene", results.scene_name},
                 {"purpose", results.purpose},
                 {"regime", results.regime},
                 {"variable", results.variable},
                 {"is_complete", results.is_complete},
                 {"provenance", results.provenance},
                 {"decisive_error", results.decisive_error},
                 {"final_time", results.final_time},
                 {"density", results.density},
                 {"damping", results.damping},
                 {"facts", Json::object()}};
    for (const auto &[what, value] : results.facts)
      json["facts"][what] = value;
    const auto add = [&](const char *name, const auto &list, const auto &to_json)
    {
      json[name] = Json::array();
      for (const auto &one : list)
        json[name].push_back(to_json(one));
    };
    add("runs", results.runs, motion_json);
    add("trends", results.trends, trend_json);
    add("orders", results.orders, trend_json);
    add("references", results.references, torus_json);
    add("omissions", results.omissions,
        [](const study::Omission &one) {
          return Json{{"what", one.what}, {"why", one.why}, {"saving", one.saving}};
        });
    json["warnings"] = results.warnings;
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
