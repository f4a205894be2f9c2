#include "uq/principal_components.h"

#include "base/error.h"
#include "base/memory.h"
#include "uq/largest_modes.h"

#include <deal.II/base/parallel.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <string>

namespace plumbline::uq
{
  namespace
  {
    using Eigen::Index;
    using Eigen::MatrixXd;
    using Eigen::VectorXd;

    constexpr std::size_t most_at_once = 64; ///< realisations in memory

    /// Do something with all of 0 ... n - 1, on all threads, in pieces that do not depend on their
    /// number, as rounding may on the size of a piece.
    template <class Action>
    void in_pieces(Index n, Index piece, const Action &action)
    {
      dealii::parallel::apply_to_subranges(
          Index(0), (n + piece - 1) / piece,
          [&](Index first, Index last)
          {
            for (Index k = first; k < last; ++k)
              action(k * piece, std::min(piece, n - k * piece));
          },
          1);
    }

    /// All realisations, some at a time.
    class Sample
    {
    public:
      Sample(const Grid &grid, std::size_t n, const Realisation &realisation)
          : size_(static_cast<Index>(grid.size())), n_(n), realisation_(realisation)
      {
      }

      /// Call the action with matrices whose columns are realisations, in their order; it may alter
      /// them.
      template <class Action>
      void for_chunks(const Action &action) const
      {
        MatrixXd chunk(size_, static_cast<Index>(std::min(n_, most_at_once)));
        for (std::size_t start = 0; start < n_; start += most_at_once)
        {
          const std::size_t n = std::min(most_at_once, n_ - start);
          in_pieces(static_cast<Index>(n), 1,
                    [&](Index k, Index)
                    {
                      std::vector<double> values(static_cast<std::size_t>(size_));
                      const std::size_t number = start + static_cast<std::size_t>(k);
                      realisation_(number, values);
                      chunk.col(k) = column(values, number);
                    });
          action(chunk.leftCols(static_cast<Index>(n)));
        }
      }

    private:
      Eigen::Map<const VectorXd> column(const std::vector<double> &values, std::size_t k) const
      {
        const Eigen::Map<const VectorXd> result(values.data(), size_);
        if (values.size() != static_cast<std::size_t>(size_) || !result.allFinite())
          throw NumericalError("realisation " + std::to_string(k) +
                               " of a random field is not a finite number at each of its " +
                               std::to_string(size_) + " nodes");
        return result;
      }

      Index size_;
      std::size_t n_;
      const Realisation &realisation_;
    };

    void check_numbers(const Grid &grid, std::size_t n_realisations, unsigned int n_modes)
    {
      check(grid);
      if (n_realisations < 2)
        throw InputError("principal components need at least 2 realisations, not " +
                         std::to_string(n_realisations) + "; give more");
      const std::size_t most = std::min(grid.size(), n_realisations - 1);
      if (n_modes < 1 || n_modes > most)
        throw InputError(std::to_string(n_realisations) + " realisations at " +
                         std::to_string(grid.size()) + " nodes have 1 to " + std::to_string(most) +
                         " principal components, not " + std::to_string(n_modes) +
                         "; ask for fewer, or give more realisations");
    }

    /// The mean and the variance at each node.
    struct Moments
    {
      VectorXd mean, variance;
    };

    Moments moments(const Sample &sample, Index size, std::size_t n)
    {
      // from the first one on, as a mean that is large beside the deviations would cost digits
      VectorXd first, sum = VectorXd::Zero(size), squares = VectorXd::Zero(size);
      sample.for_chunks(
          [&](const auto &chunk)
          {
            if (first.size() == 0)
              first = chunk.col(0);
            for (Index k = 0; k < chunk.cols(); ++k)
            {
              const VectorXd difference = chunk.col(k) - first;
              sum += difference;
              squares += difference.cwiseAbs2();
            }
          });
      const auto count = static_cast<double>(n);
      const VectorXd variance = (squares - sum.cwiseAbs2() / count) / (count - 1);
      return {first + sum / count, variance.cwiseMax(0.)};
    }

    /// out = (C - mean meanᵀ) in, where C is the mean square of all realisations, times a number.
    void multiply(const Sample &sample, const VectorXd &mean, double scale,
                  const Eigen::Map<const MatrixXd> &in, Eigen::Map<MatrixXd> &out)
    {
      constexpr Index few = 16, strip = 4096; // realisations, nodes
      out.setZero();
      sample.for_chunks(
          [&](auto chunk)
          {
            MatrixXd shares(chunk.cols(), in.cols());
            in_pieces(chunk.cols(), few,
                      [&](Index first, Index n)
                      {
                        chunk.middleCols(first, n).colwise() -= mean;
                        shares.middleRows(first, n).noalias() =
                            scale * (chunk.middleCols(first, n).transpose() * in);
                      });
            in_pieces(in.rows(), strip,
                      [&](Index first, Index n) {
                        out.middleRows(first, n).noalias() += chunk.middleRows(first, n) * shares;
                      });
          });
    }

    void store(const LargestModes &modes, const Moments &moments, Expansion &expansion)
    {
      expansion.mean.assign(moments.mean.begin(), moments.mean.end());
      expansion.variance.assign(moments.variance.begin(), moments.variance.end());
      for (const double value : modes.eigenvalue)
        expansion.eigenvalue.push_back(std::max(value, 0.));
      const double norm = 1 / std::sqrt(expansion.grid.cell_area());
      expansion.mode = modes.vector;
      for (std::vector<double> &mode : expansion.mode)
        for (double &value : mode)
          value *= norm;
    }
  } // namespace

  PrincipalComponents principal_components(const Grid &grid, std::size_t n_realisations,
                                           const Realisation &realisation, unsigned int n_modes,
                                           const PassLimit &limit)
  {
    constexpr unsigned int wider = 20; // Halko et al. take 5 to 10; a pass costs more than columns
    check_numbers(grid, n_realisations, n_modes);
    const auto size = static_cast<Index>(grid.size());
    base::require_memory(8. * static_cast<double>(std::min(n_realisations, most_at_once)) *
                             static_cast<double>(size),
                         std::to_string(most_at_once) + " realisations of a random field at " +
                             std::to_string(size) + " nodes",
                         "choose a coarser grid");
    const Sample sample(grid, n_realisations, realisation);
    const Moments of_sample = moments(sample, size, n_realisations);

    const double scale = grid.cell_area() / static_cast<double>(n_realisations - 1);
    const auto product = [&](const double *x, double *y, unsigned int n_columns)
    {
      Eigen::Map<MatrixXd> out(y, size, n_columns);
      multiply(sample, of_sample.mean, scale, {x, size, n_columns}, out);
    };
    ModeSearch search;
    search.n_modes = n_modes;
    search.block = std::min(n_modes + wider, static_cast<unsigned int>(grid.size()));
    search.most_products = limit.most_passes;
    search.tolerance = limit.tolerance;
    const LargestModes modes = largest_modes(grid.size(), product, search);

    PrincipalComponents result;
    result.residual = modes.residual;
    result.n_passes = modes.n_products;
    result.is_settled = modes.is_settled;
    result.expansion.grid = grid;
    store(modes, of_sample, result.expansion);
    const double total = result.expansion.total_variance();
    for (const double sum : modes.sum_so_far)
      result.kept.push_back(total > 0 ? std::min(1., sum / total) : 1);
    return result;
  }
} // namespace plumbline::uq
