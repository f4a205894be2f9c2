#include "report/damage_maps.h"
#include "report/view.h"
#include "study/crack.h"

#include <algorithm>

namespace plumbline::report
{
  namespace
  {
    const char *const thresholds_words =
        "Far from its tip an advancing crack separates the intact strip into two halves. It "
        "neither "
        "grows nor closes if this releases the toughness of the lattice, G_c,h, the energy of all "
        "bonds across a line at their limit. The threshold is computed from one column in "
        "equilibrium, intact and separated. W H, the energy density of uniform strain times the "
        "height between the grips, is close to it, and tends to it as the horizon decreases.";

    Table numbers(const Record &record)
    {
      return quantity_table(
          record,
          {{"advance", "of the crack tip from the notch, at the final time [length]"},
           {"speed", "of the tip [length/time]; in SI units m/s"},
           {"speed / c_R",
            "relative to the Rayleigh wave speed, by a line fitted from 1/5 to 4/5 of the advance"},
           {"fastest / c_R",
            "largest mean speed over a window of a tenth of the time for which the tip moves"},
           {"speed window", "length of this window [time]"},
           {"c_R", "Rayleigh wave speed, the theoretical limit of a mode-I crack [length/time]"},
           {"c_T", "shear wave speed [length/time]"},
           {"strained W H / G_c,h",
            "energy of the strained strip relative to the toughness of the lattice"},
           {"strain", "prescribed by the grips, u_y = strain · y"},
           {"G_c", "toughness by the bond potential [force/length]"},
           {"c", "f(∞) of the bond potential f [force/length]"},
           {"beta", "f′(0)/f(∞) of the bond potential [1/length]"},
           {"softening strain", "of a bond as long as the horizon"},
           {"G_c,h / G_c", "toughness of the lattice relative to G_c"},
           {"soft energy / G_c,h", "energy that softened bonds gain per unit advance, relative to "
                                   "the toughness of the lattice"},
           {"energy drift", "maximum change of kinetic + bonds + dissipated energy, relative to "
                            "the initial energy"},
           {"asymmetry", "maximum difference of u from its mirror image, at the final time"},
           {"time step", record.text("scheme") + " [time]"},
           {"critical step", "largest stable time step [time]"},
           {"steps", "time steps"},
           {"nodes", "including those in the grips"},
           {"resumed at", "time of the checkpoint from which the run was resumed (0: none)"}});
    }

    Part thresholds(const StudyResults &results)
    {
      return {"thresholds", "Thresholds", thresholds_words,
              table_of(results,
                       {{"series", [](const Record &r) { return text_cell(r.key.series); }},
                        {"horizon", [](const Record &r) { return number_cell(r.key.horizon); }},
                        {"h", [](const Record &r) { return number_cell(r.key.h); }},
                        number_column("G_c,h / G_c", "G_c,h / G_c"),
                        number_column("W H / G_c,h", "W H / G_c,h"),
                        text_column("no threshold, because", "no threshold")},
                       [](const Record &r) { return r.has("G_c"); })};
    }

    /// To follow "the crack" or "it".
    std::string outcome_of(const Record &record)
    {
      const std::string &outcome = record.text("outcome");
      return outcome == base::word(scene::CrackOutcome::too_short)
                 ? "was simulated for too short a time to classify"
                 : outcome;
    }

    /// @param is_of_one  of the crack's motion no other mesh size is there
    std::string verdict(const Record &record, bool is_of_one)
    {
      const std::string &outcome = record.text("outcome");
      std::string text =
          "At " + rounded(record["load"]) + " times its threshold the crack " + outcome_of(record);
      const std::string horizons = rounded(record["advance"] / record.key.horizon) + " horizons";
      if (outcome == base::word(scene::CrackOutcome::too_short))
        text += ": its tip advanced by " + horizons;
      else if (outcome == base::word(scene::CrackOutcome::arrests))
        text +=
            " after its tip advanced by " + rounded(record["advance"]) + " [length], " + horizons;
      else
        text += record["speed"] > 0
                    ? "; its mean speed is " + rounded(record["speed"]) + " [length/time], " +
                          rounded(record["speed / c_R"]) + " of the Rayleigh wave speed, at most " +
                          rounded(record["fastest / c_R"]) +
                          " over a tenth of the time for which it moves"
                    : ", at an unknown speed: too few tip positions were sampled for a fit";
      text += "; the solution is " + (record["asymmetry"] == 0
                                          ? std::string("symmetric to the last bit")
                                          : "asymmetric by " + rounded(record["asymmetry"]));
      if (!record.text("reason").empty())
        text += ". Reason: " + record.text("reason");
      if (!is_of_one)
        return text + ". This is the result at h = " + rounded(record.key.h) + ".";
      return text + ". This rests on one mesh size, h = " + rounded(record.key.h) +
             ": run with another Study/h to see how it depends on h.";
    }

