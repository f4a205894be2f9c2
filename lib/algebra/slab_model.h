#pragma once

#include "algebra/stencil.h"
#include "base/slabs.h"
#include "base/solver_choices.h"
#include "base/traffic.h"

#include <array>

// Messages of stencils on boxes in slabs, and a model of the time that these take, for any number
// of ranks: nothing is made but numbers.
namespace plumbline::algebra
{
  /// Nodes of a box in slabs of planes, as base::Slabs has them, without the ranks.
  struct SlabLayout
  {
    std::array<int, 3> n{};    ///< nodes along each axis; a lattice in the plane has n[1] = 1
    unsigned int n_blocks = 1; ///< unknowns of a node
    int reach = 0;             ///< planes of others that an operator needs on either side
    unsigned int n_ranks = 1;
    int block = 1; ///< planes of the first rank
    base::OperatorBackend backend = base::OperatorBackend::automatic;

    /// @param n_planes  from which blocks follow: n[2], or that of the cells where nodes are their
    /// vertices
    static SlabLayout of(const Stencil &stencil, const std::array<int, 3> &n, unsigned int n_ranks,
                         int n_planes);

    base::Slabs::Range owned(unsigned int rank) const;
    std::array<int, 3> first_slab() const { return {n[0], n[1], owned(0).second}; }
    unsigned int n_working() const; ///< ranks that have planes
  };

  /// What a rank sends to apply SlabOperator once: to each rank whose slab is within reach one
  /// message for each block. Exact.
  base::Traffic halo_traffic(const SlabLayout &layout, unsigned int rank);

  /// What a rank sends to apply SlabSine once: there and back, for each block, the part of its
  /// planes (rows of modes) that is in the other rank's rows (planes). The bytes are exact; FFTW
  /// may send one part in several messages.
  base::Traffic transpose_traffic(const SlabLayout &layout, unsigned int rank);

  /// What a rank sends for the sum of one number over all ranks, by recursive doubling: ⌈log2 P⌉
  /// messages (Thakur, Rabenseifner & Gropp 2005, doi:10.1177/1094342005051521, sec. 4.5).
  base::Traffic reduction_traffic(unsigned int n_ranks);

  /// What one core and its share of the network do. The defaults are assumed, not measured: a
  /// message takes 2 µs, and each rank sends 10 GB/s, as on a network of 100 Gbit/s or more with
  /// few ranks on each of its links. Stencils and transforms are about as fast as benchmarks/ranks
  /// finds them on a small machine with all cores busy; vectors come from memory, 5 GB/s for each
  /// core.
  struct Rates
  {
    double latency = 2e-6;   ///< α: of a message [s]
    double byte = 1. / 10e9; ///< β: of a byte sent [s]
    double bond = .2e-9;     ///< of an entry of a direct stencil at one node [s]
    double level = 4e-9;     ///< of a sine transform, by value and log2 of their number [s]
    double value = 8. / 5e9; ///< of a number that a vector operation reads or writes [s]
  };

  /// Seconds of an operation on the rank that takes longest: work + α messages + β bytes.
  struct ModelTime
  {
    double work = 0, messages = 0, bytes = 0; ///< [s]
    base::Traffic sent;                       ///< by the rank with most of α messages + β bytes

    double seconds() const { return work + messages + bytes; }
    ModelTime &operator+=(const ModelTime &other);
  };

  /// Not included: savings by overlap of work and messages, nodes of one machine that share a
  /// network link, contention.
  ModelTime operator_time(const SlabLayout &layout, const Stencil &stencil, const Rates &rates);
  ModelTime preconditioner_time(const SlabLayout &layout, const Rates &rates);

  /// An iteration of conjugate gradients: both of these, three sums over the ranks, and vector
  /// operations that read or write 13 numbers for each unknown (two products, p = z + β p, x += α
  /// p, r -= α A p with its norm).
  ModelTime iteration_time(const SlabLayout &layout, const Stencil &stencil, const Rates &rates);
} // namespace plumbline::algebra
