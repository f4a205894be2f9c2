#pragma once

#include "scene/scene.h"
#include "study/results.h"

#include <vector>

// What is known of a method's limit apart from a field, beside what errors of the field show.
namespace plumbline::study
{
  /// Of the proofs at two levels the one that promises less.
  const LimitProof &weaker(const LimitProof &a, const LimitProof &b);

  /// Where m grows from level to level, a rule whose weights do not tend to areas need not have the
  /// nonlocal operator for its limit, and fields of low degree do not see it. Towards the local
  /// limit (regime delta-m) second moments decide; those of nodes that come and go at the ball's
  /// edge rise by chance as well, which areas do not. A rule proven wrong at every level by itself
  /// stays so.
  /// @param levels  what is known at each
  /// @return  `incompatible`, or nothing
  LimitProof prove_by_levels(scene::Regime regime, const Trend &trend,
                             const std::vector<LimitProof> &levels);

  /// Holds trend.proof beside trend.outcome: a field may hide what is wrong, never a proof; and a
  /// proof settles what errors leave open, see Leaning. The reason says both.
  void weigh_proof(Trend &trend);
} // namespace plumbline::study
