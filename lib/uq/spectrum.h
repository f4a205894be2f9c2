#pragma once

#include "uq/expansion.h"

#include <string>
#include <vector>

namespace plumbline::uq
{
  /// How much of a field its expansion holds, for reports.
  struct Spectrum
  {
    std::vector<double> share; ///< of the variance that each mode holds, descending
    std::vector<double> kept;  ///< that it holds with all modes before it
    /// Root mean squares over the box of the deviations of the expansion and of the whole field
    /// [u].
    double deviation = 0, whole_deviation = 0;

    double variance_kept() const { return kept.empty() ? 1 : kept.back(); }
    bool is_grey() const { return variance_kept() < .5; } ///< realisations show little of the field
  };

  Spectrum spectrum_of(const Expansion &expansion);

  /// "20 modes hold 4.64 % of the variance: the field deviates by 0.0862 where the whole deviates
  /// by 0.4".
  std::string words_of(const Spectrum &spectrum);
} // namespace plumbline::uq