    DataChart tip_chart(const Record &record, const analysis::Curve &samples)
    {
      DataChart chart = linear_chart("tip", "Crack tip position", "t [time]", "x [length]",
                                     "Dashed: a Rayleigh wave that starts at the notch tip.");
      chart.data = table_of(analysis::Curve{samples[0], samples[1]});
      const std::vector<double> &t = samples[0].values, &x = samples[1].values;
      std::vector<Vertex> tip;
      for (std::size_t i = 0; i < t.size(); ++i)
        tip.push_back({t[i], x[i]});
      double right = x.front();
      for (const dealii::Point<2> &node : record.fields.at("damage").points)
        right = std::max(right, node[0] + record.key.h);
      const double from = record["notch tip"],
                   end = std::min(t.back(), (right - from) / record["c_R"]),
                   reached = from + record["c_R"] * end,
                   highest = std::max(reached, *std::max_element(x.begin(), x.end())),
                   lowest = std::min(from, *std::min_element(x.begin(), x.end())),
                   margin = .05 * (highest - lowest);
      chart.plot.y_range = Range{lowest - margin, highest + margin};
      chart.plot.lines = {long_line("crack tip", 0, std::move(tip)),
                          dashed_line("Rayleigh wave", 1, {{0, from}, {end, reached}})};
      return chart;
    }

    /// Its largest value is "fastest / c_R".
    DataChart speed_chart(const Record &record)
    {
      DataChart chart = linear_chart(
          "speed", "Crack speed", "t [time]", "tip speed / Rayleigh wave speed [1]",
          "Mean over a window of " + rounded(record["speed window"]) +
              " [time], a tenth of the time for which the tip moves, up to the end of the strip.");
      const analysis::Curve &speeds = record.curves.at("tip speed");
      std::vector<Vertex> speed;
      chart.data.columns = {"t [time]", "tip speed / Rayleigh wave speed [1]"};
      for (std::size_t i = 0; i < speeds[0].values.size(); ++i)
      {
        speed.push_back({speeds[0].values[i], speeds[1].values[i]});
        chart.data.rows.push_back({number_cell(speed.back().x), number_cell(speed.back().y)});
      }
      const double end = record.curves.at("samples")[0].values.back();
      chart.plot.lines = {long_line("crack tip", 0, std::move(speed)),
                          dashed_line("Rayleigh waves", 1, {{0, 1}, {end, 1}})};
      fit_y(chart.plot);
      return chart;
    }

    DataChart energy_chart(const analysis::Curve &samples)
    {
      DataChart chart = linear_chart(
          "energies", "Energies", "t [time]", "energy [force]",
          "The grips do not move and do no work: the sum is constant up to the error of the time "
          "steps. Softened bonds are part of the bonds.");
      chart.data = table_of(samples);
      const auto line = [&](const std::string &label, unsigned int style, const auto &value)
      {
        std::vector<Vertex> points;
        for (std::size_t i = 0; i < samples[0].values.size(); ++i)
          points.push_back({samples[0].values[i], value(i)});
        chart.plot.lines.push_back(long_line(label, style, std::move(points)));
      };
      const auto at = [&](std::size_t column)
      { return [&samples, column](std::size_t i) { return samples[column].values[i]; }; };
      constexpr std::size_t kinetic = 2, bonds = 3, soft = 4, dissipated = 5;
      line("sum", 0,
           [&](std::size_t i) { return at(kinetic)(i) + at(bonds)(i) + at(dissipated)(i); });
      line("bonds", 1, at(bonds));
      line("softened bonds", 2, at(soft));
      line("kinetic", 3, at(kinetic));
      if (samples[dissipated].values.back() > 0)
        line("dissipated", 4, at(dissipated));
      fit_y(chart.plot);
      return chart;
    }
  } // namespace

  View crack_view(const StudyResults &results)
  {
    View view{"Dynamic fracture"};
    view.parts = {thresholds(results),
                  failures(results, "Levels without a result", "no result, because")};
    view.parts.push_back(omitted_part(study::left_out_of_cracks()));
    const auto moved = std::find_if(results.records.begin(), results.records.end(),
                                    [](const Record &record) { return record.has("advance"); });
    if (moved == results.records.end())
      return view;
    const Record &record = *moved;
    view.answer =
        verdict(record, std::none_of(moved, results.records.end(),
                                     [&](const Record &other) {
                                       return other.has("advance") && other.key.h != record.key.h;
                                     }));
    view.facts = {record.key.method + ", m = " + rounded(record.key.m()),
                  "load " + rounded(record["load"]) + " × threshold",
                  "crack " + outcome_of(record)};
    view.parts.insert(view.parts.begin(), {"numbers", "Numbers", "", numbers(record)});
    const analysis::Curve &samples = record.curves.at("samples");
    view.galleries = {
        {"picture",
         "Results",
         "",
         {tip_chart(record, samples), speed_chart(record), energy_chart(samples)},
         {damage_moments(record, "Damage: softened bonds",
                         "The fraction of each node's bonds that is softened or cut, on the "
                         "undeformed body at six times; the grips are above and below. Time/frames "
                         "also writes the displacements, as VTU.")}}};
    view.tables = {{"samples", table_of(samples)}};
    return view;
  }
} // namespace plumbline::report
