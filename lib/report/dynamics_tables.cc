#include "report/dynamics_tables.h"

#include "report/text_table.h"
#include "study/reference_estimate.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumbline::report
{
  using study::DynamicResults;
  using study::MotionRun;
  using study::MotionTrend;

  const char *const motion_rates_words =
      "At the final time, with the shortest step of each scheme: nodal errors of the displacement "
      "u and of its rate v. rate: slope over the last three levels. What is left of errors in time "
      "is in them; a plateau may be theirs. proven: of rules, from h^γ/ε² for data in C^(0,γ) "
      "(Jha & Lipton 2018, doi:10.1137/17M1112236, Theorems 3 and 4); none where the horizon "
      "falls, "
      "too. Smooth data show more by rules that are AC.";

  const char *const orders_words =
      "At the finest level: errors of u against the motion of the same lattice that is exact in "
      "time (Runge-Kutta of high order with steps of its own, to 1e-12), so that errors in space "
      "have no part in them. order: slope over all steps.";

  const char *const motions_words =
      "critical: the longest stable step of the scheme, 2/√λ of the largest eigenvalue at rest for "
      "velocity Verlet; none for implicit schemes and Runge-Kutta. forces: evaluations of all "
      "bonds, "
      "tangents among them. energy: what the balance of stored, dissipated and supplied energy is "
      "off by, over the largest of them. CPU: what the steps took, and what was prepared once for "
      "all schemes and steps (bonds, mass, loads in time).";

  const char *const motion_estimates_words =
      "How far Galerkin motions may be off at the final time, of u, L2 over nodes, by the method's "
      "own means: a bound in practice, no theorem. space: 3/2 of the larger of Richardson's "
      "estimate from h/2 and 2 h and of the change to degree p + 1, at the nodes that both have; "
      "quadrature: change to forces with a Gauss point more a side; both exact in time. time: from "
      "the same equation exact in time. digits: that their sum leaves of how far u varies.";

  const char *const best_pairs_words =
      "Of all runs, preparation and steps together: no other is as accurate and cheaper. Runs that "
      "a shorter step makes worse by a tenth or more are left out: in these errors in space and in "
      "time happen to cancel.";

  const char *const torus_words =
      "The torus without a mesh (trigonometric polynomials, Gauss points in the ball, Runge-Kutta "
      "to 1e-12). change: of u, from 2/3 of the points a side.";

  double decisive_error(const DynamicResults &results, const MotionRun &run)
  {
    const auto found = run.errors.find(results.decisive_error);
    return found == run.errors.end() ? std::numeric_limits<double>::quiet_NaN() : found->second;
  }

  namespace
  {
    Cell finite(double value, const Cell &cell)
    {
      return known(std::isfinite(value), cell);
    }

    /// Columns that say which motion, where there are several.
    void add_names(std::vector<Cell> &row, const std::string &method, const std::string &problem,
                   const std::string &series)
    {
      row = {text_cell(method), text_cell(problem), text_cell(series)};
    }

    /// Without a column of names that are all the same.
    Table without_sameness(Table table, const std::vector<std::string> &heads)
    {
      for (std::size_t c = table.columns.size(); c-- > 0;)
      {
        if (std::find(heads.begin(), heads.end(), table.columns[c].head) == heads.end() ||
            table.rows.empty())
          continue;
        const bool is_same =
            std::all_of(table.rows.begin(), table.rows.end(),
                        [&](const auto &row) { return row[c].text == table.rows[0][c].text; });
        if (!is_same)
          continue;
        table.columns.erase(table.columns.begin() + static_cast<std::ptrdiff_t>(c));
        for (auto &row : table.rows)
          row.erase(row.begin() + static_cast<std::ptrdiff_t>(c));
      }
      return without_empty_columns(table);
    }

    /// How the column of a study's variable is called; of results without one it is all 0.
    std::string variable_head(const DynamicResults &results)
    {
      return results.variable.empty() ? "value" : results.variable;
    }

    /// Which one it is: method, case, series, h, horizon, the variable's value, scheme and dt.
    std::vector<Cell> cells_of(const MotionRun &run)
    {
      std::vector<Cell> row;
      add_names(row, run.method, run.problem, run.series);
      for (const Cell &cell : {number_cell(run.h), number_cell(run.horizon), number_cell(run.value),
                               text_cell(run.scheme), number_cell(run.step)})
        row.push_back(cell);
      return row;
    }

    const std::vector<std::string> names = {"case", "series", "scheme", "step"};
  } // namespace

  Table motion_rates_table(const DynamicResults &results)
  {
    Table table;
    table.columns = {"method", "case",        "series",     "scheme", "step",
                     "of",     "first error", "last error", "rate",   {"fitted", {"fitted", "±"}},
                     "proven", "verdict",     reasons_head};
    for (const MotionTrend &t : results.trends)
    {
      std::vector<Cell> row;
      add_names(row, t.method, t.problem, t.series);
      const bool has_rate = !t.rates.empty() && std::isfinite(t.rates.back());
      const bool is_fitted = t.x.size() >= 3 && std::isfinite(t.rate);
      row.push_back(text_cell(t.scheme));
      row.push_back(text_cell(t.steps));
      row.push_back(text_cell(t.error.rfind("velocity", 0) == 0 ? "v" : "u"));
      row.push_back(known(!t.values.empty(), error_cell(t.values.empty() ? 0 : t.values.front())));
      row.push_back(known(!t.values.empty(), error_cell(t.values.empty() ? 0 : t.values.back())));
      row.push_back(known(has_rate, rate_cell(has_rate ? t.rates.back() : 0)));
      row.push_back(is_fitted ? uncertain_cell(t.rate, t.rate_uncertainty)
                              : Cell{{"", ""}, "", true});
      row.push_back(text_cell(t.proven));
      row.push_back(text_cell(t.verdict));
      row.push_back(text_cell(t.reason));
      table.rows.push_back(row);
    }
    return without_sameness(table, names);
  }

  Table orders_table(const DynamicResults &results)
  {
    Table table;
    table.columns = {"method",       "case",       "series",
                     "scheme",       "longest dt", "shortest dt",
                     "first error",  "last error", {"order", {"order", "±"}},
                     "of the scheme"};
    for (const MotionTrend &t : results.orders)
    {
      std::vector<Cell> row;
      add_names(row, t.method, t.problem, t.series);
      row.push_back(text_cell(t.scheme));
      row.push_back(number_cell(t.x.front()));
      row.push_back(number_cell(t.x.back()));
      row.push_back(error_cell(t.values.front()));
      row.push_back(error_cell(t.values.back()));
      row.push_back(t.verdict.empty() ? Cell{{"", ""}, "", true}
                                      : uncertain_cell(t.rate, t.rate_uncertainty));
      row.push_back(count_cell(static_cast<std::uint64_t>(analysis::scheme(t.scheme).order)));
      table.rows.push_back(row);
    }
    return without_sameness(table, {"case", "series"});
  }

  Table motions_table(const DynamicResults &results)
  {
    Table table;
    table.columns = {"method",        "case",
                     "series",        "h",
                     "horizon",       variable_head(results),
                     "scheme",        "dt",
                     "critical",      "dt over critical",
                     "steps",         "forces",
                     "error",         "velocity error",
                     "error in time", "own estimate",
                     "energy",        "steps' CPU [s]",
                     "setup CPU [s]"};
    for (const MotionRun &run : results.runs)
    {
      if (!run.failure.empty())
        continue;
      const auto error = [&](const std::string &name)
      {
        const auto found = run.errors.find(name);
        return found == run.errors.end() ? empty_cell() : error_cell(found->second);
      };
      const bool has_critical = std::isfinite(run.critical_step) && run.critical_step > 0;
      std::vector<Cell> row = cells_of(run);
      const std::vector<Cell> rest = {
          known(has_critical, number_cell(run.critical_step)),
          known(has_critical, number_cell(run.step / run.critical_step)),
          count_cell(run.counts.n_steps),
          count_cell(run.counts.n_accelerations + run.counts.n_tangents),
          error(results.decisive_error),
          error("velocity " + results.decisive_error),
          error("nodal L2 | time"),
          run.estimate ? error_cell(run.estimate->sum()) : empty_cell(),
          error_cell(run.imbalance),
          number_cell(run.cost.solve_seconds),
          number_cell(run.cost.setup_seconds)};
      row.insert(row.end(), rest.begin(), rest.end());
      table.rows.push_back(row);
    }
    return without_sameness(table, {"case", "series", "horizon", variable_head(results)});
  }

  Table motion_estimates_table(const DynamicResults &results)
  {
    Table table;
    table.columns = {
        "method", "case",       "series", "h",   "horizon", variable_head(results), "scheme", "dt",
        "space",  "quadrature", "time",   "sum", "error",   "digits of u"};
    for (const MotionRun &run : results.runs)
    {
      if (!run.estimate || !run.failure.empty())
        continue;
      const double error = decisive_error(results, run);
      std::vector<Cell> row = cells_of(run);
      const std::vector<Cell> rest = {
          error_cell(run.estimate->space),
          error_cell(run.estimate->quadrature),
          error_cell(run.estimate->time),
          error_cell(run.estimate->sum()),
          known(std::isfinite(error), error_cell(error)),
          count_cell(study::certified_digits(run.estimate->sum(), run.size))};
      row.insert(row.end(), rest.begin(), rest.end());
      table.rows.push_back(row);
    }
    return without_sameness(table, {"case", "series", "horizon", variable_head(results), "scheme"});
  }

  namespace
  {
    /// A shorter step makes its error larger.
    bool is_flattered(const DynamicResults &results, const MotionRun &run)
    {
      constexpr double significant = 1.1;
      return std::any_of(results.runs.begin(), results.runs.end(),
                         [&](const MotionRun &other)
                         {
                           return other.method == run.method && other.problem == run.problem &&
                                  other.series == run.series && other.level == run.level &&
                                  other.scheme == run.scheme && other.step < run.step &&
                                  decisive_error(results, other) >
                                      significant * decisive_error(results, run);
                         });
    }
  } // namespace

  std::vector<const MotionRun *> best_runs(const DynamicResults &results)
  {
    if (!results.variable.empty())
      return {}; // they are of several problems
    std::vector<const MotionRun *> runs, best;
    for (const MotionRun &run : results.runs)
      if (const double error = decisive_error(results, run);
          error > 0 && run.cost.seconds() > 0 && !is_flattered(results, run))
        runs.push_back(&run);
    std::sort(runs.begin(), runs.end(),
              [](const MotionRun *a, const MotionRun *b)
              { return a->cost.seconds() < b->cost.seconds(); });
    double least = std::numeric_limits<double>::infinity();
    for (const MotionRun *run : runs)
      if (const double error = decisive_error(results, *run); error < least)
      {
        best.push_back(run);
        least = error;
      }
    return best;
  }

  Table best_pairs_table(const DynamicResults &results)
  {
    Table table;
    table.columns = {"error", "method", "case", "series", "h", "scheme", "dt", "CPU [s]"};
    for (const MotionRun *run : best_runs(results))
      table.rows.push_back({error_cell(decisive_error(results, *run)), text_cell(run->method),
                            text_cell(run->problem), text_cell(run->series), number_cell(run->h),
                            text_cell(run->scheme), number_cell(run->step),
                            number_cell(run->cost.seconds())});
    return without_sameness(table, {"case", "series"});
  }

  Table motion_facts_table(const DynamicResults &results)
  {
    Table table;
    table.columns = {"what", "value"};
    for (const auto &[what, value] : results.facts)
      table.rows.push_back({text_cell(what), text_cell(value)});
    std::vector<std::string> known;
    for (const MotionRun &run : results.runs)
      for (const auto &[what, value] : run.facts)
      {
        const std::string subject =
            run.method + ", " + run.series + ", h = " + rounded(run.h) + ": " + what;
        if (std::find(known.begin(), known.end(), subject) != known.end())
          continue;
        known.push_back(subject);
        table.rows.push_back({text_cell(subject), number_cell(value)});
      }
    return table;
  }

  Table torus_table(const DynamicResults &results)
  {
    Table table;
    table.columns = {"case",          "horizon", variable_head(results),
                     "points a side", "change",  "CPU [s]"};
    for (const study::TorusEstimate &one : results.references)
      table.rows.push_back({text_cell(one.problem), number_cell(one.horizon),
                            number_cell(one.value), count_cell(one.n_points),
                            error_cell(one.estimate), number_cell(one.seconds)});
    return without_sameness(table, {variable_head(results)});
  }

  Table motion_warnings_table(const DynamicResults &results)
  {
    Table table;
    table.columns = {"warning"};
    for (const std::string &warning : results.warnings)
      table.rows.push_back({text_cell(warning)});
    return table;
  }

  Table motion_omissions_table(const DynamicResults &results)
  {
    Table table;
    table.columns = {"left out", "because", "saves"};
    for (const study::Omission &one : results.omissions)
      table.rows.push_back({text_cell(one.what), text_cell(one.why), text_cell(one.saving)});
    return table;
  }

  Table motion_expectations_table(const DynamicResults &results)
  {
    Table table;
    table.columns = {"subject", "expected", "found", "holds"};
    for (const study::Expectation &one : results.expectations)
      table.rows.push_back({text_cell(one.subject), text_cell(one.expected), text_cell(one.found),
                            text_cell(one.holds ? "yes" : "no")});
    return table;
  }

  Table failed_motions_table(const DynamicResults &results)
  {
    Table table;
    table.columns = {"method", "series", "h", "scheme", "step", "critical", "what became of it"};
    for (const MotionRun &run : results.runs)
      if (!run.failure.empty())
        table.rows.push_back({text_cell(run.method), text_cell(run.series), number_cell(run.h),
                              text_cell(run.scheme), text_cell(run.steps),
                              finite(run.critical_step, number_cell(run.critical_step)),
                              text_cell(run.failure)});
    return table;
  }
} // namespace plumbline::report
