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

  MeshCells::MeshCells(const geometry::Mesh &mesh) : vertices_(mesh.vertices), locator_(mesh)
  {
    for (std::size_t part = 0; part < locator_.size(); ++part)
      parts_.emplace_back(locator_.polygon(part));
    for (const geometry::WholeCell &whole : mesh.wholes)
    {
      first_part_.push_back(whole.first_part);
      outlines_.push_back(whole.outline);
    }
    for (std::size_t cell = 0; cell < mesh.cells.size() && mesh.wholes.empty(); ++cell)
    {
      first_part_.push_back(cell);
      outlines_.emplace_back(mesh.cells[cell].vertex.begin(),
                             mesh.cells[cell].vertex.begin() + mesh.cells[cell].n_vertices);
    }
    first_part_.push_back(parts_.size());
    measure();
  }

  void MeshCells::measure()
  {
    for (std::size_t cell = 0; cell < outlines_.size(); ++cell)
    {
      geometry::Polygon polygon;
      for (const unsigned int vertex : outlines_[cell])
        polygon.push_back(vertices_[vertex]);
      Point<2> centroid = parts_[first_part_[cell]].moments().centroid;
      double area = parts_[first_part_[cell]].moments().area;
      for (std::size_t part = first_part_[cell] + 1; part < first_part_[cell + 1]; ++part)
      {
        const double more = parts_[part].moments().area;
        area += more;
        centroid += more / area * (parts_[part].moments().centroid - centroid);
      }
      for (std::size_t part = first_part_[cell]; part < first_part_[cell + 1]; ++part)
        cell_of_.push_back(cell);
      double radius = 0;
      // its first side is the lower one, so that shape functions are those of the unit square
      bool is_rectangle = polygon.size() == 4 && polygon[1][0] > polygon[0][0];
      for (std::size_t v = 0; v < polygon.size(); ++v)
      {
        const auto side = polygon[(v + 1) % polygon.size()] - polygon[v];
        radius = std::max(radius, polygon[v].distance(centroid));
        is_rectangle = is_rectangle && (side[0] == 0 || side[1] == 0);
      }
      polygons_.push_back(std::move(polygon));
      centroid_.push_back(centroid);
      area_.push_back(area);
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
    // those that only touch the circle are not near, whichever way rounding goes: cells around
    // translations of a cell are translations then
    constexpr double rounding = 1e-12;
    const double most = distance * distance * (1 - rounding);
    // cells of a mesh do not overlap: they are nearest at a vertex of one of them
    const auto reaches = [&](const geometry::Polygon &from, const geometry::Polygon &to)
    {
      for (const Point<2> &x : from)
        for (std::size_t w = 0; w < to.size(); ++w)
          if (square_distance(x, to[w], to[(w + 1) % to.size()]) < most)
            return true;
      return false;
    };
    return reaches(polygons_[a], polygons_[b]) || reaches(polygons_[b], polygons_[a]);
  }

  void MeshCells::find_near(std::size_t cell, double distance,
                            std::vector<unsigned int> &near) const
  {
    geometry::Box reach = geometry::bounding_box(geometry::view(polygons_[cell]));
    for (unsigned int d = 0; d < 2; ++d)
    {
      reach.lower[d] -= distance;
      reach.upper[d] += distance;
    }
    locator_.find(reach, near);
    for (unsigned int &part : near)
      part = static_cast<unsigned int>(cell_of_[part]);
    near.erase(std::unique(near.begin(), near.end()), near.end()); // parts of a cell are a run
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

  geometry::PairPosition MeshCells::position(std::size_t a, std::size_t b, double horizon) const
  {
    using geometry::PairPosition;
    return !is_near(a, b, horizon)     ? PairPosition::apart
           : farthest(a, b) <= horizon ? PairPosition::inside
                                       : PairPosition::cut;
  }
} // namespace plumbline::reference
