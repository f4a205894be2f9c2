#pragma once

#include "physics/double_well.h"
#include "reference/shapes.h"

#include <array>
#include <map>
#include <vector>

namespace plumbline::reference
{
  /// Galerkin's method with continuous elements of degree p, Q1, Q2 ..., on a torus of n[0] × n[1]
  /// square cells (dim = 1: n[0] intervals) for bonds with two wells: M ü = -∂PD/∂u, ω = 1. For
  /// each way z of the ball a cell is split by the fraction of z into 2^dim boxes, so that x and
  /// x+z stay in one cell each, where the integrand is smooth: Gauss points there. Ways z are taken
  /// in polar form on each lattice cell ∩ ball. Vectors are nodal values, shape (dim, p n[1], p
  /// n[0]), the nodes of cell i along an axis being p i ... p i + p. Of order p + 1 in L2.
  /// Accuracy: with p = 1 and n_points = 2, 3, 4 the load of .3 sin 2πx, ε = .1 = 2h, is wrong by
  /// 2.6e-4, 1.3e-6, 4e-8.
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
    /// @param degree  p
    /// @param is_lumped  masses by the diagonal of the mass matrix, scaled to the whole mass
    /// @throws InputError  h <= 0, n < 2, n_points = 0
    /// @pre law.dim() == dim, in 1D n[1] == 1; degree >= 1
    DoubleWellGalerkin(const physics::DoubleWell &law, double h, std::array<int, 2> n,
                       unsigned int n_points = 3, unsigned int degree = 1, bool is_lumped = false);

    /// Nodes along each axis.
    std::array<int, 2> n_along() const { return {n_[0] * degree_, dim == 1 ? 1 : n_[1] * degree_}; }
    std::size_t n_nodes() const { return static_cast<std::size_t>(n_along()[0]) * n_along()[1]; }
    std::size_t size() const { return dim * n_nodes(); }
    std::size_t n_evaluations() const { return n_evaluations_; } ///< exponentials a cell

    /// -∂PD/∂u.
    void residual(const std::vector<double> &u, std::vector<double> &r) const;

    /// The derivative of that along v, symmetric.
    void tangent(const std::vector<double> &u, const std::vector<double> &v,
                 std::vector<double> &out) const;

    /// M⁻¹ of -∂PD/∂u.
    void acceleration(const std::vector<double> &u, std::vector<double> &a) const;

    double energy(const std::vector<double> &u) const; ///< PD(u)

    /// M^power x in place, to round-off; power: 1, -1, and ±½ for states in which tangents are
    /// symmetric.
    void apply_mass(std::vector<double> &x, double power) const;

  private:
    /// A node of x or x+z in all cells, which counts `coefficient` in u(x+z) - u(x).
    struct Term
    {
      double coefficient = 0;
      std::ptrdiff_t shift = 0; ///< from the cell's first node in the padded field
    };
    /// A point x in all cells.
    struct Sample
    {
      double weight = 0;
      std::vector<Term> terms;
    };
    /// Powers of a mass matrix along an axis, shape (n, n).
    using AxisMass = std::map<double, std::vector<double>>;
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
    void apply_along(int axis, double power, std::vector<double> &x) const;

    physics::DoubleWell law_;
    double h_;
    std::array<int, 2> n_; ///< cells
    AxisShapes shapes_;
    int degree_, reach_; ///< reach: of bonds, in nodes
    std::size_t width_;  ///< of the padded field
    std::array<AxisMass, dim> mass_;
    std::size_t n_evaluations_ = 0;
    std::vector<Way> ways_;
  };
} // namespace plumbline::reference
