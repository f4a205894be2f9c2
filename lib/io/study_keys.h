#pragma once

#include "study/study_results.h"

// The keys of trends, proofs and expectations in JSON, see json_archive.h.
namespace plumbline::method
{
  template <typename Archive>
  void visit(Archive &a, LimitProof &proof)
  {
    a("answer", proof.answer);
    a("defect", proof.defect);
    a("mean_defect", proof.mean_defect);
    a("spread", proof.spread);
    a("ball_defect", proof.ball_defect);
    a("area_defect", proof.area_defect);
    a("reason", proof.reason);
  }
} // namespace plumbline::method

namespace plumbline::study
{
  template <typename Archive>
  void visit(Archive &a, Trend &trend)
  {
    a("method", trend.method);
    a("family", trend.family);
    a("problem", trend.problem);
    a("series", trend.series);
    a("variant", trend.variant);
    a("error", trend.error);
    a("parameter", trend.axis);
    a("x", trend.x);
    a("values", trend.values);
    a("size", trend.size);
    a("round_off", trend.round_off);
    a("rates", trend.rates);
    a("rate", trend.rate);
    a("rate_uncertainty", trend.rate_uncertainty);
    a("plateau", trend.plateau);
    a("plateau_uncertainty", trend.plateau_uncertainty);
    a("outcome", trend.outcome);
    a("verdict", trend.verdict);
    a("reason", trend.reason);
    a("proof", trend.proof);
    a("finest", trend.finest);
  }

  template <typename Archive>
  void visit(Archive &a, Expectation &expectation)
  {
    a("subject", expectation.subject);
    a("expected", expectation.expected);
    a("found", expectation.found);
    a("holds", expectation.holds);
  }
} // namespace plumbline::study
