#pragma once

#include "geometry/mesh.h"
#include "geometry/search.h"
#include "physics/kernel.h"

#include <functional>

namespace plumbline::reference
{
  /// ∫ K(|ξ|) |ξ|² dξ over the part of ball(x) that a mesh covers: 2 of an influence function's
  /// full ball, less where the body ends. Radial, so that only the mesh's outer sides near x
  /// matter:
  ///   ∮ G(min(|ξ|, δ)) dφ,  G(r) = ∫_0^r K s³ ds,
  /// in closed form on each side for powers and tables. For functions by quadrature or, where a
  /// side cuts the ball from end to end, by Chebyshev series in its distance. Thread safe.
  /// Accuracy: 1e-14. Cost: .05 µs away from outer sides, .1 µs for each one in reach; for
  /// functions some 3 µs for each side that ends in the ball.
  class WeightedVolume
  {
  public:
    WeightedVolume(const geometry::Mesh &mesh, const physics::Kernel<2> &kernel);

    /// @param x  in the mesh; on its boundary, but for corners, the limit from inside
    double operator()(const geometry::Point<2> &x) const;

  private:
    using Side = std::array<geometry::Point<2>, 2>; ///< with the mesh on its left

    struct Term
    {
      double coefficient = 0;
    };

    using Series = std::vector<Term>; ///< of Chebyshev polynomials

    /// A kernel without breaks; of powers without series.
    struct Part
    {
      physics::Kernel<2> kernel;
      Series moment; ///< ∫_t^1 s³ ρ ds over 0 <= t <= 1
      std::vector<Series>
          chords; ///< of sides at the distance (1 - τ²) δ, over parts of τ in [0, 1]
    };

    static Part part_of(const physics::Kernel<2> &kernel);
    static Series series(const std::function<double(double)> &f, double from, double to,
                         unsigned int n);
    static double missing_of_function(const Part &part, double d, double s0, double s1);
    static double missing_of_chord(const Part &part, double d);

    WeightedVolume(std::vector<Side> outer_sides, const physics::Kernel<2> &kernel);

    double missing(const dealii::Tensor<1, 2> &from, const dealii::Tensor<1, 2> &to) const;

    double horizon_;
    std::vector<Part> parts_; ///< that add up to the kernel
    double full_;             ///< of the whole ball
    std::vector<Side> sides_;
    geometry::BoxSearch<2> search_;
  };
} // namespace plumbline::reference
