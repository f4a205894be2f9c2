#pragma once

#include "algebra/sine_row.h"

#include <array>
#include <vector>

namespace plumbline::algebra
{
  /// Nodes beside a rectangle that a diagonal operator D in sine space shall hold at zero. The
  /// zeros of a longer row lie far from where a volume constraint acts; holding the nodes next to
  /// the rectangle, at both ends of an axis, brings them back. With E these nodes of one axis,
  ///   P u = u - D⁻¹ E (Eᵀ D⁻¹ E)⁻¹ Eᵀ u
  /// is zero on them; D is diagonal, so each mode across the axis has a small system of its own.
  /// P0 P1 P0 ... P0 D⁻¹ is symmetric, positive definite on the rectangle, and nearly the inverse
  /// there: in either direction alone it is exact if all nodes around are constrained, at least
  /// half a reach of them. Corners need sweeps P1 P0: two to four of them leave 3 to 5 iterations
  /// of conjugate gradients whatever the length. Source: the capacitance matrix method,
  /// Proskurowski & Widlund 1976, doi:10.1090/S0025-5718-1976-0421102-4; here mode by mode.
  class ConstrainedNodes
  {
  public:
    /// @param rows     longer rows of both axes, or rows as they are
    /// @param stride   between rows of fields, a multiple of `wide`, see simd.h
    /// @param inverse  1/λ, shape (rows[1].n, stride), zero beyond rows[0].n
    ConstrainedNodes(const std::array<SineRow, 2> &rows, int stride, const double *inverse);

    /// P0 P1 P0 ... D⁻¹, in place; of one node at each end one sweep.
    /// @param field    of modes, where nodes are constrained those of FFTW's RODFT10, whose last
    /// one is
    ///                 twice too large: a node sees half of it; shape and zeros as of inverse
    /// @param inverse  as before
    void apply(double *field, const double *inverse) const;

  private:
    /// The nodes constrained at both ends of one axis.
    struct Ends
    {
      std::size_t n = 0, n_modes = 0, n_across = 0;
      std::vector<double> seen, given; ///< Eᵀ and E: a node's modes, shape (n, n_modes)
      std::vector<double> forces;      ///< (Eᵀ D⁻¹ E)⁻¹, shape (n, n, n_across)
    };

    static Ends ends_of(const SineRow &row, std::size_t n_modes, std::size_t n_across);
    static void find_forces(Ends &ends, const double *inverse, int n_across, std::size_t along,
                            std::size_t across);
    void hold_along(double *row, const double *inverse, std::size_t j) const;

    std::array<Ends, 2> ends_; ///< n_modes with those beyond rows[0].n
    int n_sweeps_ = 0;         ///< P1 P0 after the first P0
  };
} // namespace plumbline::algebra
