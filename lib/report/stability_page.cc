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

    /// The tables that have rows, verdicts apart.
    std::vector<Part> parts(const StabilityResults &results)
    {
      return page::with_rows(
          {{"measures", "Measures", measures_words, measures_table(results)},
           {"eigenvalues", "Eigenvalues where A is not symmetric", eigenvalues_words,
            eigenvalues_table(results)},
           {"time-steps", "Critical time steps", time_steps_words, time_steps_table(results)},
           {"strains", "Where waves on strains begin to grow", strain_thresholds_words,
            strain_thresholds_table(results.strains)},
           {"growth", "How fast they grow", strain_growth_words,
            strain_growth_table(results.strains)},
           {"powers", "Over the sweep", powers_words, powers_table(results)},
           {"missing", "Levels without an operator", "", missing_operators_table(results)}});
    }

    std::string markdown(const StabilityResults &results)
    {
      std::string text = "# Stability: " + results.scene_name + "\n\n" +
                         to_markdown(stability_verdicts_table(results));
      for (const Part &part : parts(results))
        text += "\n## " + part.head + "\n\n" + to_markdown(part.table) + "\n" + part.words + "\n";
      return text;
    }

    /// How verdicts look: sign and style, in their order.
    constexpr std::array<std::pair<const char *, const char *>, 3> looks = {
        {{"✓", "converges"}, {"?", "undecided"}, {"✗", "stalls"}}};

    Data header(const StabilityResults &results)
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
      return page::begin("stability", results.scene_name, results.purpose, facts);
    }

    Data verdicts(const StabilityResults &results)
    {
      Data list = Data::array();
      for (const study::StabilityVerdict &v : results.verdicts)
        list.push_back({{"method", v.method},
                        {"look", looks[static_cast<std::size_t>(v.verdict)].second},
                        {"verdict", base::word(v.verdict)},
                        {"condition", v.condition},
                        {"explanation", v.explanation}});
      return list;
    }

    /// Charts or modes, null where there are none.
    Data pictures(const std::vector<StabilityPicture> &all, bool are_modes,
                  const std::filesystem::path &dir)
    {
      Data list = Data::array();
      for (std::size_t i = 0; i < all.size(); ++i)
        if (all[i].is_mode == are_modes)
          list.push_back(page::figure(
              {dir / "stability" / (all[i].name + ".svg"), "s" + std::to_string(i) + "-",
               all[i].title, "", are_modes ? "Picture" : "Data",
               "stability/" + all[i].name + (are_modes ? ".svg" : ".csv"), are_modes}));
      return list.empty() ? Data() : Data{{"charts", std::move(list)}};
    }

    std::string page_of(const StabilityResults &results, const std::filesystem::path &dir)
    {
      const std::vector<StabilityPicture> all = list_pictures(results);
      Data data = header(results);
      data["verdicts"] = verdicts(results);
      data["parts"] = page::parts(parts(results));
      data["measures"] = pictures(all, false, dir);
      const auto strains = strain_charts(results.strains);
      data["strains"] =
          strains.empty() ? Data() : Data{{"charts", page::charts(strains, dir, "strains")}};
      data["modes"] = pictures(all, true, dir);
      return fill("stability", data);
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
              {"value", row.value},
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
      text +=
          "\n" + to_text(part.table) + (part.words.empty() ? "" : wrapped(part.words, 120) + "\n");
    return text + "\n" + to_text(stability_verdicts_table(results));
  }

  std::string stability_json(const StabilityResults &results)
  {
    Json json{{"scene", results.scene_name},
              {"variable", results.variable},
              {"is_complete", results.is_complete},
              {"levels", Json::array()},
              {"powers", Json::array()},
              {"verdicts", Json::array()},
              {"strains", Json::array()}};
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
