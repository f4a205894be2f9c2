#include "reference/mesh/repeated_pairs.h"

#include "reference/mesh/translations.h"

#include <unordered_map>

namespace plumbline::reference
{
  RepeatedPairs::RepeatedPairs(const geometry::Mesh &mesh, const std::vector<CellPairs> &all,
                               std::vector<CellPairs> &own)
  {
    const Translations translations(mesh);
    if (!translations.has_few_shapes())
      return;
    std::unordered_map<Translations::Pair, unsigned int, Translations::Pair::Hash> known;
    std::size_t n_pairs = 0;
    for (std::size_t cell = 0; cell < all.size(); ++cell)
      for (const unsigned int partner : all[cell].partners)
      {
        ++n_pairs;
        const auto next = static_cast<unsigned int>(first_.size());
        if (known.try_emplace(translations.pair(cell, partner), next).second)
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
        own[cell].same.push_back(known.at(translations.pair(cell, partner)));
  }
} // namespace plumbline::reference
