// Net forces of surface terms at tips of cracks: what is said of them.
#include "study/tip_forces.h"

#include "study/solution_record.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace plumbline;
using namespace plumbline::study;

namespace
{
  /// One method over levels of horizon 1, 1/2, 1/4, ..., with F = c δ^power about a tip.
  StudyResults swept(double power, std::size_t n_levels = 4, double sum_of_norms = 10)
  {
    StudyResults results;
    for (std::size_t level = 0; level < n_levels; ++level)
    {
      Record run;
      run.key.method = "OPT";
      run.key.problem = "case1";
      run.key.series = "m = 3";
      run.key.horizon = std::pow(.5, level);
      const double F = .07 * std::pow(run.key.horizon, power);
      set_tip_forces(run, {{{.5, 0}, {F, 0}, sum_of_norms, F, F / std::sqrt(run.key.horizon)}});
      results.records.push_back(run);
    }
    return results;
  }
} // namespace

TEST(TipForces, of_the_root_of_the_horizon_are_named)
{
  const std::vector<std::string> findings = tip_force_findings(swept(.5));
  ASSERT_EQ(findings.size(), 1u);
  for (const char *const part :
       {"the surface terms exert a net force at the tip (0.5, 0)", "the order tends to 1/2",
        "OPT F = 0.07 sqrt(horizon)", "consistent or none"})
    EXPECT_NE(findings[0].find(part), std::string::npos) << part << " in " << findings[0];
}

TEST(TipForces, that_vanish_faster_are_rounding_or_are_seen_on_few_levels_are_not)
{
  EXPECT_TRUE(tip_force_findings(swept(1)).empty());
  EXPECT_TRUE(tip_force_findings(swept(.5, 2)).empty());
  EXPECT_TRUE(tip_force_findings(swept(.5, 4, 1e7)).empty());
  StudyResults fixed = swept(.5);
  fixed.regime = scene::Regime::horizon;
  EXPECT_TRUE(tip_force_findings(fixed).empty());
  EXPECT_TRUE(tip_force_findings({}).empty());
}

TEST(TipForces, are_warned_of_once)
{
  StudyResults results = swept(.5);
  results.warnings = {"another"};
  warn_of_tip_forces(results);
  warn_of_tip_forces(results);
  ASSERT_EQ(results.warnings.size(), 2u);
  EXPECT_EQ(results.warnings[0], "another");
}
