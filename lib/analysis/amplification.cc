#include "analysis/amplification.h"

#include <algorithm>
#include <cmath>
#include <complex>

namespace plumbline::analysis
{
  double spectral_radius(const Scheme &scheme, double lambda, double step)
  {
    const std::complex<double> root = std::sqrt(std::complex<double>(lambda)) * step;
    if (scheme.substeps.empty())
    {
      // (δ, δ') have the eigenvalues ±√λ, which the step maps to (1 + (1-θ) μ) / (1 - θ μ)
      const auto factor = [&](const std::complex<double> &mu)
      { return std::abs(1. + (1 - scheme.theta) * mu) / std::abs(1. - scheme.theta * mu); };
      return std::max(factor(root), factor(-root));
    }
    double columns[2][2] = {{1, 0}, {0, 1}}; // (δ, Δt δ') from the unit vectors
    for (const Substep &substep : scheme.substeps)
      for (double(&column)[2] : columns)
        if (substep.is_kick)
          column[1] += substep.coefficient * lambda * step * step * column[0];
        else
          column[0] += substep.coefficient * column[1];
    // the determinant of the step is 1
    const std::complex<double> half = .5 * (columns[0][0] + columns[1][1]),
                               difference = std::sqrt(half * half - 1.);
    return std::max(std::abs(half + difference), std::abs(half - difference));
  }
} // namespace plumbline::analysis
