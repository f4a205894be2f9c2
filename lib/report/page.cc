#include "report/page.h"

#include "report/formats.h"
#include "report/page_parts.h"
#include "report/tables.h"
#include "scene/choices.h"
#include "study/trend.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <sstream>
#include <utility>

namespace plumbline::report
{
  namespace page
  {
    namespace
    {
      std::string regime_words(scene::Regime regime, bool is_own_finest)
      {
        if (is_own_finest)
          return std::string(regime == scene::Regime::m ? "m-convergence: δ is fixed and h → 0"
                             : regime == scene::Regime::delta ? "m = δ/h is fixed and δ → 0"
                                                              : "δ → 0 and m = δ/h → ∞ together") +
                 "; each method is held against its own finest level, which tells whether it has a "
                 "limit, not which";
        static const std::array<const char *, 4> texts = {
            "m-convergence: the horizon δ is fixed and h → 0, against the nonlocal solution",
            "δ-convergence: m = δ/h is fixed and δ → 0, against the local limit; this decides "
            "asymptotic compatibility (AC)",
            "δm-convergence: δ → 0 and m = δ/h → ∞ together",
            "h is fixed and the horizon δ varies: how errors depend on the horizon"};
        return texts[static_cast<std::size_t>(regime)];
      }

      std::string outcome_class(study::Outcome outcome)
      {
        static const std::array<const char *, 5> names = {"converges", "stalls", "undecided",
                                                          "failed", "stalls"};
        return names[static_cast<std::size_t>(outcome)];
      }

      /// What is known apart from the field, where it says the same as the verdict or the contrary.
      std::string proof_mark(const study::Trend &trend)
      {
        using Answer = study::LimitProof::Answer;
        const study::LimitProof &proof = trend.proof;
        const bool is_good = trend.outcome == study::Outcome::converges;
        const bool is_bad = trend.outcome == study::Outcome::stalls;
        if ((is_good && proof.answer == Answer::compatible) ||
            (is_bad && proof.answer == Answer::incompatible))
          return "<small>proven</small>";
        if (!proof.has_wrong_moments())
          return "";
        return "<small>moments off by " + rounded(100 * proof.defect) + " %</small>";
      }

      std::string verdict_cell(const study::Trend *trend)
      {
        if (trend == nullptr)
          return "<td class=\"absent\">not run</td>";
        std::string text = "<td class=\"" + outcome_class(trend->outcome) + "\" title=\"" +
                           escape_html(trend->reason) + "\"><b>" + outcome_symbol(trend->outcome) +
                           " " + escape_html(verdict_words(*trend)) + "</b>";
        if (!trend->values.empty())
          text += "<small>" + rounded_error(trend->values.back()) + "</small>";
        // Between errors of the size of rounding a rate is noise.
        const std::size_t n = trend->values.size();
        if (n > 0 &&
            std::max(trend->values[n - 1], trend->values[n < 2 ? 0 : n - 2]) < trend->round_off)
          text += "<small>round-off</small>";
        else if (!trend->rates.empty() && std::isfinite(trend->rates.back()))
        {
          std::ostringstream rate;
          rate.precision(2);
          rate << std::fixed << trend->rates.back();
          text += "<small>rate " + rate.str() + "</small>";
        }
        return text + proof_mark(*trend) + "</td>";
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

      /// Two rows: problems, and below each its series.
      std::string verdict_head(const std::vector<Case> &columns)
      {
        std::string problems = "<tr><th></th>", series = "<tr><th>method</th>";
        for (auto one = columns.begin(); one != columns.end();)
        {
          const auto next = std::find_if(
              one, columns.end(), [&](const Case &other) { return other.problem != one->problem; });
          problems += "<th class=\"problem\" colspan=\"" + std::to_string(next - one) + "\">" +
                      escape_html(one->problem) + "</th>";
          for (; one != next; ++one)
            series += "<th>" + escape_html(one->series) + "</th>";
        }
        return "<thead>" + problems + "</tr>\n" + series + "</tr></thead>\n";
      }

      std::string verdict_matrix(const study::Results &results, const std::vector<Case> &columns)
      {
        std::vector<MethodName> names = methods(results);
        const std::vector<MethodName> styles = names;
        std::stable_partition(names.begin(), names.end(),
                              [](const MethodName &m) { return !m.is_reference(); });
        std::string text = "<div class=\"wide\"><table class=\"verdicts\">\n" +
                           verdict_head(columns) + "<tbody>\n";
        for (const MethodName &method : names)
        {
          text += "<tr><th class=\"method\" scope=\"row\">" +
                  marker(style_of(styles, method.name)) + escape_html(method.name) + "</th>";
          for (const Case &one : columns)
            text += verdict_cell(decisive_trend(results, method.name, one));
          text += "</tr>\n";
        }
        return text + "</tbody></table></div>\n";
      }

      /// What is behind the verdicts, and what has none.
      std::string verdict_details(const study::Results &results)
      {
        std::string text =
            folded("Fitted rates and plateaus, with the reason of each verdict",
                   to_html(verdict_table(results)) +
                       "<p class=\"soft\">Data: <code>tables/verdicts.csv</code></p>\n");
        const Table others = other_errors_table(results);
        if (!others.rows.empty())
          text += folded("Other errors", to_html(others));
        if (!results.left_out.empty())
        {
          std::string list;
          for (const std::string &solve : results.left_out)
            list += "<li>" + escape_html(solve) + "</li>";
          text += folded("Left out by the budget (" + std::to_string(results.left_out.size()) +
                             " solves)",
                         "<ul>" + list + "</ul>\n");
        }
        const Table failures = failure_table(results);
        if (!failures.rows.empty())
          text += folded("Levels without a solution (" + std::to_string(failures.rows.size()) + ")",
                         to_html(failures), true);
        return text;
      }
    } // namespace

