#include "report/statics_view.h"

#include "base/error.h"
#include "report/page_parts.h"
#include "report/tables.h"
#include "study/trend.h"
#include "tests/report/fixture.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdlib>
#include <regex>
#include <set>

namespace plumbline::report
{
  namespace
  {
    bool holds(const std::string &text, const std::string &part)
    {
      return text.find(part) != std::string::npos;
    }

    /// Blanks and line breaks, which say nothing, are one blank.
    std::string page_of(const study::StudyResults &results)
    {
      const fixture::Folder folder;
      write_study(statics_view(results), results, folder.path());
      std::string html;
      for (const char c : fixture::read(folder.path() / "report.html"))
        if (const char next = c == '\n' ? ' ' : c;
            next != ' ' || html.empty() || html.back() != ' ')
          html += next;
      return html;
    }
  } // namespace

  TEST(ReportPage, GivesEachVerdictInWordsWithErrorAndRate)
  {
    const study::StudyResults results = fixture::results();
    const std::string html = page_of(results);
    std::size_t n_converge = 0;
    for (const study::Trend &trend : results.trends)
      n_converge += trend.outcome == study::Outcome::converges ? 1 : 0;
    EXPECT_EQ(fixture::count(html, "<b>✓ AC</b>"), n_converge);
    EXPECT_EQ(fixture::count(html, "<b>✗ not AC</b>"), results.trends.size() - n_converge);
    EXPECT_TRUE(holds(html, "<b>✓ AC</b><small>3.633e-5</small><small>rate 2.00</small>"));
    EXPECT_LT(html.find("Which method?"), html.find("<h2>Verdicts"));
    EXPECT_LT(html.find("Which method?"), html.find("<b>Warning:</b>"));
    EXPECT_TRUE(holds(html, "<b>Warning:</b>"));
    EXPECT_LT(html.find("<h2>Verdicts"), html.find("<h2>Work and precision"));
    EXPECT_LT(html.find("<h2>Work and precision"), html.find("<h2>Convergence"));
  }

  // every colour of a page but those of charts is a variable, which a dark screen has its own of
  TEST(ReportPage, IsReadableOnDarkAndOnNarrowScreens)
  {
    const std::string html = page_of(fixture::results());
    const std::string style = html.substr(0, html.find("</style>"));
    const std::size_t dark = style.find("@media screen and (prefers-color-scheme: dark)");
    ASSERT_NE(dark, std::string::npos);
    const std::regex definition("(--[a-z-]+): ");
    for (std::sregex_iterator one(style.begin(), style.end(), definition), end; one != end; ++one)
      EXPECT_NE(style.find((*one)[1].str() + ": ", dark), std::string::npos) << (*one)[1];
    EXPECT_TRUE(holds(style, "scroll the picture sideways"));
    EXPECT_TRUE(holds(style, "no-repeat local")); // covers of the shadows beside tables
    // black lines of charts, and of markers beside them, are light there
    const std::string inverted = style.substr(style.find("figure:has(> .chart-data) svg", dark));
    for (const char *const what : {".marker,", ".interactive canvas,", "filter: invert("})
      EXPECT_TRUE(holds(inverted.substr(0, inverted.find('}')), what)) << what;
  }

  TEST(ReportPage, HasAllItsParts)
  {
    const std::string html = page_of(fixture::results());
    for (const char *part :
         {"Which quadrature rules stay right as the horizon δ", "✗ stalls: FA, IPA-AC, P0",
          "✗ does not hold", "family of node 17 is singular",
          "one stencil &lt;serves&gt; all nodes", "differences are less than ten times",
          "cut cells in", "kernel clipped at &lt;0&gt;", "deal.II 9.4.1, FFTW 3.3.10",
          "Cost of each run", "case_2 δ", "Left out by the budget (1)",
          "h = 0.00625: some 77 CPU s", "Measured: the coarsest level by the full model"})
      EXPECT_TRUE(holds(html, part)) << part;
    EXPECT_EQ(fixture::count(html, "role=\"img\""), 22u);
    EXPECT_EQ(fixture::count(html, "<section"), fixture::count(html, "</section>"));
    study::StudyResults trusted = fixture::results();
    trusted.references.clear();
    EXPECT_FALSE(holds(page_of(trusted), "differences are less than"));
    EXPECT_EQ(fixture::count(html, "<details"), fixture::count(html, "</details>"));
    EXPECT_EQ(fixture::count(html, "<svg"), fixture::count(html, "</svg>"));
  }

