#include "report/statics_view.h"

#include "base/error.h"
#include "report/maps.h"
#include "report/small_multiples.h"
#include "tests/report/fixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>
#include <sstream>

namespace plumbline::report
{
  namespace
  {
    bool holds(const std::string &text, const std::string &part)
    {
      return text.find(part) != std::string::npos;
    }

    void write(const study::StudyResults &results, const fixture::Folder &folder)
    {
      write_study(statics_view(results), results, folder.path());
    }

    /// The charts of a gallery.
    std::vector<DataChart> charts_of(const study::StudyResults &results, const std::string &gallery)
    {
      for (const Gallery &one : statics_galleries(results))
        if (one.id == gallery)
          return one.charts;
      return {};
    }

    std::string read(const fixture::Folder &folder, const std::string &name)
    {
      return fixture::read(folder.path() / "charts" / name);
    }
  } // namespace

  TEST(ReportCharts, DrawEachCaseWithItsDataBeside)
  {
    const fixture::Folder folder;
    const study::StudyResults results = fixture::results();
    write(results, folder);
    std::size_t n = 0;
    for (const Gallery &gallery : statics_galleries(results))
    {
      n += gallery.charts.size() + gallery.pictures.size();
      for (const DataChart &chart : gallery.charts)
      {
        const std::string svg = read(folder, chart.name + ".svg"),
                          csv = read(folder, chart.name + ".csv");
        EXPECT_TRUE(holds(svg, "</svg>")) << chart.name;
        EXPECT_TRUE(holds(svg, "<text>FA (not AC)</text>")) << chart.name;
        EXPECT_TRUE(holds(svg, "<text>IPA-AC recalibrated</text>")) << chart.name;
        EXPECT_TRUE(holds(svg, "<text>P0 (not AC)</text>")) << chart.name;
        // A head, and five methods with five levels of one case, or of the two of the problem.
        const bool is_overall = chart.name == "work-precision";
        EXPECT_EQ(fixture::count(csv, "\n"), is_overall ? 51u : 26u) << chart.name;
      }
      for (const Picture &picture : gallery.pictures)
        EXPECT_TRUE(holds(read(folder, picture.name + ".svg"), "</svg>")) << picture.name;
    }
    EXPECT_EQ(n, 1 + 5 * 4 + 1u); // overall, five kinds for four cases, error maps
    EXPECT_EQ(charts_of(results, "work").front().name, "work-precision");
  }

  TEST(ReportCharts, HaveUnitsOnTheirAxes)
  {
    const fixture::Folder folder;
    write(fixture::results(), folder);
    const auto svg = [&](const std::string &name)
    { return fixture::read(folder.path() / "charts" / (name + "_case1_m-3.svg")); };
    EXPECT_TRUE(holds(svg("convergence"), "horizon δ [length]"));
    EXPECT_TRUE(holds(svg("convergence"), "nodal L∞ against exact [unit of the solution]"));
    EXPECT_TRUE(holds(svg("work-precision"), "[CPU s]"));
    EXPECT_TRUE(holds(svg("memory"), "[MB]"));
    EXPECT_TRUE(holds(svg("pairs"), "pairs in one application [1]"));
    EXPECT_TRUE(holds(svg("iterations"), "iterations [1]"));
  }

  TEST(ReportCharts, SkipAnErrorThatHasNoPlaceOnALogarithmicAxis)
  {
    const fixture::Folder folder;
    write(fixture::results(), folder);
    const std::string csv = fixture::read(folder.path() / "charts" / "convergence_case1_m-3.csv");
    EXPECT_TRUE(holds(csv, "\nQ1,case1,m = 3,0,0.30000000000000004,\n"));  // an exact zero
    EXPECT_TRUE(holds(csv, "\nP0,case1,m = 3,2,0.075000000000000011,\n")); // NaN
    EXPECT_TRUE(holds(csv, "\nFA,case1,m = 3,4,"));                        // no solution
    EXPECT_TRUE(holds(csv, ",3.0000000000000002e-13\n") || holds(csv, ",2.9999999999999998e-13\n"));
  }

