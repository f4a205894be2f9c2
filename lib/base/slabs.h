#pragma once

#include "base/communicator.h"

#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

namespace plumbline::base
{
  /// Planes 0 ... n - 1 distributed over ranks in order, in blocks of the same number of planes:
  /// the last ranks may have fewer, or none. (FFTW's transforms ask for such blocks.)
  class Slabs
  {
  public:
    /// Planes [first, second).
    using Range = std::pair<int, int>;

    /// Blocks as small as the number of ranks allows.
    Slabs(const Communicator &ranks, int n_planes);

    /// Other planes in the same blocks.
    /// @pre n_planes <= block() · number of ranks
    Slabs with_planes(int n_planes) const;

    const Communicator &ranks() const { return ranks_; }
    int n_planes() const { return n_planes_; }
    int block() const { return block_; } ///< planes of the first rank

    Range owned(unsigned int rank) const;
    Range owned() const { return owned_; } ///< by this rank
    int n_owned() const { return owned_.second - owned_.first; }
    bool owns(int plane) const { return plane >= owned_.first && plane < owned_.second; }

    /// Planes of a field, from the ranks that own them.
    /// @param own     of this rank, shape (n_owned, plane_size)
    /// @param wanted  which ones each rank wants; it may ask for planes outside 0 ... n - 1
    /// @param result  of this rank, shape (wanted, plane_size): 0 in planes that are outside
    /// @note Collective.
    void fetch(const double *own, std::size_t plane_size,
               const std::function<Range(unsigned int rank)> &wanted, double *result) const;

    /// The same as a new array.
    std::vector<double> fetch(const std::vector<double> &own, std::size_t plane_size,
                              const std::function<Range(unsigned int rank)> &wanted) const;

    /// All planes on the first rank, none on others.
    /// @note Collective.
    std::vector<double> gather(const std::vector<double> &own, std::size_t plane_size) const;

  private:
    Slabs(Communicator ranks, int n_planes, int block);

    Communicator ranks_;
    int n_planes_, block_;
    Range owned_;
  };
} // namespace plumbline::base