  TEST(ReportPage, AnswersWhichMethodInOneSentenceAndACardForEachCase)
  {
    study::StudyResults results = fixture::results();
    results.advice[0].choices = {{1e-2, "Q1", .1, 3e-5, 5.1e-4},
                                 {1e-4, "Q1", .1, 3e-5, 5.1e-4},
                                 {1e-6, "Q1", .025, 4e-7, 3.21}};
    results.advice[1].choices.clear();
    results.advice[1].stalling.clear();
    std::string html = page_of(results);
    EXPECT_TRUE(holds(html, "<b>✓ Converge everywhere: IPA-AC recalibrated, Q1.</b> <b "
                            "class=\"no\">✗ Stall everywhere, however fine the mesh: FA, IPA-AC, "
                            "P0.</b> </p>"));
    // Targets that the same run serves share a row; another mesh size is another run.
    EXPECT_TRUE(holds(html, "<td>relative error ≤ 1e-2 … 1e-4</td>"));
    EXPECT_TRUE(holds(html, "<b>Q1</b></td><td>h = 0.1</td><td title=\"its error is 3.000e-5 in "
                            "the unit of the solution\">0.51 "
                            "ms</td>"));
    EXPECT_TRUE(holds(html, "<td>relative error ≤ 1e-6</td>"));
    EXPECT_TRUE(holds(html, "<td>h = 0.025</td><td title=\"its error is 4.000e-7 in the unit of "
                            "the solution\">3.2 s</td>"));
    EXPECT_EQ(fixture::count(html, "No converging method is accurate enough yet"), 1u);
    EXPECT_EQ(fixture::count(html, "✗ stalls: "), 3u);

    for (study::Trend &trend : results.trends)
    {
      if (trend.method == "P0" && trend.series == "m = 4")
        trend.outcome = study::Outcome::converges;
      if (trend.method == "IPA-AC")
        trend.outcome = study::Outcome::undecided;
      if (trend.method == "Q1")
        trend.outcome = study::Outcome::failed;
    }
    html = page_of(results);
    EXPECT_TRUE(holds(html, "everywhere: IPA-AC recalibrated.</b>"));
    EXPECT_TRUE(holds(html, "✗ Stall everywhere, however fine the mesh: FA.</b>"));
    EXPECT_TRUE(holds(html, "✗ Stall in some cases: P0 (2 of 4).</b>"));
    EXPECT_TRUE(holds(html, "No solution at some level: Q1."));
    EXPECT_TRUE(holds(html, "one finer level would help: IPA-AC."));
    for (study::Trend &trend : results.trends)
      trend.outcome = study::Outcome::stalls;
    html = page_of(results);
    EXPECT_TRUE(holds(html, "<b>No method converges in all 4 cases.</b>"));
    EXPECT_TRUE(holds(html, "No method of this run is known to converge."));
  }

  TEST(ReportPage, NamesTiesWarningsAndWhatIsInNoCost)
  {
    study::StudyResults results = fixture::results();
    results.advice[0].choices = {{1e-2, "Q1", .1, 3e-5, 5.1e-4, {"A<B", "FA"}},
                                 {1e-4, "Q1", .1, 3e-5, 5.1e-4}};
    std::string html = page_of(results);
    EXPECT_TRUE(holds(html, "<b>Q1</b><small>a tie with A&lt;B, FA</small></td>"));
    EXPECT_FALSE(
        holds(html, "<td>relative error ≤ 1e-2 … 1e-4</td>")); // another answer, so another row
    EXPECT_TRUE(holds(html, "<b>Warning:</b> solution &amp; load contradict each other."));
    EXPECT_FALSE(holds(html, "Not in it, since methods share it")); // nothing was made
    results.warnings.clear();
    results.records.front().set("geometry seconds", 2.5); // FA
    results.records.back().set("geometry seconds", 1.5);  // Q1
    html = page_of(results);
    EXPECT_FALSE(holds(html, "<b>Warning:</b>"));
    EXPECT_TRUE(holds(html, "the mesh of Galerkin methods, up to 1.5 s a level; mesh and cells of "
                            "meshfree nodes, up to 2.5 s a level of CPU time."));
  }

  // weights of another code have no cost to be advised by
  TEST(ReportPage, AnswersWithoutAdvice)
  {
    study::StudyResults results = fixture::results();
    const std::string answer = "✗ Stall everywhere, however fine the mesh: FA, IPA-AC, P0.";
    EXPECT_TRUE(holds(page_of(results), answer));
    results.advice.clear();
    std::string html = page_of(results);
    EXPECT_TRUE(holds(html, answer));
    EXPECT_FALSE(holds(html, "The cheapest run"));
    EXPECT_FALSE(holds(html, "class=\"card\""));
    results.trends.clear();
    EXPECT_FALSE(holds(page_of(results), "Which method?"));
  }

