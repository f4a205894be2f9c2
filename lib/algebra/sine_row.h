#pragma once

namespace plumbline::algebra
{
  constexpr int most_constrained = 5; ///< at either end of a row

  /// A row of nodes between two zeros as a preconditioner takes it: as it is, with the zeros at the
  /// next nodes outside (DST-I), or in the middle of a longer row, whose transform is fast and
  /// whose zeros are half a step beyond its ends (DST-II).
  struct SineRow
  {
    int n = 0;                     ///< of the longer row
    int n_before = 0, n_after = 0; ///< nodes before the first of the row itself, and after its last
    int n_constrained = 0;         ///< of those the nearest on either side, held at zero

    bool is_longer() const { return n_before > 0; }
    int period() const { return 2 * (is_longer() ? n : n + 1); } ///< of its waves, in steps
  };

  /// Time of a transform of this length over that of a length without large prime factors: 1 up to
  /// the factor 13, for which FFTW has code of its own (1.3 with 11), 3.4 for a factor of 200, 6
  /// for a prime of 1000. Measured with FFTW 3.3.10.
  double length_penalty(int length);

  /// Nodes to hold at either end of a row: as many as save more time than they take.
  /// @param reach         of the stencil, in steps
  /// @param n_components  several are coupled by what no preconditioner of each one sees
  int nodes_to_hold(int reach, unsigned int n_components);

  /// Of all longer rows with n nodes in the middle that which promises the least time: iterations
  /// by the number of nodes around, each with a transform of its length.
  /// @param n_constrained  at most most_constrained; 0: the zeros are where a volume constraint
  /// acts as one
  SineRow fast_sine_row(int n, int reach, int n_constrained);
} // namespace plumbline::algebra
