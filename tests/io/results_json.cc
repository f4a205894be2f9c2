#include "io/results_json.h"

#include "base/error.h"
#include "base/text_file.h"
#include "tests/report/fixture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>

namespace plumbline::io
{
  namespace fixture = report::fixture;

  namespace
  {
    std::string error_of(const std::filesystem::path &file)
    {
      try
      {
        read_results(file);
      }
      catch (const InputError &error)
      {
        return error.what();
      }
      return "no error";
    }

    void write(const std::filesystem::path &file, const std::string &text)
    {
      std::ofstream(file, std::ios::binary) << text;
    }

    /// Of 2 x 1 x 3 cells.
    study::SolutionGrid solution_grid(const std::vector<double> &values)
    {
      study::SolutionGrid grid;
      grid.method = "Q1";
      grid.problem = "case1";
      grid.series = "m = 3";
      grid.h = .1;
      grid.horizon = .3;
      grid.lower = {1, 2, 3};
      grid.upper = {2, 3, 4};
      grid.first = {1.1, 2.1, 3.1};
      grid.spacing = .2;
      grid.n = {2, 1, 3};
      grid.n_components = 3;
      grid.values = values;
      return grid;
    }

    void write_json(const study::StudyResults &results, const std::filesystem::path &file)
    {
      base::write_file(file, to_json(results));
    }
  } // namespace

  TEST(ResultsFile, IsTheSameAfterARoundTrip)
  {
    const fixture::Folder folder;
    study::StudyResults results = fixture::results();
    results.maps[0].n_components = 2;
    results.maps[0].solution.assign(results.maps[0].values.size(), -1. / 3);
    results.maps[1].axes = "xz";
    results.solution_grids.push_back(solution_grid({0, 1, 2, 1. / 3, 4, 5}));
    write_json(results, folder.path() / "a.json");
    const study::StudyResults back = read_results(folder.path() / "a.json");

    // Every key takes part: the text written from what was read is the text that was read.
    write_json(back, folder.path() / "b.json");
    EXPECT_EQ(fixture::read(folder.path() / "a.json"), fixture::read(folder.path() / "b.json"));

    // And what was read is what there was, in each part.
    ASSERT_EQ(back.records.size(), results.records.size());
    for (std::size_t i = 0; i < back.records.size(); ++i)
    {
      EXPECT_EQ(back.records[i].key.method, results.records[i].key.method);
      EXPECT_EQ(back.records[i].key.h, results.records[i].key.h);
      EXPECT_EQ(back.records[i].cost.setup_seconds, results.records[i].cost.setup_seconds);
      EXPECT_EQ(back.records[i].cost.n_bonds, results.records[i].cost.n_bonds);
      EXPECT_EQ(back.records[i].notes, results.records[i].notes);
      EXPECT_EQ(back.records[i].texts, results.records[i].texts);
      EXPECT_EQ(back.records[i].failure, results.records[i].failure);
      EXPECT_EQ(study::errors_of(back.records[i]), study::errors_of(results.records[i]));
      ASSERT_EQ(back.records[i].scalars.size(), results.records[i].scalars.size());
      for (const auto &[name, scalar] : results.records[i].scalars)
        EXPECT_EQ(back.records[i][name], scalar.value) << name;
    }
    ASSERT_EQ(back.trends.size(), results.trends.size());
    for (std::size_t i = 0; i < back.trends.size(); ++i)
    {
      EXPECT_EQ(back.trends[i].values, results.trends[i].values);
      EXPECT_EQ(back.trends[i].outcome, results.trends[i].outcome);
      EXPECT_EQ(back.trends[i].plateau, results.trends[i].plateau);
    }
    EXPECT_EQ(back.purpose, results.purpose); // with δ in it
    EXPECT_EQ(back.scene_text, results.scene_text);
    EXPECT_EQ(back.provenance, results.provenance);
    EXPECT_EQ(back.is_complete, results.is_complete);
    ASSERT_EQ(back.references.size(), results.references.size());
    for (std::size_t i = 0; i < results.references.size(); ++i)
    {
      EXPECT_EQ(back.references[i].estimate, results.references[i].estimate);
      EXPECT_EQ(back.references[i].field_estimate, results.references[i].field_estimate);
      EXPECT_EQ(back.references[i].is_of_polygon, results.references[i].is_of_polygon);
    }
    EXPECT_EQ(back.savings.at(0).full.setup_seconds, results.savings.at(0).full.setup_seconds);
    EXPECT_EQ(back.savings.at(0).difference, results.savings.at(0).difference);
    EXPECT_EQ(back.left_out, results.left_out);
    EXPECT_EQ(back.omissions.at(1).what, results.omissions.at(1).what);
    EXPECT_EQ(back.expectations.at(1).holds, false);
    ASSERT_EQ(back.advice.size(), results.advice.size());
    const study::Advice &advice = back.advice.at(3);
    EXPECT_EQ(advice.series, "m = 4");
    EXPECT_EQ(advice.stalling, results.advice.at(3).stalling);
    ASSERT_EQ(advice.choices.size(), 3u);
    EXPECT_EQ(advice.choices[1].target, 1e-4);
    EXPECT_EQ(advice.choices[1].method, "IPA-AC recalibrated");
    EXPECT_EQ(advice.choices[1].h, .0125);
    EXPECT_EQ(advice.choices[1].error, 9.7e-5);
    EXPECT_EQ(advice.choices[1].seconds, 3.2);
    EXPECT_EQ(advice.choices[1].tied, std::vector<std::string>{"Q1"});
    EXPECT_EQ(back.warnings, results.warnings);
    ASSERT_EQ(back.solution_grids.size(), 1u);
    EXPECT_EQ(back.solution_grids[0].upper, results.solution_grids[0].upper);
    EXPECT_EQ(back.solution_grids[0].first, results.solution_grids[0].first);
    EXPECT_EQ(back.solution_grids[0].n, results.solution_grids[0].n);
    EXPECT_EQ(back.solution_grids[0].values, results.solution_grids[0].values);
    ASSERT_EQ(back.maps.size(), results.maps.size());
    for (std::size_t i = 0; i < back.maps.size(); ++i)
    {
      const study::ErrorMap &map = back.maps[i], &written = results.maps[i];
      EXPECT_EQ(map.method, written.method);
      EXPECT_EQ(map.quantity, "cell averages");
      EXPECT_EQ(map.axes, i == 1 ? "xz" : "xy");
      EXPECT_EQ(map.horizon, written.horizon);
      EXPECT_EQ(map.lower, written.lower);
      EXPECT_EQ(map.upper, written.upper);
      EXPECT_EQ(map.n_x, 4u);
      EXPECT_EQ(map.n_y, 3u);
      EXPECT_EQ(map.n_components, written.n_components);
      EXPECT_EQ(map.solution, written.solution);
      ASSERT_EQ(map.values.size(), written.values.size());
      for (std::size_t j = 0; j < map.values.size(); ++j)
        if (std::isfinite(written.values[j]))
          EXPECT_EQ(map.values[j], written.values[j]);
        else
          EXPECT_TRUE(std::isnan(map.values[j]));
    }
  }

