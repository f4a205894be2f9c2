#pragma once

#include "geometry/mesh.h"
#include "geometry/search.h"

#include <optional>

namespace plumbline::geometry
{
  /// Finds the cells of a mesh at a place: O(1), as BoxSearch. A cell holds its boundary, within
  /// 1e-15 of the largest of its coordinates, so that no point falls in between the cells of a mesh
  /// that passes `check`. Thread safe.
  class CellLocator
  {
  public:
    /// @param mesh  of convex cells, copied
    explicit CellLocator(const Mesh &mesh);

    std::size_t size() const { return polygons_.size(); } ///< n_cells
    const Polygon &polygon(std::size_t cell) const { return polygons_[cell]; }
    bool is_inside(std::size_t cell) const { return is_inside_[cell]; } ///< in Ω, not in the collar

    /// The cell that holds a point, none outside of the mesh. Of cells that share it, one of Ω
    /// comes before those of the collar (Ω is closed), and then the first.
    std::optional<std::size_t> find(const Point<2> &x) const;

    /// The same for a point of the mesh.
    /// @throws InputError  a point outside, naming it
    std::size_t at(const Point<2> &x) const;

    /// Cells whose bounding boxes share a point with the given one, to rounding, ascending.
    /// @param found  overwritten
    void find(const Box &box, std::vector<unsigned int> &found) const { search_.find(box, found); }

  private:
    std::vector<Polygon> polygons_;
    std::vector<bool> is_inside_;
    BoxSearch<2> search_;
  };
} // namespace plumbline::geometry
