#pragma once

#include "geometry/mesh.h"
#include "geometry/search.h"

namespace plumbline::reference
{
  /// What assembly asks of the cells of a mesh again and again, computed once.
  class MeshCells
  {
  public:
    explicit MeshCells(const geometry::Mesh &mesh);

    MeshCells(const MeshCells &) = delete; // cells_ are views of polygons_
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

    /// Cells whose bounding boxes meet a box.
    void find(const geometry::Box &box, std::vector<unsigned int> &found) const
    {
      search_.find(box, found);
    }

    /// Cells whose distance to the given one is less than `distance`, itself included, ascending.
    /// @param near  overwritten
    void find_near(std::size_t cell, double distance, std::vector<unsigned int> &near) const;

    /// The largest distance between points of two cells.
    double farthest(std::size_t a, std::size_t b) const;

  private:
    bool is_near(std::size_t a, std::size_t b, double distance) const;

    std::vector<geometry::Polygon> polygons_;
    std::vector<geometry::ConvexCell> cells_;
    std::vector<double> radius_;
    std::vector<char> is_rectangle_;
    geometry::BoxSearch search_;
  };
} // namespace plumbline::reference
