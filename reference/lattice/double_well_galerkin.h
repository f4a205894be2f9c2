#pragma once

#include "physics/double_well.h"

#include <array>
#include <vector>

namespace plumbline::reference
{
  /// Galerkin's method with Q1 on a torus of n[0] × n[1] square cells (dim = 1: n[0] intervals) for
  /// bonds with two wells: M ü = -∂PD/∂u, ω = 1. For each way z of the ball a cell is split by the
  /// fraction of z into 2^dim boxes, so that x and x+z stay in one cell each, where the integrand
  /// is smooth: Gauss points there. Ways z are taken in polar form on each lattice cell ∩ ball.
  /// Vectors are nodal values, shape (dim, n[1], n[0]). Second order in L2.
  /// Accuracy: with n_points = 2, 3, 4 the load of .3 sin 2πx, ε = .1 = 2h, is wrong by 2.6e-4,
  /// 1.3e-6, 4e-8.
  /// Cost: (2 n_points)^dim exponentials for each of the n_points² or so points of each piece of
  /// half the ball, some thousands a cell at m = 4: hundreds of times a meshfree rule's.
  /// Not for: cracks, where S is about 1/h; an ω with kinks; jumps of DG spaces, since e^(-βΔu²/r)
  /// is a layer at r = 0 that no fixed number of points resolves.
  template <int dim>
  class DoubleWellGalerkin
  {
  public:
    /// @param n_points  Gauss points a side of a box, and of radii and angles of a piece of the
    /// ball
    /// @throws InputError  h <= 0, n < 2, n_points = 0
    /// @pre law.dim() == dim, in 1D n[1] == 1
    DoubleWellGalerkin(const physics::DoubleWell &law, double h, std::array<int, 2> n,
                       unsigned int n_points = 3);

    std::size_t n_nodes() const { return static_cast<std::size_t>(n_[0]) * n_[1]; }
    std::size_t size() const { return dim * n_nodes(); }
    std::size_t n_evaluations() const { return n_evaluations_; } ///< exponentials a cell

    /// -∂PD/∂u.
    void residual(const std::vector<double> &u, std::vector<double> &r) const;

    /// The derivative of that along v, symmetric.
    void tangent(const std::vector<double> &u, const std::vector<double> &v,
                 std::vector<double> &out) const;

    /// M⁻¹ of -∂PD/∂u, with the consistent mass.
    void acceleration(const std::vector<double> &u, std::vector<double> &a) const;

    double energy(const std::vector<double> &u) const; ///< PD(u)

    /// M x and, to round-off, M⁻¹ x, in place.
    void apply_mass(std::vector<double> &x) const;
    void apply_inverse_mass(std::vector<double> &x) const;
    /// M^½ x and M^-½ x, the same.
    void apply_mass_root(std::vector<double> &x) const;
    void apply_inverse_mass_root(std::vector<double> &x) const;

  private:
    static constexpr int n_corners = dim == 1 ? 2 : 4;

    /// A point x in all cells: u(x+z) - u(x) = Σ coefficient u(cell + shift).
    struct Sample
    {
      double weight = 0;
      std::array<double, 2 * n_corners> coefficient{};
      std::array<std::ptrdiff_t, 2 * n_corners> shift{}; ///< in the padded field
    };
    /// Half of the ball; the other half gives the same.
    struct Way
    {
      std::array<double, 2> e{};
      double r = 0, weight = 0;
      std::vector<Sample> samples;
    };

    void add_way(const physics::DoubleWell &law, const std::array<double, 2> &z, double weight,
                 unsigned int n_points);
    template <std::size_t n_fields>
    using Fields = std::array<const std::vector<double> *, n_fields>;
    template <std::size_t n_fields, typename Visit>
    void over_ways(const Fields<n_fields> &fields, const Visit &visit) const;
    template <std::size_t n_fields, typename Pull>
    void test(const Fields<n_fields> &fields, const Pull &pull, std::vector<double> &r) const;
    void convolve(const std::vector<double> &weights, std::vector<double> &x) const;

    physics::DoubleWell law_;
    double h_;
    std::array<int, 2> n_;
    int reach_;
    std::size_t width_;
    std::size_t n_evaluations_ = 0;
    std::vector<Way> ways_;
  };
} // namespace plumbline::reference
