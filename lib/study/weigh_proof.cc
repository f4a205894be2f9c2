#include "study/weigh_proof.h"

#include "base/number_text.h"
#include "study/trend.h"

#include <algorithm>

namespace plumbline::study
{
  namespace
  {
    /// A field may hide what is wrong, never a proof; and a proof settles what errors leave open.
    /// While errors are as large as wrong moments make them, the field hides none: errors of other
    /// origin that have the opposite sign fall before they show.
    void settle(Trend &trend)
    {
      constexpr double seen = 1. / 3; // of the error that wrong moments cause
      using Answer = LimitProof::Answer;
      const Answer answer = trend.proof.answer;
      if (answer == Answer::incompatible && trend.outcome == Outcome::converges)
        trend.outcome = trend.values.back() < seen * trend.proof.defect * trend.size
                            ? Outcome::field_only
                            : Outcome::undecided;
      if (trend.finest > 0) // a wrong limit is one
        return;
      if (answer == Answer::incompatible && trend.leaning == Leaning::plateau_or_power)
        trend.outcome = Outcome::stalls;
      else if (answer == Answer::compatible && trend.leaning == Leaning::none_or_plateau)
        trend.outcome = Outcome::converges;
      if (trend.outcome == Outcome::undecided || trend.leaning == Leaning::none)
        return;
      const std::string advice = ", run a finer level";
      if (const std::size_t place = trend.reason.find(advice); place != std::string::npos)
        trend.reason.erase(place, advice.size());
    }

    /// Over the last three levels defects fall slower than the root of x: those of right rules fall
    /// like x or faster, those of wrong ones go up and down.
    bool stay(const std::vector<double> &x, const std::vector<double> &defects)
    {
      constexpr double slowest = .5;
      const auto is_nil = [](double defect) { return defect <= LimitProof::tolerance; };
      return std::none_of(defects.end() - 3, defects.end(), is_nil) &&
             fit_slope({x.end() - 3, x.end()}, {defects.end() - 3, defects.end()}).value < slowest;
    }

    /// What becomes of a defect of the weights from level to level.
    Trend judge_defects(const Trend &trend, const std::vector<double> &defects)
    {
      Trend result;
      result.axis = trend.axis;
      result.x = trend.x;
      result.values = defects;
      result.size = 1;
      result.round_off = LimitProof::tolerance;
      judge(result);
      return result;
    }
  } // namespace

  const LimitProof &weaker(const LimitProof &a, const LimitProof &b)
  {
    using Answer = LimitProof::Answer;
    const auto rank = [](const LimitProof &proof) {
      return proof.answer == Answer::incompatible ? 0 : proof.answer == Answer::unknown ? 1 : 2;
    };
    if (rank(a) != rank(b))
      return rank(a) < rank(b) ? a : b;
    return a.defect > b.defect ? a : b;
  }

  LimitProof prove_by_levels(scene::Regime regime, const Trend &trend,
                             const std::vector<LimitProof> &levels)
  {
    LimitProof proof;
    const auto is_incompatible = [](const LimitProof &level)
    { return level.answer == LimitProof::Answer::incompatible; };
    if (!levels.empty() && std::all_of(levels.begin(), levels.end(), is_incompatible))
      return levels.back(); // whatever the levels
    std::vector<double> of_ball, of_areas;
    for (const LimitProof &level : levels)
    {
      of_ball.push_back(level.ball_defect);
      of_areas.push_back(level.area_defect);
    }
    if (levels.size() < levels_for_verdict || !stay(trend.x, of_areas) ||
        (regime == scene::Regime::delta_m &&
         judge_defects(trend, of_ball).outcome != Outcome::stalls))
      return proof;
    proof = levels.back();
    proof.answer = LimitProof::Answer::incompatible;
    proof.defect = proof.ball_defect;
    proof.reason = "the weights do not tend to the areas of the cells: the mean deviation is " +
                   base::to_text(100 * proof.area_defect, 3) +
                   " %, and the moments deviate from those of the ball by " +
                   base::to_text(100 * proof.ball_defect, 3) + " %";
    return proof;
  }

  void weigh_proof(Trend &trend)
  {
    using Answer = LimitProof::Answer;
    const LimitProof &proof = trend.proof;
    if (proof.reason.empty() || trend.outcome == Outcome::failed)
      return;
    settle(trend);
    std::string beside;
    if (proof.answer == Answer::compatible)
      beside = trend.outcome == Outcome::converges ? "proven: "
               : trend.outcome == Outcome::stalls
                   ? "although its limit is right for every field; look at load, constraint and "
                     "quadrature: "
                   : "its limit is right for every field: ";
    else if (proof.answer == Answer::unknown)
      beside = "not proven: ";
    else
      beside = trend.outcome == Outcome::undecided    ? "its limit is wrong for most fields: "
               : trend.outcome == Outcome::field_only ? "other fields tend to a wrong limit: "
               : proof.area_defect > 0                ? "confirmed by the weights: "
                                                      : "proven: ";
    trend.reason += "; " + beside + proof.reason;
  }
} // namespace plumbline::study
