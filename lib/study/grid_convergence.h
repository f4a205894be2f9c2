#pragma once

#include <limits>
#include <vector>

namespace plumbline::study
{
  /// √(mean of squares); 0 of none.
  double root_mean_square(const std::vector<double> &values);

  /// Values u_i at the same places on grids of mesh sizes h_i, and where they tend to by
  /// Richardson's extrapolation of the three finest ones.
  struct GridConvergence
  {
    /// p of u_i - u = C h_i^p, from root mean squares of differences to the finest grid (see
    /// own_rate); NaN: fewer than three grids, changes that do not fall, or no changes at all.
    double order = std::numeric_limits<double>::quiet_NaN();
    /// Limit less value on the finest grid, place by place: (u_n - u_{n-1}) / ((h_{n-1}/h_n)^p -
    /// 1). Empty: there is no order.
    std::vector<double> correction = {};
    double last_change = 0; ///< the root mean square of u_n - u_{n-1}

    bool is_known() const { return !correction.empty(); }
  };

  /// The change falls by no less than this as h is halved, or else nothing is extrapolated: an
  /// order of .415.
  constexpr double slowest_contraction = .75;

  /// @param h       decreasing
  /// @param values  shape (n_grids, n_values)
  /// @param most    orders above it are taken for it
  GridConvergence grid_convergence(const std::vector<double> &h,
                                   const std::vector<std::vector<double>> &values,
                                   double most = std::numeric_limits<double>::infinity());
} // namespace plumbline::study
