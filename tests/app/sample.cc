// `plumbline sample`: a random scene at many samples, in processes side by side, what it goes on
// from, and what it refuses.

#include "analysis/checkpoint.h"
#include "command.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

namespace
{
  using namespace plumbline::app;
  using Json = nlohmann::json;

  std::string smooth(int n_levels = 1)
  {
    return "sample " + std::string(PLUMBLINE_SCENES) + "/random/smooth.prm --levels " +
           std::to_string(n_levels) + " --set Sampling/counts=1,3";
  }

  Json results(const fs::path &folder)
  {
    Json json = Json::parse(read(folder / "sample.json"));
    for (Json &one : json["cases"]) // times differ
      for (Json &set : one["sets"])
        set.erase("seconds");
    json.erase("cheapest");
    return json;
  }

} // namespace

TEST(SampleCommand, tells_mean_and_deviation_and_draws_them)
{
  const fs::path folder = temporary("sample");
  const Outcome outcome = run(smooth() + " -o " + folder.string());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  expect_found(outcome.out, "error of the mean");
  const Json json = results(folder);
  EXPECT_EQ(json["n_samples"], 3); // the middle one is in both sets
  const Json &sets = json["cases"][0]["sets"];
  EXPECT_LT(sets[1]["mean_error"], .1 * sets[0]["mean_error"].get<double>());
  const std::string page = read(folder / "sample.html");
  expect_found(page, "<svg");
  expect_found(page, "Error of the mean versus samples");
  for (const char *const name : {"fields.csv", "quantities.csv", "mean-samples.csv"})
    EXPECT_TRUE(fs::exists(folder / "sample" / name)) << name;
  fs::remove_all(folder);
}

TEST(SampleCommand, draws_how_samples_of_equal_weights_are_spread)
{
  const fs::path folder = temporary("sample");
  const Outcome outcome =
      run(smooth() +
          " --quiet --set 'Sampling/rule=quasi-Monte Carlo' --set Sampling/counts=16 "
          "-o " +
          folder.string());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::string name = "histogram-opt-0.125-nodal-l2-local";
  EXPECT_TRUE(fs::exists(folder / "sample" / (name + ".svg")));
  std::istringstream rows(read(folder / "sample" / (name + ".csv")));
  std::string row;
  std::getline(rows, row);
  EXPECT_EQ(row, "from,to,samples");
  int n = 0;
  while (std::getline(rows, row))
    n += std::stoi(row.substr(row.rfind(',') + 1));
  EXPECT_EQ(n, 16);
  fs::remove_all(folder);
}

TEST(SampleCommand, has_the_same_bits_by_any_number_of_processes_and_goes_on)
{
  const fs::path one = temporary("sample_one"), two = temporary("sample_two");
  ASSERT_EQ(run(smooth() + " --quiet -o " + one.string()).exit_code, 0);
  ASSERT_EQ(run(smooth() + " --quiet --jobs 2 -o " + two.string()).exit_code, 0);
  EXPECT_EQ(results(one), results(two));
  // as after a kill: one sample is not there, and one is not whole
  fs::remove(two / "samples/000001.jsonl");
  const auto kept = fs::last_write_time(two / "samples/000000.jsonl");
  fs::remove(two / "sample.json");
  const Outcome again = run(smooth() + " -o " + two.string());
  EXPECT_EQ(again.exit_code, 0) << again.err;
  expect_found(again.err, "continuing: 2 samples");
  EXPECT_EQ(fs::last_write_time(two / "samples/000000.jsonl"), kept);
  EXPECT_EQ(results(one), results(two));
  // samples of another scene are not taken for its own
  const Outcome other = run(smooth() + " --set Study/m=4 -o " + two.string());
  EXPECT_EQ(other.exit_code, 0) << other.err;
  EXPECT_EQ(other.err.find("continuing"), std::string::npos) << other.err;
  EXPECT_NE(results(one)["cases"][0]["sets"], results(two)["cases"][0]["sets"]);
  // nor are those of other levels
  const Outcome levels = run(smooth(2) + " --set Study/m=4 -o " + two.string());
  EXPECT_EQ(levels.exit_code, 0) << levels.err;
  EXPECT_EQ(levels.err.find("continuing"), std::string::npos) << levels.err;
  EXPECT_EQ(results(two)["cases"].size(), 2);
  fs::remove_all(one);
  fs::remove_all(two);
}

