// Journals and results files give back records to the last bit.
#include "io/record_journal.h"
#include "base/error.h"
#include "io/results_json.h"
#include "tests/report/fixture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

namespace plumbline::io
{
  namespace
  {
    using analysis::Record;
    using report::fixture::Folder;

    Record full_record()
    {
      Record record;
      record.key = {"stability", "Q1",    analysis::MethodFamily::reference,
                    "case 2",    "m = 3", "lumped",
                    2,           .1 / 3,  .1,
                    -.25};
      record.cost.setup_seconds = 1. / 3;
      record.cost.solve_seconds = 2.5;
      record.cost.peak_bytes = 1e10;
      record.cost.n_unknowns = 8;
      record.cost.n_bonds = 9;
      record.cost.n_iterations = 10;
      record.set("smallest eigenvalue", 1. / 7, "b / u");
      record.set("largest eigenvalue", 1e300, "b / u");
      record.set("barrier", 5e-324);
      record.texts["proof"] = "not \"AC\"\n";
      record.curves["waves"] = {{"k", "1/length", {1, .1}},
                                {"phase speed", "length/time", {std::nan(""), -1e-17}}};
      record.fields["mode 1"] = {2, {{1. / 3, -.5}, {2, 3}}, {1. / 9, 2, 3, 4}, {.25, .75}};
      record.notes = {"a \"note\"", "another"};
      record.failure = "it ended";
      return record;
    }

    void expect_same(const Record &a, const Record &b)
    {
      EXPECT_TRUE(a.key == b.key);
      EXPECT_EQ(a.key.value, b.key.value);
      EXPECT_EQ(std::tuple(a.cost.setup_seconds, a.cost.solve_seconds, a.cost.peak_bytes),
                std::tuple(b.cost.setup_seconds, b.cost.solve_seconds, b.cost.peak_bytes));
      EXPECT_EQ(std::tuple(a.cost.n_unknowns, a.cost.n_bonds, a.cost.n_iterations),
                std::tuple(b.cost.n_unknowns, b.cost.n_bonds, b.cost.n_iterations));
      ASSERT_EQ(a.scalars.size(), b.scalars.size());
      for (const auto &[name, scalar] : a.scalars)
      {
        EXPECT_EQ(scalar.value, b[name]) << name;
        EXPECT_EQ(scalar.unit, b.scalars.at(name).unit) << name;
      }
      EXPECT_EQ(a.texts, b.texts);
      EXPECT_EQ(a.notes, b.notes);
      EXPECT_EQ(a.failure, b.failure);
      ASSERT_EQ(a.curves.size(), b.curves.size());
      for (const auto &[name, curve] : a.curves)
        for (std::size_t i = 0; i < curve.size(); ++i)
        {
          const analysis::Column &other = b.curves.at(name).at(i);
          EXPECT_EQ(std::tie(curve[i].name, curve[i].unit), std::tie(other.name, other.unit));
          ASSERT_EQ(curve[i].values.size(), other.values.size());
          for (std::size_t k = 0; k < other.values.size(); ++k)
            EXPECT_TRUE(curve[i].values[k] == other.values[k] ||
                        (std::isnan(curve[i].values[k]) && std::isnan(other.values[k])));
        }
      ASSERT_EQ(a.fields.size(), b.fields.size());
      for (const auto &[name, field] : a.fields)
      {
        const analysis::PointField &other = b.fields.at(name);
        EXPECT_EQ(std::tie(field.n_components, field.points, field.values, field.areas),
                  std::tie(other.n_components, other.points, other.values, other.areas));
      }
    }
  } // namespace

  namespace
  {
    study::StudyResults made(const analysis::Records &records)
    {
      study::StudyResults results;
      results.records = records;
      return results;
    }

    std::size_t n_earlier(const std::filesystem::path &file)
    {
      return RecordJournal(file, "scene").earlier().records.size();
    }
  } // namespace

  TEST(RecordJournal, GivesBackWhatAnalysesFoundToTheLastBit)
  {
    const Folder folder;
    const auto file = folder.path() / "rows.jsonl";
    Record small;
    small.key.h = small.key.horizon = 1;
    RecordJournal(file, "scene").append(made({full_record(), small}));
    EXPECT_TRUE(RecordJournal(file, "another scene").earlier().records.empty());
    RecordJournal journal(file, "scene");
    ASSERT_EQ(journal.earlier().records.size(), 2u);
    expect_same(full_record(), journal.earlier().records[0]);
    expect_same(small, journal.earlier().records[1]);
    journal.append(made({full_record()})); // after those that are there
    EXPECT_EQ(n_earlier(file), 3u);
  }

