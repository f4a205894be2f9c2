#include "algebra/constrained_nodes.h"

#include "algebra/simd.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace plumbline::algebra
{
  namespace
  {
    // Nodes come in pairs, one of each end: two at a time save half the loads.

    /// Of two rows, a and the next, with u, in two parts each.
    PLUMBLINE_VECTOR_CLONES void dot_products(const double *a, const double *u, std::size_t n,
                                              double *products)
    {
      Simd part0{}, part1{}, next0{}, next1{};
      for (std::size_t k = 0; k < n; k += 2 * simd_width)
      {
        const double *const row = a + k, *const next = row + n;
        const Simd value0 = load(u + k), value1 = load(u + k + simd_width);
        part0 += value0 * load(row);
        part1 += value1 * load(row + simd_width);
        next0 += value0 * load(next);
        next1 += value1 * load(next + simd_width);
      }
      part0 += part1;
      next0 += next1;
      products[0] = (part0[0] + part0[1]) + (part0[2] + part0[3]);
      products[1] = (next0[0] + next0[1]) + (next0[2] + next0[3]);
    }

    /// u -= d (a[0] factor0 + a[1] factor1)
    PLUMBLINE_VECTOR_CLONES void subtract(double *u, const double *d, const double *a,
                                          double factor0, double factor1, std::size_t n)
    {
      for (std::size_t k = 0; k < n; ++k)
        u[k] -= d[k] * (a[k] * factor0 + a[n + k] * factor1);
    }

    /// a[0] += u factor0, a[1] += u factor1
    PLUMBLINE_VECTOR_CLONES void spread(double *a, const double *u, double factor0, double factor1,
                                        std::size_t n)
    {
      for (std::size_t k = 0; k < n; ++k)
      {
        a[k] += u[k] * factor0;
        a[n + k] += u[k] * factor1;
      }
    }

    /// u += a b
    PLUMBLINE_VECTOR_CLONES void add_product(double *u, const double *a, const double *b,
                                             std::size_t n)
    {
      for (std::size_t k = 0; k < n; ++k)
        u[k] += a[k] * b[k];
    }

    /// u *= a
    PLUMBLINE_VECTOR_CLONES void scale(double *u, const double *a, std::size_t n)
    {
      for (std::size_t k = 0; k < n; ++k)
        u[k] *= a[k];
    }

    /// Sweeps that leave 3 to 4 iterations. Two ends alike need fewer: the errors of their corners
    /// are alike too, and conjugate gradients remove them together.
    int sweeps_for(const std::array<SineRow, 2> &rows)
    {
      constexpr int far = 2; // nodes that are not held
      int n_free = 0;
      bool are_alike = true;
      for (const SineRow &row : rows)
      {
        n_free = std::max(n_free, row.n_after - row.n_constrained);
        are_alike = are_alike && row.n_before == row.n_after;
      }
      if (rows[0].n_constrained <= 1)
        return rows[0].n_constrained;
      return n_free == 0 ? 2 : are_alike || n_free <= far ? 3 : 4;
    }
  } // namespace

  ConstrainedNodes::Ends ConstrainedNodes::ends_of(const SineRow &row, std::size_t n_modes,
                                                   std::size_t n_across)
  {
    const std::size_t n = 2 * row.n_constrained;
    Ends ends{n, n_modes, n_across, {}, {}, {}};
    ends.seen.resize(n * n_modes);
    ends.given.resize(n * n_modes);
    ends.forces.resize(n * n * n_across);
    for (int k = 0; k < row.n_constrained; ++k)
      for (int p = 0; p < row.n; ++p)
        for (const bool upper : {false, true})
        {
          const double x = upper ? row.n - row.n_after + k + .5 : row.n_before - 1 - k + .5,
                       mode = std::sin(2 * M_PI * (p + 1) * x / row.period());
          const std::size_t at = (2 * k + upper) * n_modes + p;
          ends.given[at] = mode;
          ends.seen[at] = p == row.n - 1 ? mode / 2 : mode;
        }
    return ends;
  }

  /// @param along, across  distance of modes in inverse
  void ConstrainedNodes::find_forces(Ends &ends, const double *inverse, int n_across,
                                     std::size_t along, std::size_t across)
  {
    const Eigen::Map<const Eigen::MatrixXd> seen(ends.seen.data(), ends.n_modes, ends.n),
        given(ends.given.data(), ends.n_modes, ends.n);
    const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(ends.n, ends.n);
    Eigen::MatrixXd values(ends.n_modes, ends.n);
    for (int q = 0; q < n_across && ends.n > 0; ++q)
    {
      for (std::size_t p = 0; p < ends.n_modes; ++p)
        values.row(p) = inverse[q * across + p * along] * given.row(p);
      const Eigen::MatrixXd forces = (seen.transpose() * values).ldlt().solve(one);
      for (std::size_t k = 0; k < ends.n * ends.n; ++k)
        ends.forces[k * ends.n_across + q] = forces.data()[k];
    }
  }

  ConstrainedNodes::ConstrainedNodes(const std::array<SineRow, 2> &rows, int stride,
                                     const double *inverse)
      : ends_{ends_of(rows[0], stride, rows[1].n), ends_of(rows[1], rows[1].n, stride)}
  {
    find_forces(ends_[0], inverse, rows[1].n, 1, stride);
    find_forces(ends_[1], inverse, rows[0].n, stride, 1);
    n_sweeps_ = sweeps_for(rows);
  }

  /// P0 of row j.
  void ConstrainedNodes::hold_along(double *row, const double *inverse, std::size_t j) const
  {
    const Ends &ends = ends_[0];
    std::array<double, 2 * most_constrained> values{}, forces{};
    for (std::size_t k = 0; k < ends.n; k += 2)
      dot_products(ends.seen.data() + k * ends.n_modes, row, ends.n_modes, values.data() + k);
    for (std::size_t k = 0; k < ends.n; ++k)
      for (std::size_t l = 0; l < ends.n; ++l)
        forces[k] += ends.forces[(k * ends.n + l) * ends.n_across + j] * values[l];
    for (std::size_t k = 0; k < ends.n; k += 2)
      subtract(row, inverse, ends.given.data() + k * ends.n_modes, forces[k], forces[k + 1],
               ends.n_modes);
  }

  void ConstrainedNodes::apply(double *field, const double *inverse) const
  {
    const Ends &ends = ends_[1];
    const std::size_t n_rows = ends.n_modes, stride = ends.n_across;
    std::vector<double> values(ends.n * stride), forces(ends.n * stride);
    for (int sweep = 0; sweep <= n_sweeps_; ++sweep)
    {
      for (std::size_t j = 0; j < n_rows; ++j)
      {
        double *const row = field + j * stride;
        const double *const inverse_row = inverse + j * stride, *const seen = ends.seen.data() + j,
                            *const given = ends.given.data() + j;
        if (sweep == 0)
          scale(row, inverse_row, stride);
        for (std::size_t k = 0; k < ends.n && sweep > 0; k += 2)
          subtract(row, inverse_row, forces.data() + k * stride, given[k * n_rows],
                   given[(k + 1) * n_rows], stride);
        hold_along(row, inverse_row, j);
        for (std::size_t k = 0; k < ends.n && sweep < n_sweeps_; k += 2)
          spread(values.data() + k * stride, row, seen[k * n_rows], seen[(k + 1) * n_rows], stride);
      }
      if (sweep == n_sweeps_)
        return;
      forces.assign(forces.size(), 0.);
      for (std::size_t k = 0; k < ends.n; ++k)
        for (std::size_t l = 0; l < ends.n; ++l)
          add_product(forces.data() + k * stride, ends.forces.data() + (k * ends.n + l) * stride,
                      values.data() + l * stride, stride);
      values.assign(values.size(), 0.);
    }
  }
} // namespace plumbline::algebra
