#include "report/growth_page.h"

#include "report/growth_charts.h"
#include "report/microstructure.h"
#include "report/page_parts.h"
#include "report/seeds.h"
#include "report/text_table.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <map>

namespace plumbline::report
{
  namespace
  {
    using analysis::Event;
    using study::GrowthResults;
    using Json = nlohmann::ordered_json;

    /// Of one of scene::growth_quantities.
    std::string meaning_of(const std::string &quantity)
    {
      static const std::map<std::string, std::string> words = {
          {"broken bonds", "the notch's not counted"},
          {"events", "at each a bond and its ties, or a batch"},
          {"peak load", "where the reaction is largest"},
          {"peak reaction", "of the grips on what they do [force]"},
          {"advance", "of the tip, from the notch's [length]"},
          {"G by bonds", "of broken bonds, each by its part of a straight crack's length, over the "
                         "width [force/length]"},
          {"K by bonds", "root of that and the mean of E/(1 - nu²)"},
          {"G by energy", "all that bonds held and that was released, over the width: above the "
                          "material's where growth is unstable [force/length]"},
          {"K by energy", "the same of G by energy"},
          {"L1", "of the crack within phase 1, the weaker, as a straight crack breaks so many "
                 "bonds; of one phase all [length]"},
          {"L2", "the same within phase 2, the tougher"},
          {"Li", "the same on their interface, of bonds with an end in each"}};
      return words.at(quantity);
    }

    Table facts_table(const GrowthResults &r)
    {
      constexpr std::size_t most_parts = 8; // of a material that varies from place to place
      Table table;
      table.columns = {"quantity", "value", "meaning"};
      const auto add = [&](const std::string &name, double value, const std::string &words) {
        table.rows.push_back({text_cell(name), number_cell(value), text_cell(words)});
      };
      const auto &work = r.work;
      for (const char *const name : scene::growth_quantities)
        add(name, r.quantity(name), meaning_of(name));
      add("width", r.path.width, "of all sides that separated, projected onto the x-axis [length]");
      add("apart", static_cast<double>(r.path.n_elsewhere),
          "sides that separated elsewhere, not connected to the notch");
      table.rows.push_back({text_cell("connected"), text_cell(r.growth.is_separated ? "no" : "yes"),
                            text_cell("paths of bonds join the grips at the end")});
      add("reaction left", r.growth.reaction_left(), "at the end, over its largest");
      const bool has_parts = r.phases().empty() && r.parts.size() <= most_parts;
      for (std::size_t i = 0; i < r.parts.size() && has_parts; ++i)
        add("length, G = " + rounded(r.parts[i].toughness), r.parts[i].length,
            std::to_string(r.parts[i].n_bonds) +
                " broken bonds of this toughness, as a straight crack has them [length]");
      add("G_h / G", r.lattice_toughness,
          "all bonds across a straight line of the lattice at their limits");
      if (r.rules.criterion == problem::Criterion::calibrated)
        add("G_peak / G", r.trapping,
            "at which a crack goes on in a strip of this lattice; G was divided by it");
      add("unpaired", static_cast<double>(r.n_unpaired),
          "broken bonds whose mirror image about the middle is whole");
      add("imbalance", r.largest_imbalance(),
          r.rules.is_corrected() ? "maximum imbalance of the bonds' energy relative to the work; "
                                   "surface terms derive from no energy"
                                 : "maximum imbalance of energy relative to the work");
      add("residual", r.largest_residual(), "force on a node over a bond's at the beginning");
      add("unknowns", static_cast<double>(r.n_unknowns), "displacements");
      add("bonds", static_cast<double>(r.n_bonds), "whole at the beginning");
      const bool is_factor = r.rules.solver != problem::GrowthSolver::multigrid;
      add(is_factor ? "factorisations" : "set-ups", static_cast<double>(work.n_factorisations),
          std::string(is_factor ? "of the equations; " : "of multigrid; ") +
              rounded_seconds(work.factor_seconds) + " in all");
      add("updates", static_cast<double>(work.n_updates),
          "events without one, up to rank " + std::to_string(work.largest_rank) + "; " +
              rounded_seconds(work.update_seconds) + " in all");
      if (work.n_iterations > 0)
        add("iterations", static_cast<double>(work.n_iterations),
            std::string(is_factor ? "of GMRES" : "of conjugate gradients") + ", at most " +
                std::to_string(work.most_iterations) + " an event");
      return table;
    }

    std::string ending(const GrowthResults &r)
    {
      switch (r.growth.end)
      {
      case problem::GrowthEnd::parted:
        return "until no path of bonds joins the grips";
      case problem::GrowthEnd::unloaded:
        return "until the reaction is " + rounded(r.rules.least_reaction) +
               " of its largest (Fracture/min reaction)";
      case problem::GrowthEnd::loaded:
        return "until Fracture/max load, " + rounded(r.rules.largest_load);
      case problem::GrowthEnd::whole:
        return "until no bond is left that can break";
      default:
        return "";
      }
    }