TEST(SampleCommand, takes_given_pictures_and_begins_anew_when_one_has_changed)
{
  const fs::path folder = temporary("sample");
  const std::string grain = write("grain.csv", "1,0\n0,0\n"), rim = write("rim.csv", "0,1\n1,1\n");
  const std::string command = "sample " + std::string(PLUMBLINE_SCENES) +
                              "/random/pictures.prm --levels 1 --set Random/modes=0 --set "
                              "Sampling/modes= --set 'Sampling/rule=Monte Carlo' --set "
                              "Sampling/counts=2 --set Random/files=" +
                              grain + "," + rim + " -o " + folder.string();
  const auto mean = [&]
  {
    const Outcome outcome = run(command);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const bool is_continued = outcome.err.find("continuing: 2 samples") != std::string::npos;
    const Json set = results(folder)["cases"][0]["sets"][0];
    return std::pair(is_continued, set["mean_size"].get<double>());
  };
  const auto first = mean();
  EXPECT_FALSE(first.first);
  EXPECT_EQ(mean(), std::pair(true, first.second));
  // stiff all over, so that it moves less
  std::ofstream(grain) << "1,1\n1,1\n";
  const auto changed = mean();
  EXPECT_FALSE(changed.first);
  EXPECT_LT(changed.second, .99 * first.second);
  fs::remove_all(folder);
  fs::remove(grain);
  fs::remove(rim);
}

TEST(SampleCommand, takes_samples_anew_when_the_table_of_the_kernel_has_changed)
{
  const fs::path folder = temporary("sample"), fresh = temporary("fresh");
  const std::string table = write("kernel.csv", "t,rho\n0,1\n1,0\n");
  const std::string scene =
      write("table.prm", "subsection Kernel\n set type = table\n set limit = none\n set table file "
                         "= " +
                             fs::path(table).filename().string() +
                             "\nend\nsubsection Problem\n set load = (1 + a)*sin(3*x)\n set "
                             "constraint = 0\n set local solution = none\nend\n"
                             "subsection Random\n set variables = a: uniform -1 1\nend\n"
                             "subsection Sampling\n set rule = tensor\n set counts = 2\nend\n"
                             "subsection Methods\n set names = IPA-AC-R2\nend\n"
                             "subsection Study\n set regime = m\n set horizon = 0.3\n set h = 0.1\n"
                             "set norms = averages L2\n set decisive error = averages L2 | own "
                             "finest level\nend\n");
  const auto sets = [&](const fs::path &place)
  {
    const Outcome outcome = run("sample " + scene + " -o " + place.string());
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err.find("continuing"), std::string::npos) << outcome.err;
    return results(place)["cases"][0]["sets"];
  };
  const Json first = sets(folder);
  const auto written = fs::last_write_time(table);
  std::ofstream(table) << "t,rho\n0,100\n1,100\n";
  fs::last_write_time(table, written); // as copies and archives have it
  const Json second = sets(folder);
  EXPECT_NE(second, first);
  EXPECT_EQ(second, sets(fresh));
  for (const fs::path &one : {folder, fresh})
    fs::remove_all(one);
  fs::remove(table);
  fs::remove(scene);
}