  TEST(ReportPage, HasColumnsOfNumbersAtTheRight)
  {
    Table table;
    table.columns = {"quantity", "value", "meaning"};
    table.rows = {{text_cell("events"), number_cell(2), text_cell("in all")},
                  {text_cell("connected"), text_cell("yes"), text_cell("at the end")}};
    const auto data = page::table(table);
    EXPECT_EQ(data["rows"][1]["cells"][0]["is_number"], false);
    EXPECT_EQ(data["rows"][1]["cells"][1]["is_number"], true);
    EXPECT_EQ(data["rows"][1]["cells"][2]["is_number"], false);
  }

  TEST(ReportPage, RanksByTheLargestErrorWhereNothingIsRefined)
  {
    study::StudyResults results = fixture::results();
    results.regime = scene::Regime::horizon;
    for (study::Record &run : results.records)
      run.set(results.decisive_error, run.key.method == "Q1" ? 1e-4 : 2e-3);
    results.records.front().set(results.decisive_error, 3e-2); // of FA
    const std::string html = page_of(results);
    EXPECT_TRUE(holds(html, "the best method first: Q1 (1.000e-4), IPA-AC (2.000e-3), IPA-AC "
                            "recalibrated (2.000e-3), P0 (2.000e-3), FA (3.000e-2).</b>"));
    EXPECT_FALSE(holds(html, "Converge everywhere"));
    EXPECT_FALSE(holds(html, "✗ stalls: "));
  }

  TEST(ReportPage, AdvisesNothingByDifferencesToAMethodsOwnFinestLevel)
  {
    study::StudyResults results = fixture::results();
    const std::string own = "averages L2 | own finest level";
    for (study::Trend &trend : results.trends)
      if (trend.error == results.decisive_error)
        trend.error = own;
    results.decisive_error = own;
    const std::string html = page_of(results);
    EXPECT_TRUE(holds(html, "<b>✓ Have a limit everywhere: IPA-AC recalibrated, Q1.</b>"));
    EXPECT_TRUE(holds(html, "none is advised"));
    EXPECT_TRUE(holds(html, "whether it has a limit, not which"));
    for (const char *part : {"✓ Converge", "The cheapest run", "class=\"card\"", "decides"})
      EXPECT_FALSE(holds(html, part)) << part;
  }

  TEST(ReportPage, FoldsTheCardsAfterTheSixth)
  {
    EXPECT_FALSE(holds(page_of(fixture::results()), "more cases"));
    const std::string html =
        page_of(fixture::make({"a", "b", "c", "d"}, {3, 4}, fixture::models(), 2));
    EXPECT_EQ(fixture::count(html, "<div class=\"card\">"), 8u);
    const std::string open = html.substr(0, html.find("2 more cases"));
    EXPECT_EQ(fixture::count(open, "<div class=\"card\">"), 6u);
  }

  TEST(ReportPage, ShowsTheExpectationsThatDoNotHoldAndFoldsTheOthers)
  {
    study::StudyResults results = fixture::results();
    std::string html = page_of(results);
    const std::size_t head = html.find("1 of 2 hold; these do not:");
    ASSERT_NE(head, std::string::npos);
    const std::size_t fold = html.find("<details><summary>✓ Those that hold", head);
    const std::size_t bad = html.find("✗ does not hold", head), good = html.find("✓ holds", head);
    EXPECT_LT(bad, fold);
    EXPECT_GT(good, fold);
    for (study::Expectation &one : results.expectations)
      one.holds = true;
    html = page_of(results);
    EXPECT_TRUE(holds(html, "<h2>What the scene expects</h2> <details><summary>✓ 2 of 2 hold<"));
    for (study::Expectation &one : results.expectations)
      one.holds = false;
    html = page_of(results);
    EXPECT_TRUE(holds(html, "0 of 2 hold; these do not:"));
    EXPECT_FALSE(holds(html, "Those that hold"));
  }

