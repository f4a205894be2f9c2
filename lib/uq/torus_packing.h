#pragma once

#include "uq/ellipses.h"

#include <vector>

namespace plumbline::uq
{
  /// Whether two equal ellipses, the second's centre at (dx, dy) from the first's, have a point in
  /// common: λ(1-λ) d·[(1-λ)A + λB]⁻¹d <= 1 for all λ in (0, 1), where A and B are the matrices
  /// with the squared semi-axes as eigenvalues. Accuracy: touching is decided to 1e-12 of the
  /// distance. Source: Perram & Wertheim 1985, doi:10.1016/0021-9991(85)90171-8, eq. 2.5 f.
  bool meet(const std::array<double, 2> &semi_axes, const Ellipses::Ellipse &first,
            const Ellipses::Ellipse &second, double dx, double dy);

  /// Ellipses on a torus that have no point in common.
  class TorusPacking
  {
  public:
    /// @param torus  a box with opposite sides joined, longer than four times the larger semi-axis
    TorusPacking(const std::array<double, 2> &semi_axes, const Box &torus);

    /// Add an ellipse unless it meets one that is there; its centre lies in the box.
    /// @return  whether it was added
    bool add(const Ellipses::Ellipse &ellipse);

  private:
    std::array<double, 2> semi_axes_;
    Box torus_;
    std::array<int, 2> n_bins_{}; ///< no smaller than the larger axis: only neighbours meet
    std::vector<std::vector<Ellipses::Ellipse>> bins_;
  };
} // namespace plumbline::uq