TEST(SampleCommand, takes_samples_anew_whose_files_are_not_whole)
{
  const fs::path whole = temporary("sample_whole"), broken = temporary("sample_broken");
  ASSERT_EQ(run(smooth() + " --quiet -o " + whole.string()).exit_code, 0);
  fs::copy(whole, broken, fs::copy_options::recursive);
  const fs::path first = broken / "samples/000000.jsonl";
  const std::string record = read(first);
  std::ofstream(first) << record.substr(0, record.size() / 2);
  std::ofstream(broken / "samples/000001.jsonl") << "{}";
  const std::string third = read(broken / "samples/000002.jsonl");
  std::ofstream(broken / "samples/000002.jsonl")
      << third.substr(0, third.find('\n') + 1); // of a subject, without records
  const Outcome outcome = run(smooth() + " -o " + broken.string());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err.find("continuing"), std::string::npos) << outcome.err;
  EXPECT_EQ(results(whole), results(broken));
  std::ofstream(broken / "samples/000002.jsonl") << third.substr(0, third.find('\n') + 1) << "{}\n";
  const Outcome again = run(smooth() + " -o " + broken.string());
  EXPECT_EQ(again.exit_code, 0) << again.err;
  expect_found(again.err, "continuing: 2 samples");
  EXPECT_EQ(results(whole), results(broken));
  fs::remove_all(whole);
  fs::remove_all(broken);
}

TEST(SampleCommand, goes_on_after_it_was_killed_to_the_same_bits)
{
  const fs::path whole = temporary("sample_whole"), killed = temporary("sample_killed");
  const std::string command = smooth(2) + " --quiet --set Sampling/counts=24 -o ";
  ASSERT_EQ(run(command + whole.string()).exit_code, 0);
  ASSERT_TRUE(kill_at(command + killed.string(), killed / "samples/000002.jsonl"))
      << "the run had ended before it was killed";
  EXPECT_FALSE(fs::exists(killed / "sample.json"));
  const auto kept = fs::last_write_time(killed / "samples/000001.jsonl");
  const Outcome resumed = run(command + killed.string());
  ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
  EXPECT_EQ(fs::last_write_time(killed / "samples/000001.jsonl"), kept);
  EXPECT_EQ(results(whole), results(killed));
  fs::remove_all(whole);
  fs::remove_all(killed);
}

TEST(SampleCommand, lets_a_growth_that_was_killed_go_on_from_its_checkpoint_to_the_same_bits)
{
  const fs::path whole = temporary("sample_whole"), killed = temporary("sample_killed"),
                 told = temporary("sample_told"), spoilt = temporary("sample_spoilt"),
                 checkpoint = "samples/sample_1/checkpoint.h5";
  const std::string command = "sample " + std::string(PLUMBLINE_SCENES) +
                              "/glass_ceramics/half_plate.prm --quiet --set Sampling/counts=2 "
                              "--set 'Fracture/largest load=0.2' --set 'Fracture/checkpoint "
                              "interval=7' -o ";
  ASSERT_EQ(run(command + whole.string()).exit_code, 0);
  ASSERT_TRUE(kill_at(command + killed.string(), killed / checkpoint))
      << "the run had ended before it was killed";
  ASSERT_TRUE(fs::exists(killed / checkpoint));
  EXPECT_FALSE(fs::exists(killed / "sample.json"));
  EXPECT_FALSE(fs::exists(killed / "samples/000001.jsonl"));
  for (const fs::path &copy : {told, spoilt})
    fs::copy(killed, copy, fs::copy_options::recursive);
  const auto kept = fs::last_write_time(killed / "samples/000000.jsonl");
  const Outcome resumed = run(command + killed.string());
  ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
  EXPECT_EQ(fs::last_write_time(killed / "samples/000000.jsonl"), kept);
  EXPECT_FALSE(fs::exists(killed / "samples/sample_1")); // no more needed
  EXPECT_EQ(results(killed), results(whole));

  // it does go on from there: what a checkpoint tells of an event is in the end what was
  constexpr std::size_t reaction_before = 2;
  auto events = *plumbline::analysis::read_checkpoint((told / checkpoint).string());
  EXPECT_GT(events.records.size(), 7 * reaction_before);
  events.records[reaction_before] = 1000;
  write_checkpoint((told / checkpoint).string(), events);
  const Outcome retold = run(command + told.string());
  ASSERT_EQ(retold.exit_code, 0) << retold.err;
  const auto peak = [](const fs::path &folder)
  { return results(folder)["cases"][0]["sets"][0]["quantities"]["peak reaction"]["largest"]; };
  EXPECT_LT(peak(whole), 100);
  EXPECT_EQ(peak(told), 1000);

  // one that is not whole is of no use: the sample begins anew
  std::ofstream(spoilt / checkpoint) << "no events";
  const Outcome anew = run(command + spoilt.string());
  ASSERT_EQ(anew.exit_code, 0) << anew.err;
  EXPECT_EQ(results(spoilt), results(whole));
  for (const fs::path &folder : {whole, killed, told, spoilt})
    fs::remove_all(folder);
}