    std::string section(const std::string &id, const std::string &head, const std::string &content)
    {
      return "<section id=\"" + id + "\">\n<h2>" + head + "</h2>\n" + content + "</section>\n";
    }

    std::string paragraph(const std::string &text)
    {
      return "<p>" + escape_html(text) + "</p>\n";
    }

    std::string folded(const std::string &summary, const std::string &content, bool is_open)
    {
      return std::string("<details") + (is_open ? " open" : "") + "><summary>" +
             escape_html(summary) + "</summary>\n" + content + "</details>\n";
    }

    std::string header(const study::Results &results)
    {
      std::array<unsigned int, 5> n{};
      for (const study::Trend &trend : results.trends)
        if (trend.error == results.decisive_error)
          ++n[static_cast<std::size_t>(trend.outcome)];
      const auto n_hold = std::count_if(results.expectations.begin(), results.expectations.end(),
                                        [](const study::Expectation &e) { return e.holds; });

      std::string text = "<header>\n<div class=\"brand\">Plumbline report</div>\n<h1>" +
                         escape_html(results.scene_name) + "</h1>\n";
      if (!results.purpose.empty())
        text += "<p class=\"purpose\">" + escape_html(results.purpose) + "</p>\n";
      if (!results.is_complete)
        text += "<p class=\"banner\"><b>This run is not complete.</b> What follows rests on the "
                "levels that are finished; the same command on the same folder goes on from "
                "here.</p>\n";
      for (const std::string &warning : results.warnings)
        text += "<p class=\"banner\"><b>Warning.</b> " + escape_html(warning) + ".</p>\n";
      text += "<p class=\"soft\">" +
              escape_html(regime_words(results.regime, study::is_against(results.decisive_error,
                                                                         scene::Target::finest))) +
              ". Verdicts rest on the error " + escape_html(error_words(results.decisive_error)) +
              ".</p>\n<ul class=\"facts\">\n<li>" + std::to_string(methods(results).size()) +
              " methods</li><li>" + std::to_string(results.runs.size()) + " runs</li><li>✓ " +
              std::to_string(n[0]) + " converge</li><li>✗ " + std::to_string(n[1]) +
              " stall</li><li>? " + std::to_string(n[2]) + " undecided</li><li>– " +
              std::to_string(n[3]) + " failed</li>";
      if (n[4] > 0)
        text += "<li>✗ " + std::to_string(n[4]) + " for this field only</li>";
      if (!results.expectations.empty())
        text += "<li>expected: " + std::to_string(n_hold) + " of " +
                std::to_string(results.expectations.size()) + " hold</li>";
      return text +
             "\n</ul>\n<nav><a href=\"#verdicts\">Verdicts</a><a href=\"#work\">Work and "
             "precision</a><a href=\"#convergence\">Convergence</a>" +
             (results.maps.empty() ? "" : "<a href=\"#maps\">Error maps</a>") +
             "<a href=\"#numbers\">Tables</a><a href=\"#reference\">Reference</a><a "
             "href=\"#model\">Model</a>"
             "<a href=\"#diagnostics\">Diagnostics</a><a href=\"#provenance\">Provenance"
             "</a></nav>\n</header>\n";
    }

