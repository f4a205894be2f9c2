#include "report/motion_json.h"

#include "io/json_archive.h"
#include "report/json_keys.h"

#include <limits>

namespace plumbline::report
{
  using io::Json;
  using io::JsonReader;
  using io::JsonWriter;

  namespace
  {
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

    Json limit_json(study::LimitProof limit)
    {
      JsonWriter writer;
      visit(writer, limit);
      return writer.take();
    }

    double number(const Json &json, double otherwise = std::numeric_limits<double>::quiet_NaN())
    {
      return json.is_null() ? otherwise : json.get<double>();
    }

    std::vector<double> numbers(const Json &json)
    {
      std::vector<double> values;
      for (const Json &value : json)
        values.push_back(number(value));
      return values;
    }

    void read_history(const Json &json, study::MotionRun &run)
    {
      const auto t = numbers(json.at("t")), kinetic = numbers(json.at("kinetic")),
                 bond = numbers(json.at("bond")), work = numbers(json.at("work")),
                 dissipated = numbers(json.at("dissipated"));
      for (std::size_t i = 0; i < t.size(); ++i)
        run.energies.push_back({t[i], kinetic.at(i), bond.at(i), work.at(i), dissipated.at(i)});
      if (json.contains("error"))
        run.history = numbers(json.at("error"));
    }
  } // namespace

  Json motion_json(const study::MotionRun &run)
  {
    Json json = {{"method", run.method},
                 {"family", base::word(run.family)},
                 {"case", run.problem},
                 {"series", run.series},
                 {"level", run.level},
                 {"h", run.h},
                 {"horizon", run.horizon},
                 {"value", run.value},
                 {"scheme", run.scheme},
                 {"steps", run.steps},
                 {"dt", run.step},
                 {"critical_step", known_number(run.critical_step)},
                 {"is_symmetric", run.is_symmetric},
                 {"failure", run.failure},
                 {"n_steps", run.counts.n_steps},
                 {"n_forces", run.counts.n_accelerations},
                 {"n_tangents", run.counts.n_tangents},
                 {"n_newton", run.counts.n_newton},
                 {"setup_seconds", run.cost.setup_seconds},
                 {"solve_seconds", run.cost.solve_seconds},
                 {"size", run.size},
                 {"area", run.area},
                 {"errors", Json::object()},
                 {"energy_imbalance", known_number(run.imbalance)},
                 {"facts", run.facts},
                 {"limit", limit_json(run.limit)}};
    for (const auto &[name, error] : run.errors)
      json["errors"][name] = known_number(error);
    if (run.estimate)
      json["estimate"] = {{"space", run.estimate->space},
                          {"quadrature", run.estimate->quadrature},
                          {"time", run.estimate->time}};
    json["history"] = energies_json(run);
    return json;
  }

  Json torus_json(const study::TorusEstimate &torus)
  {
    return {{"case", torus.problem},      {"horizon", torus.horizon}, {"n_points", torus.n_points},
            {"estimate", torus.estimate}, {"seconds", torus.seconds}, {"value", torus.value}};
  }

  study::MotionRun motion_from(const Json &json)
  {
    study::MotionRun run;
    run.method = json.at("method");
    run.family = base::from_word<study::MethodFamily>(json.at("family").get<std::string>()).value();
    run.problem = json.at("case");
    run.series = json.at("series");
    run.level = json.at("level");
    run.h = json.at("h");
    run.horizon = json.at("horizon");
    run.value = json.at("value");
    run.scheme = json.at("scheme");
    run.steps = json.at("steps");
    run.step = json.at("dt");
    run.critical_step = number(json.at("critical_step"), std::numeric_limits<double>::infinity());
    run.is_symmetric = json.at("is_symmetric");
    run.failure = json.at("failure");
    run.counts = {json.at("n_steps"), json.at("n_forces"), json.at("n_tangents"),
                  json.at("n_newton")};
    run.cost.setup_seconds = json.at("setup_seconds");
    run.cost.solve_seconds = json.at("solve_seconds");
    run.size = json.at("size");
    run.area = json.at("area");
    for (const auto &[name, error] : json.at("errors").items())
      run.errors[name] = number(error);
    run.imbalance = number(json.at("energy_imbalance"));
    if (json.contains("estimate"))
    {
      const Json &of = json.at("estimate");
      run.estimate = {of.at("space"), of.at("quadrature"), of.at("time")};
    }
    for (const auto &[name, fact] : json.at("facts").items())
      run.facts[name] = number(fact);
    if (json.contains("limit"))
    {
      JsonReader reader(json.at("limit"), "limit", "motions");
      visit(reader, run.limit);
    }
    read_history(json.at("history"), run);
    return run;
  }

  study::TorusEstimate torus_from(const Json &json)
  {
    return {json.at("case"),     json.at("horizon"), json.at("n_points"),
            json.at("estimate"), json.at("seconds"), json.at("value")};
  }
} // namespace plumbline::report