  TEST(ReportCharts, TakeWhatVariesAsAbscissa)
  {
    study::StudyResults results = fixture::results();
    for (study::Trend &trend : results.trends)
      trend.axis = study::Axis::mesh_size;
    const fixture::Folder folder;
    write(results, folder);
    for (const char *kind : {"convergence", "iterations"})
      EXPECT_TRUE(
          holds(fixture::read(folder.path() / "charts" / (std::string(kind) + "_case1_m-3.csv")),
                "level,mesh size h [length],"));
  }

  // eight mesh sizes within less than a decade, as of a published figure
  TEST(ReportCharts, LeaveOutFiguresThatWouldTouch)
  {
    Plot plot;
    plot.file = "errors.svg";
    Line line{"FA", style_of(0, false), 1.8, {}};
    for (const double n : {40., 60., 80., 100., 120., 140., 160., 180.})
    {
      plot.x_ticks.push_back(1 / n);
      line.points.push_back({1 / n, 1 / n});
    }
    plot.lines = {line};
    const std::string script = gnuplot_script({plot});
    const auto figure = [&](const std::string &text) { return holds(script, "'" + text + "' "); };
    EXPECT_TRUE(figure("0.005556") && figure("0.025"));
    EXPECT_FALSE(figure("0.00625"));                    // right beside the first
    for (const std::string text : {"0.008333", "0.01"}) // one of them at most
      EXPECT_FALSE(figure(text) && figure("0.007143"));
    EXPECT_GE(fixture::count(script, "'' 0.0"), 3u); // the lines of the grid stay
  }

