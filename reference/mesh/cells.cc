#include "reference/mesh/cells.h"

#include <algorithm>
#include <cmath>

namespace plumbline::reference
{
  namespace
  {
    using geometry::Point;

    double square_distance(const Point<2> &x, const Point<2> &a, const Point<2> &b)
    {
      const dealii::Tensor<1, 2> side = b - a;
      const double t = std::clamp(((x - a) * side) / side.norm_square(), 0., 1.);
      return (x - (a + t * side)).norm_square();
    }
  } // namespace

  MeshCells::MeshCells(const geometry::Mesh &mesh) : locator_(mesh)
  {
    for (std::size_t i = 0; i < locator_.size(); ++i)
    {
      const geometry::Polygon &polygon = locator_.polygon(i);
      cells_.emplace_back(polygon);
      outlines_.emplace_back(mesh.cells[i].vertex.begin(),
                             mesh.cells[i].vertex.begin() + mesh.cells[i].n_vertices);
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
    return reaches(locator_.polygon(a), locator_.polygon(b)) ||
           reaches(locator_.polygon(b), locator_.polygon(a));
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
    locator_.find(reach, near);
    near.erase(std::remove_if(near.begin(), near.end(),
                              [&](unsigned int other) { return !is_near(cell, other, distance); }),
               near.end());
  }

  double MeshCells::farthest(std::size_t a, std::size_t b) const
  {
    double square = 0;
    for (const Point<2> &x : locator_.polygon(a))
      for (const Point<2> &y : locator_.polygon(b))
        square = std::max(square, (x - y).norm_square());
    return std::sqrt(square);
  }
} // namespace plumbline::reference
