#include "study/target_words.h"

#include "study/trend.h"

namespace plumbline::study
{
  std::string target_words(const StudyResults &results)
  {
    const auto is = [&](scene::Target target)
    { return is_against(results.decisive_error, target); };
    if (is(scene::Target::local))
      return "the solution of the local limit";
    if (is(scene::Target::finest))
      return "each method's own finest level";
    if (is(scene::Target::reference))
      return "the reference solution" +
             (results.references.empty() ? "" : " by " + results.references.front().method);
    return "the exact solution of the nonlocal problem, Problem/solution";
  }

  bool is_between_models(const StudyResults &results)
  {
    return results.regime == scene::Regime::m &&
           is_against(results.decisive_error, scene::Target::local);
  }
} // namespace plumbline::study
