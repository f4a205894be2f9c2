#pragma once

#include "geometry/cell_locator.h"
#include "geometry/pair_position.h"

namespace plumbline::reference
{
  /// What assembly asks of the cells of a mesh again and again, computed once. Where sides follow
  /// curves (geometry::Mesh::wholes), cells are the triangles, each with straight parts.
  class MeshCells
  {
  public:
    explicit MeshCells(const geometry::Mesh &mesh);

    MeshCells(const MeshCells &) = delete; // parts_ are views of locator_'s
    MeshCells &operator=(const MeshCells &) = delete;

    std::size_t size() const { return centroid_.size(); }
    /// @pre  a cell with straight sides
    const geometry::ConvexCell &operator[](std::size_t cell) const
    {
      return parts_[first_part_[cell]];
    }
    const geometry::Point<2> &centroid(std::size_t cell) const { return centroid_[cell]; }
    double area(std::size_t cell) const { return area_[cell]; }
    double radius(std::size_t cell) const { return radius_[cell]; } ///< about the centroid
    bool is_rectangle(std::size_t cell) const { return is_rectangle_[cell] != 0; } ///< axis-aligned

    /// Of a cell, which has one if its sides are straight, else several.
    std::size_t first_part(std::size_t cell) const { return first_part_[cell]; }
    std::size_t end_of_parts(std::size_t cell) const { return first_part_[cell + 1]; }
    const geometry::ConvexCell &part(std::size_t part) const { return parts_[part]; }
    std::size_t cell_of(std::size_t part) const { return cell_of_[part]; }
    bool is_curved(std::size_t cell) const { return end_of_parts(cell) > first_part(cell) + 1; }
    bool has_curves() const { return parts_.size() > size(); }

    /// Numbers of the vertices of a cell's boundary in the mesh, counter-clockwise.
    const std::vector<unsigned int> &outline(std::size_t cell) const { return outlines_[cell]; }
    const geometry::Point<2> &vertex(unsigned int number) const { return vertices_[number]; }

    const geometry::CellLocator &locator() const { return locator_; } ///< of parts

    /// Cells whose distance to the given one is less than `distance`, itself included, ascending.
    /// @param near  overwritten
    void find_near(std::size_t cell, double distance, std::vector<unsigned int> &near) const;

    /// The largest distance between points of two cells.
    double farthest(std::size_t a, std::size_t b) const;

    /// Where they stand to a horizon: apart are those that are not near.
    geometry::PairPosition position(std::size_t a, std::size_t b, double horizon) const;

  private:
    bool is_near(std::size_t a, std::size_t b, double distance) const;
    void measure();

    std::vector<geometry::Point<2>> vertices_;
    geometry::CellLocator locator_;
    std::vector<geometry::ConvexCell> parts_;
    std::vector<std::size_t> first_part_, cell_of_;
    std::vector<std::vector<unsigned int>> outlines_;
    std::vector<geometry::Polygon> polygons_; ///< of the outlines
    std::vector<geometry::Point<2>> centroid_;
    std::vector<double> area_, radius_;
    std::vector<char> is_rectangle_;
  };
} // namespace plumbline::reference
