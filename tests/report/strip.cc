// What `plumbline strip` shows, also where nothing is finished yet.
#include "report/view.h"
#include "study/stationary_crack.h"
#include "tests/report/fixture.h"

#include <gtest/gtest.h>

namespace plumbline::report
{
  namespace
  {
    study::Record strip(const std::string &method, double h, double energy)
    {
      study::Record record;
      record.key.analysis = "strip";
      record.key.method = method;
      record.key.family = method::MethodFamily::reference;
      record.key.series = "m = 3";
      record.key.h = h;
      record.key.horizon = 3 * h;
      method::StripState state;
      state.energy = energy;
      state.intact = 1. / 7;
      state.at_end = .3;
      state.opening = {.1, 1. / 3};
      state.n_unknowns = 17;
      return study::strip_record(record, {20, 40, 15, h, {}}, state, .1 + .2,
                                 study::StripGrowth{1.3, 1.1, 1.05, .9});
    }

    study::StudyResults results()
    {
      study::StudyResults r;
      r.analysis = "strip";
      r.scene_name = "strip <1>";
      r.facts = {{"edges", "grips"}, {"height", "2"}, {"crack", "1.5"}, {"mu", "1"}};
      return r;
    }
  } // namespace

  TEST(StripPage, StandsWhereNothingIsFinishedYet)
  {
    const fixture::Folder folder;
    study::StudyResults r = results();
    r.is_complete = false;
    write_study(strip_view(r), r, folder.path());
    const std::string page = fixture::read(folder.path() / "strip.html");
    EXPECT_NE(page.find("strip &lt;1&gt;"), std::string::npos);
    EXPECT_NE(page.find("interrupted: what was finished"), std::string::npos);
    EXPECT_EQ(page.find("<table>"), std::string::npos);
    r.records = {strip("Q1", .1, 1)};
    write_study(strip_view(r), r, folder.path());
    EXPECT_EQ(fixture::count(fixture::read(folder.path() / "strip.html"), "<table>"), 1u);
  }

  TEST(StripPage, SaysHowFarMethodsAgree)
  {
    study::StudyResults r = results();
    for (const std::string method : {"Q1", "FA"})
      for (const double h : {.4, .2, .1, .05})
        r.records.push_back(strip(method, h, (method == "Q1" ? .5 : .51) + h * h));
    r.limits = {{"Q1", "m = 3", "tip energy", .5, 2, .001},
                {"FA", "m = 3", "tip energy", .51, 2, .001}};
    const View view = strip_view(r);
    EXPECT_EQ(view.answer,
              "tip energy (m = 3) of 2 methods: limits between 0.5 and 0.51, 0.01961 apart.");
    ASSERT_EQ(view.parts.size(), 4u); // three tables, and the model
    EXPECT_EQ(view.parts[0].table.rows.size(), 8u);
    EXPECT_EQ(view.parts[1].table.rows.size(), 2u);
    std::vector<std::string> names;
    for (const DataChart &chart : view.galleries.at(0).charts)
      names.push_back(chart.name);
    EXPECT_EQ(names, (std::vector<std::string>{"tip-energy", "profile", "opening", "w1",
                                               "growth-peak", "growth-released"}));
    EXPECT_EQ(view.galleries[0].charts[0].plot.lines[0].points.back().x, 0); // its limit
    EXPECT_EQ(view.galleries[0].charts[0].plot.y_label, "tip energy [mu length^2]");
    EXPECT_EQ(view.galleries[0].charts[4].plot.y_label, "growth peak [1]");
    for (const Gallery &gallery : view.galleries)
      for (const DataChart &chart : gallery.charts)
        EXPECT_TRUE(fixture::has_units(chart.plot)) << chart.name;
  }
} // namespace plumbline::report
