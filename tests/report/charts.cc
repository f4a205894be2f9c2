#include "report/charts.h"

#include "base/error.h"
#include "tests/report/fixture.h"

#include <gtest/gtest.h>

#include <algorithm>
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
  } // namespace

  TEST(ReportCharts, DrawEachCaseWithItsDataBeside)
  {
    const fixture::Folder folder;
    const study::Results results = fixture::results();
    const std::vector<Chart> charts = write_charts(results, folder.path());
    ASSERT_EQ(charts.size(), 1 + 4 * 4u); // overall, and four kinds for four cases
    EXPECT_TRUE(is_overall(charts.front()));
    for (const Chart &chart : charts)
    {
      const std::string svg = fixture::read(folder.path() / "charts" / (chart.name + ".svg"));
      const std::string csv = fixture::read(folder.path() / "charts" / (chart.name + ".csv"));
      EXPECT_TRUE(holds(svg, "</svg>")) << chart.name;
      EXPECT_TRUE(holds(svg, "<text>FA (not AC)</text>")) << chart.name;
      EXPECT_TRUE(holds(svg, "<text>IPA-AC recalibrated</text>")) << chart.name;
      EXPECT_TRUE(holds(svg, "<text>P0 (not AC)</text>")) << chart.name;
      // A head, and five methods with five levels of one case, or of the two of the problem.
      EXPECT_EQ(fixture::count(csv, "\n"), is_overall(chart) ? 51u : 26u) << chart.name;
    }
  }

  TEST(ReportCharts, HaveUnitsOnTheirAxes)
  {
    const fixture::Folder folder;
    write_charts(fixture::results(), folder.path());
    const auto svg = [&](const std::string &name)
    { return fixture::read(folder.path() / "charts" / (name + "_case1_m-3.svg")); };
    EXPECT_TRUE(holds(svg("convergence"), "horizon δ [length]"));
    EXPECT_TRUE(holds(svg("convergence"), "nodal L∞ against exact [unit of the solution]"));
    EXPECT_TRUE(holds(svg("work-precision"), "[CPU s]"));
    EXPECT_TRUE(holds(svg("memory"), "[MB]"));
    EXPECT_TRUE(holds(svg("iterations"), "iterations [1]"));
  }

  TEST(ReportCharts, SkipAnErrorThatHasNoPlaceOnALogarithmicAxis)
  {
    const fixture::Folder folder;
    write_charts(fixture::results(), folder.path());
    const std::string csv = fixture::read(folder.path() / "charts" / "convergence_case1_m-3.csv");
    EXPECT_TRUE(holds(csv, "\nQ1,case1,m = 3,0,0.30000000000000004,\n"));  // an exact zero
    EXPECT_TRUE(holds(csv, "\nP0,case1,m = 3,2,0.075000000000000011,\n")); // NaN
    EXPECT_TRUE(holds(csv, "\nFA,case1,m = 3,4,"));                        // no solution
    EXPECT_TRUE(holds(csv, ",3.0000000000000002e-13\n") || holds(csv, ",2.9999999999999998e-13\n"));
  }

  TEST(ReportCharts, TakeWhatVariesAsAbscissa)
  {
    study::Results results = fixture::results();
    for (study::Trend &trend : results.trends)
      trend.parameter = "h";
    const fixture::Folder folder;
    write_charts(results, folder.path());
    for (const char *kind : {"convergence", "iterations"})
      EXPECT_TRUE(
          holds(fixture::read(folder.path() / "charts" / (std::string(kind) + "_case1_m-3.csv")),
                "level,mesh size h [length],"));
  }

  TEST(ReportCharts, AreLeftOutWithoutAPoint)
  {
    study::Results results = fixture::results();
    for (study::Run &run : results.runs)
      run.cost.peak_bytes = 0;
    for (const Chart &chart : list_charts(results))
      EXPECT_NE(chart.kind, ChartKind::memory);
    EXPECT_TRUE(list_charts(study::Results()).empty());
    const fixture::Folder folder;
    EXPECT_TRUE(write_charts(study::Results(), folder.path()).empty());
  }

  TEST(ReportCharts, SurviveNamesThatMeanSomethingToGnuplot)
  {
    const fixture::Folder folder;
    study::Results results = fixture::results();
    for (study::Run &run : results.runs)
      if (run.method == "FA")
        run.method = "it's `touch boom` \"{x}_2\\n";
    results.trends.clear();
    write_charts(results, folder.path());
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "charts" / "boom"));
    EXPECT_TRUE(holds(fixture::read(folder.path() / "charts" / "work-precision.svg"),
                      "it's `touch boom` \"{x}_2\\n"));
  }

  TEST(ReportCharts, SayWhatToInstallWhereGnuplotIsMissing)
  {
    const fixture::Folder folder;
    const std::string path = std::getenv("PATH");
    setenv("PATH", folder.path().c_str(), 1);
    std::string message = "no error";
    try
    {
      write_charts(fixture::results(), folder.path());
    }
    catch (const NumericalError &error)
    {
      message = error.what();
    }
    setenv("PATH", path.c_str(), 1);
    EXPECT_TRUE(holds(message, "apt-get install gnuplot-nox")) << message;
    // The data do not need it.
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "charts" / "work-precision.csv"));
  }

  TEST(ReportCharts, GiveEveryMethodOfAFamilyItsOwnLook)
  {
    std::set<std::pair<std::string, unsigned int>> looks;
    for (unsigned int i = 0; i < 42; ++i)
    {
      const Style style = style_of(i, false);
      looks.insert({style.colour, style.symbol});
      EXPECT_FALSE(style.is_dashed);
      EXPECT_TRUE(style_of(i, true).is_dashed);
    }
    EXPECT_EQ(looks.size(), 42u);
  }

  TEST(ReportCharts, PutSlopeTrianglesWhereNoLineRuns)
  {
    Line steep, flat;
    for (const double x : {.01, .02, .04, .08, .16})
    {
      steep.points.push_back({x, x * x});
      flat.points.push_back({x, 1e-2});
    }
    const std::vector<Line> lines = {steep, flat};
    const Range x = {.008, .2}, y = {1e-5, 1e-1};
    std::vector<SlopeTriangle> taken;
    for (const unsigned int slope : {2u, 1u})
    {
      const auto found = place_slope(slope, lines, x, y, taken);
      ASSERT_TRUE(found) << slope;
      const SlopeTriangle &t = *found;
      EXPECT_NEAR(std::log(t.y1 / t.y0) / std::log(t.x1 / t.x0), slope, 1e-12);
      EXPECT_GT(t.x0, x.low);
      EXPECT_LT(t.x1, x.high);
      EXPECT_GT(t.y0, y.low);
      EXPECT_LT(t.y1, y.high);
      for (double s = 0; s <= 1; s += .01)
      {
        // Wherever x is over the triangle, a line runs above it or below it.
        const double at = t.x0 * std::pow(t.x1 / t.x0, s);
        const double top = t.y0 * std::pow(at / t.x0, slope);
        for (const double line : {at * at, 1e-2})
          EXPECT_TRUE(line > top || line < t.y0) << slope << ' ' << at;
        for (const SlopeTriangle &other : taken)
          EXPECT_TRUE(t.x0 > other.x1 || t.x1 < other.x0 || t.y0 > other.y1 || t.y1 < other.y0);
      }
      taken.push_back(t);
    }
    // Over twelve decades a slope of one is too flat to read.
    EXPECT_FALSE(place_slope(1, lines, {.1, .2}, {1e-14, 1e-2}, {}));
  }

  TEST(ReportCharts, HaveRangesWithTwoPowersOfTen)
  {
    for (const std::vector<double> &values : std::vector<std::vector<double>>{
             {2e-3, 3e-3}, {1e-3}, {1e-13, 2e-2}, {9e-3, 1.1e-2}, {1e-3, 1e3}})
    {
      const Range range = log_range(values);
      EXPECT_LT(range.low, values.front());
      EXPECT_GT(range.high, values.back());
      EXPECT_GE(std::floor(std::log10(range.high)) - std::ceil(std::log10(range.low)), 1);
    }
  }
} // namespace plumbline::report