  TEST(ReportPage, ShowsTheErrorMapsAfterTheConvergenceCharts)
  {
    study::StudyResults results = fixture::results();
    const std::string html = page_of(results);
    const std::size_t head = html.find("<h2>Where the error sits");
    EXPECT_LT(html.find("<h2>Convergence"), head);
    EXPECT_TRUE(holds(html, "href=\"#maps\""));
    const std::size_t image = html.find("<image style='image-rendering:pixelated'", head);
    ASSERT_NE(image, std::string::npos);
    EXPECT_LT(image, html.find("</section>", head));
    EXPECT_FALSE(holds(html, "<h2>The solution"));
    results.maps.front().solution = results.maps.front().values;
    const std::string with_solution = page_of(results);
    const std::size_t solution = with_solution.find("<h2>The solution");
    ASSERT_NE(solution, std::string::npos);
    EXPECT_LT(solution, with_solution.find("<h2>Where the error sits"));
    EXPECT_LT(with_solution.find("<image", solution), with_solution.find("</section>", solution));
    EXPECT_TRUE(holds(with_solution, "href=\"#solution\""));
    results.maps.clear();
    EXPECT_FALSE(holds(page_of(results), "#maps"));
    EXPECT_FALSE(holds(page_of(results), "Where the error sits"));
  }

  TEST(ReportPage, NeedsNothingFromOutside)
  {
    const std::string page = page_of(fixture::results());
    for (const char *part : {"<script src", "@import", "<link"})
      EXPECT_FALSE(holds(page, part)) << part;
    // besides dygraphs, which names its licence, and the data of charts
    std::string html = page.substr(0, page.rfind("<style>"));
    const std::string data = "<script type=\"application/json\"";
    for (std::size_t at = html.find(data); at != std::string::npos; at = html.find(data))
      html.erase(at, data.size());
    for (const char *part : {"http:", "https:", "src=", "@import", "<link", "<script", "url(\"",
                             "xlink:", "<?xml", "<!DOCTYPE svg"})
      EXPECT_FALSE(holds(html, part)) << part;
    EXPECT_TRUE(holds(html, "&lt;script&gt;alert(1)&lt;/script&gt; &amp; &quot;quoted&quot;"));
  }

  TEST(ReportPage, HasNoIdTwice)
  {
    const std::string html = page_of(fixture::results());
    std::set<std::string> ids;
    for (const char quote : {'"', '\''})
    {
      const std::string mark = std::string(" id=") + quote;
      for (std::size_t at = html.find(mark); at != std::string::npos; at = html.find(mark, at + 1))
      {
        const std::size_t begin = at + mark.size();
        const std::string id = html.substr(begin, html.find(quote, begin) - begin);
        EXPECT_TRUE(ids.insert(id).second) << id;
      }
    }
    EXPECT_TRUE(ids.count("verdicts") == 1);
  }

  TEST(ReportPage, SaysWhatIsRightForThisFieldOnlyAndWhatIsNotDecidedYet)
  {
    study::StudyResults results = fixture::results();
    for (study::Trend &trend : results.trends)
    {
      trend.outcome = study::Outcome::field_only;
      trend.verdict = "AC for this field only";
      trend.proof.answer = study::LimitProof::Answer::incompatible;
      trend.proof.defect = .0472;
    }
    results.advice[0].field_only = {"FA"};
    const auto n = std::to_string(results.trends.size());
    std::string html = page_of(results);
    EXPECT_TRUE(holds(html, "<b>No method converges in all 4 cases.</b>"));
    EXPECT_TRUE(holds(html, "Right for this field only, their second moments are wrong: FA"));
    EXPECT_TRUE(holds(html, "✗ right for this field only: FA"));
    EXPECT_TRUE(holds(html, "<li>✗ " + n + " for this field only</li>"));
    EXPECT_EQ(fixture::count(html, "moments off by 4.72 %"), results.trends.size());
    for (study::Trend &trend : results.trends)
    {
      trend.outcome = study::Outcome::undecided;
      trend.proof = {};
      trend.x.resize(2);
      trend.values.resize(2);
      trend.rates.resize(1);
    }
    html = page_of(results);
    EXPECT_TRUE(
        holds(html, "Not decided yet in all 4 cases, 2 of the 4 levels that a verdict needs: "));
    EXPECT_EQ(fixture::count(html, "Not decided"), 1u);
    EXPECT_FALSE(holds(html, "No method of this run is known to converge")); // said above
    EXPECT_FALSE(holds(html, "No method converges"));
    EXPECT_FALSE(holds(html, "one finer level would help:"));
  }

