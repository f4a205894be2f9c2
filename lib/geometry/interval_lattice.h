#pragma once

#include "geometry/interval.h"

#include <optional>
#include <vector>

namespace plumbline::geometry
{
  /// The cells of length h of Ω, a union of intervals: the counterpart of Lattice on a line. All
  /// else within reach of the horizon is the interaction domain.
  class IntervalLattice
  {
  public:
    /// @throws InputError  h <= 0; no interval; ends that are not multiples of h apart; more than
    /// 1e6 cells
    IntervalLattice(std::vector<Interval> pieces, double h);

    /// The same intervals with cells of another length.
    IntervalLattice at_spacing(double h) const { return {pieces_, h}; }

    double h() const { return h_; }
    int n_cells() const { return static_cast<int>(is_inside_.size()); } ///< of the hull
    std::size_t size() const { return size_; }                          ///< cells of Ω
    bool is_inside(int i) const
    {
      return i >= 0 && i < n_cells() && is_inside_[static_cast<std::size_t>(i)] != 0;
    }
    const std::vector<Interval> &pieces() const { return pieces_; }

    /// The coordinate that is so many cells from the lower end of the hull.
    double coordinate(double s) const { return origin_ + h_ * s; }

    /// A cell of Ω that contains a point or ends there, to 1e-9 h; none outside Ω.
    std::optional<int> cell_at(double x) const;

    /// visit(cell) for the cells of Ω.
    template <class Visit>
    void for_each_cell(const Visit &visit) const
    {
      for (int i = 0; i < n_cells(); ++i)
        if (is_inside(i))
          visit(i);
    }

  private:
    std::vector<Interval> pieces_;
    double h_, origin_ = 0;
    std::size_t size_ = 0;
    std::vector<char> is_inside_; ///< shape (n_cells)
  };
} // namespace plumbline::geometry
