#include "report/tables.h"

#include "report/energy_table.h"
#include "report/text_table.h"
#include "study/solution_record.h"
#include "study/trend.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace plumbline::report
{
  namespace
  {
    /// Levels of a case over all methods, coarse to fine.
    struct Level
    {
      unsigned int number;
      double h, horizon, value;
      bool holds(const study::Record &run) const
      {
        return run.key.level == number && std::abs(run.key.h - h) <= same_length * h &&
               std::abs(run.key.horizon - horizon) <= same_length * horizon;
      }
    };

    std::vector<Level> levels_of(const study::StudyResults &results, const Case &one)
    {
      std::vector<Level> levels;
      for (const study::Record &run : results.records)
        if (run.key.problem == one.problem && run.key.series == one.series &&
            std::none_of(levels.begin(), levels.end(),
                         [&](const Level &level) { return level.holds(run); }))
          levels.push_back({run.key.level, run.key.h, run.key.horizon, run.key.value});
      std::stable_sort(levels.begin(), levels.end(),
                       [](const Level &a, const Level &b) {
                         return std::make_tuple(a.number, -a.h) < std::make_tuple(b.number, -b.h);
                       });
      return levels;
    }

    bool is_against_reference(const std::string &error)
    {
      const std::string target = " | reference";
      return error.size() >= target.size() &&
             error.compare(error.size() - target.size(), target.size(), target) == 0;
    }

    bool is_fitted(const study::Trend &trend)
    {
      return std::isfinite(trend.rate);
    }

    Cell fitted_rate(const study::Trend &trend)
    {
      return is_fitted(trend) ? uncertain_cell(trend.rate, trend.rate_uncertainty)
                              : Cell{{"", ""}, empty_cell().text, true};
    }

    Cell fitted_plateau(const study::Trend &trend)
    {
      return is_fitted(trend) ? uncertain_error_cell(trend.plateau, trend.plateau_uncertainty)
                              : Cell{{"", ""}, empty_cell().text, true};
    }

    std::string span(double low, double high)
    {
      return low == high ? rounded(low) : rounded(low) + " to " + rounded(high);
    }

    void write_table(const Table &table, const std::filesystem::path &stem)
    {
      const auto with = [&](const char *extension)
      {
        std::filesystem::path file = stem;
        return file += extension; // not replace_extension: a series "m = 2.5" has a dot
      };
      write_file(with(".csv"), to_csv(table));
      write_file(with(".md"), to_markdown(table));
      write_file(with(".tex"), to_latex(table));
    }
  } // namespace

  Table error_table(const study::StudyResults &results, const Case &one)
  {
    Table table;
    table.caption = one.title() + ": error, " + error_words(results.decisive_error);
    table.columns = {"level", {"h", {"h [length]"}}, {"δ", {"horizon [length]"}}, "m"};
    if (!results.variable.empty())
      table.columns.emplace_back(results.variable);
    const std::vector<MethodName> all = methods(results);
    std::vector<const MethodName *> shown;
    const bool has_rates = results.variable.empty();
    for (const MethodName &method : all)
      if (!runs_of(results, method.name, one).empty())
      {
        shown.push_back(&method);
        table.columns.push_back({method.name, {method.name + " error"}});
        if (has_rates)
          table.columns.push_back({"rate", {method.name + " rate"}});
      }

    const study::Axis axis = axis_of(results, one);
    for (const Level &level : levels_of(results, one))
    {
      std::vector<Cell> row = {count_cell(level.number), number_cell(level.h),
                               number_cell(level.horizon), number_cell(level.horizon / level.h)};
      if (!results.variable.empty())
        row.push_back(number_cell(level.value));
      for (const MethodName *method : shown)
      {
        Cell error = empty_cell(), rate = empty_cell();
        for (const study::Record *run : runs_of(results, method->name, one))
          if (level.holds(*run))
          {
            error = error_cell(decisive_error(results, *run));
            if (const study::Trend *trend = decisive_trend(results, method->name, one))
              rate = rate_cell(rate_at(*trend, coordinate(axis, run->key)));
          }
        row.push_back(error);
        if (has_rates)
          row.push_back(rate);
      }
      table.rows.push_back(row);
    }
    return table;
  }

  Table trend_table(const study::StudyResults &results)
  {
    Table table;
    table.caption = "Verdicts on the error " + error_words(results.decisive_error) +
                    ": fitted rate, and plateau a of e = a + b x^p";
    table.columns = {"method",
                     "problem",
                     "series",
                     {"rate", {"rate", "rate uncertainty"}},
                     {"plateau", {"plateau", "plateau uncertainty"}},
                     "verdict",
                     "reason"};
    for (const MethodName &method : methods(results))
      for (const Case &one : cases(results))
        if (const study::Trend *trend = decisive_trend(results, method.name, one))
          table.rows.push_back({text_cell(trend->method), text_cell(trend->problem),
                                text_cell(trend->series), fitted_rate(*trend),
                                fitted_plateau(*trend), text_cell(verdict_words(*trend)),
                                text_cell(trend->reason)});
    return table;
  }

  Table cost_table(const study::StudyResults &results)
  {
    Table table;
    table.caption = "Cost of each run; CPU seconds are summed over threads";
    table.columns = {"method",      "problem", "series",         "h",
                     "unknowns",    "bonds",   "geometry CPU s", "setup CPU s",
                     "solve CPU s", "peak MB", "iterations"};
    for (const study::Record &run : results.records)
      if (run.failure.empty())
      {
        const bool is_timed = run.cost.seconds() > 0;
        table.rows.push_back(
            {text_cell(run.key.method), text_cell(run.key.problem), text_cell(run.key.series),
             number_cell(run.key.h), count_cell(run.cost.n_unknowns), count_cell(run.cost.n_bonds),
             known(is_timed, number_cell(study::geometry_seconds(run))),
             known(is_timed, number_cell(run.cost.setup_seconds)),
             known(is_timed, number_cell(run.cost.solve_seconds)),
             known(is_timed, number_cell(1e-6 * static_cast<double>(run.cost.peak_bytes))),
             count_cell(run.cost.n_iterations)});
      }
    return without_empty_columns(table);
  }

  Table other_errors_table(const study::StudyResults &results)
  {
    Table table;
    table.columns = {"method", "problem", "series", "error", "finest value", "rate", "verdict"};
    for (const study::Trend &trend : results.trends)
      if (trend.error != results.decisive_error)
        table.rows.push_back(
            {text_cell(trend.method), text_cell(trend.problem), text_cell(trend.series),
             text_cell(error_words(trend.error)),
             error_cell(trend.values.empty() ? std::numeric_limits<double>::quiet_NaN()
                                             : trend.values.back()),
             fitted_rate(trend), text_cell(verdict_words(trend))});
    return table;
  }

  Table estimate_table(const std::vector<study::ErrorEstimate> &estimates)
  {
    Table table;
    table.caption = "Error estimates";
    table.columns = {"method",
                     "problem",
                     "series",
                     "level",
                     "h",
                     "δ",
                     "change with h",
                     "before",
                     "rate",
                     "change to p + 1",
                     "outer quadrature",
                     "estimate, averages",
                     "certified digits",
                     "estimate, field",
                     "domain"};
    for (const study::ErrorEstimate &estimate : estimates)
      if (estimate.estimate > 0) // else none was asked for
        table.rows.push_back(
            {text_cell(estimate.method), text_cell(estimate.problem), text_cell(estimate.series),
             count_cell(estimate.level), number_cell(estimate.h), number_cell(estimate.horizon),
             error_cell(estimate.h_change), error_cell(estimate.coarse_change),
             number_cell(estimate.rate), error_cell(estimate.p_change),
             error_cell(estimate.outer_change), error_cell(estimate.estimate),
             count_cell(estimate.certified_digits), error_cell(estimate.field_estimate),
             text_cell(estimate.is_of_polygon ? "the polygon alone" : "as described")});
    return table;
  }

  Table doubtful_differences(const study::StudyResults &results)
  {
    Table table;
    table.columns = {"method",     "problem", "series",   "level",
                     "difference", "value",   "estimate", "value / estimate"};
    for (const study::ErrorEstimate &estimate : results.references)
      for (const study::Record &run : results.records)
        if (run.key.problem == estimate.problem && run.key.series == estimate.series &&
            run.key.level == estimate.level && run.key.method != estimate.method &&
            run.failure.empty())
          for (const auto &[error, value] : study::errors_of(run))
            if (is_against_reference(error) && value < trusted_ratio * estimate.estimate)
              table.rows.push_back(
                  {text_cell(run.key.method), text_cell(run.key.problem), text_cell(run.key.series),
                   count_cell(run.key.level), text_cell(error_words(error)), error_cell(value),
                   error_cell(estimate.estimate), number_cell(value / estimate.estimate)});
    return table;
  }

  Table diagnostics_table(const study::StudyResults &results)
  {
    Table table;
    table.columns = {"method",           "family",         "neighbours", "smallest weight ratio",
                     "negative weights", "worst residual", "operator",   "notes"};
    for (const MethodName &method : methods(results))
    {
      double fewest = std::numeric_limits<double>::max(), most = 0, ratio = fewest, residual = 0;
      std::size_t n_negative = 0;
      std::vector<std::string> backends, notes;
      const auto add = [](std::vector<std::string> &list, const std::string &text)
      {
        if (!text.empty() && std::find(list.begin(), list.end(), text) == list.end())
          list.push_back(text);
      };
      for (const study::Record &run : results.records)
        if (run.key.method == method.name && run.failure.empty())
        {
          const double n_neighbours = run.has("neighbours") ? run["neighbours"] : 0;
          fewest = std::min(fewest, n_neighbours);
          most = std::max(most, n_neighbours);
          ratio = std::min(ratio, run.has("smallest weight") ? run["smallest weight"] : 1);
          residual = std::max(residual, run["relative residual"]);
          n_negative = std::max(n_negative, run.count("negative weights"));
          add(backends, run.text("operator"));
          for (const std::string &note : run.notes)
            add(notes, note);
        }
      if (fewest > most)
        continue; // no run came through
      const auto join = [](const std::vector<std::string> &list, const std::string &separator)
      {
        std::string text;
        for (const std::string &item : list)
          text += (text.empty() ? "" : separator) + item;
        return text;
      };
      table.rows.push_back({text_cell(method.name),
                            text_cell(base::word(method.family)),
                            {{span(fewest, most)}, span(fewest, most), true},
                            number_cell(ratio),
                            count_cell(n_negative),
                            error_cell(residual),
                            text_cell(join(backends, ", ")),
                            text_cell(join(notes, "; "))});
    }
    return table;
  }

  Table tip_force_table(const study::StudyResults &results)
  {
    Table table;
    table.columns = {"method", "case",  "series",    "h [length]",        "horizon [length]",
                     "tip x",  "tip y", "F [force]", "F / sqrt(horizon)", "sum of norms"};
    for (const study::Record &run : results.records)
      for (const method::TipForce &one : study::tip_forces_of(run))
        table.rows.push_back({text_cell(run.key.method), text_cell(run.key.problem),
                              text_cell(run.key.series), number_cell(run.key.h),
                              number_cell(run.key.horizon), number_cell(one.tip[0]),
                              number_cell(one.tip[1]), error_cell(one.norm),
                              error_cell(one.over_root), error_cell(one.sum_of_norms)});
    return table;
  }

  Table bound_table(const study::StudyResults &results)
  {
    Table table;
    table.columns = {"method", "case",  "series", "h [length]",  "horizon [length]",
                     "error",  "‖A⁻¹‖", "bound",  "nodal error", "error / bound"};
    for (const study::Record &run : results.records)
      for (const auto &[name, bound] : study::errors_of(run))
        if (study::is_bound(name))
        {
          const std::string nodal = "nodal" + name.substr(name.find(' '));
          const bool is_largest = study::norm_of_one(name, 4) == 1;
          const bool is_known = run.has(nodal),
                     is_round_off = !(bound > study::round_off_of(run, name));
          table.rows.push_back(
              {text_cell(run.key.method), text_cell(run.key.problem), text_cell(run.key.series),
               number_cell(run.key.h), number_cell(run.key.horizon), text_cell(error_words(nodal)),
               number_cell(is_largest ? run["inverse norm"] : 1 / run["smallest eigenvalue"]),
               error_cell(bound), is_known ? error_cell(run[nodal]) : empty_cell(),
               is_known && !is_round_off ? number_cell(run[nodal] / bound) : empty_cell()});
        }
    return table;
  }

  Table saving_table(const study::StudyResults &results)
  {
    Table table;
    table.caption = "What the smallest model saved";
    table.columns = {"method", "h [length]",   "CPU time", "full",
                     "times",  "pairs summed", "full",     "largest difference"};
    for (const study::Saving &saving : results.savings)
      table.rows.push_back({text_cell(saving.method), number_cell(saving.h),
                            text_cell(rounded_seconds(saving.smallest.seconds())),
                            text_cell(rounded_seconds(saving.full.seconds())),
                            text_cell(rounded(saving.full.seconds() / saving.smallest.seconds())),
                            count_cell(saving.smallest.n_bonds), count_cell(saving.full.n_bonds),
                            error_cell(saving.difference)});
    return table;
  }

  Table failure_table(const study::StudyResults &results)
  {
    Table table;
    table.columns = {"method", "problem", "series", "level", "h", "δ"};
    if (!results.variable.empty())
      table.columns.emplace_back(results.variable);
    table.columns.emplace_back("why");
    for (const study::Record &run : results.records)
      if (!run.failure.empty())
      {
        std::vector<Cell> row = {text_cell(run.key.method), text_cell(run.key.problem),
                                 text_cell(run.key.series), count_cell(run.key.level),
                                 number_cell(run.key.h),    number_cell(run.key.horizon)};
        if (!results.variable.empty())
          row.push_back(number_cell(run.key.value));
        row.push_back(text_cell(run.failure));
        table.rows.push_back(std::move(row));
      }
    return table;
  }

  void write_tables(const study::StudyResults &results, const std::filesystem::path &dir)
  {
    const std::filesystem::path folder = dir / "tables";
    for (const Case &one : cases(results))
      write_table(error_table(results, one), folder / ("errors_" + one.slug));
    write_table(trend_table(results), folder / "verdicts");
    write_table(cost_table(results), folder / "cost");
    auto estimates = results.references;
    estimates.insert(estimates.end(), results.estimates.begin(), results.estimates.end());
    if (const Table table = estimate_table(estimates); !table.rows.empty())
      write_table(table, folder / "estimates");
    if (const Table tips = tip_force_table(results); !tips.rows.empty())
      write_table(tips, folder / "tip_forces");
    if (const Table bounds = bound_table(results); !bounds.rows.empty())
      write_table(bounds, folder / "bounds");
    if (const Table energies = energy_table(results); !energies.rows.empty())
      write_table(energies, folder / "energies");
  }
} // namespace plumbline::report