TEST(SampleCommand, compares_rules_with_the_numbers_of_each_alone)
{
  const fs::path both = temporary("sample_both"), sparse = temporary("sample_sparse"),
                 drawn = temporary("sample_drawn");
  const auto command =
      [](const std::string &rule, const std::string &counts, const fs::path &folder)
  {
    return smooth() + " --set 'Sampling/rule=" + rule + "' --set 'Sampling/counts=" + counts +
           "' -o " + folder.string();
  };
  const std::string together = command("Smolyak, Monte Carlo", "0, 1; 4, 8", both);
  ASSERT_EQ(run(together + " --jobs 2").exit_code, 0);
  ASSERT_EQ(run(command("Smolyak", "0, 1", sparse)).exit_code, 0);
  ASSERT_EQ(run(command("Monte Carlo", "4, 8", drawn)).exit_code, 0);
  const Json json = results(both), sets = json["cases"][0]["sets"];
  EXPECT_EQ(json["n_samples"], 3 + 8);
  Json alone = results(sparse)["cases"][0]["sets"];
  const Json of_drawn = results(drawn)["cases"][0]["sets"];
  alone.insert(alone.end(), of_drawn.begin(), of_drawn.end());
  EXPECT_EQ(sets, alone); // to the last bit
  const std::string page = read(both / "sample.html");
  for (const char *const text : {"h = 0.125, Smolyak", "h = 0.125, Monte Carlo",
                                 "needs the fewest samples for an error of the mean"})
    expect_found(page, text);
  // what is there is not taken again
  fs::remove(both / "samples/000009.jsonl");
  const auto kept = fs::last_write_time(both / "samples/000002.jsonl");
  const Outcome again = run(together);
  ASSERT_EQ(again.exit_code, 0) << again.err;
  expect_found(again.err, "continuing: 10 samples");
  EXPECT_EQ(fs::last_write_time(both / "samples/000002.jsonl"), kept);
  EXPECT_EQ(results(both), json);
  for (const fs::path &folder : {both, sparse, drawn})
    fs::remove_all(folder);
}

TEST(SampleCommand, touches_no_files_that_are_not_its_own)
{
  const fs::path folder = temporary("sample");
  fs::create_directories(folder / "samples");
  std::ofstream(folder / "samples/measured.json") << "{}";
  ASSERT_EQ(run(smooth() + " --quiet -o " + folder.string()).exit_code, 0);
  EXPECT_EQ(read(folder / "samples/measured.json"), "{}");
  // they stay also when its own are made anew, which go where there are fewer
  ASSERT_EQ(run(smooth() + " --quiet --set Study/m=4 --set Sampling/counts=1 -o " + folder.string())
                .exit_code,
            0);
  EXPECT_EQ(read(folder / "samples/measured.json"), "{}");
  EXPECT_TRUE(fs::exists(folder / "samples/000000.jsonl"));
  EXPECT_FALSE(fs::exists(folder / "samples/000002.jsonl"));
  ASSERT_EQ(run(smooth() + " --quiet --set Study/m=4 -o " + folder.string()).exit_code, 0);
  EXPECT_EQ(read(folder / "samples/measured.json"), "{}");
  fs::remove_all(folder);
}

