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

    struct Part
    {
      const char *id, *head, *words;
      Table table;
    };

    /// The tables that have rows, verdicts apart.
    std::vector<Part> parts(const DispersionResults &results)
    {
      std::vector<Part> all = {
          {"long", "Long waves", long_waves_words, long_waves_table(results)},
          {"levels", "Over the sweep", wave_levels_words, wave_levels_table(results)},
          {"missing", "Levels without waves", "", missing_waves_table(results)}};
      all.erase(std::remove_if(all.begin(), all.end(),
                               [](const Part &part) { return part.table.rows.empty(); }),
                all.end());
      return all;
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
        text += std::string("\n## ") + part.head + "\n\n" + to_markdown(part.table) + "\n" +
                part.words + "\n";
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

    std::string header(const DispersionResults &results)
    {
      const auto count = [&](const std::string &outcome)
      {
        return std::to_string(std::count_if(results.trends.begin(), results.trends.end(),
                                            [&](const study::Trend &t)
                                            { return outcome_class(t.outcome) == outcome; }));
      };
      return page::plain_header(results.scene_name, "dispersion", results.purpose,
                                {std::to_string(results.rows.size()) + " symbols",
                                 "✓ " + count("converges") + " converge",
                                 "? " + count("undecided") + " undecided",
                                 "✗ " + count("stalls") + " do not"});
    }

    std::string verdicts(const DispersionResults &results)
    {
      std::string text =
          "<div class=\"wide\"><table class=\"verdicts\">\n<thead><tr><th></th><th>series</th>"
          "<th>by waves</th><th>proven</th><th></th></tr></thead>\n<tbody>\n";
      for (const study::Trend &t : results.trends)
        text += "<tr><th class=\"method\" scope=\"row\">" + escape_html(t.method) + "</th><td>" +
                escape_html(t.series) + "</td><td class=\"" + outcome_class(t.outcome) + "\"><b>" +
                escape_html(t.verdict) + "</b>" +
                (t.values.empty() ? "" : "<small>" + rounded_error(t.values.back()) + "</small>") +
                "</td><td>" + in_a_word(t.proof) + "</td><td style=\"max-width: 100ch\">" +
                escape_html(t.reason) +
                (t.proof.reason.empty() ? "" : "; proof: " + escape_html(t.proof.reason)) +
                "</td></tr>\n";
      return page::section("verdicts", "Verdicts",
                           page::paragraph(question(results)) + text + "</tbody></table></div>\n");
    }

    std::string page_of(const DispersionResults &results, const std::vector<DataChart> &charts,
                        const std::filesystem::path &dir)
    {
      std::string text = verdicts(results), pictures;
      for (std::size_t i = 0; i < charts.size(); ++i)
        pictures += page::figure(
            dir / "dispersion" / charts[i].plot.file, "d" + std::to_string(i) + "-",
            charts[i].plot.title,
            "Data: <code>dispersion/" + escape_html(charts[i].name) + ".csv</code>", false);
      if (!pictures.empty())
        text += page::section(
            "charts", "Charts",
            page::paragraph(
                "Speeds at the finest level of each series, over the local limit's. "
                "Where h falls at a fixed ratio of horizon to h these curves stay as "
                "they are, and a wave of a given length moves to the right along them: "
                "a method is asymptotically compatible if its curve tends to 1 there.") +
                "<div class=\"grid\">\n" + pictures + "</div>\n");
      for (const Part &part : parts(results))
        text += page::section(part.id, part.head,
                              to_html(part.table) + "<p class=\"soft\">" + escape_html(part.words) +
                                  "</p>\n");
      return page::document(results.scene_name, "dispersion", header(results), text);
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
    {
      const std::string words = part.words;
      text += "\n" + to_text(part.table) + (words.empty() ? "" : wrapped(words, 120) + "\n");
    }
    return text + "\n" + to_text(wave_verdicts_table(results)) + wrapped(question(results), 120) +
           "\n";
  }

  std::string dispersion_json(const DispersionResults &results)
  {
    Json json{{"scene", results.scene_name},
              {"wavelength", results.study.wavelength},
              {"angles", results.study.angles},
              {"levels", Json::array()},
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
