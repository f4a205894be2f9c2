#include "report/page_script.h"
#include "report/data_charts.h"
#include "tests/report/fixture.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace
{
  using namespace plumbline::report;
  using fixture::Folder;

  Plot two_lines()
  {
    Plot plot;
    plot.file = "errors.svg";
    plot.title = "</script><b>";
    plot.x_label = "h [length]";
    plot.y_label = "error";
    plot.is_x_log = false;
    plot.lines = {{"FA", style_of(0, false), 1, {{.1, 1e-3}, {.05, 2.5e-4}}},
                  {"Q1", style_of(0, true), 1, {{.1, 1e-4}, {.05, std::nan("")}}}};
    return plot;
  }
} // namespace

TEST(PageScript, has_the_values_of_the_picture)
{
  const Folder folder;
  write_chart_data({two_lines()}, folder.path());
  const auto data = nlohmann::json::parse(fixture::read(folder.path() / "errors.json"));
  EXPECT_EQ(data["x"], "h [length]");
  EXPECT_EQ(data["xLog"], false);
  EXPECT_EQ(data["yLog"], true);
  ASSERT_EQ(data["lines"].size(), 2u);
  EXPECT_EQ(data["lines"][0]["name"], "FA");
  EXPECT_EQ(data["lines"][0]["colour"], style_of(0, false).colour);
  EXPECT_EQ(data["lines"][0]["dashed"], false);
  EXPECT_EQ(data["lines"][1]["dashed"], true);
  EXPECT_EQ(data["lines"][0]["points"],
            nlohmann::json::parse("[[0.1, 1e-3], [0.05, 2.5e-4]]")); // to the last bit
  EXPECT_EQ(data["lines"][1]["points"].size(), 1u);                  // no NaN
}

TEST(PageScript, names_lines_that_hide_each_other)
{
  Plot plot = two_lines();
  plot.lines = {{"FA", style_of(0, false), 1, {{.1, 1e-2}, {.05, 1e-4}}},
                {"PA", style_of(1, false), 1, {{.1, 1.001e-2}, {.05, 1.001e-4}}},
                {"Q1", style_of(0, true), 1, {{.1, 1.1e-2}, {.05, 1e-4}}}, // apart at its beginning
                {"", style_of(2, false), 1, {{.1, 1e-2}, {.05, 1e-4}}},
                {"OPT", style_of(3, false), 1, {{.1, 1e-2}}}}; // a point has a symbol
  EXPECT_EQ(coinciding_lines(plot), "FA = PA");
  const Folder folder;
  write_chart_data({plot, two_lines()}, folder.path());
  EXPECT_EQ(coinciding_lines(folder.path() / "map.svg"), "");
  EXPECT_EQ(coinciding_lines(folder.path() / "errors.svg"), ""); // the last one that was written
  EXPECT_EQ(coinciding_lines(two_lines()), "");
  plot.file = "hidden.svg";
  write_chart_data({plot}, folder.path());
  EXPECT_EQ(coinciding_lines(folder.path() / "hidden.svg"), "FA = PA");
}

TEST(PageScript, is_on_pages_with_charts_alone)
{
  const Folder folder;
  write_chart_data({two_lines()}, folder.path());
  const std::string element = chart_data(folder.path() / "errors.svg"), end = "</body></html>";
  EXPECT_EQ(element.find("</script>"), element.rfind("</script>")); // the title ends nothing
  const std::string page = with_script("<body>" + element + end);
  EXPECT_NE(page.find("dygraphs"), std::string::npos); // with its licence
  EXPECT_NE(page.find("MIT"), std::string::npos);
  EXPECT_NE(page.find("new Dygraph("), std::string::npos);
  EXPECT_EQ(page.find("<script src"), std::string::npos); // no network
  EXPECT_EQ(with_script("<body>" + end), "<body>" + end);
  EXPECT_EQ(chart_data(folder.path() / "map.svg"), "");
}
