#pragma once

#include "scene/scene.h"
#include "study/analysis.h"
#include "study/sampling.h"

#include <filesystem>

namespace plumbline::study
{
  /// How samples of a scene are taken: by the analysis that it has or asks for.
  struct SampleTaker
  {
    /// Before there is one.
    /// @param n_jobs  processes that take samples side by side, each with memory of its own
    /// @throws InputError  methods, memory or data that no sample will have
    std::function<void(const scene::Scene &scene, const std::filesystem::path &folder,
                       unsigned int n_jobs)>
        check;
    /// @param own  where the sample alone may keep files while it is taken; gone when it is there
    /// @throws InputError, NumericalError  as the analysis itself
    std::function<Records(const scene::Scene &sample, const std::filesystem::path &own)> take;
  };

  SampleTaker sample_taker(const scene::Scene &scene, const Methods &available);

  /// Whether each sample is an analysis of quasi-static fracture (`grow`).
  bool is_growth(const scene::Scene &scene);
} // namespace plumbline::study
