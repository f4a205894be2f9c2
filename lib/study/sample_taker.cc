#include "study/sample_taker.h"

#include "base/error.h"
#include "study/crack_analysis.h"
#include "study/dispersion.h"
#include "study/growth_analysis.h"
#include "study/sample_sweep.h"
#include "study/stability.h"
#include "study/statics.h"
#include "study/stationary_crack.h"
#include "study/transient.h"

namespace plumbline::study
{
  namespace fs = std::filesystem;
  using scene::SampledAnalysis;

  namespace
  {
    /// @param ranks  that run a sample together
    SampleTaker study_taker(const Analysis &analysis, const Methods &available,
                            const base::Communicator &ranks = base::Communicator::alone())
    {
      return {
          [analysis, available](const scene::Scene &scene, const fs::path &, unsigned int n_jobs)
          {
            const method::Methods methods = analysis.choose_methods(scene, available, 0, n_jobs);
            if (analysis.check)
              analysis.check(scene, methods, 0);
          },
          [analysis, available, ranks](const scene::Scene &sample, const fs::path &)
          { return sample_study(analysis, sample, available, ranks); }};
    }

    /// Of an analysis that keeps checkpoints.
    SampleTaker long_taker(Analysis (*analysis)(const Checkpoints &), const Methods &available)
    {
      return {[analysis, available](const scene::Scene &scene, const fs::path &folder,
                                    unsigned int n_jobs)
              { (void)analysis({folder}).choose_methods(scene, available, 0, n_jobs); },
              [analysis, available](const scene::Scene &sample, const fs::path &own)
              {
                fs::create_directories(own);
                return sample_study(analysis({own}), sample, available);
              }};
    }

    /// Without its files when it is there. What it goes on from may be of no use to it: it then
    /// begins anew, as a sample does whose record is not whole, for what fails is not tried again,
    /// whatever becomes of its checkpoint.
    SampleTaker clean(SampleTaker taker)
    {
      return {taker.check, [take = taker.take](const scene::Scene &sample, const fs::path &own)
              {
                const bool is_resumed = fs::exists(own / "checkpoint.h5");
                std::error_code not_there;
                Records records;
                try
                {
                  records = take(sample, own);
                }
                catch (const InputError &)
                {
                  if (!is_resumed)
                    throw;
                  fs::remove_all(own, not_there);
                  records = take(sample, own);
                }
                fs::remove_all(own, not_there);
                return records;
              }};
    }
  } // namespace

  bool is_growth(const scene::Scene &scene)
  {
    return scene.sampling.analysis == SampledAnalysis::of_scene && scene.fracture.is_there();
  }

  SampleTaker sample_taker(const scene::Scene &scene, const Methods &available)
  {
    if (scene.sampling.analysis == SampledAnalysis::stability)
      return study_taker(stability_analysis(), available);
    if (scene.sampling.analysis == SampledAnalysis::dispersion)
      return study_taker(dispersion_analysis(), available);
    if (is_growth(scene))
      return clean(
          long_taker([](const Checkpoints &own) { return growth_analysis(own, {}); }, available));
    if (scene.crack.is_there())
      return clean(
          long_taker([](const Checkpoints &own) { return crack_analysis(own); }, available));
    if (scene.strip.is_there())
      return study_taker(strip_analysis(), available);
    if (scene.time.is_dynamic())
      return study_taker(transient_analysis(available, {true, {}}), available);
    StaticsOptions options;
    options.has_fields = true;
    return study_taker(statics_analysis(available, options), available, base::Communicator::all());
  }
} // namespace plumbline::study
