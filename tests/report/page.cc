#include "report/page.h"

#include "base/error.h"
#include "report/page_parts.h"
#include "report/report.h"
#include "tests/report/fixture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <set>

namespace plumbline::report
{
  namespace
  {
    bool holds(const std::string &text, const std::string &part)
    {
      return text.find(part) != std::string::npos;
    }

    std::string page_of(const study::Results &results)
    {
      const fixture::Folder folder;
      write_report(results, folder.path());
      return fixture::read(folder.path() / "report.html");
    }
  } // namespace

  TEST(ReportPage, GivesEachVerdictInWordsWithErrorAndRate)
  {
    const study::Results results = fixture::results();
    const std::string html = page_of(results);
    std::size_t n_converge = 0;
    for (const study::Trend &trend : results.trends)
      n_converge += trend.outcome == study::Outcome::converges ? 1 : 0;
    EXPECT_EQ(fixture::count(html, "<b>✓ AC</b>"), n_converge);
    EXPECT_EQ(fixture::count(html, "<b>✗ not AC</b>"), results.trends.size() - n_converge);
    EXPECT_TRUE(holds(html, "<b>✓ AC</b><small>3.633e-5</small><small>rate 2.00</small>"));
    EXPECT_LT(html.find("Which method?"), html.find("<h2>Verdicts"));
    EXPECT_LT(html.find("<h2>Verdicts"), html.find("<h2>Work and precision"));
    EXPECT_LT(html.find("<h2>Work and precision"), html.find("<h2>Convergence"));
  }

  TEST(ReportPage, HasAllItsParts)
  {
    const std::string html = page_of(fixture::results());
    for (const char *part :
         {"Which quadrature rules stay right as the horizon δ", "Take IPA-AC recalibrated",
          "✗ does not hold", "family of node 17 is singular",
          "one stencil &lt;serves&gt; all nodes", "differences are less than ten times",
          "cut cells in", "kernel clipped at &lt;0&gt;", "deal.II 9.4.1, FFTW 3.3.10",
          "Cost of each run", "case_2 δ"})
      EXPECT_TRUE(holds(html, part)) << part;
    EXPECT_EQ(fixture::count(html, "role=\"img\""), 17u);
    EXPECT_EQ(fixture::count(html, "<section"), fixture::count(html, "</section>"));
    EXPECT_EQ(fixture::count(html, "<details"), fixture::count(html, "</details>"));
    EXPECT_EQ(fixture::count(html, "<svg"), fixture::count(html, "</svg>"));
  }

  TEST(ReportPage, NeedsNothingFromOutside)
  {
    std::string html = page_of(fixture::results());
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

  TEST(ReportPage, CallsRoundingByItsName)
  {
    study::Results results = fixture::results();
    study::Trend &trend = results.trends.back();
    trend.values = {1e-13, 2e-13, 0};
    trend.rates = {-1, 1e9};
    EXPECT_TRUE(holds(page_of(results), "<b>✓ AC</b><small>0</small><small>round-off</small>"));
    trend.values = {1e-3, 2e-3, 0};
    trend.rates = {-1, -INFINITY};
    EXPECT_TRUE(holds(page_of(results), "<b>✓ AC</b><small>0</small></td>"));
  }

  TEST(ReportPage, DoesNotTrustAReferenceWithoutEstimate)
  {
    study::Results results = fixture::results();
    for (study::ReferenceEstimate &estimate : results.references)
      estimate.h_change = estimate.p_change = estimate.estimate = 0;
    EXPECT_TRUE(holds(page_of(results), "nothing says how far the reference can be trusted"));
  }

  TEST(ReportPage, SaysThatARunIsNotComplete)
  {
    study::Results results = fixture::results();
    EXPECT_FALSE(holds(page_of(results), "This run is not complete"));
    results.is_complete = false;
    EXPECT_TRUE(holds(page_of(results), "This run is not complete"));
    EXPECT_TRUE(holds(page_of(study::Results()), "No run has been finished yet"));
  }

  TEST(ReportPage, StandsWithoutChartsAndNamesWhatIsMissing)
  {
    const fixture::Folder folder;
    const std::string path = std::getenv("PATH");
    setenv("PATH", folder.path().c_str(), 1);
    EXPECT_THROW(write_report(fixture::results(), folder.path()), NumericalError);
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