TEST(SampleCommand, shares_samples_among_ranks)
{
  const fs::path one = temporary("sample_one"), two = temporary("sample_two");
  ASSERT_EQ(run(smooth() + " --quiet -o " + one.string()).exit_code, 0);
  const Outcome outcome = run_on_two_ranks(smooth() + " --quiet -o " + two.string());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(results(one), results(two));
  fs::remove_all(one);
  fs::remove_all(two);
}

// E = (2 + ...)(2 + 3 ξ), which is negative at the lowest of three points of deviation 1.
TEST(SampleCommand, lists_a_sample_that_fails_and_keeps_the_rest)
{
  const fs::path folder = temporary("sample");
  const std::string command =
      smooth() + " --set 'Random/variables=xi: normal 0 1' --set 'Material/E=2 + 3*xi' -o " +
      folder.string();
  const Outcome outcome = run(command);
  EXPECT_EQ(outcome.exit_code, 3);
  expect_found(outcome.err, "failed: Material/E");
  const Json json = results(folder);
  ASSERT_EQ(json["failures"].size(), 1);
  EXPECT_NEAR(json["failures"][0]["values"][0], -std::sqrt(3.), 1e-14);
  EXPECT_TRUE(json["cases"][0]["sets"][1]["quantities"].empty());
  EXPECT_FALSE(json["cases"][0]["sets"][0]["quantities"].empty());
  expect_found(read(folder / "sample.html"),
               "Failed samples; the results are those of the others.");
  // it is not tried again: it would fail again
  std::map<std::string, fs::file_time_type> written;
  for (const auto &file : fs::directory_iterator(folder / "samples"))
    written[file.path().string()] = fs::last_write_time(file);
  const Outcome again = run(command);
  EXPECT_EQ(again.exit_code, 3);
  expect_found(again.err, "failed: Material/E");
  for (const auto &[file, time] : written)
    EXPECT_EQ(fs::last_write_time(file), time) << file;
  EXPECT_EQ(results(folder), json);
  fs::remove_all(folder);
}

TEST(SampleCommand, charts_the_variance_that_modes_hold)
{
  const fs::path folder = temporary("sample");
  const Outcome outcome = run(
      "sample " + std::string(PLUMBLINE_SCENES) +
      "/failures/twenty_modes.prm --set Study/h=10 --set Random/cell=10 --set Sampling/counts=0 "
      "--set Random/realisations=40 -o " +
      folder.string());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  expect_found(outcome.out, "20 modes hold");
  const Json json = Json::parse(read(folder / "sample.json"));
  double sum = 0;
  for (const Json &share : json["spectrum"])
    sum += share.get<double>();
  EXPECT_EQ(json["spectrum"].size(), 20);
  EXPECT_NEAR(json["variance_kept"], sum, 1e-12);
  expect_found(read(folder / "sample.html"), "Variance of the modes");
  EXPECT_TRUE(fs::exists(folder / "sample/spectrum.csv"));
  fs::remove_all(folder);
  // so do pages of one sample
  const Outcome one = run("grow " + std::string(PLUMBLINE_SCENES) +
                          "/failures/twenty_modes.prm --set Sampling/rule=none --set Study/h=10 "
                          "--set Random/cell=10 --set Random/realisations=40 -o " +
                          folder.string());
  ASSERT_EQ(one.exit_code, 0) << one.err;
  expect_found(read(folder / "grow.html"), "20 modes hold");
  expect_found(read(folder / "grow.html"), "Variance of the modes");
  expect_found(read(folder / "grow.html"), "40 realisations of the field: Random/seed = 1");
  EXPECT_EQ(Json::parse(read(folder / "grow.json"))["records"][0]["scalars"]["field seed"]["value"],
            1);
  fs::remove_all(folder);
  const Outcome statics =
      run("run " + std::string(PLUMBLINE_SCENES) +
          "/random/smooth.prm --levels 1 --set Sampling/rule=none --set Random/field=exponential "
          "--set Random/modes=3 --set Random/length=0.2 --set Random/cell=0.1 -o " +
          folder.string());
  expect_found(statics.err, "3 modes hold 32.5 % of the variance");
  expect_found(read(folder / "report.html"), "3 modes hold");
  fs::remove_all(folder);
}

