#include "study/crack_warnings.h"

#include "base/number_text.h"
#include "geometry/crack_tips.h"

#include <algorithm>

namespace plumbline::study
{
  std::vector<std::string> tip_warnings(const scene::Problem &problem,
                                        const method::Methods &methods)
  {
    const bool has_bonds =
        std::any_of(methods.begin(), methods.end(),
                    [](const auto &one) { return one->side() == method::Side::meshfree; });
    std::vector<std::string> warnings;
    if (!has_bonds || !problem.cells)
      return warnings;
    for (const geometry::TipOnBonds &tip :
         geometry::tips_on_bonds(problem.damage.cracks, problem.cells->nodes, problem.horizon()))
      warnings.push_back("h = " + base::to_text(problem.h, 4) + ": " + tip.text(problem.origin));
    return warnings;
  }
} // namespace plumbline::study
