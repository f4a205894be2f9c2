// `plumbline sample` of each analysis: what is found at samples, against the analysis alone.

#include "command.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace
{
  using namespace plumbline::app;
  using Json = nlohmann::json;

  // A solid of random stiffness, which eigenvalues follow and speeds the root of.
  const char *const solid =
      "subsection Kernel\n set type = 1/r\n set limit = Navier\nend\n"
      "subsection Random\n set variables = e: uniform 1 2\nend\n"
      "subsection Sampling\n set rule = tensor\n set counts = 4\nend\n"
      "subsection Material\n set model = LPS\n set E = e\n set nu = 0.25\nend\n"
      "subsection Methods\n set names = PA-AC, OPT\nend\n"
      "subsection Study\n set h = 0.25, 0.125\n set m = 2\nend\n"
      "subsection Problem\n set solution = x*y, x\nend\n";

  Json sampled(const std::string &file, const std::string &options)
  {
    const fs::path folder = temporary("sampled");
    const Outcome outcome =
        run("sample " + file + " --quiet -o " + folder.string() + ' ' + options);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    for (const auto &left : fs::directory_iterator(folder / "samples")) // of samples themselves
      EXPECT_FALSE(left.is_directory()) << left.path();
    const Json json = Json::parse(read(folder / "sample.json"));
    fs::remove_all(folder);
    return json;
  }

  Json measured(const std::string &command, const std::string &file, const std::string &options)
  {
    const fs::path folder = temporary("measured");
    const Outcome outcome =
        run(command + ' ' + file + " --quiet -o " + folder.string() + ' ' + options);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const Json json = Json::parse(read(folder / (command + ".json")));
    fs::remove_all(folder);
    return json;
  }

  const Json &last_set(const Json &one, const std::string &quantity)
  {
    return one["sets"].back()["quantities"][quantity];
  }

  // of a uniform variable on [1, 2]
  const double mean = 1.5, deviation = 1 / std::sqrt(12.),
               mean_of_root = 2. / 3 * (std::pow(2., 1.5) - 1),
               mean_of_inverse_root = 2 * (std::sqrt(2.) - 1);
} // namespace

TEST(SampledAnalyses, eigenvalues_follow_the_stiffness_and_critical_steps_its_inverse_root)
{
  const std::string file = write("solid.prm", solid);
  const Json samples = sampled(file, "--set Sampling/analysis=stability"),
             alone = measured("stability", file, "--set Random/values=1");
  ASSERT_EQ(samples["cases"].size(), 4u); // two methods, two levels each
  ASSERT_EQ(alone["records"].size(), 4u);
  for (std::size_t i = 0; i < 4; ++i)
  {
    const Json &one = samples["cases"][i], &row = alone["records"][i];
    EXPECT_EQ(one["method"], row["key"]["method"]);
    EXPECT_EQ(one["h"], row["key"]["h"]);
    for (const std::string name : {"smallest eigenvalue", "largest eigenvalue"})
    {
      const double unit = row["scalars"][name]["value"];
      EXPECT_NEAR(last_set(one, name)["mean"], mean * unit, 1e-8 * unit) << i;
      EXPECT_NEAR(last_set(one, name)["deviation"], deviation * unit, 1e-6 * unit) << i;
    }
    const double step = row["scalars"]["critical step"]["value"];
    EXPECT_NEAR(last_set(one, "critical step")["mean"], mean_of_inverse_root * step, 1e-6 * step);
  }
}

TEST(SampledAnalyses, speeds_follow_the_root_of_the_stiffness)
{
  const std::string file = write("solid.prm", solid);
  const Json samples = sampled(file, "--set Sampling/analysis=dispersion --levels 1"),
             alone = measured("dispersion", file, "--set Random/values=1 --levels 1");
  ASSERT_EQ(samples["cases"].size(), 2u);
  for (std::size_t i = 0; i < 2; ++i)
    for (const std::string waves : {"L waves at 0°", "T waves at 0°", "L waves at 22.5°",
                                    "T waves at 22.5°", "L waves at 45°", "T waves at 45°"})
    {
      const std::string name = waves + ": phase speed";
      const double unit = alone["records"][i]["scalars"][name]["value"];
      EXPECT_NEAR(last_set(samples["cases"][i], name)["mean"], mean_of_root * unit, 1e-6 * unit)
          << name;
    }
}

// Lengths of the crack that are random have the mean of those that two strips have.
TEST(SampledAnalyses, standing_cracks_are_those_of_their_strips)
{
  const std::string file = std::string(PLUMBLINE_SCENES) + "/fracture/strip.prm",
                    few = " --methods DGQ0,PA-AC --set Study/h=0.15 ";
  const Json samples =
      sampled(file, few + "--set 'Random/variables=a: uniform' --set Sampling/rule=tensor --set "
                          "Sampling/counts=2 --set 'Random/keys=Strip/crack: 3.6 + 0.15*sign(a)'");
  ASSERT_EQ(samples["cases"].size(), 2u);
  const Json shorter = measured("strip", file, few + "--set Strip/crack=3.45"),
             longer = measured("strip", file, few + "--set Strip/crack=3.75");
  for (std::size_t i = 0; i < 2; ++i)
  {
    const auto found = [&](const Json &strip, const std::string &what) -> double
    { return strip["records"][i]["scalars"][what]["value"]; };
    const double a = found(shorter, "tip energy"), b = found(longer, "tip energy");
    EXPECT_NEAR(last_set(samples["cases"][i], "tip energy")["mean"], .5 * (a + b), 1e-9);
    EXPECT_NEAR(last_set(samples["cases"][i], "tip energy")["deviation"], .5 * std::abs(a - b),
                1e-9);
    EXPECT_NEAR(last_set(samples["cases"][i], "release")["mean"], found(shorter, "release"), 1e-4);
  }
}

// Of two loads about the threshold one lets the crack run.
TEST(SampledAnalyses, cracks_run_above_their_threshold_and_arrest_below)
{
  const std::string file = std::string(PLUMBLINE_SCENES) + "/griffith/arrest.prm";
  const Json samples =
      sampled(file, "--levels 1 --set 'Random/variables=a: uniform' --set "
                    "Sampling/rule=tensor --set Sampling/counts=2 --set 'Random/keys=Crack/load: 1 "
                    "+ 0.06*sign(a)' --set Time/frames=2");
  ASSERT_EQ(samples["cases"].size(), 1u);
  const Json &one = samples["cases"][0];
  EXPECT_EQ(one["method"], "FA");
  EXPECT_NEAR(last_set(one, "runs")["mean"], .5, 1e-12);
  EXPECT_NEAR(last_set(one, "runs")["least"], 0, 0);
  EXPECT_GT(last_set(one, "advance")["largest"], .5);
  EXPECT_LT(last_set(one, "advance")["least"], .1);
  EXPECT_NEAR(last_set(one, "threshold")["deviation"], 0, 1e-12);
}

TEST(SampledAnalyses, are_refused_before_the_first_sample)
{
  const std::string file = write("solid.prm", solid);
  expect_refused("sample " + file +
                     " --set Sampling/analysis=dispersion --set 'Random/field=exponential' --set "
                     "Random/modes=1 --set Random/cell=0.25 --set 'Material/E=e + R' --set "
                     "Domain/mesh=squares",
                 "dispersion");
  expect_refused("sample " + file + " --set Sampling/analysis=waves",
                 "write one of scene, stability, dispersion");
}
