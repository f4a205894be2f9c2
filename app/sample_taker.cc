#include "sample_taker.h"

#include "base/error.h"
#include "methods.h"
#include "study/crack_analysis.h"
#include "study/dispersion.h"
#include "study/growth_analysis.h"
#include "study/sample_sweep.h"
#include "study/stability.h"
#include "study/statics.h"
#include "study/stationary_crack.h"
#include "study/transient.h"

namespace plumbline::app
{
  namespace fs = std::filesystem;
  using scene::SampledAnalysis;
  using study::SampleCase;

  namespace
  {
    /// @param ranks  that run a sample together
    SampleTaker study_taker(const study::Analysis &analysis,
                            const base::Communicator &ranks = base::Communicator::alone())
    {
      return {[analysis](const scene::Scene &scene, const fs::path &, unsigned int n_jobs)
              {
                const method::Methods methods =
                    analysis.choose_methods(scene, all_methods(), 0, n_jobs);
                if (analysis.check)
                  analysis.check(scene, methods, 0);
              },
              [analysis, ranks](const scene::Scene &sample, const fs::path &)
              { return study::sample_study(analysis, sample, all_methods(), ranks); }};
    }

    /// Of an analysis that keeps checkpoints.
    SampleTaker long_taker(study::Analysis (*analysis)(const study::Checkpoints &))
    {
      return {[analysis](const scene::Scene &scene, const fs::path &folder, unsigned int n_jobs)
              { (void)analysis({folder}).choose_methods(scene, all_methods(), 0, n_jobs); },
              [analysis](const scene::Scene &sample, const fs::path &own)
              {
                fs::create_directories(own);
                return study::sample_study(analysis({own}), sample, all_methods());
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
                std::vector<SampleCase> cases;
                try
                {
                  cases = take(sample, own);
                }
                catch (const InputError &)
                {
                  if (!is_resumed)
                    throw;
                  fs::remove_all(own, not_there);
                  cases = take(sample, own);
                }
                fs::remove_all(own, not_there);
                return cases;
              }};
    }
  } // namespace

  bool is_growth(const scene::Scene &scene)
  {
    return scene.sampling.analysis == SampledAnalysis::of_scene && scene.fracture.is_there();
  }

  SampleTaker sample_taker(const scene::Scene &scene)
  {
    if (scene.sampling.analysis == SampledAnalysis::stability)
      return study_taker(study::stability_analysis());
    if (scene.sampling.analysis == SampledAnalysis::dispersion)
      return study_taker(study::dispersion_analysis());
    if (is_growth(scene))
      return clean(long_taker([](const study::Checkpoints &own)
                              { return study::growth_analysis(own, {}); }));
    if (scene.crack.is_there())
      return clean(
          long_taker([](const study::Checkpoints &own) { return study::crack_analysis(own); }));
    if (scene.strip.is_there())
      return study_taker(study::strip_analysis());
    if (scene.time.is_dynamic())
      return study_taker(study::transient_analysis(all_methods(), {true, {}}));
    study::StaticsOptions options;
    options.has_fields = true;
    return study_taker(study::statics_analysis(all_methods(), options), base::Communicator::all());
  }
} // namespace plumbline::app