  TEST(RecordJournal, LeavesOutALineThatAKillCutShort)
  {
    const Folder folder;
    const auto file = folder.path() / "rows.jsonl";
    RecordJournal(file, "scene").append(made({full_record()}));
    RecordJournal(file, "scene").append(made({full_record()}));
    std::filesystem::resize_file(file, std::filesystem::file_size(file) - 9);
    EXPECT_EQ(n_earlier(file), 1u);
  }

  TEST(RecordJournal, LeavesOutAGroupThatAKillCutShort)
  {
    const Folder folder;
    const auto file = folder.path() / "rows.jsonl";
    RecordJournal journal(file, "scene");
    journal.append(made({full_record()}));
    journal.append(made({full_record(), full_record()}));
    EXPECT_EQ(n_earlier(file), 3u);
    std::filesystem::resize_file(file, std::filesystem::file_size(file) - 9);
    EXPECT_EQ(n_earlier(file), 1u);
  }

  TEST(RecordJournal, IsContinuedByOthersBehindItsLastWholeLine)
  {
    const Folder folder;
    const auto file = folder.path() / "rows.jsonl";
    RecordJournal(file, "scene").append(made({full_record()}));
    RecordJournal one(file, "scene"), other(file, "scene");
    one.join();
    other.join();
    one.append(made({full_record()}));
    other.append(made({full_record()}));
    EXPECT_EQ(n_earlier(file), 3u);
    std::filesystem::resize_file(file, std::filesystem::file_size(file) - 9); // that one is killed
    one.append(made({full_record(), full_record()}));
    EXPECT_EQ(n_earlier(file), 4u);
  }

  TEST(RecordJournal, GivesBackMapsOfCurvesWhichHaveNoHeight)
  {
    const Folder folder;
    const auto file = folder.path() / "rows.jsonl";
    study::StudyResults results = made({full_record()});
    study::ErrorMap map;
    map.h = map.horizon = 1;
    map.n_x = 2;
    map.n_y = 1;
    map.upper = {1, 0};
    map.values = {1, 2};
    results.maps = {map};
    RecordJournal(file, "scene").append(results);
    EXPECT_EQ(RecordJournal(file, "scene").earlier().maps.size(), 1u);
  }

  TEST(RecordJournal, TakesNothingOfAFileThatIsNone)
  {
    const Folder folder;
    const auto file = folder.path() / "rows.jsonl";
    RecordJournal(file, "scene").append(made({full_record()}));
    std::ofstream(file, std::ios::app) << "{\"key\": {}}\n"; // whole, but no record
    RecordJournal journal(file, "scene");
    EXPECT_TRUE(journal.earlier().records.empty());
    journal.append(made({full_record()})); // in its place
    EXPECT_EQ(n_earlier(file), 1u);
  }

  TEST(ResultsJson, GivesBackStudies)
  {
    study::StudyResults results;
    results.analysis = "stability";
    results.scene_name = "a scene";
    results.variable = "q";
    results.facts = {{"longest wave", "1"}};
    results.records = {full_record()};
    results.verdicts = {{"Q1", "m = 3", "stable", study::Rating::doubtful, "m >= 3", "words"}};
    results.powers = {{"Q1", "m = 3", study::Axis::horizon, {{"smallest eigenvalue", .5}}}};
    results.expectations = {{"subject", "expected", "found", true}};
    results.warnings = {"a warning"};
    results.is_complete = false;
    const study::StudyResults read = from_json(to_json(results), "a file");
    expect_same(results.records[0], read.records.at(0));
    EXPECT_EQ(read.verdicts.at(0).rating, study::Rating::doubtful);
    EXPECT_EQ(read.powers.at(0).of, results.powers[0].of);
    EXPECT_EQ(read.powers[0].axis, study::Axis::horizon);
    EXPECT_EQ(read.facts, results.facts);
    EXPECT_FALSE(read.is_complete);
    EXPECT_EQ(to_json(read), to_json(results));
  }

  TEST(ResultsJson, NamesWhatIsMissing)
  {
    std::string text = to_json(study::StudyResults{});
    const auto at = text.find("\"records\"");
    ASSERT_NE(at, std::string::npos);
    text.replace(at, 9, "\"recordz\"");
    try
    {
      (void)from_json(text, "a file");
      FAIL() << "no error";
    }
    catch (const InputError &error)
    {
      EXPECT_NE(std::string(error.what()).find("records is missing"), std::string::npos)
          << error.what();
    }
  }
} // namespace plumbline::io
