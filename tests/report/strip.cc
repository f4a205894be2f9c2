#include "report/row_journal.h"
#include "report/strip_page.h"

#include "tests/report/fixture.h"

#include <gtest/gtest.h>

#include <fstream>

namespace plumbline::report
{
  namespace
  {
    using StripJournal = RowJournal<study::StripRow>;

    study::StripRow strip(const std::string &method, double energy)
    {
      study::StripRow row;
      row.method = method;
      row.family = method::MethodFamily::reference;
      row.series = "m = 3";
      row.h = .1;
      row.horizon = .3;
      row.strip = {20, 40, 15, .1, 15.5};
      row.state.energy = energy;
      row.state.intact = 1. / 7;
      row.state.at_end = .3;
      row.state.opening = {.1, 1. / 3};
      row.state.n_unknowns = 17;
      row.release = .1 + .2;
      row.growth = study::StripGrowth{1.3, 1.1, 1.05, .9};
      row.seconds = 2.5;
      return row;
    }
  } // namespace

  TEST(StripJournal, GivesBackAllThatAStripIsToTheLastBit)
  {
    const fixture::Folder folder;
    const study::StripRow written = strip("Q1", 1. / 3);
    StripJournal(folder.path() / "strip.jsonl", "scene").append({written});
    const StripJournal journal(folder.path() / "strip.jsonl", "scene");
    ASSERT_EQ(journal.earlier().size(), 1u);
    const study::StripRow &read = journal.earlier().front();
    EXPECT_EQ(read.method, "Q1");
    EXPECT_EQ(read.family, method::MethodFamily::reference);
    EXPECT_EQ(read.series, written.series);
    EXPECT_EQ(read.h, written.h);
    EXPECT_EQ(read.horizon, written.horizon);
    EXPECT_EQ(read.strip.n_height, 20);
    EXPECT_EQ(read.strip.n_length, 40);
    EXPECT_EQ(read.strip.n_crack, 15);
    EXPECT_EQ(read.strip.h, written.h);
    EXPECT_EQ(read.strip.K_tip, 15.5);
    EXPECT_EQ(read.state.energy, written.state.energy);
    EXPECT_EQ(read.state.intact, written.state.intact);
    EXPECT_EQ(read.state.at_end, written.state.at_end);
    EXPECT_EQ(read.state.opening, written.state.opening);
    EXPECT_EQ(read.state.n_unknowns, 17u);
    EXPECT_EQ(read.release, written.release);
    ASSERT_TRUE(read.growth);
    EXPECT_EQ(read.growth->peak, 1.3);
    EXPECT_EQ(read.growth->mean, 1.1);
    EXPECT_EQ(read.growth->released, 1.05);
    EXPECT_EQ(read.growth->bonds, .9);
    EXPECT_EQ(read.seconds, 2.5);
    EXPECT_TRUE(read.failure.empty());
  }

  TEST(StripJournal, KeepsWhatWasFinishedHoweverOftenARunIsKilled)
  {
    const fixture::Folder folder;
    for (unsigned int i = 0; i < 3; ++i)
    {
      StripJournal journal(folder.path() / "strip.jsonl", "scene");
      ASSERT_EQ(journal.earlier().size(), i);
      journal.append({strip("Q1", i)});
    }
    const StripJournal journal(folder.path() / "strip.jsonl", "scene");
    ASSERT_EQ(journal.earlier().size(), 3u);
    for (unsigned int i = 0; i < 3; ++i)
      EXPECT_EQ(journal.earlier()[i].state.energy, i);
  }

  TEST(StripJournal, TakesNothingOfAnotherSceneNorOfAFileThatIsNone)
  {
    const fixture::Folder folder;
    const auto file = folder.path() / "strip.jsonl";
    StripJournal(folder.path() / "strip.jsonl", "scene").append({strip("Q1", 1)});
    EXPECT_TRUE(StripJournal(folder.path() / "strip.jsonl", "another").earlier().empty());
    std::ofstream(file, std::ios::app) << "{\"method\": \"cut o";
    EXPECT_EQ(StripJournal(folder.path() / "strip.jsonl", "scene").earlier().size(), 1u);
    std::ofstream(file, std::ios::app) << "ff\"}\n"; // whole, but no strip
    EXPECT_TRUE(StripJournal(folder.path() / "strip.jsonl", "scene").earlier().empty());
  }

  TEST(StripPage, StandsWhereNothingIsFinishedYet)
  {
    const fixture::Folder folder;
    study::StripResults results;
    results.scene_name = "strip <1>";
    results.is_complete = false;
    write_strip(results, {}, folder.path());
    const std::string page = fixture::read(folder.path() / "strip.html");
    EXPECT_NE(page.find("strip &lt;1&gt;"), std::string::npos);
    EXPECT_NE(page.find("interrupted: what was finished"), std::string::npos);
    EXPECT_EQ(page.find("<table>"), std::string::npos);
    results.rows = {strip("Q1", 1)};
    write_strip(results, {}, folder.path());
    EXPECT_EQ(fixture::count(fixture::read(folder.path() / "strip.html"), "<table>"), 1u);
  }
} // namespace plumbline::report
