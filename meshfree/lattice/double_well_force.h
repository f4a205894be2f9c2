#pragma once

#include "meshfree/rules/double_well_bonds.h"

#include <cstdint>

namespace plumbline::meshfree
{
  /// What lies beyond the box of nodes.
  enum class Exterior
  {
    empty,   ///< nothing: ω = 0, no bonds
    periodic ///< the nodes of the other side: a torus
  };

  /// Forces of two wells on a lattice of n[0] × n[1] nodes; with dim = 1, n[1] = 1. Vectors have
  /// shape (dim, n[1], n[0]). Each node sums over all its bonds, rows in parallel, with the same
  /// bits for any number of threads. The four mirror images of a bond are added in an order that
  /// mirror images share, so fields that are symmetric about either axis of the box stay so to the
  /// last bit.
  /// Accuracy: 1e-14 of Σ |bond forces|, the exponential's included; other potentials as theirs.
  /// Cost: 1.3e9 to 2e9 bonds (to one neighbour of one node) a second and core where registers
  /// hold eight numbers, .25e9 where they hold four; a padded copy of the vectors. Potentials that
  /// are not exponential take about five times as long.
  /// Not for: calling one object from several threads at a time.
  template <int dim>
  class DoubleWellForce
  {
  public:
    using Gradient = std::array<std::array<double, dim>, dim>;

    /// @param bonds  of every node, with all their mirror images
    /// @param omega  the boundary function at the nodes, shape (n[1], n[0]), >= 0; empty: 1
    /// @param mean_gradient  G of a torus: displacements go on as u_a(x + L_b) = u_a(x) + G_ab L_b,
    /// L the sides of the box, so that u may be a uniform strain and something periodic
    /// @param shape  φ of the bonds
    /// @throws InputError  h <= 0, n < 1, ω of another size, negative, not finite or 0 everywhere
    /// @throws NumericalError  weights that differ between mirror images
    DoubleWellForce(const std::vector<WellBond> &bonds, double h, std::array<int, 2> n,
                    Exterior exterior, std::vector<double> omega = {}, Gradient mean_gradient = {},
                    physics::WellPotential shape = {});

    std::size_t size() const { return dim * n_nodes(); }
    std::size_t n_nodes() const { return static_cast<std::size_t>(n_[0]) * n_[1]; }
    std::uint64_t n_bonds() const; ///< one force evaluation sums over, those beyond the box too

    /// F(u) = -∇PD(u) / h^dim.
    void force(const std::vector<double> &u, std::vector<double> &f) const;

    /// F'(u) v, symmetric.
    void tangent(const std::vector<double> &u, const std::vector<double> &v,
                 std::vector<double> &f) const;

    /// PD(u), to 1e-14 relative at strains however small.
    double energy(const std::vector<double> &u) const;

    /// What a group of four mirror images shares (see the source).
    struct Group
    {
      std::array<std::ptrdiff_t, 4> shift{}; ///< to the neighbours in the padded fields
      std::array<double, 2> way{};           ///< see well_unit
      double strength = 0;
    };

  private:
    enum class Quantity
    {
      force,
      tangent,
      energy
    };
    template <Quantity quantity>
    void evaluate(const std::vector<double> &u, const std::vector<double> *v, double *result) const;
    template <Quantity quantity, class Lanes>
    void evaluate_rows(const Lanes &shape, int from, int to, double *result) const;
    void pad(const double *field, const std::array<double, dim> &jump, double *padded) const;

    double h_;
    std::array<int, 2> n_;
    Exterior exterior_;
    std::vector<double> omega_; ///< padded, empty for 1
    Gradient jump_;             ///< G_ab L_b
    physics::WellPotential shape_;
    int reach_;
    std::size_t width_, block_size_;     ///< of the padded fields
    std::vector<Group> oblique_, axial_; ///< (±k1, ±k2); (±k, 0) and (0, ±k)
    mutable std::vector<double> padded_; ///< u and v, shape (2 dim, n[1] + 2 reach, width)
  };
} // namespace plumbline::meshfree