  TEST(ReportPage, CallsRoundingByItsName)
  {
    study::StudyResults results = fixture::results();
    study::Trend &trend = results.trends.back();
    trend.round_off = 1e-12;
    trend.values = {1e-13, 2e-13, 0};
    trend.rates = {-1, 1e9};
    EXPECT_TRUE(holds(page_of(results), "<b>✓ AC</b><small>0</small><small>round-off</small>"));
    trend.values = {1e-3, 2e-3, 1e-13};
    trend.rates = {-1, 34};
    EXPECT_TRUE(holds(page_of(results), "<b>✓ AC</b><small>1.000e-13</small></td>"));
    trend.values = {1e-3, 2e-3, 0};
    trend.rates = {-1, -INFINITY};
    EXPECT_TRUE(holds(page_of(results), "<b>✓ AC</b><small>0</small></td>"));
  }

  TEST(ReportPage, CallsRoundingWhatTheStudyCallsRounding)
  {
    for (const double factor : {.99, 1.01})
    {
      study::Trend trend;
      trend.x = {.8, .4, .2, .1};
      trend.size = 3;
      trend.round_off = 3e-10;
      trend.values = std::vector<double>(4, factor * trend.round_off);
      study::judge(trend);
      EXPECT_EQ(holds(trend.reason, "exact to round-off"), factor < 1) << trend.reason;
    }
  }

  TEST(ReportPage, DoesNotTrustAReferenceWithoutEstimate)
  {
    study::StudyResults results = fixture::results();
    for (study::ErrorEstimate &estimate : results.references)
      estimate.h_change = estimate.p_change = estimate.estimate = 0;
    EXPECT_TRUE(holds(page_of(results), "nothing says how far the reference can be trusted"));
  }

  TEST(ReportPage, SaysWhichEstimatesHoldForThePolygonAlone)
  {
    study::StudyResults results = fixture::results();
    EXPECT_TRUE(holds(page_of(results), "a bound in practice, no theorem: in audits of"));
    EXPECT_FALSE(holds(page_of(results), "the polygon alone"));
    results.references.at(0).is_of_polygon = true;
    EXPECT_TRUE(holds(page_of(results), "the polygon alone"));
    EXPECT_TRUE(holds(page_of(results), "the error of that, of order h², is not in them"));
    results.estimates = results.references;
    EXPECT_FALSE(holds(page_of(results), "&lt;code")); // tags are no text
    results.references.clear();
    EXPECT_TRUE(holds(page_of(results), "the error of that, of order h², is not in them"));
    EXPECT_FALSE(holds(page_of(results), "&lt;code"));
    const fixture::Folder folder;
    write_study(statics_view(results), results, folder.path());
    const std::string table = fixture::read(folder.path() / "tables" / "estimates.csv");
    EXPECT_TRUE(holds(table, "the polygon alone"));
    EXPECT_TRUE(holds(table, "as described"));
  }

  TEST(ReportPage, SaysThatARunIsNotComplete)
  {
    study::StudyResults results = fixture::results();
    EXPECT_FALSE(holds(page_of(results), "This run is not complete"));
    results.is_complete = false;
    EXPECT_TRUE(holds(page_of(results), "This run is not complete"));
    EXPECT_TRUE(holds(page_of(study::StudyResults()), "No run has been finished yet"));
  }

  TEST(ReportPage, StandsWithoutChartsAndNamesWhatIsMissing)
  {
    const fixture::Folder folder;
    const std::string path = std::getenv("PATH");
    setenv("PATH", folder.path().c_str(), 1);
    const auto write = [&]
    { write_study(statics_view(fixture::results()), fixture::results(), folder.path()); };
    EXPECT_THROW(write(), NumericalError);
    setenv("PATH", path.c_str(), 1);
    const std::string html = fixture::read(folder.path() / "report.html");
    EXPECT_TRUE(holds(html, "<b>✗ not AC</b>"));
    EXPECT_TRUE(holds(html, "install gnuplot-nox"));
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "results.json"));
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "tables" / "verdicts.csv"));
  }

  TEST(ReportPage, TakesASvgWithoutItsPrologue)
  {
    const std::string svg = "<?xml version=\"1.0\"?>\n<svg viewBox=\"0 0 8 5\" xmlns=\"x\">"
                            "<title>Gnuplot</title><desc>d</desc><rect id='a'/>"
                            "<use xlink:href='#a'/></svg>";
    EXPECT_EQ(page::inline_svg(svg, "c1-", "a < b"),
              "<svg viewBox=\"0 0 8 5\" role=\"img\" aria-label=\"a &lt; b\"><rect id='c1-a'/>"
              "<use href='#c1-a'/></svg>");
  }
} // namespace plumbline::report