namespace
{
  /// Columns by their names; empty cells are 0.
  std::map<std::string, std::vector<double>> columns_of(const fs::path &file)
  {
    std::istringstream lines(read(file));
    std::vector<std::string> names;
    std::map<std::string, std::vector<double>> columns;
    std::string line, cell;
    std::getline(lines, line);
    for (std::istringstream cells(line); std::getline(cells, cell, ',');)
      names.push_back(cell);
    while (std::getline(lines, line))
    {
      std::istringstream cells(line);
      for (const std::string &name : names)
      {
        cell.clear();
        std::getline(cells, cell, ',');
        columns[name].push_back(cell.empty() ? 0 : std::stod(cell));
      }
    }
    return columns;
  }
} // namespace

TEST(SampleCommand, refuses_a_file_where_samples_go)
{
  const fs::path folder = temporary("sample");
  fs::create_directories(folder);
  std::ofstream(folder / "samples") << "mine";
  const Outcome outcome = run(smooth() + " -o " + folder.string());
  EXPECT_EQ(outcome.exit_code, 2) << outcome.out;
  expect_found(outcome.err, "samples' is a file, but samples are written to a folder");
  EXPECT_EQ(read(folder / "samples"), "mine");
  EXPECT_FALSE(fs::exists(folder / "sample.json"));
  fs::remove_all(folder);
}

TEST(SampleCommand, writes_weights_and_modes)
{
  const fs::path folder = temporary("sample");
  const Outcome outcome =
      run("sample " + std::string(PLUMBLINE_SCENES) +
          "/random/modes.prm --levels 1 --set Output/fields=true --set Sampling/counts=1,2 --set "
          "Sampling/modes=1,3 -o " +
          folder.string());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  auto weights = columns_of(folder / "sample/weights.csv");
  unsigned int n_sets = 0;
  for (const auto &[name, weight] : weights)
    if (name.find("weight of ") == 0)
    {
      ++n_sets; // a standard normal variable: mean 0 and, from 3 points on, variance 1
      double sum = 0, mean = 0, variance = 0;
      for (std::size_t i = 0; i < weight.size(); ++i)
      {
        const double xi = weights["mode 1"][i];
        sum += weight[i];
        mean += weight[i] * xi;
        variance += weight[i] * xi * xi;
      }
      EXPECT_NEAR(sum, 1, 1e-12) << name;
      EXPECT_NEAR(mean, 0, 1e-12) << name;
      EXPECT_NEAR(variance, 1, 1e-12) << name;
    }
  EXPECT_EQ(n_sets, 4u);
  // modes: the share of the first two, over the grid, is that of the spectrum
  const Json json = Json::parse(read(folder / "sample.json"));
  auto modes = columns_of(folder / "sample/modes.csv");
  const auto squares = [&](const std::string &name)
  {
    double sum = 0;
    for (const double value : modes[name])
      sum += value * value;
    return sum;
  };
  const double whole = squares("standard deviation");
  for (unsigned int k = 0; k < 3; ++k)
    EXPECT_NEAR(squares("mode " + std::to_string(k + 1)) / whole, json["spectrum"][k], 1e-10) << k;
  const auto [least, largest] = std::minmax_element(modes["x"].begin(), modes["x"].end());
  EXPECT_GT(*least, 0);
  EXPECT_LT(*largest, 1);
  fs::remove_all(folder);
}

