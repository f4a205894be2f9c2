#pragma once

#include "geometry/cell_locator.h"

namespace plumbline::reference
{
  /// What assembly asks of the cells of a mesh again and again, computed once.
  class MeshCells
  {
  public:
    explicit MeshCells(const geometry::Mesh &mesh);

    MeshCells(const MeshCells &) = delete; // cells_ are views of locator_'s
    MeshCells &operator=(const MeshCells &) = delete;

    std::size_t size() const { return cells_.size(); }
    const geometry::ConvexCell &operator[](std::size_t cell) const { return cells_[cell]; }
    const geometry::Point<2> &centroid(std::size_t cell) const
    {
      return cells_[cell].moments().centroid;
    }
    double area(std::size_t cell) const { return cells_[cell].moments().area; }
    double radius(std::size_t cell) const { return radius_[cell]; } ///< about the centroid
    bool is_rectangle(std::size_t cell) const { return is_rectangle_[cell] != 0; } ///< axis-aligned

    /// Numbers of the vertices of a cell's boundary in the mesh, counter-clockwise.
    const std::vector<unsigned int> &outline(std::size_t cell) const { return outlines_[cell]; }

    const geometry::CellLocator &locator() const { return locator_; }

    /// Cells whose distance to the given one is less than `distance`, itself included, ascending.
    /// @param near  overwritten
    void find_near(std::size_t cell, double distance, std::vector<unsigned int> &near) const;

    /// The largest distance between points of two cells.
    double farthest(std::size_t a, std::size_t b) const;

  private:
    bool is_near(std::size_t a, std::size_t b, double distance) const;

    geometry::CellLocator locator_;
    std::vector<geometry::ConvexCell> cells_;
    std::vector<double> radius_;
    std::vector<char> is_rectangle_;
    std::vector<std::vector<unsigned int>> outlines_;
  };
} // namespace plumbline::reference
