#include "uq/karhunen_loeve.h"

#include "base/error.h"
#include "base/number_text.h"
#include "uq/largest_modes.h"
#include "uq/toeplitz.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace plumbline::uq
{
  namespace
  {
    void require_modes(unsigned int n_modes, const Grid &grid)
    {
      check(grid);
      if (n_modes < 1 || n_modes > grid.size())
        throw InputError("a random field on a grid of " + std::to_string(grid.n[0]) + " x " +
                         std::to_string(grid.n[1]) + " nodes has 1 to " +
                         std::to_string(grid.size()) + " modes, not " + std::to_string(n_modes) +
                         "; ask for fewer, or refine the grid");
    }

    /// The largest modes of the covariance matrix, normalised over the box.
    LargestModes grid_modes(const CovarianceFunction &covariance, const Grid &grid,
                            unsigned int n_modes)
    {
      constexpr double rounding = 1e-10; // of eigenvalues, relative to the largest
      const ToeplitzProduct product(covariance, grid);
      ModeSearch search;
      search.n_modes = n_modes;
      LargestModes modes = largest_modes(
          grid.size(), [&](const double *x, double *y, unsigned int n) { product.apply(x, y, n); },
          search);
      if (!modes.is_settled)
        throw NumericalError("the modes of a random field do not settle within " +
                             std::to_string(modes.n_products) +
                             " products; ask for fewer modes, or choose a coarser grid");
      for (double &value : modes.eigenvalue)
      {
        if (value < -rounding * std::abs(modes.eigenvalue[0]))
          throw NumericalError("the covariance of a random field has an eigenvalue of " +
                               base::to_text(value, 3) + " beside a largest of " +
                               base::to_text(modes.eigenvalue[0], 3) +
                               ": it is no covariance; take one that is positive definite");
        value = std::max(value, 0.);
      }
      const double norm = 1 / std::sqrt(grid.cell_area());
      for (std::vector<double> &vector : modes.vector)
        for (double &value : vector)
          value *= norm;
      return modes;
    }

    Expansion without_modes(const Grid &grid, double mean, double variance)
    {
      Expansion expansion;
      expansion.grid = grid;
      expansion.mean.assign(grid.size(), mean);
      expansion.variance.assign(grid.size(), variance);
      return expansion;
    }

    /// The largest products of the modes along x and y.
    void add_products(const LineModes &x, const LineModes &y, unsigned int n_modes,
                      Expansion &expansion)
    {
      std::vector<std::array<std::size_t, 2>> pairs;
      for (std::size_t i = 0; i < x.mode.size(); ++i)
        for (std::size_t j = 0; j < y.mode.size(); ++j)
          pairs.push_back({i, j});
      const auto value = [&](const std::array<std::size_t, 2> &pair)
      { return x.eigenvalue[pair[0]] * y.eigenvalue[pair[1]]; };
      std::stable_sort(pairs.begin(), pairs.end(),
                       [&](const auto &a, const auto &b) { return value(a) > value(b); });
      pairs.resize(n_modes);
      for (const auto &pair : pairs)
      {
        expansion.eigenvalue.push_back(value(pair));
        auto &mode = expansion.mode.emplace_back();
        mode.reserve(expansion.grid.size());
        for (const double along_y : y.mode[pair[1]])
          for (const double along_x : x.mode[pair[0]])
            mode.push_back(along_x * along_y);
      }
    }
  } // namespace

  LineModes karhunen_loeve(const std::function<double(double)> &covariance, double length,
                           unsigned int n, unsigned int n_modes)
  {
    const Grid line{{{0, 0}, {length, 1}}, {static_cast<int>(n), 1}};
    require_modes(n_modes, line);
    LargestModes modes =
        grid_modes([&](double dx, double) { return covariance(dx); }, line, n_modes);
    return {std::move(modes.eigenvalue), std::move(modes.vector)};
  }

  Expansion karhunen_loeve(const CovarianceFunction &covariance, const Grid &grid,
                           unsigned int n_modes, double mean)
  {
    require_modes(n_modes, grid);
    Expansion expansion = without_modes(grid, mean, covariance(0, 0));
    LargestModes modes = grid_modes(covariance, grid, n_modes);
    expansion.eigenvalue = std::move(modes.eigenvalue);
    expansion.mode = std::move(modes.vector);
    return expansion;
  }

  Expansion karhunen_loeve(const Covariance &covariance, const Grid &grid, unsigned int n_modes,
                           double mean)
  {
    check(covariance);
    if (!covariance.is_separable())
      return karhunen_loeve(CovarianceFunction(covariance), grid, n_modes, mean);
    require_modes(n_modes, grid);
    std::array<LineModes, 2> lines;
    for (unsigned int d = 0; d < 2; ++d)
    {
      const double scale = d == 0 ? covariance.variance : 1;
      const auto n = static_cast<unsigned int>(grid.n[d]);
      lines[d] =
          karhunen_loeve([&](double distance) { return scale * covariance.factor(d, distance); },
                         grid.side(d), n, std::min(n, n_modes));
    }
    Expansion expansion = without_modes(grid, mean, covariance.variance);
    add_products(lines[0], lines[1], n_modes, expansion);
    return expansion;
  }
} // namespace plumbline::uq