    std::string verdicts(const study::Results &results)
    {
      const std::vector<Case> all = cases(results);
      if (all.empty())
        return section("verdicts", "Verdicts", paragraph("No run has been finished yet."));
      const std::string legend =
          "<p class=\"soft\">In each cell: the verdict, the error at the "
          "finest level, and the rate over the last two levels. ✓&nbsp;converges: no plateau, rate "
          "at least ¾. ✗&nbsp;stalls: a significant plateau, or a growing error; or for this field "
          "only: it converges, but second moments say that other fields tend to a wrong limit. "
          "?&nbsp;undecided: one finer level would help, or four levels are not there yet. "
          "–&nbsp;failed: no solution at some level. Proven: what theory says of every smooth "
          "field agrees with what is observed here (second moments of the weights; for Galerkin "
          "spaces "
          "Tian &amp; Du 2014, doi:10.1137/130942644).</p>\n";
      return section("verdicts", "Verdicts",
                     verdict_matrix(results, by_problem(all)) + legend + verdict_details(results));
    }

    std::string numbers(const study::Results &results)
    {
      std::string text;
      bool is_first = true;
      for (const Case &one : cases(results))
      {
        const Table table = error_table(results, one);
        text += folded(table.caption,
                       to_html(table) + "<p class=\"soft\">Data: <code>tables/errors_" +
                           escape_html(one.slug) + ".csv</code></p>\n",
                       is_first);
        is_first = false;
      }
      text +=
          "<p class=\"soft\">Nodal errors: at each method’s own nodes, which count alike in "
          "L2, √(area · mean e²). Averages: of the solution over the comparison cells, each by its "
          "area. In the collar every space takes the constraint at its nodes: DGQ0 and DGP0 at "
          "cell centres, as one-point rules do, not its averages.</p>\n";
      text +=
          folded("Cost of each run",
                 to_html(cost_table(results)) +
                     "<p class=\"soft\">CPU seconds are summed over "
                     "threads. Geometry, the mesh and for meshfree methods "
                     "the cells of nodes, is in no cost. Data: <code>tables/cost.csv</code></p>\n");
      return section("numbers", "Tables", text);
    }

    std::string diagnostics(const study::Results &results)
    {
      const Table table = diagnostics_table(results);
      return section("diagnostics", "Diagnostics",
                     table.rows.empty() ? paragraph("None yet.") : to_html(table));
    }

    std::string provenance(const study::Results &results)
    {
      Table table;
      table.columns = {"what", "value"};
      for (const auto &[key, value] : results.provenance)
        table.rows.push_back({text_cell(key), text_cell(value)});
      return section(
          "provenance", "Provenance",
          folded("Versions, libraries, machine", to_html(table)) +
              folded("The scene as read", "<pre>" + escape_html(results.scene_text) + "</pre>\n") +
              "<p class=\"soft\">All numbers: <code>results.json</code>, unrounded "
              "tables in <code>tables/*.csv</code>, data of each chart beside it in "
              "<code>charts/*.csv</code>.</p>\n");
    }
  } // namespace page

  void write_page(const study::Results &results, const std::filesystem::path &dir)
  {
    const std::string html = page::document(
        results.scene_name, "report", page::header(results),
        page::advice(results) + page::verdicts(results) + page::expectations(results) +
            page::charts(results, dir) + page::numbers(results) + page::reference(results) +
            page::model(results) + page::diagnostics(results) + page::provenance(results));
    write_file(dir / "report.html", html);
  }
} // namespace plumbline::report
