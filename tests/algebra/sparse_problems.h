// Sparse systems on square lattices, for tests on any number of ranks.
#pragma once

#include "algebra/sparse_system.h"
#include "base/error.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plumbline::algebra
{
  using base::Communicator;

  struct Lattice
  {
    int n = 20;         ///< nodes a side
    double reach = 3.2; ///< horizon over spacing
    unsigned int n_components = 1;
    bool is_symmetric = true; ///< else weights that differ by direction and node
    bool is_tied = true;      ///< to a collar of zero values
  };

  /// Σ_j w(r) e⊗e (u(i) - u(j)) with w = 1 - r/δ; e is 1 for one component, else the bond's
  /// direction.
  inline CsrMatrix matrix(const Lattice &lattice)
  {
    const int n = lattice.n, reach = static_cast<int>(lattice.reach);
    const unsigned int n_components = lattice.n_components;
    CsrMatrix rows;
    rows.start = {0};
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        for (unsigned int c = 0; c < n_components; ++c)
        {
          std::vector<double> own(n_components);
          std::size_t own_entry = 0;
          for (int l = -reach; l <= reach; ++l)
            for (int k = -reach; k <= reach; ++k)
            {
              const double r = std::hypot(k, l);
              const bool is_inside = i + k >= 0 && i + k < n && j + l >= 0 && j + l < n;
              if (r > lattice.reach || !(is_inside || lattice.is_tied))
                continue;
              const double bias = lattice.is_symmetric ? 0 : .4 * std::sin(i + 2. * j + 3 * k + l);
              const double w = (1 - r / lattice.reach) * (1 + bias);
              if (r == 0)
                own_entry = rows.value.size();
              for (unsigned int d = 0; d < n_components; ++d)
              {
                const double e[] = {k / r, l / r};
                const double a = r == 0 ? 0 : n_components == 1 ? w : w * e[c] * e[d];
                own[d] += a;
                if (is_inside)
                {
                  rows.column.push_back(n_components * ((j + l) * n + i + k) + d);
                  rows.value.push_back(-a);
                }
              }
            }
          for (unsigned int d = 0; d < n_components; ++d)
            rows.value[own_entry + d] = own[d];
          rows.start.push_back(rows.value.size());
        }
    return rows;
  }

  inline std::vector<double> times(const CsrMatrix &rows, const std::vector<double> &x)
  {
    std::vector<double> y(rows.n_rows());
    for (std::size_t i = 0; i < y.size(); ++i)
      for (std::size_t e = rows.start[i]; e < rows.start[i + 1]; ++e)
        y[i] += rows.value[e] * x[rows.column[e]];
    return y;
  }

  inline std::vector<double> wave(std::size_t n)
  {
    std::vector<double> x(n);
    for (std::size_t i = 0; i < n; ++i)
      x[i] = std::sin(.01 * static_cast<double>(i)) + .3 * std::cos(1.7 * static_cast<double>(i));
    return x;
  }

  inline double norm(const std::vector<double> &x)
  {
    double sum = 0;
    for (const double value : x)
      sum += value * value;
    return std::sqrt(sum);
  }

  inline double distance(std::vector<double> x, const std::vector<double> &y)
  {
    for (std::size_t i = 0; i < x.size(); ++i)
      x[i] -= y[i];
    return norm(x);
  }

  struct System
  {
    CsrMatrix rows;
    std::vector<double> right_hand_side;
  };

  enum class Spread
  {
    by_shares,
    on_last,
    split ///< every entry among all ranks
  };

  /// This rank's part of a system that all ranks know.
  inline System part(const System &whole, Spread spread, unsigned int n_components,
                     const Communicator &communicator)
  {
    const unsigned int rank = communicator.rank(), n_ranks = communicator.n_ranks();
    const auto [first, last] =
        communicator.owned_range(whole.right_hand_side.size() / n_components);
    System part{{{0}, {}, {}}, whole.right_hand_side};
    for (std::size_t i = 0; i < whole.rows.n_rows(); ++i)
    {
      const std::size_t node = i / n_components;
      double factor = 2. * (rank + 1) / (n_ranks * (n_ranks + 1));
      if (spread == Spread::by_shares)
        factor = first <= node && node < last;
      else if (spread == Spread::on_last)
        factor = rank + 1 == n_ranks;
      part.right_hand_side[i] *= factor;
      for (std::size_t e = whole.rows.start[i]; factor != 0 && e < whole.rows.start[i + 1]; ++e)
      {
        part.rows.column.push_back(whole.rows.column[e]);
        part.rows.value.push_back(factor * whole.rows.value[e]);
      }
      part.rows.start.push_back(part.rows.column.size());
    }
    return part;
  }

  inline SparseSolution solve(const System &system, const SparseOptions &options,
                              const Communicator &communicator = Communicator::all(),
                              Spread spread = Spread::by_shares)
  {
    const System own = part(system, spread, options.n_components, communicator);
    return solve_sparse(own.rows, own.right_hand_side, options, communicator);
  }

  inline System known(const Lattice &lattice)
  {
    const CsrMatrix rows = matrix(lattice);
    return {rows, times(rows, wave(rows.n_rows()))};
  }

  inline SparseOptions with(SparseSolver solver)
  {
    SparseOptions options;
    options.solver = solver;
    return options;
  }

  /// Fails unless every rank gets a NumericalError that says all of the words.
  inline void expect_error(const System &system, const SparseOptions &options,
                           const std::vector<std::string> &words)
  {
    try
    {
      const System own = part(system, Spread::by_shares, options.n_components, Communicator::all());
      solve_sparse(own.rows, own.right_hand_side, options, Communicator::all());
      ADD_FAILURE() << "no error";
    }
    catch (const NumericalError &error)
    {
      for (const auto &word : words)
        EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
  }
} // namespace plumbline::algebra
