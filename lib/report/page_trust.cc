#include "report/formats.h"
#include "report/page_parts.h"
#include "report/tables.h"

#include <algorithm>
#include <array>
#include <cstdint>

// What a reader can rely on: the reference's own error, what was left out of the model, what the
// scene expects.
namespace plumbline::report::page
{
  namespace
  {
    constexpr const char *meaning_of_estimates =
        "Each solution is held against those of half h (or of twice and four times h, where that "
        "is "
        "much cheaper) and of one more degree. Richardson’s extrapolation by the rate, the "
        "smallest "
        "of the method’s, the domain’s and what is observed, times a safety factor of 3/2 (of 2 "
        "where h is doubled), or 3/2 of the change to p + 1 if that is larger, and the last change "
        "by outer quadrature make the estimate of the error (L2) of the cell averages and of the "
        "field. It is a bound in practice, no theorem: in audits of shipped scenes with a known "
        "solution, and of loads without one against much finer solutions "
        "(<code>benchmarks/estimates</code>), no error was above it. The digits that it leaves "
        "certain are those of the cell averages.";
    constexpr const char *about_polygons =
        " <b>Where the domain is “the polygon alone”, the mesh cannot be made anew at another h: "
        "estimates and digits hold for the polygon that its cells fill. If that stands for a "
        "curved "
        "domain, the error of that, of order h², is not in them</b>; a .geo file or a generator "
        "would bring it in.";

    std::string explanation(const std::vector<study::ErrorEstimate> &estimates,
                            const std::string &end = "")
    {
      const bool has_polygon =
          std::any_of(estimates.begin(), estimates.end(),
                      [](const study::ErrorEstimate &e) { return e.is_of_polygon; });
      return "<p>" + std::string(meaning_of_estimates) + (has_polygon ? about_polygons : "") + end +
             "</p>\n";
    }
  } // namespace

  std::string reference(const study::Results &results)
  {
    if (results.references.empty() && results.estimates.empty())
      return section("reference", "The reference’s own error",
                     paragraph("No estimate: errors here are against an exact solution, or the "
                               "scene did not ask for one."));
    const std::string others =
        results.estimates.empty()
            ? ""
            : paragraph("The same for other Galerkin solutions:") +
                  folded("Estimates (" + std::to_string(results.estimates.size()) + " solutions)",
                         to_html(estimate_table(results.estimates)),
                         results.estimates.size() <= 12);
    if (results.references.empty())
      return section("reference", "The solutions’ own error estimates",
                     explanation(results.estimates) + others);
    const Table doubtful = doubtful_differences(results);
    std::string text = explanation(
        results.references, " Digits are not certified where outer quadrature was not refined.");
    text += folded("Estimates (" + std::to_string(results.references.size()) + " levels)",
                   to_html(estimate_table(results.references)), results.references.size() <= 12) +
            others;
    const bool is_estimated =
        std::any_of(results.references.begin(), results.references.end(),
                    [](const study::ErrorEstimate &e) { return e.estimate > 0; });
    if (doubtful.rows.empty())
      return section("reference", "The reference’s own error",
                     text + paragraph(is_estimated
                                          ? "Every difference from the reference is at least ten "
                                            "times its estimate."
                                          : "The scene did not ask for the estimates, so nothing "
                                            "says how far the reference can be trusted."));
    text += "<div class=\"warning\"><b>⚠ " + std::to_string(doubtful.rows.size()) +
            " differences are less than ten times the reference’s own estimate.</b> They may be "
            "the reference’s error as much as the method’s: refine the reference, or read them as "
            "“equal to the reference”.</div>\n" +
            folded("Which differences", to_html(doubtful), doubtful.rows.size() <= 12);
    return section("reference", "The reference’s own error", text);
  }

  std::string model(const study::Results &results)
  {
    std::uint64_t n_checks = 0;
    std::size_t n_runs = 0;
    double worst = 0;
    for (const study::Run &run : results.runs)
      if (run.diagnostics.n_geometry_checks > 0)
      {
        n_checks += run.diagnostics.n_geometry_checks;
        worst = std::max(worst, run.diagnostics.geometry_difference);
        ++n_runs;
      }
    for (const study::ErrorEstimate &reference : results.references)
      if (reference.n_geometry_checks > 0)
      {
        n_checks += reference.n_geometry_checks;
        worst = std::max(worst, reference.geometry_difference);
        ++n_runs;
      }
    std::string text;
    if (results.omissions.empty())
      text = paragraph("Nothing that the scene asks for was left out.");
    else
    {
      Table table;
      table.columns = {"left out", "because", "saves"};
      for (const study::Omission &omission : results.omissions)
        table.rows.push_back(
            {text_cell(omission.what), text_cell(omission.why), text_cell(omission.saving)});
      text = to_html(table);
    }
    if (!results.savings.empty())
      text += paragraph("Measured: the coarsest level by the full model, too, which leaves out "
                        "nothing (a mesh and a sparse matrix where a stencil would do, the "
                        "dilatation even where it is zero).") +
              to_html(saving_table(results));
    text += paragraph(n_checks == 0 ? "Geometry: no cut cell was recomputed with the exact backend."
                                    : "Geometry: " + std::to_string(n_checks) + " cut cells in " +
                                          std::to_string(n_runs) +
                                          " runs were recomputed with exact geometry; the worst "
                                          "difference is " +
                                          rounded(worst) + " of a cell.");
    return section("model", "What was modelled, and what was left out", text);
  }

  std::string expectations(const study::Results &results)
  {
    if (results.expectations.empty())
      return "";
    std::array<std::string, 2> rows; // of those that do not hold, and of those that do
    std::size_t n_hold = 0;
    for (const study::Expectation &one : results.expectations)
    {
      n_hold += one.holds ? 1 : 0;
      rows[one.holds ? 1 : 0] +=
          std::string("<tr><td class=\"") + (one.holds ? "yes\">✓ holds" : "no\">✗ does not hold") +
          "</td><td>" + escape_html(one.subject) + "</td><td>" + escape_html(one.expected) +
          "</td><td>" + escape_html(one.found) + "</td></tr>\n";
    }
    const auto table = [](const std::string &body)
    {
      return "<div class=\"wide\"><table>\n<thead><tr><th></th><th>subject</th><th>expected</th>"
             "<th>found</th></tr></thead>\n<tbody>\n" +
             body + "</tbody></table></div>\n";
    };
    const std::string words =
        std::to_string(n_hold) + " of " + std::to_string(results.expectations.size()) + " hold";
    std::string text;
    if (!rows[0].empty())
      text = "<p class=\"no\">✗ " + words + "; these do not:</p>\n" + table(rows[0]);
    if (!rows[1].empty())
      text += folded(rows[0].empty() ? "✓ " + words : "✓ Those that hold", table(rows[1]));
    return section("expectations", "What the scene expects", text);
  }
} // namespace plumbline::report::page
