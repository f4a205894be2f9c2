#include "toughness_study.h"

#include "base/error.h"
#include "base/json_text.h"
#include "base/text_file.h"
#include "physics/expression.h"
#include "scene/scene_file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <tuple>

namespace plumbline::toughness
{
  using Json = nlohmann::ordered_json;
  using report::DataChart;
  using report::Line;

  namespace
  {
    scene::Scene phase(const scene::Scene &scene, const std::string &fraction)
    {
      return scene::parse_scene(scene.name, scene.text,
                                {{"Random/fraction", fraction},
                                 {"Random/modes", "0"},
                                 {"Random/values", ""},
                                 {"Sampling/rule", "none"}});
    }

    double toughness_of(const scene::Scene &scene)
    {
      return physics::Expression("Fracture/toughness", scene.fracture.toughness,
                                 scene.names(1))(scene.domain.cracks.front().back());
    }

    /// E/(1 - ν²)
    double modulus_of(const scene::Scene &scene)
    {
      const physics::Lame lame = scene.material.lame()(scene.domain.cracks.front().back());
      return 4 * lame.mu * (lame.lambda + lame.mu) / (lame.lambda + 2 * lame.mu);
    }

    std::optional<Toughness> toughness_from(const Json &quantities, const std::string &name)
    {
      if (!quantities.contains(name))
        return {};
      const Json &one = quantities.at(name);
      Toughness result;
      one.at("mean").get_to(result.mean);
      if (!one.at("deviation").is_null())
        result.deviation = one.at("deviation").get<double>();
      one.at("standard_error").get_to(result.standard_error);
      return result;
    }

    Entry entry_from(const Json &json, const scene::Scene &scene)
    {
      const Json &set = json.at("cases").at(0).at("sets").back();
      Entry entry;
      entry.fraction = scene.random.fraction;
      entry.rule = scene.sampling.rule_words();
      if (scene.random.n_modes > 0)
        entry.rule += ", " + std::to_string(scene.random.n_modes) + " modes";
      set.at("samples").get_to(entry.n_samples);
      set.at("missing").get_to(entry.n_missing);
      set.at("seconds").get_to(entry.seconds);
      if (const Json &kept = json.at("variance_kept"); !kept.is_null())
        entry.variance_kept = kept.get<double>();
      entry.by_bonds = toughness_from(set.at("quantities"), "K by bonds");
      entry.by_energy = toughness_from(set.at("quantities"), "K by energy");
      return entry;
    }

    std::optional<double> number_from(const Json &json, const std::string &name)
    {
      const Json &scalars = json.at("records").at(0).at("scalars");
      return scalars.contains(name)
                 ? std::optional<double>(scalars.at(name).at("value").get<double>())
                 : std::nullopt;
    }

    Crack crack_from(const Json &json, const scene::Scene &scene, const fs::path &folder)
    {
      Crack crack;
      crack.fraction = scene.random.fraction;
      crack.realisation = scene.random.realisation;
      crack.by_bonds = number_from(json, "K by bonds");
      crack.by_energy = number_from(json, "K by energy");
      crack.picture = folder / "grow/microstructure.svg";
      return crack;
    }

    /// What a command of plumbline has left of its scene.
    /// @param take  what it says of it
    void read_results(const fs::path &file, const std::string &command,
                      const std::function<void(const Json &, const scene::Scene &)> &take)
    {
      constexpr std::size_t most_bytes = 1'000'000'000;
      const std::string what = "'" + file.string() + "'", remedy = "remove it and take it again";
      try
      {
        const Json json = base::parse_json(
            base::read_text_file(file.string(), what, most_bytes, file.filename().string()), what,
            remedy);
        take(json, scene::parse_scene(json.at("scene").get<std::string>(),
                                      json.at("scene_text").get<std::string>()));
      }
      catch (const Json::exception &error)
      {
        throw InputError(what + " is not what '" + command + "' writes of a growth (" +
                         error.what() + "); " + remedy);
      }
    }

    double plain_mean(double first, double second, double fraction)
    {
      return (1 - fraction) * first + fraction * second;
    }

