#pragma once

#include "reference/mesh/rows.h"

namespace plumbline::reference
{
  /// Pairs of cells that are translations of one another. Each pair is told which one stands for
  /// it, the first of its kind, so that results do not depend on who asks.
  class RepeatedPairs
  {
  public:
    using Pair = std::pair<std::size_t, std::size_t>;

    /// Fills `same` of a rank's own pairs if most of all ranks' pairs repeat; else there is none to
    /// stand for others.
    /// @param all  those of all ranks, so that the same ones stand for others on each
    RepeatedPairs(const geometry::Mesh &mesh, const std::vector<CellPairs> &all,
                  std::vector<CellPairs> &own);

    const std::vector<Pair> &first() const { return first_; } ///< empty: most pairs are single

  private:
    std::vector<Pair> first_;
  };
} // namespace plumbline::reference
