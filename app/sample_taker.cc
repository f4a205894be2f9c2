#include "sample_taker.h"

#include "base/error.h"
#include "base/number_text.h"
#include "methods.h"
#include "study/crack_analysis.h"
#include "study/dispersion.h"
#include "study/growth_analysis.h"
#include "study/preflight.h"
#include "study/sample_sweep.h"
#include "study/stability.h"
#include "study/stationary_crack.h"

#include <algorithm>
#include <cmath>

namespace plumbline::app
{
  namespace fs = std::filesystem;
  using scene::SampledAnalysis;
  using study::SampleCase;

  namespace
  {
    void add_if_finite(SampleCase &one, const std::string &name, double value)
    {
      if (std::isfinite(value))
        one.quantities[name] = value;
    }

    /// Of nodes that stand for h² each.
    template <class Nodes>
    study::SampleField damage_of(const Nodes &nodes, double h, std::vector<double> damage)
    {
      study::SampleField field;
      for (const auto &node : nodes)
      {
        field.x.push_back(node[0]);
        field.y.push_back(node[1]);
        field.area.push_back(h * h);
      }
      field.values = std::move(damage);
      return field;
    }

    std::vector<SampleCase> grow_sample(const scene::Scene &scene, const fs::path &own)
    {
      fs::create_directories(own);
      const study::GrowthResults growth =
          study::grow_body(scene, all_methods(), own / "checkpoint.h5");
      SampleCase one;
      one.method = growth.method;
      one.problem = base::word(growth.rules.breaking);
      one.series = scene.study.series.front().name;
      one.h = growth.h;
      one.horizon = growth.horizon;
      one.seconds = growth.seconds;
      for (const char *const name : scene::growth_quantities)
        add_if_finite(one, name, growth.quantity(name));
      one.field = damage_of(growth.nodes, growth.h, growth.moments.back().damage);
      return {one};
    }

    SampleTaker statics_taker()
    {
      return {[](const scene::Scene &scene, const fs::path &, unsigned int n_jobs)
              {
                const method::Methods available = all_methods();
                study::check_memory(scene, study::choose_methods(scene, available), available, 0,
                                    n_jobs);
                study::check_data(scene);
              },
              [](const scene::Scene &sample, const fs::path &)
              {
                const method::Methods available = all_methods();
                return study::sweep_sample(sample, study::choose_methods(sample, available),
                                           available);
              }};
    }

    SampleTaker motion_taker()
    {
      return {[](const scene::Scene &scene, const fs::path &, unsigned int)
              { study::check_motions(scene, study::choose_methods(scene, all_methods()), 0); },
              [](const scene::Scene &sample, const fs::path &)
              {
                return study::move_sample(sample, study::choose_methods(sample, all_methods()),
                                          all_methods());
              }};
    }

    SampleTaker study_taker(const study::Analysis &analysis)
    {
      return {[analysis](const scene::Scene &scene, const fs::path &, unsigned int n_jobs)
              { (void)analysis.choose_methods(scene, all_methods(), 0, n_jobs); },
              [analysis](const scene::Scene &sample, const fs::path &)
              { return study::sample_study(analysis, sample, all_methods()); }};
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

    SampleTaker growth_taker()
    {
      return {[](const scene::Scene &scene, const fs::path &, unsigned int n_jobs)
              { study::check_growth_size(scene, n_jobs); },
              grow_sample};
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
      return study_taker(study::dispersion_analysis(study::usual_angles));
    if (is_growth(scene))
      return clean(growth_taker());
    if (scene.crack.is_there())
      return clean(
          long_taker([](const study::Checkpoints &own) { return study::crack_analysis(own); }));
    if (scene.strip.is_there())
      return study_taker(study::strip_analysis());
    return scene.time.is_dynamic() ? motion_taker() : statics_taker();
  }
} // namespace plumbline::app
