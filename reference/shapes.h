#pragma once

#include "geometry/lattice.h"

#include <memory>
#include <vector>

namespace dealii
{
  template <int dim, int spacedim>
  class FiniteElement;
}

namespace plumbline::reference
{
  /// The one-dimensional shape functions of deal.II's FE_Q or FE_DGQ, in cells of length 1, sorted
  /// into families that repeat from cell to cell. Tensor products of them span the lattice spaces.
  class AxisShapes
  {
  public:
    AxisShapes(bool is_continuous, unsigned int degree);

    bool is_continuous() const { return is_continuous_; }
    unsigned int degree() const { return degree_; }
    const std::vector<geometry::AxisSpecies> &families() const { return families_; }
    unsigned int n_local() const { return degree_ + 1; } ///< shape functions on one cell

    /// Local shape function a at x in [0, 1].
    double value(unsigned int a, double x) const;
    double derivative(unsigned int a, double x) const;

    /// Support point of local shape function a, in [0, 1].
    double support_point(unsigned int a) const { return support_points_[a]; }

    /// Which family, and at which cell from this one, a local shape function belongs to.
    struct Owner
    {
      unsigned int family = 0;
      int shift = 0;
    };
    Owner owner(unsigned int a) const;

    /// A family's function restricted to one cell, counted from the family's own.
    struct Restriction
    {
      int cell = 0;
      unsigned int local = 0;
    };
    std::vector<Restriction> restrictions(unsigned int family) const;

  private:
    bool is_continuous_;
    unsigned int degree_;
    std::shared_ptr<const dealii::FiniteElement<1, 1>> element_;
    std::vector<unsigned int> deal_index_; ///< of local function a, from left to right
    std::vector<double> support_points_;
    std::vector<geometry::AxisSpecies> families_;
  };

  /// The correlations r_st(τ) = ∫ φ_s(x) φ_t(x + τ) dx of all families s, t: on each interval
  /// [j, j + 1], j = -2 ... 1, a Legendre series of degree 2 degree + 1.
  class Correlations
  {
  public:
    static constexpr int first_interval = -2, n_intervals = 4;

    explicit Correlations(const AxisShapes &shapes);

    unsigned int n_modes() const { return n_modes_; }

    /// Legendre coefficients on [j, j + 1] of r_st, or nullptr where r_st vanishes.
    const double *coefficients(unsigned int s, unsigned int t, int j) const;

    /// r_st(τ) itself, by exact integration.
    double operator()(unsigned int s, unsigned int t, double tau) const;

  private:
    AxisShapes shapes_;
    unsigned int n_families_, n_modes_;
    std::vector<std::vector<double>> series_; ///< index (s n_families + t) n_intervals + j - first
  };

  /// Legendre polynomials P_0 ... P_{n-1} on [-1, 1].
  void legendre(double x, unsigned int n, double *values);
} // namespace plumbline::reference