    std::string verdict(const GrowthResults &r, const std::vector<std::string> &faults)
    {
      std::string text;
      if (r.growth.events.empty())
        text = "No bond breaks up to load " + rounded(r.growth.last_load);
      else
        text = std::to_string(r.n_broken()) + " bonds break at " +
               std::to_string(r.growth.events.size()) + " events from load " +
               rounded(r.growth.events.front().load) + " on, " + ending(r) +
               ". The reaction is largest, " + rounded(r.quantity("peak reaction")) + ", at load " +
               rounded(r.quantity("peak load")) + "; the crack advances by " + rounded(r.advance());
      if (r.path.n_elsewhere > 0)
        text += "; bonds also part elsewhere, " + std::to_string(r.path.n_elsewhere) +
                " sides that do not join the notch";
      if (!r.growth.events.empty())
        text += ". At the end " + std::string(r.growth.is_separated ? "no bonds" : "bonds still") +
                " join the grips, and " + rounded(r.growth.reaction_left()) +
                " of the largest reaction is left";
      for (const std::string &fault : faults)
        text += ". EXPECTED: " + fault;
      return text + ".";
    }

    std::string phase_words(const GrowthResults &r)
    {
      const std::vector<double> phases = r.phases();
      return phases.size() == 2
                 ? " Phase 1 has G = " + rounded(phases[0]) +
                       " and phase 2 has G = " + rounded(phases[1]) +
                       (r.rules.of_bonds == problem::BondToughness::mean
                            ? "; a bond between the phases has the mean of both values."
                            : "; each bond has the minimum of G along its length.")
                 : "";
    }

    std::string interface_words(const GrowthResults &r)
    {
      return r.rules.interfaces.empty()
                 ? ""
                 : " Bonds across " + std::to_string(r.rules.interfaces.size()) +
                       (r.rules.interfaces.size() == 1 ? " line has" : " lines have") +
                       " a G of its own (Fracture/interfaces).";
    }

    std::string model_words(const GrowthResults &r)
    {
      return "Model: " + r.model +
             ". A bond breaks at the stretch s0, s0² = πG/(3δ(λ + μ)), at which all bonds across a "
             "straight cut of the continuum hold G (Fan et al. 2022, eq. (2.25); exact where λ = "
             "μ). On this lattice they hold " +
             rounded(r.lattice_toughness) +
             " G, and a crack needs more than that to pass from one column of nodes to the next" +
             (r.rules.criterion == problem::Criterion::calibrated
                  ? ": " + rounded(r.trapping) +
                        " G, as a strip shows, by the root of which s0 was lowered (Fracture/"
                        "criterion = calibrated)."
                  : ".") +
             phase_words(r) + interface_words(r) +
             (r.spectrum ? " Of the random field " + words_of(*r.spectrum) + "." : "");
    }

    /// With what makes it again.
    std::string origin_words(const GrowthResults &r)
    {
      const std::string seeds = seed_words(r.random);
      return model_words(r) + (seeds.empty() ? "" : " " + seeds + ".");
    }

    std::string page_of(const GrowthResults &r, const std::vector<std::string> &faults,
                        const std::filesystem::path &dir)
    {
      Data data =
          page::begin("grow", r.scene_name, r.purpose,
                      {r.method + ", m = " + rounded(r.horizon / r.h), base::word(r.rules.breaking),
                       (faults.empty() ? "✓ " : "✗ ") + base::word(r.growth.end)});
      data["verdict"] = verdict(r, faults);
      data["warnings"] = r.warnings;
      data["microstructure"] = Data();
      if (has_microstructure(r))
        data["microstructure"] = page::figure(
            {dir / "grow/microstructure.svg", "microstructure-", "The crack in its microstructure",
             "Grey: G of the nodes, the tougher the darker. Sides between next "
             "neighbours that have separated: of the crack orange, apart from it blue; "
             "of the notch black.",
             "Data", "grow/sides.csv", true});
      data["moments"] = page::figure(
          {dir / "grow/moments.svg", "moments-", "Where bonds are broken",
           "The part of each node's bonds that is broken or cut, on the body at rest, after even "
           "parts of all broken bonds. Beside a straight crack at m = 3 it is 11/28, 6/28 and "
           "1/28.",
           "Picture", "grow/moments.svg", true});
      data["charts"] = page::charts(growth_charts(r), dir, "grow");
      data["table"] = page::table(facts_table(r));
      data["model"] = origin_words(r);
      data["left_out"] = study::left_out_of_growth(r.rules);
      data["scene_text"] = r.scene_text;
      return fill("grow", data);
    }