TEST(SampleCommand, says_what_growths_will_take_before_the_first)
{
  const fs::path folder = temporary("sample");
  const std::string command = "sample " + std::string(PLUMBLINE_SCENES) +
                              "/glass_ceramics/half_plate.prm --set 'Fracture/largest load=0.1'";
  const Outcome outcome = run(command + " --set Sampling/counts=3 -o " + folder.string());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  // 5000 nodes, 350 um to go, 4 um a column, 18 bonds each: 54 log2(5000) entries a node, 3 ns
  expect_found(outcome.err, "3 samples of 5000 nodes: some 16 s each, 47 s in all by 1 process, ");
  expect_found(outcome.err, "straight cracks of 1575 bonds");
  // lengths in two phases are quantities like the others
  const Json quantities = results(folder)["cases"][0]["sets"][0]["quantities"];
  for (const char *const name : {"L1", "L2", "Li"})
    EXPECT_TRUE(quantities.contains(name)) << name;
  // seeds of both: samples' variables, of which there are none, and fields
  const std::string page = read(folder / "sample.html");
  expect_found(page, "Sampling/seed = 1");
  expect_found(page, "Random/seed = 1, realisations 1 to 3");
  const Outcome again = run(command + " --set Sampling/counts=1 -o " + folder.string());
  EXPECT_EQ(again.err.find("of 5000 nodes"), std::string::npos) << again.err; // not worth it
  fs::remove_all(folder);
}

TEST(SampleCommand, refuses_what_does_not_fit_so_many_times)
{
  const std::string scenes = std::string(PLUMBLINE_SCENES),
                    plate = "sample " + scenes + "/glass_ceramics/half_plate.prm",
                    jobs = " --jobs 4096 --set Sampling/counts=4096";
  expect_refused(plate + " --set Study/h=0.04", "Study/h = 0.04 gives a body of 5e+07 nodes");
  const auto drawn = [&](const std::string &command)
  {
    return command + jobs + " --set 'Random/variables=a: normal' --set 'Sampling/rule=Monte Carlo'";
  };
  const std::string smooth_scene = "sample " + scenes + "/random/smooth.prm";
  for (const std::string &command :
       {plate + jobs + " --set Study/h=2",
        smooth_scene + jobs + " --set 'Sampling/rule=Monte Carlo' --set Study/h=0.0078125",
        drawn("sample " + scenes +
              "/griffith/run.prm --set Study/h=0.025,0.003125 --set "
              "'Random/keys=Crack/load: 1.03 + 0.001*a'"),
        drawn("sample " + scenes +
              "/fracture/strip.prm --methods PA-AC --set "
              "'Random/keys=Material/E: 2.5 + 0.1*a'")})
    expect_refused(command, "in each of 4096 processes (--jobs)");
}

TEST(SampleCommand, a_scene_is_run_at_any_sample)
{
  const fs::path folder = temporary("run");
  const std::string scene = std::string(PLUMBLINE_SCENES) + "/random/smooth.prm";
  EXPECT_EQ(
      run("run " + scene + " --levels 1 --quiet --set Random/values=0.1 -o " + folder.string())
          .exit_code,
      0);
  fs::remove_all(folder);
}

TEST(SampleCommand, refuses_what_it_cannot_take)
{
  expect_refused(smooth() + " --set Sampling/rule=none", "Sampling/rule = none");
  expect_refused(smooth() + " --set Sampling/rule=tensor,tensor", "'tensor' occurs twice");
  expect_refused(smooth() + " --set Sampling/counts=2000000", "2e+06 samples, more than");
  expect_refused(smooth() + " --set Sampling/counts=100000", "1e+05 points of a variable");
  expect_refused(smooth() + " --set Sampling/rule=Smolyak --set Sampling/counts=1000000000",
                 "at least 2e+09 samples, more than 1e+06");
}
