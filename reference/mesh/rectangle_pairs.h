#pragma once

#include "reference/mesh/cell_shapes.h"
#include "reference/mesh/kernel_entries.h"
#include "reference/mesh/pair_blocks.h"

namespace plumbline::reference
{
  /// Blocks of pairs of axis-aligned rectangles, exact to round-off for any two sizes: the double
  /// integral is one over the ball, ∬ C(y - x) φ(x) ψ(y) = ∫_ball C(z) ∫ φ(x) ψ(x + z) dx dz, and
  /// the correlation is a piecewise polynomial, a product over the axes.
  class RectanglePairs
  {
  public:
    /// @param shapes  of quadrilaterals
    RectanglePairs(const CellShapes &shapes, const KernelEntries &profile, double horizon,
                   geometry::Backend backend);

    void integrate(const geometry::Box &outer, const geometry::Box &inner, PairBlocks &blocks);

  private:
    static constexpr unsigned int n_kinds = 3; ///< outer, cross, inner

    struct Piece
    {
      double lower = 0, upper = 0;
      std::vector<double> series[n_kinds]; ///< shape (n_axis, n_axis, n_modes): Legendre
    };

    std::vector<Piece> correlate(double outer_lower, double outer_upper, double inner_lower,
                                 double inner_upper) const;
    void moments(const Piece &x, const Piece &y);
    void find_rule(double ball_radius, const std::array<Point<2>, 4> &corners,
                   const SmoothEntries &kernel);
    void add_moments(const Piece &x, const Piece &y, const SmoothEntries &kernel);
    void contract(const Piece &x, const Piece &y, PairBlocks &blocks);

    const CellShapes &shapes_;
    const KernelEntries &profile_;
    geometry::Ball ball_;
    geometry::Backend backend_;
    unsigned int n_axis_, n_modes_;
    std::vector<double> gauss_points_, gauss_weights_; ///< of the correlations
    std::vector<double> moments_;                      ///< shape (n_entries, modes, modes)
    geometry::CutRule rule_;
  };
} // namespace plumbline::reference
