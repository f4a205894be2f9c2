#pragma once

namespace plumbline::algebra
{
  /// A row of nodes between two zeros as a preconditioner takes it: as the middle of a longer row,
  /// whose transform is fast and whose zeros are where they fit the operator.
  struct SineRow
  {
    int n = 0;        ///< of the longer row
    int n_before = 0; ///< nodes before the first of the row itself, as many as after its last one
    /// Where the zero is: a whole step beyond the outermost node (DST-I) or half of one (DST-II).
    bool is_zero_between = false;

    double distance() const { return n_before + (is_zero_between ? .5 : 1.); } ///< of that [h]
    int period() const { return 2 * (is_zero_between ? n : n + 1); }           ///< of its waves
  };

  /// Where a volume constraint acts as a zero: this many steps beyond the outermost free node.
  /// Conjugate gradients need fewest iterations there; measured for constant, linear and 1/r
  /// kernels of m = 1.5 to 20, rules and Q1. A reach of 1 is the 5-point or 9-point stencil:
  /// exactly 1.
  /// @param reach  of the stencil, in steps
  double best_zero(int reach);

  /// Time of a transform of this length over that of a length without large prime factors: 1 up to
  /// the factor 13, for which FFTW has code of its own, 3.4 for a factor of 200, 6 for a prime of
  /// 1000. Measured with FFTW 3.3.10.
  double length_penalty(int length);

  /// Of all rows with n nodes in the middle that which promises the least time: iterations by how
  /// far its zero is from `best`, each with a transform of its length.
  /// @param is_exact  with the zero at `best` = 1 the operator is inverted in one iteration
  SineRow fast_sine_row(int n, double best, bool is_exact);

  /// Cells before and after n cells of a rectangle whose values are reflected oddly about its ends,
  /// for the same reasons; the period is twice n and these.
  /// @param best  as above, from the centre of the outermost cell
  int fast_cells_around(int n, double best);
} // namespace plumbline::algebra
