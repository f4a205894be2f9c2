#pragma once

#include "uq/expansion.h"

#include <functional>

namespace plumbline::uq
{
  /// Writes realisation k, from 0, of a field at the nodes of a grid into `values`, shape (n[1],
  /// n[0]); the same whenever it is asked. Called by several threads at once.
  using Realisation = std::function<void(std::size_t k, std::vector<double> &values)>;

  /// How well.
  struct PassLimit
  {
    unsigned int most_passes = 6; ///< through all realisations, besides the one for their mean
    double tolerance = 1e-8; ///< of a residual, relative to the largest eigenvalue: ends it earlier
  };

  /// The expansion that holds most of the variance of given realisations.
  struct PrincipalComponents
  {
    Expansion expansion;          ///< mean and variance those of the sample (n - 1 in the divisor)
    std::vector<double> residual; ///< ‖C φ - λ φ‖: an eigenvalue is no further from λ [u² length²]
    std::vector<double> kept; ///< variance kept after each pass: its growth tells what is missing
    unsigned int n_passes = 0;
    bool is_settled = false; ///< all residuals are within the tolerance
  };

  /// Principal components of realisations that are made anew in each pass, so that memory holds no
  /// more than 64 of them: eigenvalues of their sample covariance by block Lanczos, the block wider
  /// than the modes are many by 20, which is randomised subspace iteration that throws no block
  /// away; see largest_modes, also for the sign of modes.
  /// Accuracy: eigenvalues come from below, so the variance kept is no more than the best modes
  /// hold. Where they lie close together, as for grains far smaller than the box, it settles long
  /// before the single modes do: to 3e-3 of itself after 6 passes there. Eigenvalues of a sample
  /// are not those of the field: the largest are above by about the share √(modes that matter /
  /// n_realisations).
  ///
  /// Cost: a pass takes the time to make the realisations and 4 (n_modes + 20) operations for each
  /// node of each: 20 modes of 20,000 with grains at 400 × 200 nodes 6 minutes on two cores.
  /// Memory: 64 + 2 n_modes + 7 (n_modes + 20) vectors. The same bits on any number of threads.
  /// Source: Halko, Martinsson & Tropp 2011, doi:10.1137/090771806; Musco & Musco 2015,
  /// arXiv:1504.05477.
  /// @throws InputError  fewer than 2 realisations; n_modes not in [1, min(nodes, realisations -
  /// 1)]; check(grid); not enough memory
  /// @throws NumericalError  a realisation that is not finite, naming it
  PrincipalComponents principal_components(const Grid &grid, std::size_t n_realisations,
                                           const Realisation &realisation, unsigned int n_modes,
                                           const PassLimit &limit = {});
} // namespace plumbline::uq
