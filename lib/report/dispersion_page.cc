#include "report/dispersion_page.h"

#include "report/dispersion_charts.h"
#include "report/dispersion_tables.h"
#include "report/page_parts.h"
#include "report/text_table.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace plumbline::report
{
  namespace
  {
    using study::DispersionResults;
    using Json = nlohmann::ordered_json;

    /// The tables that have rows, verdicts apart.
    std::vector<Part> parts(const DispersionResults &results)
    {
      return page::with_rows(
          {{"long", "Long waves", long_waves_words, long_waves_table(results)},
           {"levels", "Over the sweep", wave_levels_words, wave_levels_table(results)},
           {"missing", "Levels without waves", "", missing_waves_table(results)}});
    }

    std::string question(const DispersionResults &results)
    {
      return "The longest wave of the domain is " + rounded(results.study.wavelength) +
             " long. By waves: does its phase speed, in the worst of the directions, tend to the "
             "nonlocal operator's, which tends to the local limit's itself as the horizon falls? "
             "Proven: by the second moments of the stencil, or because a Galerkin space holds the "
             "continuous piecewise linear functions.";
    }

    std::string markdown(const DispersionResults &results)
    {
      std::string text = "# Dispersion: " + results.scene_name + "\n\n" +
                         to_markdown(wave_verdicts_table(results)) + "\n" + question(results) +
                         "\n";
      for (const Part &part : parts(results))
        text += "\n## " + part.head + "\n\n" + to_markdown(part.table) + "\n" + part.words + "\n";
      return text;
    }

    const char *outcome_class(study::Outcome outcome)
    {
      switch (outcome)
      {
      case study::Outcome::converges:
        return "converges";
      case study::Outcome::undecided:
        return "undecided";
      default:
        return "stalls";
      }
    }

    Data header(const DispersionResults &results)
    {
      const auto count = [&](const std::string &outcome)
      {
        return std::to_string(std::count_if(results.trends.begin(), results.trends.end(),
                                            [&](const study::Trend &t)
                                            { return outcome_class(t.outcome) == outcome; }));
      };
      std::vector<std::string> facts{
          std::to_string(results.rows.size()) + " symbols", "✓ " + count("converges") + " converge",
          "? " + count("undecided") + " undecided", "✗ " + count("stalls") + " do not"};
      if (!results.is_complete)
        facts.emplace_back(page::interrupted);
      return page::begin("dispersion", results.scene_name, results.purpose, facts);
    }

    Data verdicts(const DispersionResults &results)
    {
      Data list = Data::array();
      for (const study::Trend &t : results.trends)
        list.push_back({{"method", t.method},
                        {"series", t.series},
                        {"look", outcome_class(t.outcome)},
                        {"verdict", t.verdict},
                        {"error", t.values.empty() ? "" : rounded_error(t.values.back())},
                        {"proven", in_a_word(t.proof)},
                        {"reason", t.reason},
                        {"proof", t.proof.reason}});
      return list;
    }

    std::string page_of(const DispersionResults &results, const std::vector<DataChart> &charts,
                        const std::filesystem::path &dir)
    {
      Data data = header(results);
      data["question"] = question(results);
      data["verdicts"] = verdicts(results);
      data["curves"] =
          charts.empty() ? Data() : Data{{"charts", page::charts(charts, dir, "dispersion")}};
      data["parts"] = page::parts(parts(results));
      return fill("dispersion", data);
    }

    Json known_number(double value)
    {
      return std::isfinite(value) ? Json(value) : Json();
    }

    Json sample_json(const study::WaveSample &sample)
    {
      return {{"k", sample.k},
              {"phase_speed", known_number(sample.phase)},
              {"group_speed", known_number(sample.group)},
              {"nonlocal_phase_speed", known_number(sample.exact_phase)},
              {"nonlocal_group_speed", known_number(sample.exact_group)}};
    }

    Json level_json(const study::DispersionRow &row)
    {
      Json json{{"method", row.method},
                {"family", base::word(row.side)},
                {"series", row.series},
                {"h", row.h},
                {"horizon", row.horizon},
                {"value", row.value},
                {"failure", row.failure},
                {"largest_squared_frequency", row.range.largest},
                {"least_squared_frequency", row.range.least},
                {"critical_step", known_number(row.critical_step())},
                {"anisotropy", Json::array()},
                {"waves", Json::array()}};
      for (const double difference : row.anisotropy)
        json["anisotropy"].push_back(known_number(difference));
      for (const study::WaveCurve &curve : row.curves)
      {
        Json wave{{"polarisation", name(curve.polarisation)},
                  {"angle", curve.angle},
                  {"local_speed", curve.local_speed},
                  {"long_wave_error", known_number(curve.long_wave_error)},
                  {"longest", sample_json(curve.longest)},
                  {"samples", Json::array()}};
        for (const study::WaveSample &sample : curve.samples)
          wave["samples"].push_back(sample_json(sample));
        json["waves"].push_back(wave);
      }
      return json;
    }
  } // namespace

  std::string dispersion_text(const DispersionResults &results)
  {
    std::string text = results.scene_name + "\n";
    for (const Part &part : parts(results))
      text +=
          "\n" + to_text(part.table) + (part.words.empty() ? "" : wrapped(part.words, 120) + "\n");
    return text + "\n" + to_text(wave_verdicts_table(results)) + wrapped(question(results), 120) +
           "\n";
  }

  std::string dispersion_json(const DispersionResults &results)
  {
    Json json{{"scene", results.scene_name},        {"variable", results.variable},
              {"is_complete", results.is_complete}, {"wavelength", results.study.wavelength},
              {"angles", results.study.angles},     {"levels", Json::array()},
              {"verdicts", Json::array()}};
    for (const study::DispersionRow &row : results.rows)
      json["levels"].push_back(level_json(row));
    for (const study::Trend &t : results.trends)
      json["verdicts"].push_back({{"method", t.method},
                                  {"series", t.series},
                                  {"error", t.error},
                                  {base::word(t.axis), t.x},
                                  {"errors", t.values},
                                  {"rates", t.rates},
                                  {"plateau", t.plateau},
                                  {"plateau_uncertainty", t.plateau_uncertainty},
                                  {"verdict", t.verdict},
                                  {"reason", t.reason},
                                  {"proven", in_a_word(t.proof)},
                                  {"moment_defect", t.proof.defect},
                                  {"proof", t.proof.reason}});
    return json.dump(2) + "\n";
  }

  void write_dispersion(const DispersionResults &results, const std::filesystem::path &dir)
  {
    write_file(dir / "dispersion.json", dispersion_json(results));
    write_file(dir / "dispersion.md", markdown(results));
    const std::vector<DataChart> charts = dispersion_charts(results);
    write_with_pictures(
        dir / "dispersion.html", [&] { write_charts(charts, dir / "dispersion"); },
        [&] { return page_of(results, charts, dir); });
  }
} // namespace plumbline::report
