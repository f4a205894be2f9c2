#include "uq/spectrum.h"

#include "base/number_text.h"

#include <cmath>

namespace plumbline::uq
{
  Spectrum spectrum_of(const Expansion &expansion)
  {
    const double total = expansion.total_variance(),
                 area = expansion.grid.side(0) * expansion.grid.side(1);
    Spectrum spectrum;
    for (unsigned int k = 0; k < expansion.n_modes(); ++k)
    {
      spectrum.share.push_back(total > 0 ? expansion.eigenvalue[k] / total : 0);
      spectrum.kept.push_back(expansion.variance_kept(k + 1));
    }
    spectrum.whole_deviation = std::sqrt(total / area);
    spectrum.deviation = std::sqrt(spectrum.variance_kept() * total / area);
    return spectrum;
  }

  std::string words_of(const Spectrum &spectrum)
  {
    return std::to_string(spectrum.kept.size()) + " modes hold " +
           base::to_text(100 * spectrum.variance_kept(), 3) +
           " % of the variance: the standard deviation of the field is " +
           base::to_text(spectrum.deviation, 3) + " instead of " +
           base::to_text(spectrum.whole_deviation, 3);
  }
} // namespace plumbline::uq
