#pragma once

#include "geometry/visibility.h"
#include "physics/coefficient.h"
#include "reference/mesh/cells.h"
#include "reference/mesh/kernel_entries.h"
#include "reference/mesh/pair_blocks.h"
#include "reference/mesh/shape_rules.h"
#include "reference/mesh/space.h"

#include <memory>
#include <optional>

namespace plumbline::reference
{
  /// Blocks of any pair of cells by quadrature: outer points x on E, and on ball(x) ∩ E' a rule
  /// that is exact on the curved piece: few points on whole cells, a fan of curved triangles on cut
  /// ones, polar about x where the kernel has a kink or a singularity there. Zero row sums by
  /// construction: the same points serve the three blocks.
  /// The inner integral is only piecewise smooth in x: it has kinks where the circle, or one of
  /// those where the profile has a break, crosses a vertex of E' or touches a side. There E is
  /// halved `refinement` times, elsewhere a third as often. On the boundary of E' it behaves like d
  /// log d (kernels like 1/r) or better: parts of E there take points that crowd towards their
  /// sides. Accuracy: where the circle comes to touch a side the integral is like d^(3/2), so that
  /// two refinements gain a factor of 32; what each of them gains depends on how the kink cuts the
  /// smallest parts.
  /// Past a crack only that of E' counts which is seen from x: what its shadow leaves of E', as
  /// convex polygons. There are kinks where a line from x past a crack's end meets a vertex of E'.
  /// Not thread safe: give each thread its own copy.
  class PairQuadrature
  {
  public:
    PairQuadrature(const MeshSpace &space, const MeshCells &cells, const KernelEntries &profile,
                   double horizon, std::optional<physics::Coefficient> coefficient,
                   unsigned int refinement, geometry::Backend backend);

    /// @param between  all cracks that lie between the two cells
    void integrate(std::size_t outer, std::size_t inner, PairBlocks &blocks,
                   const std::vector<geometry::Cut> &between = {});

    /// No quadrature is needed: a constant kernel, and all of E' in the ball of all of E.
    bool is_product(std::size_t outer, std::size_t inner) const;

  private:
    const ShapeRule *smooth_rule(double between, std::size_t outer, std::size_t inner) const;
    template <int n_entries, int n_shapes>
    void integrate_as(std::size_t outer, std::size_t inner, PairBlocks &blocks);
    /// Part of the unit cell: a square or triangle of side `size` at (s, t), or a triangle turned
    /// by π in the square that it shares with an upright one.
    struct Part
    {
      double s = 0, t = 0, size = 0;
      bool is_turned = false;

      Point<2> point(const Point<2> &unit) const
      {
        return is_turned ? Point<2>(s + size * (1 - unit[0]), t + size * (1 - unit[1]))
                         : Point<2>(s + size * unit[0], t + size * unit[1]);
      }
    };

    template <int n_entries, int n_shapes>
    void integrate_part(const Part &part, unsigned int level, std::size_t outer, std::size_t inner,
                        PairBlocks &blocks);
    template <int n_entries, int n_shapes>
    void integrate_point(std::size_t outer, std::size_t inner, const Point<2> &unit, double weight,
                         const double *phi, PairBlocks &blocks);
    enum class Kink
    {
      none,
      at_side,  ///< x may come close to a side of E'
      at_circle ///< or the circle to a vertex, or to touching a side, or a crack's end before one
    };
    Kink find_kink(const Part &part, std::size_t outer, std::size_t inner) const;
    /// What is seen of a cell from x.
    struct Region
    {
      const geometry::ConvexCell &polygon;
      double distance = 0, radius = 0; ///< of its centroid from x, about its centroid
      bool is_all = true;              ///< of the cell
    };
    template <int n_entries, int n_shapes>
    void integrate_inner(const Point<2> &x, std::size_t inner);
    template <int n_entries, int n_shapes>
    void add_region(const Point<2> &x, const Region &region, std::size_t inner);
    template <int n_entries, int n_shapes>
    void add_ball(const geometry::Ball &ball, const SmoothEntries &entries, const Region &region,
                  std::size_t inner);
    template <int n_entries, int n_shapes>
    void add_points(const Point<2> &x, const SmoothEntries &kernel, std::size_t inner,
                    const geometry::CutRule &rule);
    template <int n_entries, int n_shapes>
    void add_whole(const Point<2> &x, const SmoothEntries &kernel, std::size_t inner,
                   const ShapeRule &rule);
    template <int n_entries, int n_shapes>
    void add(const Point<2> &x, const SmoothEntries &kernel, const Point<2> &y, double weight,
             const double *phi);
    void add_moments(const geometry::Moments &moments, std::size_t inner);
    void integrate_constant(std::size_t outer, std::size_t inner, PairBlocks &blocks) const;
    unsigned int kernel_degree(const SmoothEntries &kernel, double distance, double radius) const;
    bool is_cut(double between, std::size_t outer, std::size_t inner) const;

    const MeshSpace &space_;
    const MeshCells &cells_;
    const KernelEntries &profile_;
    double horizon_;
    std::optional<physics::Coefficient> coefficient_;
    std::vector<geometry::Cut> between_; ///< cracks, of the pair at hand
    std::vector<geometry::Polygon> seen_;
    unsigned int refinement_;
    double accuracy_; ///< of inner rules, relative
    geometry::Backend backend_;
    std::shared_ptr<const PairRules> rules_;

    unsigned int n_;                           ///< shape functions on a cell
    bool has_moments_;                         ///< a constant kernel on linear shape functions
    double a_x_ = 1;                           ///< the coefficient at x
    std::vector<double> sum_, first_, second_; ///< at x: ∫C, ∫Cφ, ∫Cφφ, n_entries inmost
    std::vector<double> phi_, outer_phi_;
    geometry::CutRule rule_;
  };
} // namespace plumbline::reference