    std::string markdown(const GrowthResults &r, const std::vector<std::string> &faults)
    {
      std::string text = "# Growth: " + r.scene_name + "\n\n" + verdict(r, faults) + "\n\n";
      for (const std::string &warning : r.warnings)
        text += "Warning: " + warning + ".\n\n";
      text += to_markdown(facts_table(r)) + "\n" + origin_words(r) +
              "\n\n## What was left out of the model\n\n";
      for (const std::string &one : study::left_out_of_growth(r.rules))
        text += "- " + one + "\n";
      return text + "\n## The scene as read\n\n```\n" + r.scene_text + "```\n";
    }

    Json known_number(double value)
    {
      return std::isfinite(value) ? Json(value) : Json();
    }

    Json to_json(const Event &e, const dealii::Point<2> &tip)
    {
      return {{"critical_load", e.critical},
              {"load", e.load},
              {"bonds", e.bonds},
              {"reaction_before", e.reaction_before},
              {"reaction", e.reaction},
              {"work", e.work},
              {"stored", e.stored},
              {"in_bonds", e.in_bonds},
              {"released", e.released},
              {"tip", {tip[0], tip[1]}}};
    }
  } // namespace

  std::string growth_text(const GrowthResults &r)
  {
    return r.scene_name + "\n\n" + to_text(facts_table(r)) + "\n" + wrapped(origin_words(r), 120) +
           "\n\n" + wrapped(verdict(r, {}), 120) + "\n";
  }

  std::string growth_json(const GrowthResults &r)
  {
    const bool has_field = r.random.field != scene::FieldKind::none;
    const Json realisation = r.random.is_drawn_whole() ? Json(r.random.realisation) : Json();
    Json json{{"scene", r.scene_name},
              {"scene_text", r.scene_text},
              {"field_seed", has_field ? Json(r.random.seed) : Json()},
              {"field_realisation", realisation},
              {"method", r.method},
              {"model", r.model},
              {"h", r.h},
              {"horizon", r.horizon},
              {"breaking", base::word(r.rules.breaking)},
              {"stretch", base::word(r.rules.stretch)},
              {"criterion", base::word(r.rules.criterion)},
              {"has_surface_terms", r.rules.is_corrected()},
              {"surface_terms", base::word(r.rules.surface_terms)},
              {"lattice_toughness", r.lattice_toughness},
              {"trapping", r.trapping},
              {"n_unknowns", r.n_unknowns},
              {"n_bonds", r.n_bonds},
              {"n_broken", r.n_broken()},
              {"end", base::word(r.growth.end)},
              {"last_load", known_number(r.growth.last_load)},
              {"is_connected", !r.growth.is_separated},
              {"reaction_left", known_number(r.growth.reaction_left())},
              {"first_stiffness", r.growth.first_stiffness},
              {"peak_load", r.quantity("peak load")},
              {"peak_reaction", r.quantity("peak reaction")},
              {"advance", r.advance()},
              {"G_by_bonds", known_number(r.quantity("G by bonds"))},
              {"G_by_energy", known_number(r.quantity("G by energy"))},
              {"K_by_bonds", known_number(r.quantity("K by bonds"))},
              {"K_by_energy", known_number(r.quantity("K by energy"))},
              {"phases", r.phases()},
              {"L1", known_number(r.quantity("L1"))},
              {"L2", known_number(r.quantity("L2"))},
              {"Li", known_number(r.quantity("Li"))},
              {"plane_modulus", r.plane_modulus},
              {"variance_kept", r.spectrum ? Json(r.spectrum->variance_kept()) : Json()},
              {"n_apart", r.path.n_elsewhere},
              {"n_unpaired", r.n_unpaired},
              {"warnings", r.warnings},
              {"energy_imbalance", r.largest_imbalance()},
              {"residual", r.largest_residual()},
              {"solver", base::word(r.rules.solver)},
              {"n_factorisations", r.work.n_factorisations},
              {"n_updates", r.work.n_updates},
              {"largest_rank", r.work.largest_rank},
              {"n_iterations", r.work.n_iterations},
              {"most_iterations", r.work.most_iterations},
              {"seconds", r.seconds},
              {"n_resumed", r.growth.n_resumed},
              {"events", Json::array()}};
    for (std::size_t i = 0; i < r.growth.events.size(); ++i)
      json["events"].push_back(to_json(r.growth.events[i], r.origin + r.path.tips[i]));
    return json.dump(2) + "\n";
  }

  void write_growth(const GrowthResults &results, const std::vector<std::string> &faults,
                    const std::filesystem::path &dir)
  {
    write_file(dir / "grow.json", growth_json(results));
    write_file(dir / "grow.md", markdown(results, faults));
    write_with_pictures(
        dir / "grow.html", [&] { write_growth_pictures(results, dir); },
        [&] { return page_of(results, faults, dir); });
  }
} // namespace plumbline::report
