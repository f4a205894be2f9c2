#pragma once

#include "geometry/cube_lattice.h"
#include "geometry/lattice.h"

namespace plumbline::geometry
{
  /// Degrees of freedom of several families on the cells of a lattice in space, the counterpart of
  /// NodeSet: family = s1 + n (s2 + n s3), n families along an axis, each at the positions of the
  /// cells of the bounding box. Vectors over them have shape (n_blocks, n[2], n[1], n[0]), block =
  /// component · n_families + family, and vanish where nothing is free.
  struct CubeFamilies
  {
    std::vector<AxisSpecies> axis;
    unsigned int n_components = 1;
    std::array<int, 3> n{};
    std::vector<char> is_free; ///< shape (n_families, n[2], n[1], n[0]): the support lies in Ω

    unsigned int n_families() const
    {
      return static_cast<unsigned int>(axis.size() * axis.size() * axis.size());
    }
    unsigned int n_blocks() const { return n_components * n_families(); }
    std::size_t n_positions() const { return static_cast<std::size_t>(n[0]) * n[1] * n[2]; }
    std::size_t size() const { return n_blocks() * n_positions(); }
    std::size_t n_free() const; ///< of one component

    /// The families along the axes that make up a family.
    std::array<unsigned int, 3> along(unsigned int family) const;

    /// False outside the bounding box as well.
    bool free(unsigned int family, const std::array<int, 3> &at) const
    {
      return is_within(at, n) && is_free[family * n_positions() + number_within(at, n)] != 0;
    }

    /// visit(family, position) for the free ones, family by family, x fastest.
    template <class Visit>
    void for_each_free(const Visit &visit) const
    {
      for (unsigned int family = 0; family < n_families(); ++family)
        for_each_index({0, 0, 0}, n,
                       [&](const std::array<int, 3> &at)
                       {
                         if (free(family, at))
                           visit(family, at);
                       });
    }

    /// Places of the free ones of all components in vectors, component by component.
    std::vector<std::size_t> free_places() const;
  };

  /// All degrees of freedom whose support lies in Ω: a family at a vertex along an axis needs the
  /// cells on both sides, every other family its own cell.
  CubeFamilies free_families(const CubeLattice &lattice, std::vector<AxisSpecies> axis,
                             unsigned int n_components);
} // namespace plumbline::geometry
