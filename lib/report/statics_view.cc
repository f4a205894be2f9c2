#include "report/statics_view.h"

#include "base/number_text.h"
#include "report/counted.h"
#include "report/tables.h"
#include "scene/choices.h"
#include "study/model_facts.h"
#include "study/solution_record.h"
#include "study/target_words.h"
#include "study/trend.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace plumbline::report
{
  namespace
  {
    using study::Outcome;
    using study::Trend;

    std::string regime_words(const StudyResults &results)
    {
      const scene::Regime regime = results.regime;
      if (study::is_against(results.decisive_error, scene::Target::finest))
        return std::string(regime == scene::Regime::m ? "m-convergence: δ is fixed and h → 0"
                           : regime == scene::Regime::delta ? "m = δ/h is fixed and δ → 0"
                                                            : "δ → 0 and m = δ/h → ∞ together") +
               "; each method is compared with its own finest level, which tells whether it has "
               "a limit, not which";
      if (regime == scene::Regime::variable)
        return "h and δ are fixed and " + results.variable + " varies: how errors depend on it";
      static const std::array<const char *, 4> texts = {
          "m-convergence: the horizon δ is fixed and h → 0, towards the nonlocal solution",
          "δ-convergence: m = δ/h is fixed and δ → 0, towards the local limit; this decides "
          "asymptotic compatibility (AC)",
          "δm-convergence: δ → 0 and m = δ/h → ∞ together",
          "h is fixed and the horizon δ varies: how errors depend on the horizon"};
      return texts[static_cast<std::size_t>(regime)];
    }

    /// Both of the last two errors.
    bool is_round_off(const Trend &trend)
    {
      const std::size_t n = trend.values.size();
      return n > 0 &&
             std::max(trend.values[n - 1], trend.values[n < 2 ? 0 : n - 2]) < trend.round_off;
    }

    /// What is known apart from the field, where it says the same as the verdict.
    bool is_proven(const Trend &trend)
    {
      using Answer = study::LimitProof::Answer;
      const Answer answer = trend.proof.answer;
      if (trend.proof.area_defect > 0) // seen from level to level
        return false;
      return (trend.outcome == Outcome::converges && answer == Answer::compatible) ||
             (trend.outcome == Outcome::stalls && answer == Answer::incompatible);
    }

    /// Why there is this verdict: in short where a proof stands beside the errors.
    std::string reason_of(const Trend &trend)
    {
      constexpr int n_digits = 3;
      const bool is_open = trend.outcome == Outcome::undecided;
      if (trend.outcome == Outcome::failed || trend.values.empty() ||
          (trend.proof.reason.empty() && !is_open) ||
          (is_open && trend.reason.find("last error") != std::string::npos))
        return trend.reason;
      std::string text = "last error " + base::to_text(trend.values.back(), n_digits);
      if (trend.values.back() <= trend.round_off)
        text += " (round-off)";
      else if (const double rate = study::last_rate(trend); std::isfinite(rate))
        text += ", rate " + base::to_text(rate, n_digits);
      return text + "; " + (is_open ? trend.reason : trend.proof.reason);
    }

    Cell verdict_cell(const Trend *trend)
    {
      static const std::array<const char *, 5> looks = {"converges", "stalls", "undecided",
                                                        "failed", "stalls"};
      Cell cell = text_cell("not run");
      cell.look = "absent";
      if (trend == nullptr)
        return cell;
      cell = text_cell(outcome_symbol(trend->outcome) + " " + verdict_words(*trend));
      cell.look = looks[static_cast<std::size_t>(trend->outcome)];
      cell.is_strong = true;
      cell.hint = trend->reason;
      if (!trend->values.empty())
        cell.notes.push_back(rounded_error(trend->values.back()));
      if (is_round_off(*trend))
        cell.notes.emplace_back("round-off");
      if (const double rate = study::last_rate(*trend); std::isfinite(rate))
      {
        std::array<char, 32> text{};
        std::snprintf(text.data(), text.size(), "rate %.2f", rate);
        cell.notes.emplace_back(text.data());
      }
      if (is_proven(*trend))
        cell.notes.emplace_back("proven");
      else if (trend->proof.has_wrong_moments())
        cell.notes.push_back("moments off by " + rounded(100 * trend->proof.defect) + " %");
      return cell;
    }

    /// Cases with those of one problem side by side.
    std::vector<Case> by_problem(const std::vector<Case> &all)
    {
      std::vector<Case> columns;
      for (const Case &one : all)
        if (std::none_of(columns.begin(), columns.end(),
                         [&](const Case &c) { return c.problem == one.problem; }))
          std::copy_if(all.begin(), all.end(), std::back_inserter(columns),
                       [&](const Case &other) { return other.problem == one.problem; });
      return columns;
    }

    /// A row for each method, rules first; columns: problems, and below each its series.
    Table verdict_matrix(const StudyResults &results)
    {
      const std::vector<Case> columns = by_problem(cases(results));
      Table table;
      table.columns = {"method"};
      for (const Case &one : columns)
      {
        table.columns.emplace_back(one.series);
        table.columns.back().group = one.problem;
      }
      const std::vector<MethodName> styles = methods(results);
      std::vector<MethodName> names = styles;
      std::stable_partition(names.begin(), names.end(),
                            [](const MethodName &m) { return !m.is_reference(); });
      for (const MethodName &method : names)
      {
        auto &row = table.rows.emplace_back();
        row.push_back(text_cell(method.name));
        row.back().marker = page::marker(style_of(styles, method.name));
        for (const Case &one : columns)
          row.push_back(verdict_cell(decisive_trend(results, method.name, one)));
      }
      return table;
    }

    /// The numbers below the page's title.
    std::vector<std::string> facts(const StudyResults &results)
    {
      const auto n = [&](Outcome outcome)
      {
        return std::count_if(results.trends.begin(), results.trends.end(),
                             [&](const Trend &trend) {
                               return trend.error == results.decisive_error &&
                                      trend.outcome == outcome;
                             });
      };
      std::vector<std::string> all = {counted(methods(results).size(), "method"),
                                      counted(results.records.size(), "run")};
      for (const auto &[outcome, words] : {std::pair(Outcome::converges, "converge"),
                                           {Outcome::stalls, "stall"},
                                           {Outcome::undecided, "undecided"},
                                           {Outcome::failed, "failed"},
                                           {Outcome::field_only, "for this field only"}})
        if (outcome != Outcome::field_only || n(outcome) > 0)
          all.push_back(outcome_symbol(outcome) + " " + std::to_string(n(outcome)) + " " + words);
      return all;
    }

    /// A table below the part before it, in a file of its id.
    Part folded(const std::string &id, const std::string &head, const Table &table,
                const std::string &lead = {}, Fold fold = Fold::closed)
    {
      Part part{id, head, "", table, true, fold, lead};
      part.file = id;
      return part;
    }

    /// Open if it is short.
    Fold by_length(const Table &table)
    {
      constexpr std::size_t most_rows = 12;
      return table.rows.size() <= most_rows ? Fold::open : Fold::closed;
    }

    std::vector<Part> numbers(const StudyResults &results)
    {
      std::vector<Part> parts = {
          {"numbers", "Tables",
           "Nodal errors: at each method’s own nodes, which count alike in L2, √(area · mean e²). "
           "Averages: of the solution over the comparison cells, each by its area. In the "
           "volume-constrained layer every space takes the constraint at its nodes (DGQ0 and DGP0 "
           "at cell centres, as one-point rules do), not its averages."}};
      for (const Case &one : cases(results))
      {
        const Table errors = error_table(results, one);
        parts.push_back(folded("errors_" + one.slug, errors.caption, errors, "",
                               parts.size() == 1 ? Fold::open : Fold::closed));
      }
      parts.push_back(folded("verdicts",
                             "Fitted rates and plateaus, with the reason of each verdict",
                             trend_table(results)));
      parts.push_back(folded("other-errors", "Other errors", other_errors_table(results)));
      parts.push_back(folded("cost", "Cost of each run", cost_table(results)));
      parts.back().words =
          "CPU seconds are summed over threads. Geometry, the mesh and for meshfree "
          "methods the cells of nodes, is in no cost.";
      return parts;
    }

    std::string estimate_words(const std::vector<study::ErrorEstimate> &estimates,
                               bool has_reference)
    {
      std::string words =
          "Each solution is held against those of half h (or of twice and four times h, where that "
          "is much cheaper) and of one more degree. Richardson’s extrapolation by the rate, the "
          "smallest of the method’s, the domain’s and what is observed, times a safety factor of "
          "3/2 (of 2 where h is doubled), or 3/2 of the change to p + 1 if that is larger, and the "
          "last change by outer quadrature make the estimate of the error (L2) of the cell "
          "averages and of the field. It is a bound in practice, no theorem: in audits of shipped "
          "scenes with a known solution, and of loads without one against much finer solutions "
          "(benchmarks/estimates), no error was above it. The digits that it leaves certain are "
          "those of the cell averages.";
      if (std::any_of(estimates.begin(), estimates.end(),
                      [](const study::ErrorEstimate &e) { return e.is_of_polygon; }))
        words += " Where the domain is “the polygon alone”, the mesh cannot be made anew at "
                 "another h: estimates and digits hold for the polygon that its cells fill. If "
                 "that stands for a curved domain, the error of that, of order h², is not in them; "
                 "a .geo file or a generator would bring it in.";
      if (std::any_of(estimates.begin(), estimates.end(),
                      [](const study::ErrorEstimate &e) { return std::isnan(e.field_estimate); }))
        words += " In three dimensions the estimate is that of the cell averages alone, from half "
                 "and twice h; these problems are not in the audits.";
      if (has_reference)
        words += " Digits are not certified where outer quadrature was not refined.";
      return words;
    }

    /// The reference's own estimates, and the differences that are too small for them.
    std::vector<Part> reference(const StudyResults &results)
    {
      const bool has_reference = !results.references.empty();
      std::vector<study::ErrorEstimate> all = results.references;
      all.insert(all.end(), results.estimates.begin(), results.estimates.end());
      const Table doubtful = has_reference ? doubtful_differences(results) : Table(),
                  estimates = estimate_table(all);
      const bool is_estimated =
          std::any_of(results.references.begin(), results.references.end(),
                      [](const study::ErrorEstimate &e) { return e.estimate > 0; });
      Part head{"reference",
                has_reference || all.empty() ? "The reference’s own error"
                                             : "The solutions’ own error estimates",
                "",
                {},
                true};
      head.lead = all.empty() ? "No estimate: errors here are against an exact solution, or the "
                                "scene did not ask for one."
                              : estimate_words(all, has_reference);
      if (has_reference && doubtful.rows.empty())
        head.words = is_estimated ? "Every difference from the reference is at least ten times its "
                                    "estimate."
                                  : "The scene did not ask for the estimates, so nothing says how "
                                    "far the reference can be trusted.";
      std::vector<Part> parts = {
          head, folded("estimates",
                       "Estimates (" + counted(estimates.rows.size(), "solution") + ")", estimates,
                       has_reference && !results.estimates.empty()
                           ? "Of the reference, " + results.references.front().method +
                                 ", and of the other Galerkin solutions."
                           : "",
                       by_length(estimates))};
      if (const std::size_t n = doubtful.rows.size(); n > 0)
      {
        parts.push_back(folded("doubtful",
                               "⚠ " + std::to_string(n) +
                                   " differences are less than ten times the reference’s own "
                                   "estimate",
                               doubtful,
                               "They may be the reference’s error as much as the method’s: refine "
                               "the reference, or read them as “equal to the reference”.",
                               by_length(doubtful)));
        parts.back().is_warning = true;
      }
      return parts;
    }

    /// Cut cells that were recomputed.
    std::string geometry_words(const StudyResults &results)
    {
      std::uint64_t n_checks = 0;
      std::size_t n_runs = 0;
      double worst = 0;
      const auto count = [&](std::size_t n, double difference)
      {
        n_checks += n;
        n_runs += n > 0 ? 1 : 0;
        worst = std::max(worst, difference);
      };
      for (const Record &run : results.records)
        count(run.count("geometry checks"), run["geometry difference"]);
      for (const study::ErrorEstimate &one : results.references)
        count(one.n_geometry_checks, one.geometry_difference);
      return n_checks == 0 ? "Geometry: no cut cell was recomputed with the exact backend."
                           : "Geometry: " + std::to_string(n_checks) + " cut cells in " +
                                 std::to_string(n_runs) +
                                 " runs were recomputed with exact geometry; the worst difference "
                                 "is " +
                                 rounded(worst) + " of a cell.";
    }

    /// What was modelled, and what was left out.
    std::vector<Part> model(const StudyResults &results)
    {
      using study::Omission;
      std::vector<std::pair<std::string, std::string>> constants;
      for (const auto &one : results.facts)
        if (!study::is_of_equation(one.first)) // which is above
          constants.push_back(one);
      using Constant = std::pair<std::string, std::string>;
      const Table omissions =
          table_of(results.omissions,
                   std::vector<ColumnOf<Omission>>{
                       {"left out", [](const Omission &o) { return text_cell(o.what); }},
                       {"because", [](const Omission &o) { return text_cell(o.why); }},
                       {"saves", [](const Omission &o) { return text_cell(o.saving); }}});
      const Table facts =
          table_of(constants,
                   std::vector<ColumnOf<Constant>>{
                       {"constant", [](const Constant &c) { return text_cell(c.first); }},
                       {"value", [](const Constant &c) { return text_cell(c.second); }}});
      Part head{"model", "What was modelled, and what was left out", geometry_words(results),
                omissions, true};
      if (omissions.rows.empty())
      {
        head.table = {};
        head.lead = "Nothing that the scene asks for was left out.";
      }
      return {
          head, folded("constants", "Constants that follow from Material/E", facts, "", Fold::open),
          folded("savings", "Measured savings", saving_table(results),
                 "Measured: the coarsest level by the full model, too, which leaves out nothing "
                 "(a mesh and a sparse matrix where a stencil would do, the dilatation even "
                 "where it is zero).",
                 Fold::open)};
    }

    std::vector<Part> diagnostics(const StudyResults &results)
    {
      return {
          {"diagnostics", "Diagnostics", "", diagnostics_table(results), true},
          folded("bounds", "Consistency and stability: bounds on the nodal error",
                 bound_table(results),
                 "Linf: the largest truncation error times ‖A⁻¹‖∞; L2: the L2 norm of the "
                 "truncation error divided by the smallest eigenvalue of the symmetric part of A. "
                 "Error / bound shows how sharp the bound is. It can exceed 1 in Linf if A is not "
                 "an M-matrix, because ‖A⁻¹‖∞ is then estimated from below. This ratio is left out "
                 "where the bound is at round-off level."),
          folded("energies", "Energies", energy_table(results),
                 "Energy: ½ a(u, u) of the solution with the method’s own bilinear form a, and of "
                 "the target at the method’s nodes. Parts that depend on the constraint alone are "
                 "left out, see the schema. Error in the energy norm: √a(e, e) of the nodal error "
                 "e; relative to √(2 energy)."),
          folded(
              "tip_forces", "Net force of the surface terms about crack tips",
              tip_force_table(results),
              "F is the sum of the surface forces on nodes whose nearest point of the crack is "
              "within two horizons of the tip. Where F / √horizon is constant over the levels, the "
              "error tends to √horizon; where F is rounding, the surface terms are in balance.")};
    }

    /// What the terminal shows: verdicts with their reasons in short.
    Part brief(const StudyResults &results)
    {
      Part part{"verdicts",
                results.decisive_error + " (compared with " + study::target_words(results) + ")",
                "",
                {}};
      part.table.columns = {"method", "problem", "series", "verdict", "reason"};
      for (const Trend &trend : results.trends)
        if (trend.error == results.decisive_error)
          part.table.rows.push_back({text_cell(trend.method), text_cell(trend.problem),
                                     text_cell(trend.series), text_cell(trend.verdict),
                                     text_cell(reason_of(trend))});
      return part;
    }
  } // namespace

  View statics_view(const StudyResults &results)
  {
    View view{"Static solutions"};
    view.files = {"report", "results", "tables", "charts"};
    view.redraw = "call plumbline report on this folder";
    view.setting = regime_words(results) + ". Verdicts are based on the error " +
                   error_words(results.decisive_error) + ": methods are compared with " +
                   study::target_words(results) + ".";
    view.facts = facts(results);
    view.verdicts = verdict_matrix(results);
    if (view.verdicts.rows.empty())
      view.answer = "No run has been finished yet.";
    add_advice(results, view);
    view.words =
        results.variable.empty()
            ? "In each cell: the verdict, the error at the finest level, and the rate over the "
              "last two levels. ✓ converges: no plateau, rate at least ¾. ✗ stalls: a significant "
              "plateau that no slow power fits as well, or a growing error; or for this field "
              "only: it converges, but the moments of its weights say that other fields tend to a "
              "wrong limit. ? undecided: one finer level would help, or four levels are not there "
              "yet. – failed: no solution at some level. Proven: what theory says of every smooth "
              "field agrees with what is observed here (second moments of the weights; for "
              "Galerkin spaces Tian & Du 2014, doi:10.1137/130942644)."
            : "In each cell: the largest error over the values of " + results.variable +
                  ", and the one at the last of them. Nothing is refined, so that ? stands where a "
                  "method neither converges nor stalls.";
    view.galleries = statics_galleries(results);
    view.parts = {{"failures", "Levels without a solution", "", failure_table(results), true}};
    for (const auto &parts :
         {numbers(results), reference(results), model(results), diagnostics(results)})
      view.parts.insert(view.parts.end(), parts.begin(), parts.end());
    for (const auto &[what, value] : results.facts)
      if (!study::is_of_equation(what) && what != study::assumption_1_fact) // on the page
        view.constants.push_back(what + ": " + value);
    view.brief = {brief(results)};
    return view;
  }
} // namespace plumbline::report
