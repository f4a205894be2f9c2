#pragma once

#include "base/cost.h"
#include "scene/scene.h"
#include "study/study_results.h"

namespace plumbline::study
{
  /// CPU time that a study's references and error estimates take, which no record counts.
  class EstimateCost
  {
  public:
    static constexpr auto name = "cost of estimates"; ///< what the study keeps of it

    /// What `solve` returns, and its time counted.
    template <class Solve>
    auto timed(const Solve &solve)
    {
      const base::CpuTimer timer;
      auto result = solve();
      seconds_ += timer.seconds();
      return result;
    }

    /// Adds this time, and how to avoid it, to the facts of a study if it is at least half of the
    /// total and at least 2 CPU s.
    void tell(const scene::Scene &scene, StudyResults &results) const;

  private:
    double seconds_ = 0;
  };
} // namespace plumbline::study
