#include "reference/mesh/translations.h"

#include <cmath>
#include <map>

namespace plumbline::reference
{
  std::size_t Translations::Pair::Hash::operator()(const Pair &pair) const
  {
    constexpr std::uint64_t odd = 0x9e3779b97f4a7c15u; // 2^64 over the golden ratio
    std::uint64_t hash = pair.outer * std::uint64_t(1 << 16) + pair.inner;
    for (const std::int64_t x : pair.offset)
      hash = (hash ^ static_cast<std::uint64_t>(x)) * odd ^ hash >> 29;
    return hash;
  }

  Translations::Place Translations::place(const dealii::Tensor<1, 2> &x) const
  {
    return {std::llround(x[0] / quantum_), std::llround(x[1] / quantum_)};
  }

  Translations::Translations(const geometry::Mesh &mesh)
      : mesh_(mesh), quantum_(1e-9 * mesh.longest_side())
  {
    constexpr std::size_t most = 64;
    std::map<std::array<Place, 3>, unsigned int> shapes;
    for (std::size_t cell = 0; cell < mesh.cells.size() && has_few_; ++cell)
    {
      const geometry::Polygon polygon = mesh.polygon(cell);
      std::array<Place, 3> sides{}; // of a triangle the last is the first vertex itself
      for (std::size_t v = 1; v < polygon.size(); ++v)
        sides[v - 1] = place(polygon[v] - polygon[0]);
      shape_.push_back(
          shapes.try_emplace(sides, static_cast<unsigned int>(shapes.size())).first->second);
      has_few_ = shapes.size() <= most;
    }
  }
} // namespace plumbline::reference
