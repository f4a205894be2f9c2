#pragma once

#include "geometry/mesh.h"

#include <array>
#include <cstdint>
#include <tuple>
#include <vector>

namespace plumbline::reference
{
  /// Cells of a mesh, and pairs of them, that are translations of one another: on uniform meshes,
  /// nearly all. Cells that differ by less than 1e-9 of the mesh's longest side have one shape.
  class Translations
  {
  public:
    explicit Translations(const geometry::Mesh &mesh);

    /// There are 64 shapes at most; else nothing is known of pairs.
    bool has_few_shapes() const { return has_few_; }

    /// A pair of cells, but for where it is.
    struct Pair
    {
      unsigned int outer = 0, inner = 0;    ///< shapes
      std::array<std::int64_t, 2> offset{}; ///< of the inner cell, in quanta

      bool operator==(const Pair &other) const { return all() == other.all(); }
      bool operator<(const Pair &other) const { return all() < other.all(); }

      struct Hash
      {
        std::size_t operator()(const Pair &pair) const;
      };

    private:
      std::tuple<unsigned int, unsigned int, std::int64_t, std::int64_t> all() const
      {
        return {outer, inner, offset[0], offset[1]};
      }
    };

    /// @pre has_few_shapes()
    Pair pair(std::size_t outer, std::size_t inner) const
    {
      return {shape_[outer], shape_[inner], place(start(inner) - start(outer))};
    }

  private:
    using Place = std::array<std::int64_t, 2>;

    Place place(const dealii::Tensor<1, 2> &x) const;
    const geometry::Point<2> &start(std::size_t cell) const
    {
      return mesh_.vertices[mesh_.cells[cell].vertex[0]];
    }

    const geometry::Mesh &mesh_;
    double quantum_;
    std::vector<unsigned int> shape_; ///< of each cell
    bool has_few_ = true;
  };
} // namespace plumbline::reference