    DataChart chart_of(const Study &study, const std::string &name, const std::string &title,
                       std::optional<Toughness> Entry::*kind)
    {
      DataChart chart = report::named(
          name, title,
          "Bars: one standard deviation of the samples, as published; standard errors of means are "
          "in the table. Mixture: the straight line between the phases alone. Mean field: a "
          "straight crack through the mean material.");
      chart.plot.x_label = "fraction of the area";
      chart.plot.y_label = "K [force / length^(3/2)]";
      chart.plot.is_x_log = chart.plot.is_y_log = false;
      chart.data.columns = {"rule", "fraction", "mean", "deviation", "standard error"};
      unsigned int n = 0;
      const auto baseline = [&](const std::string &label, double (Baselines::*value)(double) const)
      {
        constexpr unsigned int n_parts = 50;
        Line line{label, report::style_of(n++, true), 1.2, {}, n_parts + 1};
        for (unsigned int i = 0; i <= n_parts; ++i)
        {
          const double fraction = static_cast<double>(i) / n_parts;
          line.points.push_back({fraction, (study.baselines.*value)(fraction)});
        }
        chart.plot.lines.push_back(line);
      };
      baseline("mixture", &Baselines::mixture);
      baseline("mean field", &Baselines::mean_field);
      double largest = study.baselines.mixture(1);
      unsigned int n_rules = 0;
      for (const Entry &entry : study.entries)
      {
        if (!(entry.*kind))
          continue;
        const Toughness &found = *(entry.*kind);
        if (chart.plot.lines.back().label != entry.rule)
          chart.plot.lines.push_back({entry.rule, report::style_of(n_rules++, false), 1.8, {}, 1});
        Line &line = chart.plot.lines.back();
        line.points.push_back({entry.fraction, found.mean});
        line.bars.push_back(found.deviation.value_or(0));
        largest = std::max(largest, found.mean + found.deviation.value_or(0));
        chart.data.rows.push_back(
            {report::text_cell(entry.rule), report::number_cell(entry.fraction),
             report::number_cell(found.mean),
             found.deviation ? report::number_cell(*found.deviation) : report::empty_cell(),
             report::number_cell(found.standard_error)});
      }
      chart.plot.y_range = report::Range{0, 1.05 * largest};
      return chart;
    }
  } // namespace

  double Baselines::mixture(double fraction) const
  {
    return plain_mean(first, second, fraction);
  }

  double Baselines::mean_field(double fraction) const
  {
    return std::sqrt(plain_mean(first_G, second_G, fraction) *
                     plain_mean(first_modulus, second_modulus, fraction));
  }

  Baselines baselines(const scene::Scene &scene)
  {
    const scene::Scene none = phase(scene, "0"), all = phase(scene, "1");
    Baselines result;
    result.first_G = toughness_of(none);
    result.second_G = toughness_of(all);
    result.first_modulus = modulus_of(none);
    result.second_modulus = modulus_of(all);
    result.first = std::sqrt(result.first_G * result.first_modulus);
    result.second = std::sqrt(result.second_G * result.second_modulus);
    return result;
  }

  Study read_study(const fs::path &folder)
  {
    Study study;
    for (const auto &part : fs::directory_iterator(folder))
    {
      if (fs::exists(part.path() / "sample.json"))
        read_results(part.path() / "sample.json", "plumbline sample",
                     [&](const Json &json, const scene::Scene &scene)
                     {
                       if (study.entries.empty())
                         study.baselines = baselines(scene);
                       study.scene_name = scene.name;
                       study.entries.push_back(entry_from(json, scene));
                     });
      if (fs::exists(part.path() / "grow.html"))
        read_results(part.path() / "grow.json", "plumbline grow",
                     [&](const Json &json, const scene::Scene &scene)
                     { study.cracks.push_back(crack_from(json, scene, part.path())); });
    }
    if (study.entries.empty())
      throw InputError("'" + folder.string() +
                       "' has no folders with a sample.json; run benchmarks/toughness first");
    std::sort(study.entries.begin(), study.entries.end(),
              [](const Entry &a, const Entry &b)
              { return std::tie(a.rule, a.fraction) < std::tie(b.rule, b.fraction); });
    std::sort(study.cracks.begin(), study.cracks.end(),
              [](const Crack &a, const Crack &b) { return a.fraction < b.fraction; });
    return study;
  }

  report::Table study_table(const Study &study)
  {
    report::Table table;
    table.columns = {"fraction",
                     "rule",
                     "samples",
                     "missing",
                     "variance kept",
                     "K by bonds",
                     "deviation",
                     "standard error",
                     "K by energy",
                     "deviation, energy",
                     "standard error, energy",
                     "mixture",
                     "mean field",
                     "CPU seconds"};
    for (const Entry &entry : study.entries)
    {
      std::vector<report::Cell> row = {
          report::number_cell(entry.fraction), report::text_cell(entry.rule),
          report::count_cell(entry.n_samples), report::count_cell(entry.n_missing),
          entry.variance_kept ? report::number_cell(*entry.variance_kept) : report::empty_cell()};
      for (const auto &kind : {entry.by_bonds, entry.by_energy})
      {
        const auto known = [&](double value)
        { return kind && value > 0 ? report::number_cell(value) : report::empty_cell(); };
        row.push_back(known(kind ? kind->mean : 0));
        row.push_back(kind && !kind->deviation ? report::text_cell("negative variance")
                                               : known(kind ? *kind->deviation : 0));
        row.push_back(known(kind ? kind->standard_error : 0));
      }
      row.push_back(report::number_cell(study.baselines.mixture(entry.fraction)));
      row.push_back(report::number_cell(study.baselines.mean_field(entry.fraction)));
      row.push_back(report::number_cell(entry.seconds));
      table.rows.push_back(std::move(row));
    }
    return table;
  }

  std::vector<DataChart> study_charts(const Study &study)
  {
    return {chart_of(study, "by-bonds", "K by counts of broken bonds", &Entry::by_bonds),
            chart_of(study, "by-energy", "K by energy", &Entry::by_energy)};
  }
} // namespace plumbline::toughness
