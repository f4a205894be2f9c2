#include "report/crack_page.h"

#include "base/number_text.h"
#include "report/crack_charts.h"
#include "report/data_charts.h"
#include "report/page_parts.h"
#include "report/text_table.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace plumbline::report
{
  namespace
  {
    using study::CrackResults;
    using study::CrackThreshold;
    using Json = nlohmann::ordered_json;

    Table facts_table(const CrackResults &r)
    {
      Table table;
      table.columns = {"quantity", "value", "meaning"};
      const auto add = [&](const std::string &name, double value, const std::string &words) {
        table.rows.push_back({text_cell(name), number_cell(value), text_cell(words)});
      };
      const auto &m = r.motion;
      add("advance", m.advance, "of the tip, from the notch to the end of the time [length]");
      add("speed / c_R", m.speed / r.rayleigh_speed(),
          "the line fitted to the tip where it has gone 1/5 to 4/5 of its way");
      add("fastest / c_R", m.fastest / r.rayleigh_speed(), "over any tenth of the time");
      add("c_R", r.rayleigh_speed(), "Rayleigh waves, which no crack overtakes [length/time]");
      add("c_T", r.transverse, "shear waves [length/time]");
      add("W H / G_c,h", r.crack.load * r.own.energy / r.own.toughness,
          "energy of the strained strip over the lattice's toughness");
      add("strain", r.strain, "of the grips, u_y = strain y");
      add("G_c", r.toughness, "of the law [energy/length]");
      add("G_c,h / G_c", r.own.toughness / r.toughness, "of the lattice, over that");
      add("soft energy / G_c,h", m.soft_per_length / r.own.toughness,
          "rise of the energy in soft bonds for a length of advance");
      add("energy drift", m.energy_drift,
          "largest change of kinetic + bonds + dissipated, relative to the start");
      add("asymmetry", r.asymmetry, "largest difference of u from its mirror image, at the end");
      add("time step", r.plan.step, r.plan.scheme);
      if (r.plan.critical_step)
        add("critical step", *r.plan.critical_step, "beyond which errors grow without bound");
      add("steps", static_cast<double>(r.history.n_steps), "of the motion");
      add("nodes", static_cast<double>(r.n[0]) * r.n[1], "the grips' too");
      return table;
    }

    Table thresholds_table(const CrackResults &results)
    {
      Table table;
      table.columns = {"series",      "horizon",     "h",
                       "G_c,h / G_c", "W H / G_c,h", "no threshold, because"};
      for (const CrackThreshold &one : results.thresholds)
        table.rows.push_back({text_cell(one.series), number_cell(one.horizon), number_cell(one.h),
                              number_cell(one.toughness / results.toughness),
                              known(one.failure.empty(), number_cell(one.energy / one.toughness)),
                              known(!one.failure.empty(), text_cell(one.failure))});
      return without_empty_columns(table);
    }

    const char *const thresholds_words =
        "Far from its tip a crack turns the intact strip into two halves. It neither grows nor "
        "closes where that sets free the lattice's toughness G_c,h, all bonds across a line at "
        "their limit; found from one column in equilibrium, intact and separated. W H, the uniform "
        "strain's energy times the height between the grips, is close to it, and tends to it with "
        "the horizon.";

    std::string verdict(const CrackResults &results)
    {
      const auto &m = results.motion;
      std::string text = "At " + rounded(results.crack.load) + " of its threshold the crack " +
                         crack_outcome_words(m.outcome);
      if (m.outcome == scene::CrackOutcome::too_short)
        text += ": its tip advanced by " + rounded(m.advance / results.own.horizon) + " horizons";
      else if (m.outcome == scene::CrackOutcome::arrests)
        text += " after " + rounded(m.advance) + ", " + rounded(m.advance / results.own.horizon) +
                " horizons, of its notch's tip";
      else
        text += " at " + rounded(m.speed / results.rayleigh_speed()) +
                " of the speed of Rayleigh "
                "waves, at most " +
                rounded(m.fastest / results.rayleigh_speed());
      text += "; the picture is " + (results.asymmetry == 0
                                         ? std::string("symmetric to the last bit")
                                         : "asymmetric by " + rounded(results.asymmetry));
      if (!m.reason.empty())
        text += ". Reason: " + m.reason;
      for (const std::string &warning : results.warnings())
        text += ". Warning: " + warning;
      if (!results.is_as_expected())
        text += ". EXPECTED: it " + crack_outcome_words(results.expected);
      return text + ".";
    }

    std::string page_of(const CrackResults &results, const std::filesystem::path &dir)
    {
      Data data = page::begin("crack", results.scene_name, results.purpose,
                              {results.method + ", m = " + rounded(results.own.m()),
                               "load " + rounded(results.crack.load) + " of the threshold",
                               (results.is_as_expected() ? "✓ it " : "✗ it ") +
                                   crack_outcome_words(results.motion.outcome)});
      data["verdict"] = verdict(results);
      data["pictures"] = Data::array();
      data["charts"] = Data::array();
      for (const CrackPicture &picture : crack_pictures())
        data[picture.is_large ? "pictures" : "charts"].push_back(
            page::figure({dir / "crack" / (picture.name + ".svg"), picture.name + "-",
                          picture.title, picture.caption, "Data", picture.file, picture.is_large}));
      data["parts"] =
          page::parts({{"numbers", "Numbers", "", facts_table(results)},
                       {"thresholds", "Thresholds", thresholds_words, thresholds_table(results)}});
      data["left_out"] = study::left_out_of_cracks();
      return fill("crack", data);
    }

    std::string markdown(const CrackResults &results)
    {
      std::string text = "# Crack: " + results.scene_name + "\n\n" + verdict(results) + "\n\n" +
                         to_markdown(facts_table(results)) + "\n## Thresholds\n\n" +
                         to_markdown(thresholds_table(results)) + "\n" + thresholds_words +
                         "\n\n## What was left out of the model\n\n";
      for (const std::string &one : study::left_out_of_cracks())
        text += "- " + one + "\n";
      return text;
    }

    Json known_number(double value)
    {
      return std::isfinite(value) ? Json(value) : Json();
    }
  } // namespace

  std::string crack_outcome_words(scene::CrackOutcome outcome)
  {
    return outcome == scene::CrackOutcome::too_short
               ? "was simulated for too short a time to classify"
               : base::word(outcome);
  }

  std::string crack_text(const CrackResults &results)
  {
    return results.scene_name + "\n\n" + to_text(facts_table(results)) + "\n" +
           to_text(thresholds_table(results)) + wrapped(thresholds_words, 120) + "\n\n" +
           wrapped(verdict(results), 120) + "\n";
  }

  std::string crack_json(const CrackResults &r)
  {
    Json json{{"scene", r.scene_name},
              {"method", r.method},
              {"h", r.own.h},
              {"horizon", r.own.horizon},
              {"load", r.crack.load},
              {"strain", r.strain},
              {"toughness", r.toughness},
              {"lattice_toughness", r.own.toughness},
              {"rayleigh_speed", r.rayleigh_speed()},
              {"damping", r.damping},
              {"scheme", r.plan.scheme},
              {"step", r.plan.step},
              {"critical_step", r.plan.critical_step ? Json(*r.plan.critical_step) : Json()},
              {"n_steps", r.history.n_steps},
              {"n_bonds", r.n_bonds},
              {"seconds", r.seconds},
              {"resumed_at", r.history.resumed_at},
              {"outcome", base::word(r.motion.outcome)},
              {"reason", r.motion.reason},
              {"warnings", r.warnings()},
              {"expected", base::word(r.expected)},
              {"advance", r.motion.advance},
              {"speed", r.motion.speed},
              {"fastest", r.motion.fastest},
              {"energy_drift", r.motion.energy_drift},
              {"soft_energy_per_length", r.motion.soft_per_length},
              {"asymmetry", r.asymmetry},
              {"thresholds", Json::array()},
              {"samples", Json::array()}};
    for (const CrackThreshold &one : r.thresholds)
      json["thresholds"].push_back({{"series", one.series},
                                    {"h", one.h},
                                    {"horizon", one.horizon},
                                    {"lattice_toughness", one.toughness},
                                    {"energy", known_number(one.energy)},
                                    {"failure", one.failure}});
    for (const study::CrackSample &s : r.history.samples)
      json["samples"].push_back({{"t", s.t},
                                 {"tip", r.origin[0] + s.tip},
                                 {"kinetic", s.kinetic},
                                 {"bonds", s.bonds},
                                 {"soft", s.soft},
                                 {"dissipated", s.dissipated},
                                 {"branches", s.n_branches}});
    return json.dump(2) + "\n";
  }

  void write_crack(const CrackResults &results, const std::filesystem::path &dir)
  {
    write_file(dir / "crack.json", crack_json(results));
    write_file(dir / "crack.md", markdown(results));
    write_with_pictures(
        dir / "crack.html", [&] { write_crack_pictures(results, dir); },
        [&] { return page_of(results, dir); });
  }
} // namespace plumbline::report
