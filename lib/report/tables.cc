#include "report/tables.h"

#include "report/text_table.h"
#include "report/view.h"
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
    using study::Trend;

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

    const study::Key &place_of(const Record &run)
    {
      return run.key;
    }
    template <class Row>
    const Row &place_of(const Row &row)
    {
      return row;
    }

    /// Method, problem and series, then others.
    template <class Row>
    std::vector<ColumnOf<Row>> of_case(std::vector<ColumnOf<Row>> others)
    {
      std::vector<ColumnOf<Row>> columns = {
          {"method", [](const Row &row) { return text_cell(place_of(row).method); }},
          {"problem", [](const Row &row) { return text_cell(place_of(row).problem); }},
          {"series", [](const Row &row) { return text_cell(place_of(row).series); }}};
      std::move(others.begin(), others.end(), std::back_inserter(columns));
      return columns;
    }

    /// For tables with several rows of a run, or none: where it is, and more.
    Table with_place(const std::vector<Column> &others)
    {
      Table table;
      table.columns = {"method", "case", "series", "h [length]", "horizon [length]"};
      table.columns.insert(table.columns.end(), others.begin(), others.end());
      return table;
    }
    void add_row(Table &table, const Record &run, const std::vector<Cell> &others)
    {
      table.rows.push_back({text_cell(run.key.method), text_cell(run.key.problem),
                            text_cell(run.key.series), number_cell(run.key.h),
                            number_cell(run.key.horizon)});
      table.rows.back().insert(table.rows.back().end(), others.begin(), others.end());
      table.rows.back().resize(table.columns.size(), empty_cell());
    }

    std::string joined(const std::vector<std::string> &list, const std::string &separator)
    {
      std::string text;
      for (const std::string &item : list)
        text += (text.empty() ? "" : separator) + item;
      return text;
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
    std::vector<Trend> decisive;
    for (const MethodName &method : methods(results))
      for (const Case &one : cases(results))
        if (const Trend *trend = decisive_trend(results, method.name, one))
          decisive.push_back(*trend);
    Table table = table_of(
        decisive,
        of_case<Trend>({{{"rate", {"rate", "rate uncertainty"}}, fitted_rate},
                        {{"plateau", {"plateau", "plateau uncertainty"}}, fitted_plateau},
                        {"verdict", [](const Trend &t) { return text_cell(verdict_words(t)); }},
                        {"reason", [](const Trend &t) { return text_cell(t.reason); }}}));
    table.caption = "Verdicts on the error " + error_words(results.decisive_error) +
                    ": fitted rate, and plateau a of e = a + b x^p";
    return table;
  }

  Table cost_table(const study::StudyResults &results)
  {
    const auto timed = [](double (*value)(const Record &))
    {
      return [=](const Record &run)
      { return known(run.cost.seconds() > 0, number_cell(value(run))); };
    };
    Table table = table_of(
        results,
        of_case<Record>(
            {{"h", [](const Record &run) { return number_cell(run.key.h); }},
             {"unknowns", [](const Record &run) { return count_cell(run.cost.n_unknowns); }},
             {"bonds", [](const Record &run) { return count_cell(run.cost.n_bonds); }},
             {"geometry CPU s", timed(study::geometry_seconds)},
             {"setup CPU s", timed([](const Record &run) { return run.cost.setup_seconds; })},
             {"solve CPU s", timed([](const Record &run) { return run.cost.solve_seconds; })},
             {"peak MB", timed([](const Record &run)
                               { return 1e-6 * static_cast<double>(run.cost.peak_bytes); })},
             {"iterations", [](const Record &run) { return count_cell(run.cost.n_iterations); }}}),
        [](const Record &run) { return run.failure.empty(); });
    table.caption = "Cost of each run; CPU seconds are summed over threads";
    return table;
  }

  Table other_errors_table(const study::StudyResults &results)
  {
    std::vector<Trend> others;
    std::copy_if(results.trends.begin(), results.trends.end(), std::back_inserter(others),
                 [&](const Trend &trend) { return trend.error != results.decisive_error; });
    return table_of(
        others,
        of_case<Trend>({{"error", [](const Trend &t) { return text_cell(error_words(t.error)); }},
                        {"finest value", [](const Trend &t)
                         { return error_cell(t.values.empty() ? NAN : t.values.back()); }},
                        {"rate", fitted_rate},
                        {"verdict", [](const Trend &t) { return text_cell(verdict_words(t)); }}}));
  }

  Table estimate_table(const std::vector<study::ErrorEstimate> &estimates)
  {
    using Estimate = study::ErrorEstimate;
    std::vector<Estimate> asked; // of others there is none
    std::copy_if(estimates.begin(), estimates.end(), std::back_inserter(asked),
                 [](const Estimate &e) { return e.estimate > 0; });
    Table table = table_of(
        asked,
        of_case<Estimate>(
            {{"level", [](const Estimate &e) { return count_cell(e.level); }},
             {"h", [](const Estimate &e) { return number_cell(e.h); }},
             {"δ", [](const Estimate &e) { return number_cell(e.horizon); }},
             {"change with h", [](const Estimate &e) { return error_cell(e.h_change); }},
             {"before", [](const Estimate &e) { return error_cell(e.coarse_change); }},
             {"rate", [](const Estimate &e) { return number_cell(e.rate); }},
             {"change to p + 1", [](const Estimate &e) { return error_cell(e.p_change); }},
             {"outer quadrature", [](const Estimate &e) { return error_cell(e.outer_change); }},
             {"estimate, averages", [](const Estimate &e) { return error_cell(e.estimate); }},
             {"certified digits", [](const Estimate &e) { return count_cell(e.certified_digits); }},
             {"estimate, field", [](const Estimate &e) { return error_cell(e.field_estimate); }},
             {"domain", [](const Estimate &e)
              { return text_cell(e.is_of_polygon ? "the polygon alone" : "as described"); }}}));
    table.caption = "Error estimates";
    return table;
  }

  Table doubtful_differences(const study::StudyResults &results)
  {
    Table table;
    table.columns = {"method",     "problem", "series",   "level",
                     "difference", "value",   "estimate", "value / estimate"};
    for (const study::ErrorEstimate &estimate : results.references)
      for (const Record &run : results.records)
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
      for (const Record &run : results.records)
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
      table.rows.push_back({text_cell(method.name),
                            text_cell(base::word(method.family)),
                            {{span(fewest, most)}, span(fewest, most), true},
                            number_cell(ratio),
                            count_cell(n_negative),
                            error_cell(residual),
                            text_cell(joined(backends, ", ")),
                            text_cell(joined(notes, "; "))});
    }
    return table;
  }

  Table tip_force_table(const study::StudyResults &results)
  {
    Table table = with_place({"tip x", "tip y", "F [force]", "F / sqrt(horizon)", "sum of norms"});
    for (const Record &run : results.records)
      for (const method::TipForce &one : study::tip_forces_of(run))
        add_row(table, run,
                {number_cell(one.tip[0]), number_cell(one.tip[1]), error_cell(one.norm),
                 error_cell(one.over_root), error_cell(one.sum_of_norms)});
    return table;
  }

  Table bound_table(const study::StudyResults &results)
  {
    Table table = with_place({"error", "‖A⁻¹‖", "bound", "nodal error", "error / bound"});
    for (const Record &run : results.records)
      for (const auto &[name, bound] : study::errors_of(run))
        if (study::is_bound(name))
        {
          const std::string nodal = "nodal" + name.substr(name.find(' '));
          const bool is_largest = study::norm_of_one(name, 4) == 1;
          const bool is_known = run.has(nodal),
                     is_round_off = !(bound > study::round_off_of(run, name));
          add_row(table, run,
                  {text_cell(error_words(nodal)),
                   number_cell(is_largest ? run["inverse norm"] : 1 / run["smallest eigenvalue"]),
                   error_cell(bound), known(is_known, error_cell(run[nodal])),
                   known(is_known && !is_round_off, number_cell(run[nodal] / bound))});
        }
    return table;
  }

  Table energy_table(const study::StudyResults &results)
  {
    Table table =
        with_place({"target", "energy", "energy of the target", "energy / energy of the target - 1",
                    "error in the energy norm", "relative"});
    for (const Record &run : results.records)
    {
      if (!run.has("energy"))
        continue;
      bool has_target = false;
      for (const std::string target : {"exact", "local"})
      {
        const std::string of_target = "energy of " + target, name = "energy | " + target;
        if (!run.has(of_target))
          continue;
        has_target = true;
        const double size = study::size_of(run, name);
        add_row(table, run,
                {text_cell(target), number_cell(run["energy"]), number_cell(run[of_target]),
                 known(run[of_target] != 0, error_cell(run["energy"] / run[of_target] - 1)),
                 run.has(name) ? error_cell(run[name]) : text_cell("none: not positive definite"),
                 known(run.has(name) && size > 0, error_cell(run[name] / size))});
      }
      if (!has_target)
        add_row(table, run, {text_cell(""), number_cell(run["energy"])});
    }
    return table;
  }

  Table saving_table(const study::StudyResults &results)
  {
    using study::Saving;
    return table_of(
        results.savings,
        std::vector<ColumnOf<Saving>>{
            {"method", [](const Saving &s) { return text_cell(s.method); }},
            {"h [length]", [](const Saving &s) { return number_cell(s.h); }},
            {"CPU time",
             [](const Saving &s) { return text_cell(rounded_seconds(s.smallest.seconds())); }},
            {"full", [](const Saving &s) { return text_cell(rounded_seconds(s.full.seconds())); }},
            {"times", [](const Saving &s)
             { return text_cell(rounded(s.full.seconds() / s.smallest.seconds())); }},
            {"pairs summed", [](const Saving &s) { return count_cell(s.smallest.n_bonds); }},
            {"full", [](const Saving &s) { return count_cell(s.full.n_bonds); }},
            {"largest difference", [](const Saving &s) { return error_cell(s.difference); }}});
  }

  Table failure_table(const study::StudyResults &results)
  {
    const bool varies = !results.variable.empty();
    return table_of(
        results,
        of_case<Record>({{"level", [](const Record &run) { return count_cell(run.key.level); }},
                         {"h", [](const Record &run) { return number_cell(run.key.h); }},
                         {"δ", [](const Record &run) { return number_cell(run.key.horizon); }},
                         {results.variable, [=](const Record &run)
                          { return known(varies, number_cell(run.key.value)); }},
                         {"why", [](const Record &run) { return text_cell(run.failure); }}}),
        [](const Record &run) { return !run.failure.empty(); });
  }
} // namespace plumbline::report
