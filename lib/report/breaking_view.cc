#include "report/breaking_view.h"

#include "report/counted.h"
#include "report/damage_maps.h"
#include "study/breaking.h"

#include <algorithm>

namespace plumbline::report
{
  namespace
  {
    using analysis::Curve;

    Table numbers(const Record &record)
    {
      return quantity_table(
          record,
          {{"advance", "distance from the notch tip to the crack's farthest point [length]"},
           {"angle", "of this line against the direction of the notch [degree]"},
           {"branched", "distance over which the crack has two parts or more [length]"},
           {"speed", "of the tip, by a line fitted from 1/5 to 4/5 of the advance, without jumps "
                     "[length/time]"},
           {"speed / c_R", "relative to the Rayleigh wave speed"},
           {"fastest / c_R",
            "largest mean speed over an advance of four horizons or more without jumps"},
           {"c_R", "Rayleigh wave speed [length/time]"},
           {"c_T", "shear wave speed [length/time]"},
           {"first break", "when the first bond broke [time]"},
           {"broken bonds", "without those that the notch cuts"},
           {"apart", "separated cell faces that are not connected to a notch"},
           {"broken energy", "energy dissipated in broken bonds [force]"},
           {"broken energy / G", "over G times the length of a straight crack that breaks as many "
                                 "bonds; compare G_h / G"},
           {"energy gained", "by the body as bonds broke that were stretched where others are "
                             "compressed [force]"},
           {"energy imbalance", "maximum change of kinetic + bonds + broken + dissipated - work, "
                                "relative to the largest energy without that of the mean "
                                "velocity"},
           {"overshoot", "mean of stretch / s0 - 1 when a bond was found broken; of first order in "
                         "the time step"},
           {"s0", "critical stretch [1]"},
           {"G_h / G", "energy of all bonds across a line of the lattice at s0, relative to G"},
           {"time step", record.text("scheme") + " [time]"},
           {"critical step", "largest stable time step of the unbroken body [time]"},
           {"nodes", "including those in the grips"},
           {"bonds", "unbroken at t = 0"},
           {"resumed at", "time of the checkpoint from which the run was resumed (0: none)"}});
    }

    std::string verdict(const Record &record)
    {
      const std::string &outcome = record.text("outcome");
      std::string text =
          record.count("broken bonds") == 0 ? "No bond breaks; the crack " : "The crack ";
      text += outcome == base::word(scene::CrackOutcome::too_short)
                  ? "was simulated for too short a time to classify"
                  : outcome;
      if (record["advance"] > 0)
        text += "; its farthest point is " + rounded(record["advance"]) +
                " [length] from the notch tip, at " + rounded(record["angle"]) +
                " degrees to the notch";
      if (record.has("speed"))
        text += "; its speed is " + rounded(record["speed"]) + " [length/time], " +
                rounded(record["speed / c_R"]) + " of the Rayleigh wave speed";
      return text + "; the energy balance is off by " + rounded(record["energy imbalance"]) +
             " of the largest energy. Reason: " + record.text("reason") +
             ". This rests on one mesh size, h = " + rounded(record.key.h) + ".";
    }

    std::string model(const Record &record)
    {
      return "Model: " + record.text("model") +
             ", with inertia. A bond is linear until its stretch reaches s0, and broken for good "
             "from then on (Silling & Askari 2005). Bonds break between two time steps; the energy "
             "dissipated in them is found from the energy before and after.";
    }

    std::vector<Vertex> line_of(const Curve &curve, const std::string &x, const std::string &y)
    {
      std::vector<Vertex> points;
      for (std::size_t i = 0; i < curve[0].values.size(); ++i)
        points.push_back({column(curve, x)[i], column(curve, y)[i]});
      return points;
    }

    DataChart tip_chart(const Record &record)
    {
      const Curve &tip = record.curves.at("tip");
      DataChart chart =
          linear_chart("tip", "Crack advance", "t [time]", "distance from the notch tip [length]",
                       "Of the crack that goes farthest, at every time step in which it grew. "
                       "Dashed: a Rayleigh "
                       "wave that starts at the notch tip when the crack begins to grow.");
      chart.data = table_of(tip);
      const double begin = column(tip, "t").front(),
                   end = std::min(begin + record["advance"] / record["c_R"],
                                  record.curves.at("samples")[0].values.back());
      chart.plot.lines = {
          long_line("crack tip", 0, line_of(tip, "t", "advance")),
          dashed_line("Rayleigh wave", 1, {{begin, 0}, {end, record["c_R"] * (end - begin)}})};
      fit_y(chart.plot);
      return chart;
    }

    DataChart energy_chart(const Record &record)
    {
      const Curve &samples = record.curves.at("samples");
      DataChart chart = linear_chart(
          "energies", "Energy balance", "t [time]", "energy [force]",
          "Work of grips and loads = kinetic + bonds + broken + dissipated, up to the error of the "
          "time steps: the maximum imbalance is " +
              rounded(record["energy imbalance"]) + " of the largest energy.");
      chart.data = table_of(samples);
      const std::vector<std::pair<std::string, std::string>> lines = {
          {"work", "work"},
          {"kinetic", "kinetic"},
          {"bonds", "bonds"},
          {"broken", "dissipated in broken bonds"},
          {"dissipated", "dissipated by damping"}};
      unsigned int style = 0;
      for (const auto &[name, label] : lines)
        if (const std::vector<double> &values = column(samples, name);
            std::any_of(values.begin(), values.end(), [](double value) { return value != 0; }))
          chart.plot.lines.push_back(long_line(label, style++, line_of(samples, "t", name)));
      if (!chart.plot.lines.empty())
        fit_y(chart.plot);
      return chart;
    }
  } // namespace

  bool is_of_breaking(const Record &record)
  {
    return record.has("energy imbalance");
  }

  View breaking_view(const Record &record)
  {
    View view{"Dynamic fracture"};
    view.answer = verdict(record);
    view.parts = {{"numbers", "Numbers", "", numbers(record)},
                  {"cracks", "Cracks",
                   "The crack of each notch, at the final time: its farthest point, the distance "
                   "and angle to the notch, and the distance over which it is branched.",
                   table_of(record.curves.at("cracks"))},
                  model_part(model(record)),
                  omitted_part(study::left_out_of_breaking())};
    view.facts = {record.key.method + ", m = " + rounded(record.key.m()),
                  "crack " + record.text("outcome")};
    std::vector<DataChart> charts;
    if (!record.curves.at("tip")[0].values.empty())
      charts.push_back(tip_chart(record));
    if (DataChart energies = energy_chart(record); !energies.plot.lines.empty())
      charts.push_back(std::move(energies));
    view.galleries = {
        {"picture",
         "Results",
         "",
         std::move(charts),
         {damage_moments(
             record, "Damage: broken bonds",
             "The fraction of each node's bonds that is broken or cut, on the undeformed body at "
             "six times. Time/frames also writes the displacements, as VTU.")}}};
    view.tables = {{"samples", table_of(record.curves.at("samples"))},
                   {"breaks", table_of(record.curves.at("breaks"))}};
    return view;
  }
} // namespace plumbline::report
