#pragma once

#include "study/analysis.h"
#include "study/crack.h"

#include <functional>
#include <vector>

namespace plumbline::study
{
  /// The strip at the last of some times: u of shape (2, n_nodes), and the nodes' damage.
  using WriteStrip = std::function<void(const std::vector<double> &times,
                                        const std::vector<dealii::Point<2>> &nodes, const Vector &u,
                                        const Vector &damage)>;

  /// Of a scene with a notched strip (section Crack) the threshold of every level, and the crack's
  /// motion at the finest one of the first series.
  ///
  /// Scalars of each level: "G_c" of the law [force/length], "G_c,h / G_c" of the lattice, and
  /// "W H / G_c,h" at the threshold, or the text "no threshold". Where the crack moves, texts
  /// "outcome" and "reason", the scalars of CrackMotion and others; curves "samples" over time and
  /// "moments", the times of the components of the field "damage".
  /// @param write  called at each frame, see TimeSection; empty: there are none
  Analysis crack_analysis(const Checkpoints &checkpoints, const WriteStrip &write = {});
} // namespace plumbline::study
