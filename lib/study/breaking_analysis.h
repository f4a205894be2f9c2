#pragma once

#include "study/breaking.h"
#include "study/crack_analysis.h"

namespace plumbline::study
{
  /// Move a scene's body (Time/final time, Fracture/toughness) and enter what becomes of it.
  ///
  /// Texts "outcome" and "reason", see judge_breaking, and "scheme". Scalars, of the crack that
  /// went farthest: "advance" [length], "angle" [degree], "branched" [length], "speed"
  /// [length/time], "speed / c_R" and "fastest / c_R", where they are defined; "c_R", "c_T";
  /// "broken bonds", "apart", "first break", "overshoot" (mean of stretch / s0 - 1 when bonds
  /// broke), "energy imbalance", "broken energy" [force], "broken energy / G" (over the sum of
  /// G L, L the length of a straight crack that breaks as many bonds), "energy gained" [force], see
  /// energy_gained, "time step" and others. Curves: "samples" (energies), "breaks", "tip" (of that
  /// crack), "cracks" (one row for each notch), "moments"; field "damage".
  /// @param record  begun
  Record breaking_record(const Place &place, method::MovingBody body,
                         const Checkpoints &checkpoints, const WriteStrip &write, Record record);

  /// Expected/crack, and what is never right: an energy balance that is off by 1 % or more.
  std::vector<Expectation> check_breaking(const Record &record,
                                          const scene::ExpectedSection &expected);
} // namespace plumbline::study