  TEST(ResultsFile, KeepsTheExtremesOfNumbers)
  {
    const fixture::Folder folder;
    study::StudyResults results;
    study::Record run;
    run.cost.n_bonds = std::numeric_limits<std::uint64_t>::max();
    run.key.h = .1;
    run.key.horizon = std::nextafter(.3, 1.);
    run.cost.setup_seconds = std::numeric_limits<double>::denorm_min();
    run.cost.solve_seconds = std::numeric_limits<double>::max();
    run.set("nan | exact", std::nan(""));
    results.records = {run};
    study::Trend trend;
    trend.rate = std::numeric_limits<double>::infinity();
    results.trends = {trend};
    write_json(results, folder.path() / "results.json");
    EXPECT_NE(fixture::read(folder.path() / "results.json").find("\"rate\": null"),
              std::string::npos);
    EXPECT_TRUE(std::isnan(read_results(folder.path() / "results.json").trends.at(0).rate));
    const study::Record back = read_results(folder.path() / "results.json").records.at(0);
    EXPECT_EQ(back.cost.n_bonds, run.cost.n_bonds);
    EXPECT_EQ(back.key.h, run.key.h);
    EXPECT_EQ(back.key.horizon, run.key.horizon);
    EXPECT_EQ(back.cost.setup_seconds, run.cost.setup_seconds);
    EXPECT_EQ(back.cost.solve_seconds, run.cost.solve_seconds);
    EXPECT_FALSE(back.has("nan | exact"));
  }

  TEST(ResultsFile, DescribesEveryKeyInSchemaMd)
  {
    const std::string schema_md = fixture::read(PLUMBLINE_SCHEMA);
    ASSERT_FALSE(schema_md.empty());
    const fixture::Folder folder;
    study::StudyResults results = fixture::results();
    for (study::Record &run : results.records)
      for (const auto &[error, value] : study::errors_of(run))
        run.scalars.erase(error); // their keys, and those of the provenance, are the user's
    results.provenance.clear();
    write_json(results, folder.path() / "results.json");
    const std::string json = fixture::read(folder.path() / "results.json");
    std::size_t n_keys = 0;
    for (std::size_t at = json.find("\": "); at != std::string::npos;
         at = json.find("\": ", at + 1))
    {
      const std::size_t begin = json.rfind('"', at - 1) + 1;
      const std::string key = json.substr(begin, at - begin);
      if (key == "cost" || key == "diagnostics")
        continue; // described with their parts
      EXPECT_TRUE(schema_md.find("`" + key + "`") != std::string::npos ||
                  schema_md.find("." + key + "`") != std::string::npos)
          << key;
      ++n_keys;
    }
    EXPECT_GT(n_keys, 1000u);
  }

