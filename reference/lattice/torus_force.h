#pragma once

#include "physics/double_well.h"

#include <array>
#include <memory>
#include <vector>

namespace plumbline::reference
{
  /// Forces of two wells on a torus without any mesh: u is the trigonometric polynomial through its
  /// values on n^dim equidistant points, and the bond integral is taken by Gauss points in the
  /// radius and, in 2D, equidistant angles. For smooth u both converge exponentially, so this is
  /// exact to round-off with a few dozen points; ω = 1. Vectors have shape (dim, n, n), x running
  /// fastest, or n in 1D.
  /// Cost: (n_radii n_angles) transforms of n^dim points; n a product of small primes.
  /// Not for: fields with kinks or jumps; calling one object from several threads at a time.
  template <int dim>
  class TorusForce
  {
  public:
    using Strain = std::array<std::array<double, dim>, dim>;

    /// @param n         points a side, even, > 2
    /// @param side      of the torus [length]
    /// @param n_angles  in 2D; ignored in 1D
    /// @param mean_strain  E, symmetric: the displacement is E x + u
    /// @throws InputError  n odd or too small, side <= 0, no points in the radius or angle
    /// @pre law.dim() == dim
    TorusForce(const physics::DoubleWell &law, unsigned int n, double side, unsigned int n_radii,
               unsigned int n_angles = 1, Strain mean_strain = {});
    TorusForce(TorusForce &&) noexcept;
    ~TorusForce();

    std::size_t size() const;

    /// F(u) at the points.
    void force(const std::vector<double> &u, std::vector<double> &f) const;

    /// PD(u).
    double energy(const std::vector<double> &u) const;

    /// The trigonometric polynomial through values of one component, shape (n, n) or n, at x.
    double interpolate(const double *values, const std::array<double, dim> &x) const;

  private:
    struct Data;
    std::unique_ptr<Data> data_;
  };
} // namespace plumbline::reference
