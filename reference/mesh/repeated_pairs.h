#pragma once

#include "reference/mesh/rows.h"

#include <cstdint>
#include <unordered_map>

namespace plumbline::reference
{
  /// Pairs of cells that are translations of one another: on uniform meshes, nearly all. Each pair
  /// is told which one stands for it, the first of its kind, so that results do not depend on who
  /// asks.
  class RepeatedPairs
  {
  public:
    using Pair = std::pair<std::size_t, std::size_t>;

    /// Fills `same` of a rank's own pairs if most of all ranks' pairs repeat; else there is none to
    /// stand for others. Cells that differ by less than 1e-9 of the longest side have one shape.
    /// @param all  those of all ranks, so that the same ones stand for others on each
    RepeatedPairs(const geometry::Mesh &mesh, const std::vector<CellPairs> &all,
                  std::vector<CellPairs> &own);

    const std::vector<Pair> &first() const { return first_; } ///< empty: most pairs are single

  private:
    using Place = std::array<std::int64_t, 2>; ///< in quanta
    struct Key
    {
      unsigned int outer = 0, inner = 0; ///< shapes
      Place offset{};
      bool operator==(const Key &other) const
      {
        return outer == other.outer && inner == other.inner && offset == other.offset;
      }
    };
    struct Hash
    {
      std::size_t operator()(const Key &key) const;
    };

    Place place(const Point<2> &x) const;
    bool find_shapes(const geometry::Mesh &mesh);

    double quantum_;
    std::vector<unsigned int> shape_; ///< of each cell
    std::vector<Pair> first_;
  };
} // namespace plumbline::reference
