// The page and numbers of `plumbline sample`.

#include "report/sampling_page.h"
#include "scene/scene_file.h"
#include "tests/report/fixture.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace plumbline::report
{
  namespace
  {
    study::SamplingResults sampled()
    {
      study::SamplingResults r;
      r.scene_name = "ellipses";
      r.sampling.rules = {uq::SampleRule::monte_carlo};
      r.sampling.seed = 3;
      r.random.field = scene::FieldKind::ellipses;
      r.random.seed = 7;
      r.n_samples = 16;
      r.is_complete = true;
      return r;
    }
  } // namespace

  TEST(SamplingReport, TellsIntervalsOfMeansOfIndependentSamples)
  {
    study::SamplingResults results = sampled();
    study::CaseStatistics one;
    one.of.method = "OPT";
    one.of.h = .25;
    one.is_finest = true;
    study::SetStatistics set;
    set.n_samples = 4;
    set.quantities["K by bonds"] = uq::statistics({1, 2, 3, 6}, {.25, .25, .25, .25}, true);
    one.sets = {set};
    results.cases = {one};
    const std::string interval = "-0.4374 to 6.437"; // 3 ± 3.18245 √(14/12)
    const fixture::Folder folder;
    write_sampling(results, {}, folder.path());
    for (const std::string &text :
         {fixture::read(folder.path() / "sample.html"), fixture::read(folder.path() / "sample.md"),
          sampling_summary(results, "")})
      EXPECT_NE(text.find(interval), std::string::npos) << text;
    const auto confidence = [&]
    {
      const auto json = nlohmann::json::parse(sampling_json(results));
      return json["cases"][0]["sets"][0]["quantities"]["K by bonds"]["confidence_interval"];
    };
    EXPECT_NEAR(confidence()[0], 3 - 3.182446305 * std::sqrt(14. / 12), 1e-8);
    EXPECT_NEAR(confidence()[1], 3 + 3.182446305 * std::sqrt(14. / 12), 1e-8);
    const Table table = sampling_quantity_table(results);
    const std::string csv = to_csv(table);
    EXPECT_NE(csv.find(",mean from,mean to,"), std::string::npos) << csv;
    // none where samples are not independent
    results.sampling.rules = {uq::SampleRule::tensor};
    results.cases[0].sets[0].quantities["K by bonds"] =
        uq::statistics({1, 2, 3, 6}, {.25, .25, .25, .25}, false);
    EXPECT_TRUE(confidence().is_null());
    EXPECT_EQ(sampling_summary(results, "").find("95 %"), std::string::npos)
        << sampling_summary(results, "");
  }

  TEST(SamplingReport, AnswersFirstAndShowsNothingEmpty)
  {
    study::SamplingResults results = sampled();
    study::CaseStatistics one;
    one.of.method = "FA";
    one.of.h = .25;
    one.is_finest = true;
    study::SetStatistics set;
    set.n_samples = 4;
    set.quantities["runs"] = uq::statistics({0, 0, 1, 1}, {.25, .25, .25, .25}, false);
    set.quantities["threshold"] =
        uq::statistics({.9, .9, .9, .9 + 1e-15}, {.25, .25, .25, .25}, false);
    one.sets = {set};
    results.cases = {one};
    const fixture::Folder folder;
    write_sampling(results, {"runs are 2"}, folder.path());
    const std::string page = fixture::read(folder.path() / "sample.html"),
                      answer =
                          "<p class=\"answer\">Means by FA at h = 0.25 over 4 samples: runs 0.5, "
                          "standard deviation 0.5. Not as expected: runs are 2.</p>";
    EXPECT_LT(page.find(answer), page.find("<section")) << page;
    EXPECT_EQ(page.find("<h2>Results"), std::string::npos); // there are no charts
    const Table table = sampling_quantity_table(results);
    for (const Column &column : table.columns)
      EXPECT_NE(column.head, "problem");
    EXPECT_NE(to_csv(table).find(",least,largest"), std::string::npos) << to_csv(table);
    const auto &row = table.rows.at(1); // constant but for its last digit
    EXPECT_TRUE(std::any_of(row.begin(), row.end(),
                            [](const Cell &cell) { return cell.text == "round-off"; }));
    results.cases[0].sets[0].quantities.clear();
    results.cases[0].sets[0].mean_error = .125;
    results.cases[0].sets[0].count = 2;
    write_sampling(results, {}, folder.path());
    const std::string other = fixture::read(folder.path() / "sample.html");
    EXPECT_EQ(other.find("Quantities at the finest"), std::string::npos);
    EXPECT_NE(other.find("The smallest error of the mean, 0.125 [unit of the field], is that of FA "
                         "at h = 0.25 with count 2."),
              std::string::npos)
        << other;
  }

  TEST(SamplingReport, HasNoDeviationWhereAVarianceIsNegative)
  {
    study::SamplingResults results = sampled();
    study::CaseStatistics one;
    one.of.method = "OPT";
    one.sets.resize(2);
    one.sets[0].deviation_size = .125;
    one.sets[1].mean_size = 1;
    one.sets[1].negative_part = .5;
    one.sets[1].mean_error = .25;
    results.cases = {one};
    const auto sets = nlohmann::json::parse(sampling_json(results))["cases"][0]["sets"];
    EXPECT_EQ(sets[0]["deviation_size"], .125);
    EXPECT_EQ(sets[1]["negative_variance_part"], .5);
    EXPECT_EQ(sets[1]["mean_error"], .25);
    EXPECT_TRUE(sets[1]["deviation_size"].is_null());
    EXPECT_TRUE(sets[1]["deviation_error"].is_null());
    const Table table = sampling_field_table(results);
    const auto column = std::find_if(table.columns.begin(), table.columns.end(),
                                     [](const Column &c) { return c.head == "‖deviation‖"; }) -
                        table.columns.begin();
    EXPECT_EQ(table.rows[0].at(column).text, "0.125");
    EXPECT_EQ(table.rows[1].at(column).text, empty_cell().text);
  }

  TEST(SamplingReport, HasNoMeanOfAFieldWhereThereIsNone)
  {
    study::SamplingResults results = sampled();
    study::CaseStatistics one; // of eigenvalues, say
    one.of.method = "OPT";
    one.sets.resize(1);
    results.cases = {one};
    EXPECT_EQ(to_csv(sampling_field_table(results)).find("‖"), std::string::npos);
    results.cases[0].sets[0].deviation_size = 0; // a field that is 0
    EXPECT_NE(to_csv(sampling_field_table(results)).find("‖mean‖"), std::string::npos);
  }

  TEST(SamplingReport, HasATableOfSamplesWithTheirVariables)
  {
    study::SamplingResults results = sampled();
    results.variables = {"a", "mode 1"};
    study::CaseStatistics one;
    one.of.method = "OPT";
    one.of.series = "m = 3";
    one.of.h = .25;
    one.is_finest = true;
    for (std::size_t i = 0; i < 120; ++i)
    {
      results.points.push_back({.5 * static_cast<double>(i), -1});
      if (i == 1)
        continue; // that failed
      one.samples.push_back(i);
      one.values["K"].push_back(i == 2 ? std::nullopt : std::optional(1000. + i));
    }
    results.cases = {one};
    const fixture::Folder folder;
    results.sampling.rules = {uq::SampleRule::tensor}; // there is no histogram to draw
    write_sampling(results, {}, folder.path());
    const std::string csv = fixture::read(folder.path() / "sample/samples_opt-m-3-0.25.csv");
    EXPECT_EQ(csv.substr(0, csv.find("4,2,")), "sample,a,mode 1,K\n0,0,-1,1000\n2,1,-1,\n"
                                               "3,1.5,-1,1003\n");
    EXPECT_NE(csv.find("\n119,59.5,-1,1119\n"), std::string::npos);
    const std::string page = fixture::read(folder.path() / "sample.html");
    EXPECT_NE(page.find("Samples of OPT, m = 3, h = 0.25: the first 100 of 119"),
              std::string::npos);
    EXPECT_NE(page.find(">1100<"), std::string::npos); // the hundredth
    EXPECT_EQ(page.find(">1101<"), std::string::npos);
  }

  TEST(SamplingReport, TellsWhereSamplesAndMeshBalance)
  {
    study::SamplingResults results = sampled();
    results.balance = {{"OPT", "u", "m = 3", .5, 0, 8, .02, 2},
                       {"OPT", "u", "m = 3", .25, 0, 8, .005, std::nullopt}};
    const fixture::Folder folder;
    write_sampling(results, {}, folder.path());
    for (std::string text :
         {fixture::read(folder.path() / "sample.html"), fixture::read(folder.path() / "sample.md"),
          sampling_summary(results, "")})
    {
      std::replace(text.begin(), text.end(), '\n', ' '); // it may be wrapped
      text.erase(std::unique(text.begin(), text.end(),
                             [](char a, char b) { return a == ' ' && b == ' '; }),
                 text.end());
      EXPECT_NE(text.find("h = 0.5: beyond count 2 more samples do not reduce the error"),
                std::string::npos)
          << text;
      EXPECT_NE(text.find("h = 0.25: samples still limit the error of the mean, 0.005 at count 8"),
                std::string::npos)
          << text;
    }
    const auto json = nlohmann::json::parse(sampling_json(results))["balance"];
    EXPECT_EQ(json[0]["enough"], 2);
    EXPECT_EQ(json[0]["largest"], 8);
    EXPECT_TRUE(json[1]["enough"].is_null());
    EXPECT_EQ(json[1]["error"], .005);
  }

  TEST(SamplingReport, DrawsHistogramsOfSamplesOfEqualWeights)
  {
    study::SamplingResults results = sampled();
    study::CaseStatistics one;
    one.of.method = "OPT";
    one.of.h = .25;
    one.values["K by bonds"] = {0,   .5,  .5,  1.5, 1.5, 1.5, 2.5, 3.5,
                                3.5, 3.5, 3.5, 4.5, 5.5, 5.5, 5.5, 6};
    results.cases = {one};
    for (const auto rule : {uq::SampleRule::monte_carlo, uq::SampleRule::quasi_monte_carlo})
    {
      results.sampling.rules = {rule};
      const std::vector<DataChart> charts = sampling_charts(results);
      ASSERT_EQ(charts.size(), 1u);
      EXPECT_EQ(charts[0].name, "histogram-opt-0.25-k-by-bonds");
      EXPECT_TRUE(fixture::has_units(charts[0].plot));
      EXPECT_EQ(to_csv(charts[0].data),
                "from,to,samples\n0,1,3\n1,2,3\n2,3,1\n3,4,4\n4,5,1\n5,6,4\n");
    }
    results.sampling.rules = {uq::SampleRule::tensor}; // whose weights differ
    EXPECT_TRUE(sampling_charts(results).empty());
  }

  TEST(SamplingReport, DrawsWhatDependsOnAnEquidistantVariable)
  {
    study::SamplingResults results = sampled();
    results.variables = {"nu"};
    results.points = {{.5}, {.25}, {.375}};
    study::CaseStatistics one;
    one.of.method = "OPT";
    one.of.series = "m = 3";
    one.of.h = .25;
    one.samples = {0, 1, 2};
    one.values["nodal L2 | exact"] = {.75, .125, std::nullopt};
    one.values["K"] = {-1, 2, 3};
    results.cases = {one};
    results.sampling.rules = {uq::SampleRule::tensor};
    EXPECT_TRUE(sampling_charts(results).empty());
    results.sampling.rules = {uq::SampleRule::equidistant};
    const std::vector<DataChart> charts = sampling_charts(results);
    ASSERT_EQ(charts.size(), 2u);
    EXPECT_EQ(charts[0].name, "over-nu-k");
    EXPECT_TRUE(fixture::has_units(charts[0].plot));
    EXPECT_FALSE(charts[0].plot.is_y_log);
    EXPECT_EQ(charts[1].name, "over-nu-nodal-l2-exact");
    EXPECT_TRUE(charts[1].plot.is_y_log);
    ASSERT_EQ(charts[1].plot.lines.size(), 1u);
    ASSERT_EQ(charts[1].plot.lines[0].points.size(), 2u);
    EXPECT_EQ(charts[1].plot.lines[0].points[0].x, .25);
    EXPECT_EQ(charts[1].plot.lines[0].points[0].y, .125);
    EXPECT_EQ(
        to_csv(charts[1].data),
        "method,case,series,h,nu,value\nOPT,,m = 3,0.25,0.5,0.75\nOPT,,m = 3,0.25,0.25,0.125\n");
    EXPECT_NE(sampling_summary(results, "").find("The variables are not random"),
              std::string::npos);
    EXPECT_EQ(sampling_summary(results, "").find("noise"), std::string::npos);
    results.variables = {"nu", "a"}; // a chart has room for one
    EXPECT_TRUE(sampling_charts(results).empty());
  }

  TEST(SamplingReport, ComparesRulesOnOnePage)
  {
    study::SamplingResults results = sampled();
    study::CaseStatistics one;
    one.of.method = "OPT";
    one.of.h = .25;
    one.is_finest = true;
    for (const auto rule : {uq::SampleRule::smolyak, uq::SampleRule::monte_carlo})
      for (const unsigned int count : {1, 2})
      {
        study::SetStatistics set;
        set.rule = rule;
        set.count = count;
        set.n_samples = rule == uq::SampleRule::smolyak ? 4 * count : 40 * count;
        set.mean_error = 1. / static_cast<double>(set.n_samples);
        set.deviation_size = set.seconds = 1;
        set.standard_error = .5;
        set.quantities["K"] = uq::statistics({1, 2}, {.5, .5}, false);
        one.sets.push_back(set);
      }
    results.cases = {one};
    const Table alone = sampling_field_table(results);
    EXPECT_EQ(to_csv(alone).find("rule"), std::string::npos); // there is one
    results.sampling.rules = {uq::SampleRule::smolyak, uq::SampleRule::monte_carlo};
    results.comparisons = {{"OPT",
                            "",
                            "",
                            .25,
                            "mean",
                            .125,
                            {{uq::SampleRule::smolyak, 8}, {uq::SampleRule::monte_carlo, 40}}},
                           {"OPT",
                            "",
                            "",
                            .25,
                            "deviation",
                            .5,
                            {{uq::SampleRule::smolyak, 4}, {uq::SampleRule::monte_carlo, 80}}}};
    const std::vector<DataChart> charts = sampling_charts(results);
    ASSERT_EQ(charts.size(), 1u); // one h, and one time
    EXPECT_EQ(charts[0].name, "mean-samples");
    ASSERT_EQ(charts[0].plot.lines.size(), 2u);
    for (const auto &[i, label, first] :
         {std::tuple{0, "h = 0.25, Smolyak", 4.}, std::tuple{1, "h = 0.25, Monte Carlo", 40.}})
    {
      EXPECT_EQ(charts[0].plot.lines[i].label, label);
      ASSERT_EQ(charts[0].plot.lines[i].points.size(), 2u);
      EXPECT_EQ(charts[0].plot.lines[i].points[0].x, first);
    }
    EXPECT_NE(to_csv(charts[0].data).find("value,rule\nOPT,0.25,0,4,1,0.25,Smolyak\n"),
              std::string::npos)
        << to_csv(charts[0].data);
    for (const Table &table : {sampling_field_table(results), sampling_quantity_table(results)})
    {
      EXPECT_NE(to_csv(table).find(",rule,"), std::string::npos);
      EXPECT_NE(to_csv(table).find(",Monte Carlo,"), std::string::npos);
    }
    const fixture::Folder folder;
    write_sampling(results, {}, folder.path());
    const std::string page = fixture::read(folder.path() / "sample.html");
    for (const char *const text :
         {"Sampling rules: Smolyak (growth odd), Monte Carlo (Sampling/seed = 3)",
          "Weights w of the largest set by Smolyak", "Weights w of the largest set by Monte Carlo",
          "h = 0.25: Smolyak needs the fewest samples for an error of the mean that all rules "
          "reach, "
          "0.125 (Smolyak 8, Monte Carlo 40 samples)",
          "an error of the deviation that all rules reach, 0.5 (Smolyak 4, Monte Carlo 80 "
          "samples)"})
      EXPECT_NE(page.find(text), std::string::npos) << text;
    const auto json = nlohmann::json::parse(sampling_json(results));
    EXPECT_EQ(json["rule"], "Smolyak, Monte Carlo");
    EXPECT_EQ(json["cases"][0]["sets"][2]["rule"], "Monte Carlo");
    EXPECT_EQ(json["comparisons"][1]["samples"]["Monte Carlo"], 80);
  }

  TEST(SamplingReport, SummarisesIn25LinesOf120Columns)
  {
    study::SamplingResults results = sampled();
    results.findings = {"a long finding " + std::string(60, 'a') + " " + std::string(90, 'b') +
                            " " + std::string(100, 'c') + " " + std::string(100, 'd'),
                        "one two", "three", "four", "five"};
    for (unsigned int i = 0; i < 40; ++i)
    {
      study::CaseStatistics one;
      one.of.method = "method with a long name " + std::to_string(i);
      one.of.problem = std::string(50, 'u');
      one.of.h = .25;
      study::SetStatistics set;
      for (const char *name : {"energy of the whole body", "reaction force", "K by bonds"})
        set.quantities[name] = uq::statistics({1, 2, 3, 6}, {.25, .25, .25, .25}, true);
      one.sets = {set};
      results.cases.push_back(one);
    }
    std::istringstream text(sampling_summary(results, "results/x/sample.html"));
    std::string line;
    std::size_t n_lines = 0;
    while (std::getline(text, line))
    {
      ++n_lines;
      EXPECT_LE(std::count_if(line.begin(), line.end(),
                              [](char c)
                              { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }),
                120)
          << line;
    }
    EXPECT_LE(n_lines, 25u);
    EXPECT_NE(text.str().find("2 more findings in the report"), std::string::npos) << text.str();
    EXPECT_NE(text.str().find("more rows in the report"), std::string::npos) << text.str();
  }

  TEST(SamplingReport, TellsTheSeedsOfSamplesAndOfFields)
  {
    const fixture::Folder folder;
    study::SamplingResults results = sampled();
    write_sampling(results, {}, folder.path());
    for (std::string text :
         {fixture::read(folder.path() / "sample.html"), fixture::read(folder.path() / "sample.md"),
          sampling_summary(results, "")})
    {
      std::replace(text.begin(), text.end(), '\n', ' '); // it may be wrapped
      EXPECT_NE(text.find("Sampling/seed = 3"), std::string::npos) << text;
      EXPECT_NE(text.find("Random/seed = 7, realisations 1 to 16"), std::string::npos) << text;
    }
    auto json = nlohmann::json::parse(fixture::read(folder.path() / "sample.json"));
    EXPECT_EQ(json["seed"], 3);
    EXPECT_EQ(json["field_seed"], 7);
    results.random = {};
    json = nlohmann::json::parse(sampling_json(results));
    EXPECT_TRUE(json["field_seed"].is_null());
    EXPECT_EQ(sampling_summary(results, "").find("Random/seed"), std::string::npos);
  }
} // namespace plumbline::report
