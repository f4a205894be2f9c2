// Toughness over a fraction: baselines against published numbers, and what is read of samples.

#include "benchmarks/toughness_study.h"

#include "base/error.h"
#include "scene/scene_file.h"
#include "tests/report/fixture.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace plumbline::toughness
{
  namespace
  {
    using Json = nlohmann::json;
    namespace fixture = report::fixture;

    scene::Scene glass_ceramic(const std::vector<scene::Override> &overrides = {})
    {
      return scene::read_scene(std::string(PLUMBLINE_SCENES) + "/glass_ceramics/half_plate.prm",
                               overrides);
    }

    const std::vector<scene::Override> modes = {{"Random/modes", "20"},
                                                {"Random/cell", "4"},
                                                {"Sampling/rule", "Smolyak"},
                                                {"Sampling/counts", "1"}};

    void write_sample(const fs::path &folder, const scene::Scene &scene, const Json &deviation)
    {
      const Json k = {{"mean", 1.5}, {"deviation", deviation}, {"standard_error", .02}};
      Json json{{"scene", scene.name}, {"scene_text", scene.text}, {"variance_kept", nullptr}};
      if (scene.random.n_modes > 0)
        json["variance_kept"] = .046;
      json["cases"] = {{{"sets",
                         {{{"samples", 41},
                           {"missing", 0},
                           {"seconds", 12},
                           {"quantities", {{"K by bonds", k}, {"K by energy", k}}}}}}}};
      report::write_file(folder / "sample.json", json.dump());
    }
  } // namespace

  // Table 1 of Fan et al. 2022 has .75 and 3.5 beside E, G and nu.
  TEST(Toughness, OfPhasesAndTheirMeansIsThatOfTheTable)
  {
    const Baselines found = baselines(glass_ceramic());
    EXPECT_NEAR(found.mixture(0), .75, 5e-4);
    EXPECT_NEAR(found.mixture(1), 3.5, 5e-4);
    EXPECT_NEAR(found.mixture(.2), .8 * found.mixture(0) + .2 * found.mixture(1), 1e-14);
    EXPECT_NEAR(found.mean_field(0), found.mixture(0), 1e-14);
    EXPECT_NEAR(found.mean_field(1), found.mixture(1), 1e-14);
    // √((1 - f) G1 + f G2) √(((1 - f) E1 + f E2) / (1 - nu²)), GPa um^(1/2)
    EXPECT_NEAR(found.mean_field(.2), std::sqrt(22.542e-3 * 90.6 / .9375), 1e-12);
    EXPECT_NEAR(found.mean_field(.2), 1.476, 5e-4);
    EXPECT_NEAR(found.mean_field(.4), 2.038, 5e-4);
    EXPECT_NEAR(found.mean_field(.6), 2.548, 5e-4);
    EXPECT_NEAR(found.mean_field(.8), 3.032, 5e-4);
  }

  TEST(Toughness, IsReadOfSamplesByRuleAndFraction)
  {
    const fixture::Folder folder;
    std::vector<scene::Override> more = modes;
    more.push_back({"Random/fraction", "0.6"});
    write_sample(folder.path() / "a", glass_ceramic(more), nullptr);
    write_sample(folder.path() / "b", glass_ceramic(modes), .1);
    write_sample(folder.path() / "c", glass_ceramic(), .2);
    const Study study = read_study(folder.path());
    ASSERT_EQ(study.entries.size(), 3u);
    EXPECT_EQ(study.entries[0].rule, "Monte Carlo");
    EXPECT_EQ(study.entries[2].rule, "Smolyak, 20 modes");
    EXPECT_EQ(study.entries[2].fraction, .6);
    EXPECT_FALSE(study.entries[2].by_bonds->deviation);
    EXPECT_EQ(*study.entries[1].variance_kept, .046);
    EXPECT_FALSE(study.entries[0].variance_kept);
    EXPECT_NEAR(study.baselines.second, 3.5, 5e-4);
    const std::string csv = to_csv(study_table(study));
    EXPECT_NE(csv.find("negative variance"), std::string::npos) << csv;
    // baselines, then a line for each rule, with bars
    const auto charts = study_charts(study);
    ASSERT_EQ(charts.size(), 2u);
    ASSERT_EQ(charts[0].plot.lines.size(), 4u);
    EXPECT_EQ(charts[0].plot.lines[2].bars, std::vector<double>{.2});
    EXPECT_EQ(charts[0].plot.lines[3].bars, (std::vector<double>{.1, 0}));
    report::write_charts(charts, folder.path());
    EXPECT_NE(fixture::read(folder.path() / "by-bonds.svg").find("</svg>"), std::string::npos);
    EXPECT_NE(fixture::read(folder.path() / "charts.gp").find("yerrorbars"), std::string::npos);
  }

  TEST(Toughness, OfNoSamplesOrOthersIsRefused)
  {
    const fixture::Folder folder;
    EXPECT_THROW((void)read_study(folder.path()), InputError);
    report::write_file(folder.path() / "a/sample.json", "{\"scene\": 1}");
    EXPECT_THROW((void)read_study(folder.path()), InputError);
  }
} // namespace plumbline::toughness
