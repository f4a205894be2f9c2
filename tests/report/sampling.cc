// The page and numbers of `plumbline sample`.

#include "report/sampling_page.h"
#include "tests/report/fixture.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace plumbline::report
{
  namespace
  {
    study::SamplingResults sampled()
    {
      study::SamplingResults r;
      r.scene_name = "ellipses";
      r.sampling.rule = random::SampleRule::monte_carlo;
      r.sampling.seed = 3;
      r.random.field = scene::FieldKind::ellipses;
      r.random.seed = 7;
      r.n_samples = 16;
      r.is_complete = true;
      return r;
    }
  } // namespace

  TEST(SamplingReport, TellsTheSeedsOfSamplesAndOfFields)
  {
    const fixture::Folder folder;
    study::SamplingResults results = sampled();
    write_sampling(results, {}, folder.path());
    for (std::string text : {fixture::read(folder.path() / "sample.html"),
                             fixture::read(folder.path() / "sample.md"), sampling_text(results)})
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
    EXPECT_EQ(sampling_text(results).find("Random/seed"), std::string::npos);
  }
} // namespace plumbline::report
