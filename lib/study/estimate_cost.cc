#include "study/estimate_cost.h"

#include "base/number_text.h"

namespace plumbline::study
{
  void EstimateCost::tell(const scene::Scene &scene, StudyResults &results) const
  {
    constexpr double long_enough = 2; // CPU s
    constexpr int n_digits = 2;
    double all = seconds_;
    for (const Record &record : results.records)
      all += record.cost.seconds();
    if (seconds_ < long_enough || seconds_ < .5 * all)
      return;
    const bool is_estimated = scene.reference.estimate != scene::Estimate::none;
    results.facts[is_estimated ? "time of the reference and error estimates"
                               : "time of the reference"] =
        base::to_text(seconds_, n_digits) + " of " + base::to_text(all, n_digits) + " CPU s" +
        (is_estimated ? "; for first trials write Reference/estimate = none" : "");
  }
} // namespace plumbline::study
