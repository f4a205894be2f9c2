#include "algebra/multigrid.h"

#include <deal.II/base/mpi.h>

#include <Epetra_MultiVector.h>
#include <Teuchos_ParameterList.hpp>

#include <algorithm>
#include <cmath>

namespace plumbline::algebra
{
  namespace
  {
    /// Couplings below this fraction of the diagonal do not join nodes into ML's aggregates. At
    /// most .02, which suits finite elements, but below the strongest coupling of all but a few
    /// rows: rows of many small entries would otherwise not be coarsened at all.
    double aggregation_threshold(const CsrView &own, const OwnedRanges &ranges,
                                 unsigned int n_components)
    {
      std::vector<double> strongest(own.n_rows() + 1, 1); // one more, a rank may have none
      for (std::size_t i = 0; i < own.n_rows(); ++i)
      {
        const std::size_t row = ranges.own_first + i;
        double coupling = 0, diagonal = 0;
        for (std::size_t e = own.start[i]; e < own.start[i + 1]; ++e)
          if (own.column[e] == row)
            diagonal = own.value[e];
          else if (own.column[e] / n_components != row / n_components)
            coupling = std::max(coupling, std::abs(own.value[e]));
        strongest[i] = coupling / std::abs(diagonal);
      }
      const auto low = strongest.begin() + strongest.size() / 20;
      std::nth_element(strongest.begin(), low, strongest.end());
      return std::min(.02, .7 * dealii::Utilities::MPI::min(*low, ranges.communicator.mpi));
    }

    /// Modes of little energy: the constants and, where places are known, the rotations.
    struct NearNullSpace
    {
      int dimension;
      std::vector<double> values; ///< shape (dimension, own_size), and one more: a rank may have
                                  ///< no rows, but ML wants values of it
    };

    template <int dim>
    NearNullSpace near_null_space(const OwnedRanges &ranges, unsigned int n_components,
                                  const std::vector<dealii::Point<dim>> &nodes)
    {
      constexpr std::size_t n_planes = dim * (dim - 1) / 2;
      const bool has_rotations = n_components == dim && !nodes.empty();
      const std::size_t n = ranges.own_size,
                        dimension = n_components + (has_rotations ? n_planes : 0);
      NearNullSpace modes{static_cast<int>(dimension), std::vector<double>(dimension * n + 1)};
      for (std::size_t i = 0; i < n; ++i)
      {
        const std::size_t node = (ranges.own_first + i) / n_components,
                          c = (ranges.own_first + i) % n_components;
        modes.values[c * n + i] = 1;
        if (!has_rotations)
          continue;
        const auto arm = nodes[node] - nodes.front();
        std::size_t mode = dim;
        for (unsigned int d = 0; d < dim; ++d)
          for (unsigned int e = d + 1; e < dim; ++e, ++mode)
            if (c == d || c == e)
              modes.values[mode * n + i] = c == d ? -arm[e] : arm[d];
      }
      return modes;
    }
  } // namespace

  template <int dim>
  Multigrid::Multigrid(const CsrView &own, const OwnedRanges &ranges, unsigned int n_components,
                       const std::vector<dealii::Point<dim>> &nodes)
      : entries_(to_trilinos(own, ranges))
  {
    // elliptic, also if not symmetric: measured to be the more robust
    decltype(cycle_)::AdditionalData data;
    data.aggregation_threshold = aggregation_threshold(own, ranges, n_components);
    Teuchos::ParameterList parameters;
    std::unique_ptr<Epetra_MultiVector> deals_own;
    data.set_parameters(parameters, deals_own, entries_);
    NearNullSpace modes = near_null_space(ranges, n_components, nodes);
    parameters.set("null space: type", "pre-computed");
    parameters.set("null space: dimension", modes.dimension);
    parameters.set("null space: vectors", modes.values.data());
    cycle_.initialize(entries_, parameters);
  }

  template Multigrid::Multigrid(const CsrView &, const OwnedRanges &, unsigned int,
                                const std::vector<dealii::Point<2>> &);
  template Multigrid::Multigrid(const CsrView &, const OwnedRanges &, unsigned int,
                                const std::vector<dealii::Point<3>> &);
} // namespace plumbline::algebra
