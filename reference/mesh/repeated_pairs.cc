#include "reference/mesh/repeated_pairs.h"

#include <cmath>
#include <map>

namespace plumbline::reference
{
  std::size_t RepeatedPairs::Hash::operator()(const Key &key) const
  {
    constexpr std::uint64_t odd = 0x9e3779b97f4a7c15u; // 2^64 over the golden ratio
    std::uint64_t hash = key.outer * std::uint64_t(1 << 16) + key.inner;
    for (const std::int64_t x : key.offset)
      hash = (hash ^ static_cast<std::uint64_t>(x)) * odd ^ hash >> 29;
    return hash;
  }

  RepeatedPairs::Place RepeatedPairs::place(const Point<2> &x) const
  {
    return {std::llround(x[0] / quantum_), std::llround(x[1] / quantum_)};
  }

  /// Whether there are few.
  bool RepeatedPairs::find_shapes(const geometry::Mesh &mesh)
  {
    constexpr std::size_t most = 64;
    std::map<std::array<Place, 3>, unsigned int> shapes;
    for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
    {
      const geometry::Polygon polygon = mesh.polygon(cell);
      std::array<Place, 3> sides{}; // of a triangle the last is the first vertex itself
      for (std::size_t v = 1; v < polygon.size(); ++v)
        sides[v - 1] = place(Point<2>(polygon[v] - polygon[0]));
      shape_.push_back(
          shapes.try_emplace(sides, static_cast<unsigned int>(shapes.size())).first->second);
      if (shapes.size() > most)
        return false;
    }
    return true;
  }

  RepeatedPairs::RepeatedPairs(const geometry::Mesh &mesh, const std::vector<CellPairs> &all,
                               std::vector<CellPairs> &own)
      : quantum_(1e-9 * mesh.longest_side())
  {
    if (!find_shapes(mesh))
      return;
    const auto key = [&](std::size_t outer, std::size_t inner)
    {
      const auto start = [&](std::size_t cell)
      { return mesh.vertices[mesh.cells[cell].vertex[0]]; };
      return Key{shape_[outer], shape_[inner], place(Point<2>(start(inner) - start(outer)))};
    };
    std::unordered_map<Key, unsigned int, Hash> known;
    std::size_t n_pairs = 0;
    for (std::size_t cell = 0; cell < all.size(); ++cell)
      for (const unsigned int partner : all[cell].partners)
      {
        ++n_pairs;
        if (known.try_emplace(key(cell, partner), static_cast<unsigned int>(first_.size())).second)
          first_.emplace_back(cell, partner);
      }
    constexpr std::size_t often = 4; // fewer repetitions are not worth the memory
    if (first_.size() * often > n_pairs)
    {
      first_.clear();
      return;
    }
    for (std::size_t cell = 0; cell < own.size(); ++cell)
      for (const unsigned int partner : own[cell].partners)
        own[cell].same.push_back(known.at(key(cell, partner)));
  }
} // namespace plumbline::reference
