#include "report/dynamics_view.h"

#include "base/number_text.h"
#include "report/counted.h"
#include "report/selection.h"
#include "report/text_table.h"
#include "study/reference_estimate.h"
#include "study/transient.h"
#include "study/trend.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace plumbline::report
{
  using study::Trend;

  namespace
  {
    bool has_succeeded(const Record &record)
    {
      return record.failure.empty();
    }

    /// Without columns of these heads that are all the same, and without empty ones.
    Table without_sameness(Table table, const std::vector<std::string> &heads)
    {
      for (std::size_t c = table.columns.size(); c-- > 0 && !table.rows.empty();)
        if (std::find(heads.begin(), heads.end(), table.columns[c].head) != heads.end() &&
            std::all_of(table.rows.begin(), table.rows.end(),
                        [&](const auto &row) { return row[c].text == table.rows[0][c].text; }))
        {
          table.columns.erase(table.columns.begin() + static_cast<std::ptrdiff_t>(c));
          for (auto &row : table.rows)
            row.erase(row.begin() + static_cast<std::ptrdiff_t>(c));
        }
      return without_empty_columns(table);
    }

    /// A row for each record: which one it is, then others.
    Table table_of(const StudyResults &results, const std::vector<RecordColumn> &others,
                   const IsShown &is_shown)
    {
      std::vector<RecordColumn> columns = {
          {"method", [](const Record &r) { return text_cell(r.key.method); }},
          {"case", [](const Record &r) { return text_cell(r.key.problem); }},
          {"series", [](const Record &r) { return text_cell(r.key.series); }},
          {"h", [](const Record &r) { return number_cell(r.key.h); }},
          {"horizon", [](const Record &r) { return number_cell(r.key.horizon); }}};
      if (!results.variable.empty())
        columns.push_back(
            {results.variable, [](const Record &r) { return number_cell(r.key.value); }});
      columns.push_back(text_column("scheme", "scheme"));
      columns.push_back(number_column("dt", "time step"));
      columns.insert(columns.end(), others.begin(), others.end());
      return without_sameness(report::table_of(results, columns, is_shown),
                              {"case", "series", "horizon"});
    }

    Part rates(const StudyResults &results)
    {
      const auto proven = results.facts.find("proven order of rules");
      Table table;
      table.columns = {"method",     "case",   "series",
                       "scheme",     "of",     "first error",
                       "last error", "rate",   {"fitted", {"fitted", "±"}},
                       "proven",     "verdict"};
      for (const Trend &t : results.trends)
      {
        if (t.axis == study::Axis::time_step)
          continue;
        const bool is_fitted = t.x.size() >= 3 && std::isfinite(t.rate),
                   is_proven =
                       proven != results.facts.end() && t.family == study::MethodFamily::meshfree;
        table.rows.push_back(
            {text_cell(t.method), text_cell(t.problem), text_cell(t.series), text_cell(t.variant),
             text_cell(t.error.rfind("velocity", 0) == 0 ? "v" : "u"),
             known(!t.values.empty(), error_cell(t.values.empty() ? 0 : t.values.front())),
             known(!t.values.empty(), error_cell(t.values.empty() ? 0 : t.values.back())),
             rate_cell(study::last_rate(t)),
             is_fitted ? uncertain_cell(t.rate, t.rate_uncertainty)
                       : Cell{{"", ""}, empty_cell().text, true},
             known(is_proven, text_cell(is_proven ? proven->second : "")), text_cell(t.verdict)});
      }
      return {"rates", "Errors and rates over levels",
              "At the final time, with the shortest step of each scheme: nodal errors of the "
              "displacement u and of its rate v. rate: of the last two levels; fitted: slope over "
              "the last three. What is left of errors in time is in them; a plateau may be theirs. "
              "proven: of rules, from h^γ/ε² for data in C^(0,γ) (Jha & Lipton 2018, "
              "doi:10.1137/17M1112236, Theorems 3 and 4); none where the horizon falls, too. "
              "Smooth data show more by rules that are AC.",
              without_sameness(table, {"case", "series", "scheme"})};
    }

    Part reasons(const StudyResults &results)
    {
      Table table;
      table.columns = {"method", "case", "series", "scheme", "of", "verdict", "why"};
      for (const Trend &t : results.trends)
        if (t.axis != study::Axis::time_step)
          table.rows.push_back({text_cell(t.method), text_cell(t.problem), text_cell(t.series),
                                text_cell(t.variant),
                                text_cell(t.error.rfind("velocity", 0) == 0 ? "v" : "u"),
                                text_cell(t.verdict), text_cell(t.reason)});
      return {"reasons", "Reasons of the verdicts", "",
              without_sameness(table, {"case", "series", "scheme"}), true};
    }

    Part orders(const StudyResults &results)
    {
      Table table;
      table.columns = {"method",       "case",       "series",
                       "scheme",       "longest dt", "shortest dt",
                       "first error",  "last error", {"order", {"order", "±"}},
                       "of the scheme"};
      for (const Trend &t : results.trends)
        if (t.axis == study::Axis::time_step)
          table.rows.push_back(
              {text_cell(t.method), text_cell(t.problem), text_cell(t.series), text_cell(t.variant),
               number_cell(t.x.front()), number_cell(t.x.back()), error_cell(t.values.front()),
               error_cell(t.values.back()),
               t.verdict.empty() ? Cell{{"", ""}, empty_cell().text, true}
                                 : uncertain_cell(t.rate, t.rate_uncertainty),
               count_cell(static_cast<std::uint64_t>(analysis::scheme(t.variant).order))});
      return {"orders", "Orders in time",
              "At the finest level: errors of u against the solution of the same semidiscrete "
              "equations that is exact in time (Runge-Kutta of high order with steps of its own, "
              "to 1e-12), so that errors in space have no part in them. order: slope over all "
              "steps.",
              without_sameness(table, {"case", "series"})};
    }

    RecordColumn decisive_column(const StudyResults &results, const std::string &head)
    {
      return {head, [&results](const Record &record)
              {
                const double error = decisive_error(results, record);
                return known(std::isfinite(error), error_cell(error));
              }};
    }

    Part estimates(const StudyResults &results)
    {
      return {"estimates", "Estimated errors of Galerkin methods",
              "Of u at the final time, L2 over nodes: a bound in practice (not proven). space: 3/2 "
              "of the larger of Richardson's estimate from h/2 and 2 h and of the change to degree "
              "p + 1, at the nodes that both have; quadrature: change to forces with a Gauss point "
              "more a side; both exact in time. time: from the same equations exact in time. "
              "digits: that their sum leaves of how far u varies.",
              table_of(results,
                       {error_column("space", "estimated error in space"),
                        error_column("quadrature", "estimated error by quadrature"),
                        error_column("time", "estimated error in time"),
                        error_column("sum", "estimated error"),
                        decisive_column(results, "error"),
                        {"digits of u",
                         [](const Record &record) {
                           return count_cell(study::certified_digits(record["estimated error"],
                                                                     record["extent of u"]));
                         }}},
                       [](const Record &record)
                       { return has_succeeded(record) && record.has("estimated error"); })};
    }

    Part bounds(const StudyResults &results)
    {
      return {
          "bounds", "A priori bounds of errors and energies",
          "From Jha & Lipton 2018, doi:10.1137/17M1112236. error: largest over time, of u and "
          "its rate together, L2 over nodes; bound: its bound, (17) for symplectic Euler and "
          "(52), with the factor 6 of (41), for schemes with θ; empty for other schemes, and "
          "where C̄ is infinite or steps are too long. C_t, C_s: (37) and (38), from the largest "
          "norms along the computed solution. energy and its bound (58): the largest over time. "
          "Proven for FA with exact areas.",
          table_of(results,
                   {text_column("step", "step"), number_column("C_t", "C_t"),
                    number_column("C_s", "C_s"), error_column("error", "largest error over time"),
                    error_column("bound", "error bound"), text_column("by", "error bound of"),
                    number_column("energy", "largest energy"),
                    number_column("bound of energy", "energy bound")},
                   [](const Record &record)
                   { return has_succeeded(record) && record.has("energy bound"); })};
    }

    Part best(const StudyResults &results)
    {
      Table table;
      table.columns = {"error", "method", "case", "series", "h", "scheme", "dt", "CPU [s]"};
      for (const Record *record : best_records(results))
        table.rows.push_back(
            {error_cell(decisive_error(results, *record)), text_cell(record->key.method),
             text_cell(record->key.problem), text_cell(record->key.series),
             number_cell(record->key.h), text_cell(record->text("scheme")),
             number_cell((*record)["time step"]), number_cell(record->cost.seconds())});
      return {"best", "The best pairs of h and time step",
              "Of all runs, preparation and steps together: no other is as accurate and cheaper. "
              "Runs that a shorter step makes worse by a tenth or more are left out: in these "
              "errors in space and in time happen to cancel.",
              without_sameness(table, {"case", "series"})};
    }

    Part runs(const StudyResults &results)
    {
      const auto velocity = [&results](const Record &record)
      { return error_column("", "velocity " + results.decisive_error).cell(record); };
      return {
          "runs", "All runs",
          "critical: the longest stable step of the scheme, 2/√λ of the largest eigenvalue at rest "
          "for velocity Verlet; none for implicit schemes and Runge-Kutta. forces: evaluations of "
          "all bonds, tangents among them. energy: what the balance of stored, dissipated and "
          "supplied energy is off by, over the largest of them. CPU: what the steps took, and what "
          "was prepared once for all schemes and steps (bonds, mass, loads in time).",
          table_of(results,
                   {number_column("critical", "critical step"),
                    {"dt over critical",
                     [](const Record &record)
                     {
                       return known(record["critical step"] > 0,
                                    number_cell(record["time step"] / record["critical step"]));
                     }},
                    count_column("steps", "time steps"),
                    {"forces",
                     [](const Record &record) {
                       return count_cell(record.count("force evaluations") +
                                         record.count("tangents"));
                     }},
                    decisive_column(results, "error"),
                    {"velocity error", velocity},
                    error_column("error in time", study::time_error),
                    error_column("own estimate", "estimated error"),
                    error_column("energy", "energy imbalance"),
                    {"steps' CPU [s]",
                     [](const Record &record) { return number_cell(record.cost.solve_seconds); }},
                    {"setup CPU [s]",
                     [](const Record &record) { return number_cell(record.cost.setup_seconds); }}},
                   has_succeeded),
          true};
    }

    Part failed(const StudyResults &results)
    {
      return {
          "failures", "Runs that did not reach the final time", "",
          table_of(results,
                   {text_column("step", "step"),
                    number_column("critical", "critical step"),
                    {"because", [](const Record &record) { return text_cell(record.failure); }}},
                   [](const Record &record) { return !record.failure.empty(); })};
    }

    /// One row for each reference on a torus, from the first record that has it.
    Part reference(const StudyResults &results)
    {
      Table table;
      table.columns = {
          "case",          "horizon", results.variable.empty() ? "value" : results.variable,
          "points a side", "change",  "CPU [s]"};
      std::set<std::tuple<std::string, double, double>> shown;
      for (const Record &r : results.records)
        if (r.has("reference points") &&
            shown.insert({r.key.problem, r.key.horizon, r.key.value}).second)
          table.rows.push_back({text_cell(r.key.problem), number_cell(r.key.horizon),
                                number_cell(r.key.value), count_cell(r.count("reference points")),
                                error_cell(r["reference change"]),
                                number_cell(r["reference seconds"])});
      return {"reference", "The reference",
              "The torus without a mesh (trigonometric polynomials, Gauss points in the ball, "
              "Runge-Kutta to 1e-12). change: of u, from 2/3 of the points a side.",
              without_sameness(table, {table.columns[2].head}), true};
    }

    /// Constants of the model, and of the methods: scalars that no other table shows.
    Part model(const StudyResults &results)
    {
      static const std::set<std::string> shown = {"time step",
                                                  "critical step",
                                                  "time steps",
                                                  "force evaluations",
                                                  "tangents",
                                                  "Newton iterations",
                                                  "kinetic energy",
                                                  "bond energy",
                                                  "energy imbalance",
                                                  "extent of u",
                                                  "area of the domain",
                                                  "symmetric",
                                                  "reference points",
                                                  "reference change",
                                                  "reference seconds",
                                                  "moment defect",
                                                  "mean moment defect",
                                                  "spread of moments",
                                                  "ball defect",
                                                  "area defect",
                                                  "estimated error",
                                                  "estimated error in space",
                                                  "estimated error by quadrature",
                                                  "estimated error in time",
                                                  "C_t",
                                                  "C_t of (49)",
                                                  "C_s",
                                                  "C of (63)",
                                                  "largest error over time",
                                                  "error bound",
                                                  "largest energy",
                                                  "energy bound"};
      Table table;
      table.columns = {"what", "value"};
      for (const auto &[what, value] : results.facts)
        if (what.rfind(study::left_out_of_model, 0) != 0)
          table.rows.push_back({text_cell(what), text_cell(value)});
      std::set<std::string> known;
      for (const Record &record : results.records)
        for (const auto &[what, scalar] : record.scalars)
        {
          const std::string subject = record.key.method + ", " + record.key.series +
                                      ", h = " + rounded(record.key.h) + ": " + what;
          if (shown.count(what) == 0 && what.find(" | ") == std::string::npos &&
              known.insert(subject).second)
            table.rows.push_back({text_cell(subject), number_cell(scalar.value)});
        }
      return {"model", "The model", "", table, true};
    }

    Part omissions(const StudyResults &results)
    {
      Table table;
      table.columns = {"left out", "because"};
      for (const auto &[what, why] : results.facts)
        if (what.rfind(study::left_out_of_model, 0) == 0)
          table.rows.push_back(
              {text_cell(what.substr(study::left_out_of_model.size())), text_cell(why)});
      return {"omissions", "What was left out of the model", "", table, true};
    }

    /// A shorter step makes its error larger.
    bool is_flattered(const StudyResults &results, const Record &record)
    {
      constexpr double significant = 1.1;
      const auto is_worse = [&](const Record &other)
      {
        return other.key.method == record.key.method && other.key.problem == record.key.problem &&
               other.key.series == record.key.series && other.key.level == record.key.level &&
               other.text("scheme") == record.text("scheme") &&
               other["time step"] < record["time step"] &&
               decisive_error(results, other) > significant * decisive_error(results, record);
      };
      return std::any_of(results.records.begin(), results.records.end(), is_worse);
    }

    /// "Observed order in time (expected): explicit Euler 1.03 (1), ...".
    std::string orders_answer(const StudyResults &results)
    {
      constexpr int n_digits = 3;
      std::string text;
      std::set<std::string> methods, problems, series;
      for (const study::Trend &t : results.trends)
        if (t.axis == study::Axis::time_step)
        {
          methods.insert(t.method);
          problems.insert(t.problem);
          series.insert(t.series);
        }
      for (const study::Trend &t : results.trends)
        if (t.axis == study::Axis::time_step && !t.verdict.empty())
          text += (text.empty() ? "Observed order in time (expected order): " : ", ") +
                  (methods.size() > 1 ? t.method + " with " : "") + t.variant +
                  (problems.size() > 1 ? ", " + t.problem : "") +
                  (series.size() > 1 ? ", " + t.series : "") + " " +
                  base::to_text(t.rate, n_digits) + " (" +
                  std::to_string(analysis::scheme(t.variant).order) + ")";
      return text;
    }
  } // namespace

  std::vector<const Record *> best_records(const StudyResults &results)
  {
    if (!results.variable.empty())
      return {}; // they are of several problems
    std::vector<const Record *> records, best;
    for (const Record &record : results.records)
      if (decisive_error(results, record) > 0 && record.cost.seconds() > 0 &&
          !is_flattered(results, record))
        records.push_back(&record);
    std::sort(records.begin(), records.end(),
              [](const Record *a, const Record *b)
              { return a->cost.seconds() < b->cost.seconds(); });
    double least = std::numeric_limits<double>::infinity();
    for (const Record *record : records)
      if (const double error = decisive_error(results, *record); error < least)
      {
        best.push_back(record);
        least = error;
      }
    return best;
  }

  View dynamics_view(const StudyResults &results)
  {
    View view{"Transient analysis"};
    const auto fact = [&](const std::string &name)
    {
      const auto found = results.facts.find(name);
      return found == results.facts.end() ? "" : found->second;
    };
    view.facts = {counted(results.records.size(), "run"), "T = " + fact("final time T"),
                  "regime " + fact("regime")};
    view.parts = {rates(results),     orders(results), estimates(results), bounds(results),
                  best(results),      failed(results), reasons(results),   runs(results),
                  reference(results), model(results),  omissions(results)};
    view.galleries = {{"charts", "Charts", "", dynamics_charts(results)}};
    if (answer_of(view).empty())
      view.answer = orders_answer(results);
    return view;
  }
} // namespace plumbline::report