  TEST(ResultsFile, ReplacesTheFileAndLeavesNoPart)
  {
    const fixture::Folder folder;
    const std::filesystem::path file = folder.path() / "new" / "results.json";
    write_json(fixture::results(), file);
    write_json(study::StudyResults(), file);
    EXPECT_TRUE(read_results(file).records.empty());
    std::size_t n_files = 0;
    for (const auto &entry : std::filesystem::directory_iterator(file.parent_path()))
      n_files += entry.is_regular_file() ? 1 : 0;
    EXPECT_EQ(n_files, 1u);
  }

  TEST(ResultsFile, SaysWhatIsWrongWithAFileAndWhatToDo)
  {
    const fixture::Folder folder;
    const std::filesystem::path file = folder.path() / "results.json";
    const auto expect = [&](const std::string &part)
    {
      const std::string message = error_of(file);
      EXPECT_NE(message.find(part), std::string::npos) << message;
      EXPECT_NE(message.find(file.string()), std::string::npos) << message;
      EXPECT_NE(message.find("; "), std::string::npos) << "no remedy in: " << message;
    };
    expect("cannot be read");
    write(file, "{\"schema\": " + std::to_string(schema) + ", ");
    expect("is not JSON");
    write(file, "[1]");
    expect("is not an object");
    write(file, "{}");
    expect("schema is missing");
    write(file, "{\"schema\": 2}");
    expect("schema = 2");
    write(file, "{\"schema\": " + std::to_string(schema) + "}");
    expect("analysis is missing");

    const auto damaged = [&](const std::string &from, const std::string &to)
    {
      write_json(fixture::results(), file);
      std::string text = fixture::read(file);
      const std::size_t at = text.find(from);
      ASSERT_NE(at, std::string::npos) << from;
      write(file, text.replace(at, from.size(), to));
    };
    damaged("\"outcome\": \"stalls\"", "\"outcome\": \"so so\"");
    expect("trends[0].outcome is not one of converges, stalls, undecided, failed");
    damaged("\"n_unknowns\": 81", "\"n_unknowns\": -81");
    expect("records[0].cost.n_unknowns is not a whole number");
    damaged("\"peak_bytes\":", "\"bytes\":");
    expect("records[0].cost.peak_bytes is missing");
    damaged("\"n_x\": 4", "\"n_x\": 5");
    expect("maps[0].values has 12 numbers, not n_x * n_y = 15");
    damaged("\"solution\": []", "\"solution\": [1]");
    expect("maps[0].solution has 1 numbers, neither none nor n_x * n_y = 12");
    damaged("\"lower\": [", "\"lower\": [3,");
    expect("maps[0].lower is not an array of two numbers");
    damaged("\"h\": 0.1", "\"h\": \"0.1\"");
    expect(".h is not a number");
    damaged("\"h\": 0.1", "\"h\": null");
    expect("h is not a positive length");
    damaged("\"h\": 0.1", "\"h\": 1e400");
    expect(": a number is beyond the range of double precision");
    damaged("\"horizon\": 0.3", "\"horizon\": -0.3");
    expect("horizon is not a positive length");
    damaged("\"x\": [", "\"x\": [0.4,");
    expect("trends[0].values has 5 numbers, not 6");
    damaged("\"rates\": [", "\"rates\": [2,");
    expect("trends[0].rates and one more has 6 numbers, not 5");
    damaged("\"upper\": [\n    2", "\"upper\": [\n    0");
    expect("maps[0] has an upper corner that is not above and right of the lower one");
    study::StudyResults in_space = fixture::results();
    in_space.solution_grids.push_back(solution_grid({0, 1, 2}));
    write_json(in_space, file);
    expect("solution_grids[0].values has 3 numbers, not n_x * n_y * n_z = 6");
    damaged("\"target\": 0.01", "\"target\": null");
    expect("choices[0].target is not a positive number");
    damaged("\"purpose\":", "\"regime\": \"m\", \"purpose\":");
    expect(", line 6: the key 'regime' comes twice in one object");
  }

  TEST(ResultsFile, NestedEverDeeperIsRefused)
  {
    const fixture::Folder folder;
    const std::filesystem::path file = folder.path() / "results.json";
    for (const std::string open : {"{\"a\":", "["})
    {
      std::string deep;
      for (int i = 0; i < 100000; ++i)
        deep += open;
      write(file, deep);
      EXPECT_NE(error_of(file).find("line 1: is nested deeper than 64 levels; run the scene again"),
                std::string::npos)
          << error_of(file);
    }
  }
} // namespace plumbline::io
