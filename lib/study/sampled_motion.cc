#include "study/sampled_motion.h"

#include "analysis/checkpoint.h"

#include <cmath>

namespace plumbline::study
{
  namespace
  {
    /// i if sample is the i-th of `intervals` even parts of all samples, rounded.
    std::optional<unsigned int> part(unsigned int sample, unsigned int n_samples,
                                     unsigned int intervals)
    {
      const double ratio = static_cast<double>(n_samples) / intervals;
      const auto i = static_cast<unsigned int>(std::lround(sample / ratio));
      if (static_cast<unsigned int>(std::lround(i * ratio)) == sample)
        return i;
      return {};
    }
  } // namespace

  double CrackPlan::time(unsigned int sample) const
  {
    return sample == n_samples ? final_time : final_time * sample / n_samples;
  }

  std::optional<unsigned int> CrackPlan::frame(unsigned int sample) const
  {
    if (n_frames == 0)
      return {};
    return part(sample, n_samples, n_frames);
  }

  std::optional<unsigned int> CrackPlan::moment(unsigned int sample) const
  {
    return part(sample, n_samples, n_crack_moments - 1);
  }

  void run_samples(const CrackPlan &plan, State &state, const SampledMotion &motion)
  {
    const std::string file = plan.checkpoints.file().string();
    const auto saved = analysis::read_checkpoint(file);
    if (saved && saved->subject == plan.subject && saved->state.u.size() == state.u.size())
    {
      state = saved->state;
      motion.resume(saved->records);
    }
    const auto write_checkpoint = [&] {
      analysis::write_checkpoint(file, {plan.subject, state, motion.records()});
    };
    if (motion.n_taken() == 0)
    {
      motion.begin();
      motion.on_sample(0);
    }
    for (unsigned int k = motion.n_taken(); k <= plan.n_samples; ++k)
    {
      const State before = state;
      try
      {
        motion.advance(plan.time(k));
      }
      catch (const Interrupted &)
      {
        state = before;
        write_checkpoint();
        throw;
      }
      motion.on_sample(k);
      const bool is_to_stop = k < plan.n_samples && plan.checkpoints.is_to_stop();
      if ((k % plan.interval == 0 && k < plan.n_samples) || is_to_stop)
        write_checkpoint();
      if (is_to_stop)
        throw Interrupted();
    }
  }
} // namespace plumbline::study
