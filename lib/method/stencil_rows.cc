#include "method/stencil_rows.h"

#include "base/memory.h"
#include "geometry/for_each_index.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace plumbline::method
{
  namespace
  {
    using Index = std::array<int, 3>;

    /// A non-zero entry in a row of a stencil.
    struct Entry
    {
      unsigned int family, component;
      Index offset;
      double value;
    };

    /// Numbers of nodes within the reach of a stencil around the lattice.
    class Numbering
    {
    public:
      static constexpr std::int64_t unseen = -1, reached = -2;

      Numbering(const LatticeNodes &nodes, const Index &reaches) : nodes_(nodes), reaches_(reaches)
      {
        numbers_.assign(nodes.n_families * block(), unseen);
      }

      template <class Visit>
      void for_each(const Index &margin, const Visit &visit) const
      {
        for (unsigned int family = 0; family < nodes_.n_families; ++family)
          geometry::for_each_index(
              {-margin[0], -margin[1], -margin[2]},
              {nodes_.n[0] + margin[0], nodes_.n[1] + margin[1], nodes_.n[2] + margin[2]},
              [&](const Index &at) { visit(family, at); });
      }

      std::int64_t &operator()(unsigned int family, const Index &at)
      {
        std::size_t place = family;
        for (unsigned int d = 3; d-- > 0;)
          place = place * width(d) + static_cast<std::size_t>(at[d] + reaches_[d]);
        return numbers_[place];
      }

    private:
      std::size_t width(unsigned int d) const
      {
        return static_cast<std::size_t>(nodes_.n[d]) + 2 * static_cast<std::size_t>(reaches_[d]);
      }
      std::size_t block() const { return width(0) * width(1) * width(2); }

      const LatticeNodes &nodes_;
      Index reaches_;
      std::vector<std::int64_t> numbers_;
    };

    /// Of each block row.
    std::vector<std::vector<Entry>> entries_of(const algebra::Stencil &stencil,
                                               unsigned int n_families)
    {
      std::vector<std::vector<Entry>> entries(stencil.n_blocks());
      for (unsigned int s = 0; s < stencil.n_blocks(); ++s)
        for (unsigned int t = 0; t < stencil.n_blocks(); ++t)
          stencil.for_each_offset(
              [&](int k1, int k2, int k3)
              {
                const double value = stencil(s, t, k1, k2, k3);
                if (value != 0)
                  entries[s].push_back({t % n_families, t / n_families, {k1, k2, k3}, value});
              });
      return entries;
    }

    Index moved(const Index &at, const Index &by)
    {
      return {at[0] + by[0], at[1] + by[1], at[2] + by[2]};
    }
  } // namespace

  StencilRows make_rows(const algebra::Stencil &stencil, const LatticeNodes &nodes)
  {
    const auto entries = entries_of(stencil, nodes.n_families);
    const unsigned int nc = nodes.n_components;
    StencilRows result;
    Numbering number(nodes, stencil.reaches());
    number.for_each({0, 0, 0},
                    [&](unsigned int family, const Index &at)
                    {
                      if (!nodes.is_free(family, at))
                        return;
                      number(family, at) = static_cast<std::int64_t>(result.nodes.size());
                      result.nodes.push_back({family, at});
                    });
    result.n_free = result.nodes.size();
    double n_entries = 0;
    for (std::size_t k = 0; k < result.n_free; ++k)
      for (unsigned int c = 0; c < nc; ++c)
        n_entries +=
            static_cast<double>(entries[c * nodes.n_families + result.nodes[k].family].size());
    base::require_memory(n_entries * (sizeof(double) + sizeof(unsigned int)),
                         "the matrix with " + std::to_string(static_cast<long long>(n_entries)) +
                             " entries",
                         "choose a larger h");

    for (std::size_t k = 0; k < result.n_free; ++k)
      for (unsigned int c = 0; c < nc; ++c)
        for (const Entry &entry : entries[c * nodes.n_families + result.nodes[k].family])
          if (auto &one = number(entry.family, moved(result.nodes[k].position, entry.offset));
              one == Numbering::unseen)
            one = Numbering::reached;
    number.for_each(stencil.reaches(),
                    [&](unsigned int family, const Index &at)
                    {
                      auto &one = number(family, at);
                      if (one != Numbering::reached)
                        return;
                      one = static_cast<std::int64_t>(result.nodes.size());
                      result.nodes.push_back({family, at});
                    });

    result.rows.start.assign(1, 0);
    result.rows.column.reserve(static_cast<std::size_t>(n_entries));
    result.rows.value.reserve(static_cast<std::size_t>(n_entries));
    std::vector<std::pair<unsigned int, double>> row;
    for (std::size_t k = 0; k < result.n_free; ++k)
      for (unsigned int c = 0; c < nc; ++c)
      {
        row.clear();
        for (const Entry &entry : entries[c * nodes.n_families + result.nodes[k].family])
          row.emplace_back(
              static_cast<unsigned int>(
                  number(entry.family, moved(result.nodes[k].position, entry.offset)) * nc +
                  entry.component),
              entry.value);
        std::sort(row.begin(), row.end());
        for (const auto &[column, value] : row)
        {
          result.rows.column.push_back(column);
          result.rows.value.push_back(value);
        }
        result.rows.start.push_back(result.rows.column.size());
      }
    return result;
  }
} // namespace plumbline::method
