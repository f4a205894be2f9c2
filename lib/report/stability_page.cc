#include "report/stability_page.h"

#include "base/error.h"
#include "report/data_charts.h"
#include "report/page_parts.h"
#include "report/stability_pictures.h"
#include "report/stability_tables.h"
#include "report/strain_charts.h"
#include "report/text_table.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace plumbline::report
{
  namespace
  {
    using study::StabilityResults;
    using Json = nlohmann::ordered_json;

    struct Part
    {
      const char *id, *head, *words;
      Table table;
    };

    /// The tables that have rows, verdicts apart.
    std::vector<Part> parts(const StabilityResults &results)
    {
      std::vector<Part> all = {
          {"measures", "Measures", measures_words, measures_table(results)},
          {"eigenvalues", "Eigenvalues where A is not symmetric", eigenvalues_words,
           eigenvalues_table(results)},
          {"time-steps", "Critical time steps", time_steps_words, time_steps_table(results)},
          {"strains", "Where waves on strains begin to grow", strain_thresholds_words,
           strain_thresholds_table(results.strains)},
          {"growth", "How fast they grow", strain_growth_words,
           strain_growth_table(results.strains)},
          {"powers", "Over the sweep", powers_words, powers_table(results)},
          {"missing", "Levels without an operator", "", missing_operators_table(results)}};
      all.erase(std::remove_if(all.begin(), all.end(),
                               [](const Part &part) { return part.table.rows.empty(); }),
                all.end());
      return all;
    }

    std::string markdown(const StabilityResults &results)
    {
      std::string text = "# Stability: " + results.scene_name + "\n\n" +
                         to_markdown(stability_verdicts_table(results));
      for (const Part &part : parts(results))
        text += std::string("\n## ") + part.head + "\n\n" + to_markdown(part.table) + "\n" +
                part.words + "\n";
      return text;
    }

    /// How verdicts look: sign and style, in their order.
    constexpr std::array<std::pair<const char *, const char *>, 3> looks = {
        {{"✓", "converges"}, {"?", "undecided"}, {"✗", "stalls"}}};

    std::string header(const StabilityResults &results)
    {
      std::vector<std::string> facts{std::to_string(results.verdicts.size()) + " methods",
                                     std::to_string(results.rows.size()) + " operators"};
      for (std::size_t i = 0; i < looks.size(); ++i)
      {
        const auto verdict = static_cast<study::StabilityAnswer>(i);
        const auto n =
            std::count_if(results.verdicts.begin(), results.verdicts.end(),
                          [&](const study::StabilityVerdict &v) { return v.verdict == verdict; });
        facts.push_back(looks[i].first + (" " + std::to_string(n)) + " " + base::word(verdict));
      }
      if (!results.is_complete)
        facts.emplace_back(page::interrupted);
      return page::plain_header(results.scene_name, "stability", results.purpose, facts);
    }

    std::string verdicts(const StabilityResults &results)
    {
      std::string text = "<div class=\"wide\"><table class=\"verdicts\">\n<tbody>\n";
      for (const study::StabilityVerdict &v : results.verdicts)
        text += "<tr><th class=\"method\" scope=\"row\">" + escape_html(v.method) +
                "</th><td class=\"" + looks[static_cast<std::size_t>(v.verdict)].second + "\"><b>" +
                base::word(v.verdict) + "</b>" +
                (v.condition.empty() ? "" : "<small>" + escape_html(v.condition) + "</small>") +
                "</td><td style=\"max-width: 100ch\">" + escape_html(v.explanation) +
                "</td></tr>\n";
      return page::section("verdicts", "Verdicts",
                           text +
                               "</tbody></table></div>\n<p class=\"soft\">stable: the symmetric "
                               "part is positive definite at all levels with a constant that "
                               "does not fall, no weight is negative, moments are independent, "
                               "and bonds tie all nodes. conditionally stable: under the "
                               "condition given. unstable: no condition on m = δ/h helps.</p>\n");
    }

    std::string pictures(const std::vector<StabilityPicture> &all, bool are_modes,
                         const std::filesystem::path &dir)
    {
      std::string text;
      for (std::size_t i = 0; i < all.size(); ++i)
      {
        if (all[i].is_mode != are_modes)
          continue;
        text += page::figure(
            dir / "stability" / (all[i].name + ".svg"), "s" + std::to_string(i) + "-", all[i].title,
            std::string(are_modes ? "Picture" : "Data") + ": <code>stability/" +
                escape_html(all[i].name) + (are_modes ? ".svg" : ".csv") + "</code>",
            are_modes);
      }
      return text;
    }

    std::string page_of(const StabilityResults &results, const std::filesystem::path &dir)
    {
      const std::vector<StabilityPicture> all = list_pictures(results);
      std::string text = verdicts(results);
      for (const Part &part : parts(results))
        text += page::section(part.id, part.head,
                              to_html(part.table) + "<p class=\"soft\">" + escape_html(part.words) +
                                  "</p>\n");
      if (const std::string charts = pictures(all, false, dir); !charts.empty())
        text += page::section("charts", "Measures over the sweep",
                              page::paragraph("Levels where a value is not positive, or not known, "
                                              "have no point.") +
                                  "<div class=\"grid\">\n" + charts + "</div>\n");
      std::string growth;
      unsigned int n_charts = 0;
      for (const DataChart &chart : strain_charts(results.strains))
        growth += page::figure(
            dir / "strains" / chart.plot.file, "g" + std::to_string(n_charts++) + "-",
            chart.caption, "Data: <code>strains/" + escape_html(chart.name) + ".csv</code>", false);
      if (!growth.empty())
        text += page::section("strain-charts", "Waves on uniform strains",
                              "<div class=\"grid\">\n" + growth + "</div>\n");
      if (const std::string modes = pictures(all, true, dir); !modes.empty())
        text += page::section(
            "modes", "Modes",
            page::paragraph("The field that costs the least energy, or all that cost none (any "
                            "basis of them), at the finest level with at most 1600 nodes. Smooth "
                            "and spread over the domain is as it should be; what changes from "
                            "node to node, or sits at a few nodes, is the method's own.") +
                modes + "<p class=\"soft\">The finest level: <code>stability/*.vtu</code></p>\n");
      return page::document(results.scene_name, "stability", header(results), text);
    }

    /// Null for 0: not known.
    Json known_step(double value)
    {
      return value > 0 ? Json(value) : Json();
    }

    Json level_json(const study::StabilityRow &row)
    {
      const study::Stability &s = row.stability;
      const algebra::Eigenvalues &e = s.eigenvalues;
      return {{"method", row.method},
              {"family", base::word(row.side)},
              {"series", row.series},
              {"h", row.h},
              {"horizon", row.horizon},
              {"failure", row.failure},
              {"unknowns", s.n_unknowns},
              {"smallest_eigenvalue", s.smallest},
              {"largest_eigenvalue", s.largest},
              {"zero_modes", s.n_zero},
              {"is_symmetric", s.is_symmetric()},
              {"eigenvalues_of_a", e.n_computed == 0
                                       ? Json()
                                       : Json{{"least_real_part", e.smallest_real},
                                              {"least_modulus", e.smallest_modulus},
                                              {"largest_modulus", e.largest_modulus},
                                              {"largest_imaginary_part", e.largest_imaginary}}},
              {"has_signs", s.has_signs},
              {"asymmetry", s.signs.asymmetry},
              {"rows_with_positive_entries", s.signs.n_positive},
              {"rows_not_dominant", s.signs.n_weak},
              {"rows_not_tied", s.signs.n_loose},
              {"parts", s.signs.n_parts},
              {"is_m_matrix", s.has_signs && s.signs.is_m_matrix()},
              {"inverse_norm", s.inverse_norm},
              {"is_inverse_norm_exact", s.is_norm_exact},
              {"barrier", row.consistency.barrier},
              {"negative_weights", s.diagnostics.n_negative_weights},
              {"smallest_weight", s.diagnostics.smallest_weight_ratio},
              {"moment_conditions", s.diagnostics.n_conditions},
              {"moment_rank", s.diagnostics.rank},
              {"moment_singular_value", s.diagnostics.smallest_singular_value},
              {"inner_nodes", row.consistency.n_inner},
              {"exact_degree", row.consistency.degree},
              {"critical_step", known_step(row.steps.own())},
              {"critical_step_lumped", known_step(row.steps.lumped())},
              {"largest_eigenvalue_in_motion", known_step(row.steps.largest)},
              {"density", row.steps.density},
              {"only_oscillates", row.steps.is_oscillating},
              {"notes", s.diagnostics.notes}};
    }

    Json strain_json(const study::StrainGrowth &growth)
    {
      Json json{{"series", growth.series},
                {"strain", growth.name},
                {"h", growth.h},
                {"horizon", growth.horizon},
                {"ellipticity_lost", growth.thresholds.ellipticity},
                {"first_wave_of_torus", known_step(growth.first_wave)},
                {"criterion_64", growth.thresholds.local},
                {"samples", Json::array()},
                {"methods", Json::array()}};
      for (const study::StrainSample &sample : growth.samples)
        json["samples"].push_back({{"amplitude", sample.amplitude},
                                   {"strain", sample.strain},
                                   {"wave", sample.wave},
                                   {"symbol", sample.symbol},
                                   {"local", sample.local}});
      for (const study::MethodGrowth &one : growth.methods)
        json["methods"].push_back({{"method", one.method},
                                   {"linear", one.linear},
                                   {"observed", one.observed},
                                   {"difference", growth.difference(one)},
                                   {"failure", one.failure}});
      return json;
    }
  } // namespace

  std::string stability_text(const StabilityResults &results)
  {
    std::string text = results.scene_name + "\n";
    for (const Part &part : parts(results))
    {
      const std::string words = part.words;
      text += "\n" + to_text(part.table) + (words.empty() ? "" : wrapped(words, 120) + "\n");
    }
    return text + "\n" + to_text(stability_verdicts_table(results));
  }

  std::string stability_json(const StabilityResults &results)
  {
    Json json{{"scene", results.scene_name}, {"is_complete", results.is_complete},
              {"levels", Json::array()},     {"powers", Json::array()},
              {"verdicts", Json::array()},   {"strains", Json::array()}};
    for (const study::StrainGrowth &growth : results.strains)
      json["strains"].push_back(strain_json(growth));
    for (const study::StabilityRow &row : results.rows)
      json["levels"].push_back(level_json(row));
    for (const study::StabilityTrend &t : results.trends)
      json["powers"].push_back({{"method", t.method},
                                {"series", t.series},
                                {"parameter", base::word(t.axis)},
                                {"smallest_eigenvalue", t.smallest},
                                {"largest_eigenvalue", t.largest},
                                {"inverse_norm", t.inverse_norm}});
    for (const study::StabilityVerdict &v : results.verdicts)
      json["verdicts"].push_back({{"method", v.method},
                                  {"verdict", base::word(v.verdict)},
                                  {"condition", v.condition},
                                  {"explanation", v.explanation}});
    return json.dump(2) + "\n";
  }

  void write_stability(const StabilityResults &results, const std::filesystem::path &dir)
  {
    write_file(dir / "stability.json", stability_json(results));
    write_file(dir / "stability.md", markdown(results));
    write_with_pictures(
        dir / "stability.html",
        [&]
        {
          write_pictures(results, dir);
          write_charts(strain_charts(results.strains), dir / "strains");
        },
        [&] { return page_of(results, dir); });
  }
} // namespace plumbline::report
