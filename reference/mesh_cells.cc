#include "reference/mesh_cells.h"

#include <algorithm>
#include <cmath>

namespace plumbline::reference
{
  namespace
  {
    using geometry::Point;

    std::vector<geometry::Polygon> polygons(const geometry::Mesh &mesh)
    {
      std::vector<geometry::Polygon> result;
      for (std::size_t i = 0; i < mesh.cells.size(); ++i)
        result.push_back(mesh.polygon(i));
      return result;
    }

    std::vector<geometry::Box> boxes(const std::vector<geometry::ConvexCell> &cells)
    {
      std::vector<geometry::Box> result;
      for (const geometry::ConvexCell &cell : cells)
        result.push_back(cell.box());
      return result;
    }

    double square_distance(const Point<2> &x, const Point<2> &a, const Point<2> &b)
    {
      const dealii::Tensor<1, 2> side = b - a;
      const double t = std::clamp(((x - a) * side) / side.norm_square(), 0., 1.);
      return (x - (a + t * side)).norm_square();
    }
  } // namespace

  MeshCells::MeshCells(const geometry::Mesh &mesh)
      : polygons_(polygons(mesh)), cells_(polygons_.begin(), polygons_.end()),
        search_(boxes(cells_))
  {
    for (std::size_t i = 0; i < cells_.size(); ++i)
    {
      const geometry::Polygon &polygon = polygons_[i];
      double radius = 0;
      // its first side is the lower one, so that shape functions are those of the unit square
      bool is_rectangle = polygon.size() == 4 && polygon[1][0] > polygon[0][0];
      for (std::size_t v = 0; v < polygon.size(); ++v)
      {
        const auto side = polygon[(v + 1) % polygon.size()] - polygon[v];
        radius = std::max(radius, polygon[v].distance(centroid(i)));
        is_rectangle = is_rectangle && (side[0] == 0 || side[1] == 0);
      }
      radius_.push_back(radius);
      is_rectangle_.push_back(is_rectangle);
    }
  }

  bool MeshCells::is_near(std::size_t a, std::size_t b, double distance) const
  {
    const double between = centroid(a).distance(centroid(b));
    if (between >= distance + radius(a) + radius(b))
      return false;
    if (between < distance)
      return true;
    // cells of a mesh do not overlap: they are nearest at a vertex of one of them
    const auto reaches = [&](const geometry::Polygon &from, const geometry::Polygon &to)
    {
      for (const Point<2> &x : from)
        for (std::size_t w = 0; w < to.size(); ++w)
          if (square_distance(x, to[w], to[(w + 1) % to.size()]) < distance * distance)
            return true;
      return false;
    };
    return reaches(polygons_[a], polygons_[b]) || reaches(polygons_[b], polygons_[a]);
  }

  void MeshCells::find_near(std::size_t cell, double distance,
                            std::vector<unsigned int> &near) const
  {
    geometry::Box reach = cells_[cell].box();
    for (unsigned int d = 0; d < 2; ++d)
    {
      reach.lower[d] -= distance;
      reach.upper[d] += distance;
    }
    search_.find(reach, near);
    near.erase(std::remove_if(near.begin(), near.end(),
                              [&](unsigned int other) { return !is_near(cell, other, distance); }),
               near.end());
  }

  double MeshCells::farthest(std::size_t a, std::size_t b) const
  {
    double square = 0;
    for (const Point<2> &x : polygons_[a])
      for (const Point<2> &y : polygons_[b])
        square = std::max(square, (x - y).norm_square());
    return std::sqrt(square);
  }
} // namespace plumbline::reference