  TEST(ReportCharts, AreLeftOutWithoutAPoint)
  {
    study::StudyResults results = fixture::results();
    for (study::Record &run : results.records)
      run.cost.peak_bytes = 0;
    results.maps.clear();
    EXPECT_TRUE(charts_of(results, "memory").empty());
    for (const Gallery &gallery : statics_galleries(results))
      EXPECT_TRUE(gallery.pictures.empty()) << gallery.id;
    for (const Gallery &gallery : statics_galleries(study::StudyResults()))
      EXPECT_TRUE(gallery.charts.empty() && gallery.pictures.empty()) << gallery.id;
    const fixture::Folder folder;
    write(study::StudyResults(), folder);
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "charts"));
  }

  TEST(ReportCharts, SurviveNamesThatMeanSomethingToGnuplot)
  {
    const fixture::Folder folder;
    study::StudyResults results = fixture::results();
    for (study::Record &run : results.records)
      if (run.key.method == "FA")
        run.key.method = "it's `touch boom` \"{x}_2\\n";
    results.trends.clear();
    write(results, folder);
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
      write(fixture::results(), folder);
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

  TEST(ReportCharts, HaveSlopeTrianglesOnlyIfALineHasASlope)
  {
    const auto has_triangles = [](const std::vector<std::vector<Vertex>> &lines)
    {
      Plot plot;
      plot.has_slopes = plot.shows_round_off = true;
      for (const auto &points : lines)
        plot.lines.push_back({"FA", style_of(0, false), 1.8, points});
      return holds(gnuplot_script({plot}), "polygon from");
    };
    EXPECT_TRUE(has_triangles({{{.2, 4e-2}, {.1, 1e-2}}}));
    EXPECT_TRUE(has_triangles({{{.2, 4e-2}}, {{.2, 1e-2}, {.1, 5e-3}}}));
    EXPECT_FALSE(has_triangles({{{.2, 4e-2}}, {{.1, 1e-2}}})); // single points
    EXPECT_FALSE(has_triangles({{{.2, 4e-2}, {.1, 1e-14}}}));
    EXPECT_FALSE(has_triangles({{{.2, 4e-14}, {.1, 1e-14}}}));
  }

  TEST(ReportCharts, PutSlopeTrianglesBesideLinesOfLikeSlope)
  {
    // lines of observed slopes, 1.85 and 1.5: the triangle of 2 belongs to the first one
    Line like, other;
    for (const double x : {.01, .02, .04, .08, .16})
    {
      like.points.push_back({x, .01 * std::pow(x, 1.85)});
      other.points.push_back({x, std::pow(x, 1.5)});
    }
    for (const bool is_first : {true, false})
    {
      const std::vector<Line> lines =
          is_first ? std::vector<Line>{like, other} : std::vector<Line>{other, like};
      const auto found = place_slope(2, lines, {.008, .2}, {1e-7, 1e-1}, {});
      ASSERT_TRUE(found);
      const double x = std::sqrt(found->x0 * found->x1), y = std::sqrt(found->y0 * found->y1);
      EXPECT_LT(std::abs(std::log(y / (.01 * std::pow(x, 1.85)))),
                .5 * std::abs(std::log(y / std::pow(x, 1.5))));
    }
  }

  TEST(ReportCharts, PutRoundOffIntoAStripOfRows)
  {
    Line exact_one, exact_two, other;
    exact_one.style = style_of(0, false);
    exact_two.style = style_of(1, false);
    other.style = style_of(2, false);
    exact_one.points = {{.1, 1e-13}, {.2, 3e-15}};
    exact_two.points = {{.1, 2e-16}, {.2, 5e-3}};
    other.points = {{.1, 1e-3}, {.2, 1e-2}};
    const Strip strip = make_strip({exact_one, other, exact_two}, {1e-3, 1e-1});
    ASSERT_EQ(strip.rows.size(), 2u);
    EXPECT_EQ(strip.range.high, 1e-3);
    EXPECT_GT(strip.range.low, 1e-3 / 100); // less than half of the picture
    const std::vector<Vertex> one = strip.enter(exact_one), two = strip.enter(exact_two);
    EXPECT_EQ(one[0].y, one[1].y);
    EXPECT_LT(one[0].y, strip.range.high);
    EXPECT_LT(two[0].y, one[0].y);
    EXPECT_GT(two[0].y, strip.range.low);
    EXPECT_EQ(two[1].y, 5e-3);
    EXPECT_EQ(strip.enter(other)[0].y, 1e-3);
    const std::vector<Vertex> best = strip.cut({{.1, 1e-3}, {.3, 1e-13}});
    ASSERT_EQ(best.size(), 3u);
    EXPECT_EQ(best[1].y, strip.range.high);
    EXPECT_EQ(best[2].y, strip.range.low);
    EXPECT_EQ(best[2].x, .3);

    // The axis is of the other errors; there is no strip where all or none are of rounding.
    Plot plot;
    plot.shows_round_off = true;
    plot.lines = {exact_one, other, exact_two};
    EXPECT_TRUE(holds(gnuplot_script({plot}), "'round-off'"));
    EXPECT_TRUE(holds(gnuplot_script({plot}), "set ytics nomirror 1e-3,"));
    EXPECT_TRUE(holds(gnuplot_script({plot}), "\n\n0.20000000000000001 0.0050000000000000001\n"))
        << "the way out of the strip has no line";
    plot.lines = {other};
    EXPECT_FALSE(holds(gnuplot_script({plot}), "'round-off'"));
    plot.lines = {exact_one};
    EXPECT_FALSE(holds(gnuplot_script({plot}), "'round-off'"));
    EXPECT_TRUE(holds(gnuplot_script({plot}), " 3.0000000000000002e-15\n") ||
                holds(gnuplot_script({plot}), " 2.9999999999999998e-15\n"))
        << "drawn where it is";
  }

  TEST(ReportCharts, ShowWorkOfTheProblemThatIsNotSolvedExactly)
  {
    study::StudyResults results = fixture::results();
    EXPECT_EQ(telling_problem(results), "case_2 δ"); // case1 has a zero, a NaN, a failure
    for (study::Record &run : results.records)
      if (run.key.problem != "case1" && run.key.method != "FA")
        run.set(results.decisive_error, 1e-14);
    EXPECT_EQ(telling_problem(results), "case1");
    const std::string title = charts_of(results, "work").front().plot.title;
    EXPECT_EQ(title.find("case1: "), 0u) << title;
    EXPECT_TRUE(holds(title, "the best of m = 3, m = 4")) << title;
    EXPECT_EQ(charts_of(results, "memory").front().name, "memory_case1_m-3");
    for (study::Record &run : results.records)
      run.set(results.decisive_error, run.key.problem == "case1" ? 1e-14 : 1e-3);
    EXPECT_EQ(charts_of(results, "memory").front().name, "memory_case-2-delta_m-3");
    EXPECT_EQ(telling_problem(study::StudyResults()), "");
  }

  TEST(ReportCharts, DrawErrorMapsOnOneScaleWithTheirDataBeside)
  {
    const fixture::Folder folder;
    const study::StudyResults results = fixture::results();
    write(results, folder);
    const std::string svg = fixture::read(folder.path() / "charts" / "error-maps.svg");
    const std::string csv = fixture::read(folder.path() / "charts" / "error-maps.csv");
    EXPECT_EQ(fixture::count(svg, "<image style='image-rendering:pixelated'"), 5u);
    EXPECT_TRUE(holds(svg, ">|error of cell averages| [unit of the solution]<"));
    EXPECT_TRUE(holds(svg, ">case1, m = 3, h = 0.1: where the error sits<"));
    for (const fixture::Model &model : fixture::models())
      EXPECT_TRUE(holds(svg, ">" + model.method + "<")) << model.method;
    // A head, and 12 blocks of which one lies outside: the upper right of the lowest row.
    EXPECT_EQ(fixture::count(csv, "\n"), 1 + 5 * 11u);
    EXPECT_TRUE(holds(csv, "\nFA,case1,m = 3,0.10000000000000001,0.25,-0.66666666666666"));
    EXPECT_FALSE(holds(csv, ",1.75,-0.6666"));
    EXPECT_TRUE(holds(csv, ",1.75,0.6666"));
    EXPECT_EQ(fixture::count(csv, ",0\n"), 5u) << "a zero stays a zero";
  }

  TEST(ReportCharts, ScaleErrorMapsByWhatIsPositiveAndAboveRounding)
  {
    const auto scale = [](const std::vector<double> &values)
    {
      study::ErrorMap map;
      map.values = values;
      return colour_scale({map});
    };
    const double nan = std::nan("");
    // Many decades: from the least to the largest; few: whole decades.
    EXPECT_EQ(scale({2e-7, nan, 0, 5e-2}).low, 2e-7);
    EXPECT_EQ(scale({2e-7, nan, 0, 5e-2}).high, 5e-2);
    EXPECT_NEAR(scale({2e-3, 5e-2}).low, 1e-3, 1e-12);
    EXPECT_NEAR(scale({2e-3, 5e-2}).high, 1e-1, 1e-12);
    // Round-off beside real errors has one colour; alone it has a scale of its own.
    EXPECT_EQ(scale({2e-15, 5e-2}).low, round_off);
    EXPECT_NEAR(scale({2e-15, 3e-14}).low, 1e-15, 1e-24);
    EXPECT_NEAR(scale({2e-19, 2e-18}).low, 1e-16, 1e-25);
    for (const std::vector<double> &values : std::vector<std::vector<double>>{{}, {nan, 0}, {1e-3}})
    {
      EXPECT_GT(scale(values).low, 0); // the scale is logarithmic
      EXPECT_GE(scale(values).high, 9.9 * scale(values).low);
    }
  }

  TEST(ReportCharts, DrawZeroAsTheLowEndAndNothingOutsideTheDomain)
  {
    study::ErrorMap map;
    map.method = "it's";
    map.quantity = "nodal values";
    map.n_x = map.n_y = 2;
    map.upper = {1, 1};
    map.values = {0, 1e-3, std::nan(""), 1e-6};
    const std::string script = map_script({map}, "a.svg");
    EXPECT_TRUE(holds(script, "$m0 << EOD\n1.000e-6 1.000e-3\nNaN 1.000e-6\nEOD\n")) << script;
    EXPECT_TRUE(holds(script, "set title 'it''s' noenhanced"));
    EXPECT_TRUE(holds(script, "'|error of nodal values| [unit of the solution]'"));
  }

  TEST(ReportCharts, DrawTheSolutionOfTheFirstGalerkinMethodOrTheMostAccurateOne)
  {
    const fixture::Folder folder;
    study::StudyResults results = fixture::results();
    const auto shown = [&] { return solution_map(results.maps, methods(results)); };
    EXPECT_EQ(shown(), nullptr);
    for (study::ErrorMap &map : results.maps)
      map.solution = {-.5, 0, 1, std::nan(""), 0, 0, 0, 0, 0, 0, 0, .25};
    ASSERT_NE(shown(), nullptr);
    EXPECT_EQ(shown()->method, "P0"); // Q1 is more accurate
    for (const Gallery &gallery : statics_galleries(results))
    {
      if (gallery.id == "solution")
      {
        ASSERT_EQ(gallery.pictures.size(), 1u);
        EXPECT_EQ(gallery.pictures[0].title, "case1, m = 3, h = 0.1: solution computed with P0");
      }
    }

    write(results, folder);
    const std::string svg = fixture::read(folder.path() / "charts" / "solution.svg"),
                      csv = fixture::read(folder.path() / "charts" / "solution.csv");
    EXPECT_EQ(fixture::count(svg, "<image style='image-rendering:pixelated'"), 1u);
    EXPECT_TRUE(holds(svg, ">u [unit of the solution]<"));
    EXPECT_EQ(fixture::count(csv, "\n"), 1 + 11u); // a head, and blocks inside the domain
    EXPECT_TRUE(holds(csv, "\nP0,case1,m = 3,0.10000000000000001,0.25,-0.66666666666666"));
    EXPECT_TRUE(holds(csv, ",-0.5\n"));

    results.maps.resize(3); // of rules alone
    EXPECT_EQ(shown()->method, "FA");
    results.maps[0].n_components = 2;
    EXPECT_TRUE(holds(solution_script(results.maps[0], "a.svg"), "'|u| [unit of the solution]'"));
    EXPECT_TRUE(holds(solution_script(results.maps[0], "a.svg"), "set cbrange [-0.5:1]\n"));
  }

  TEST(ReportCharts, HaveFiguresThatDifferAtTheStepsOfALinearAxis)
  {
    const auto script = [](const Range &range)
    {
      Plot plot;
      plot.is_y_log = false;
      plot.y_range = range;
      plot.lines.push_back({"FA", style_of(0, false), 1.8, {{1, range.low}, {2, range.high}}});
      return gnuplot_script({plot});
    };
    EXPECT_TRUE(holds(script({0, 1}), "format y '%.6g'"));
    EXPECT_TRUE(holds(script({2.41992, 2.41994}), "format y '%.8g'")); // steps of 2e-6
    const auto margin = [&](const Range &range)
    {
      const std::string text = script(range), head = "lmargin at screen ";
      return std::stod(text.substr(text.find(head) + head.size()));
    };
    EXPECT_GT(margin({2.41992, 2.41994}), margin({0, 1}));
  }

  TEST(ReportCharts, HaveFiguresOfTheAbscissaThatDoNotTouch)
  {
    for (const double end : {8.3e-6, 1., 12345., 2.5e-3})
    {
      Plot plot;
      plot.is_x_log = plot.is_y_log = false;
      plot.lines.push_back({"crack tip", style_of(0, false), 1.8, {{0, 0}, {end, 1}}});
      const std::string text = gnuplot_script({plot}), head = "set xtics nomirror ";
      ASSERT_TRUE(holds(text, head)) << text;
      const double step = std::stod(text.substr(text.find(head) + head.size())),
                   n = std::floor(end / step), pixels = 420, character = 8.4;
      EXPECT_GE(n, 2) << end;
      std::ostringstream figure;
      figure << 2 * step;
      EXPECT_LT(static_cast<double>(figure.str().size()) * character, pixels / n) << end;
    }
  }

  TEST(ReportCharts, HaveRoomForTheFiguresOfSmallLengths)
  {
    const auto margin = [](double size)
    {
      const SmallMultiples panels(1, 1, {-size, -size}, {size, size});
      const std::string text = panels.panel(0, ""), head = "lmargin at screen ";
      return 820 * std::stod(text.substr(text.find(head) + head.size()));
    };
    EXPECT_NEAR(margin(1), 74, 1e-3);
    EXPECT_GT(margin(5e-3), margin(1)); // -0.005 is wider than -1
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
