#pragma once

#include "analysis/integrate.h"
#include "study/analysis.h"

#include <functional>
#include <optional>
#include <string>

// The one loop of motions in which something breaks: recorded at equal times, with checkpoints.
namespace plumbline::study
{
  using analysis::State;
  using analysis::Vector;

  constexpr unsigned int n_crack_moments = 6;

  struct CrackPlan
  {
    double final_time = 0, step = 0, density = 1;
    std::string scheme;
    std::optional<double> critical_step;
    bool shows_blow_up = false;
    unsigned int n_samples = 6, n_frames = 0;
    unsigned int interval = 1; ///< of checkpoints [samples]
    std::string subject;       ///< of checkpoints: all that they depend on
    Checkpoints checkpoints;

    double time(unsigned int sample) const;
    /// The number of the frame or moment at a sample, of n + 1 or n of them at even distances.
    std::optional<unsigned int> frame(unsigned int sample) const;
    std::optional<unsigned int> moment(unsigned int sample) const;
  };

  /// A motion and the records of it, without its state.
  struct SampledMotion
  {
    std::function<void(const Vector &records)> resume; ///< the state is the checkpoint's already
    std::function<unsigned int()> n_taken;             ///< samples
    std::function<void()> begin;                       ///< take the sample at t = 0
    /// Move to the end and take a sample there. May throw Interrupted before it has changed
    /// anything but the state.
    std::function<void(double end)> advance;
    std::function<void(unsigned int sample)> on_sample; ///< e.g. write a frame
    std::function<Vector()> records;                    ///< for checkpoints
  };

  /// Move from the plan's checkpoint if there is one of the same subject, and write checkpoints on
  /// the way: the result has the same bits wherever it was stopped.
  /// @param state  at t = 0; at the end on return
  /// @throws InputError   a checkpoint that cannot be read or written
  /// @throws Interrupted  after a checkpoint of the last sample
  void run_samples(const CrackPlan &plan, State &state, const SampledMotion &motion);
} // namespace plumbline::study
