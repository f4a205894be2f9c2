#include "study/node_warnings.h"

#include "base/number_text.h"
#include "geometry/crack_tips.h"
#include "study/unseen_features.h"

#include <algorithm>

namespace plumbline::study
{
  std::vector<std::string> node_warnings(const scene::Case &one, const method::Methods &methods)
  {
    const problem::Problem<2> &problem = one.problem;
    const bool has_bonds = std::any_of(
        methods.begin(), methods.end(),
        [](const auto &method) { return method->family() == method::MethodFamily::meshfree; });
    std::vector<std::string> warnings = unseen_features(one);
    if (!has_bonds || !problem.cells())
      return warnings;
    for (const geometry::TipOnBonds &tip :
         geometry::tips_on_bonds(problem.damage.cracks, problem.cells()->nodes, problem.horizon()))
      warnings.push_back("h = " + base::to_text(problem.h, 4) + ": " + tip.text(problem.origin));
    return warnings;
  }
} // namespace plumbline::study
