#include "geometry/polyhedron_clip.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace plumbline::geometry
{
  using dealii::Point;
  using dealii::Tensor;
  using Indices = ConvexPolyhedron::Indices;

  ClippedPolyhedron::ClippedPolyhedron(const Point<3> &lower, const Point<3> &upper)
  {
    const ConvexPolyhedron box = ConvexPolyhedron::box(lower, upper);
    vertices_ = box.vertices();
    for (const ConvexPolyhedron::Face &face : box.faces())
    {
      Tensor<1, 3> normal;
      for (unsigned int d = 0; d < 3; ++d)
        normal[d] = std::round(static_cast<double>(face.normal[d]));
      faces_.push_back({face.vertices, normal});
    }
  }

  double ClippedPolyhedron::volume() const
  {
    double volume = 0;
    for (const Face &face : faces_)
      for (std::size_t k = 2; k < face.vertices.size(); ++k)
      {
        const Point<3> &apex = vertices_.front();
        volume += (vertices_[face.vertices[0]] - apex) *
                  cross_product_3d(vertices_[face.vertices[k - 1]] - apex,
                                   vertices_[face.vertices[k]] - apex) /
                  6;
      }
    return volume;
  }

  bool ClippedPolyhedron::clip(const Tensor<1, 3> &normal, double offset)
  {
    const double length = normal.norm();
    const Tensor<1, 3> unit = normal / length;
    std::vector<double> heights;
    for (const Point<3> &x : vertices_)
      heights.push_back(unit * x - offset / length);
    // vertices may lie at the tolerance itself, on both sides of it by rounding
    for (const double tolerance : {1e-12, 1.7e-12, 2.9e-12, .6e-12, 5e-12, 1e-11})
    {
      if (std::none_of(heights.begin(), heights.end(), [&](double s) { return s > tolerance; }))
        return true;
      if (std::none_of(heights.begin(), heights.end(), [&](double s) { return s < -tolerance; }))
      {
        vertices_.clear();
        faces_.clear();
        return false;
      }
      if (try_clip(unit, heights, tolerance))
        return true;
    }
    throw NumericalError("a Voronoi cell cannot be clipped: too many nodes are equidistant up to "
                         "rounding; round their coordinates or move some nodes");
  }

  bool ClippedPolyhedron::try_clip(const Tensor<1, 3> &normal, const std::vector<double> &heights,
                                   double tolerance)
  {
    std::vector<Point<3>> vertices = vertices_;
    std::map<std::pair<unsigned int, unsigned int>, unsigned int> known;
    const auto is_kept = [&](unsigned int v) { return heights[v] <= tolerance; };
    const auto crossing = [&](unsigned int kept, unsigned int lost)
    {
      if (heights[kept] >= -tolerance) // it lies on the plane
        return kept;
      const auto [place, is_new] =
          known.insert({{kept, lost}, static_cast<unsigned int>(vertices.size())});
      if (is_new)
      {
        const double s = heights[kept] / (heights[kept] - heights[lost]);
        vertices.push_back(vertices_[kept] + s * (vertices_[lost] - vertices_[kept]));
      }
      return place->second;
    };

    std::vector<Face> faces;
    std::map<unsigned int, unsigned int> next; // along the new face
    for (const Face &face : faces_)
    {
      Face rest{{}, face.normal};
      const auto add = [&](unsigned int vertex)
      {
        if (rest.vertices.empty() || rest.vertices.back() != vertex)
          rest.vertices.push_back(vertex);
      };
      unsigned int n_exits = 0, exit = 0, entry = 0;
      for (std::size_t k = 0; k < face.vertices.size(); ++k)
      {
        const unsigned int a = face.vertices[k], b = face.vertices[(k + 1) % face.vertices.size()];
        if (is_kept(a))
          add(a);
        if (is_kept(a) && !is_kept(b))
        {
          ++n_exits;
          add(exit = crossing(a, b));
        }
        else if (!is_kept(a) && is_kept(b))
          add(entry = crossing(b, a));
      }
      if (n_exits > 1)
        return false;
      if (n_exits == 1 && exit != entry && !next.insert({entry, exit}).second)
        return false;
      while (rest.vertices.size() > 1 && rest.vertices.back() == rest.vertices.front())
        rest.vertices.pop_back();
      if (rest.vertices.size() > 2)
        faces.push_back(std::move(rest));
    }

    if (!next.empty())
    {
      Face cap{{}, normal};
      const unsigned int first = next.begin()->first;
      unsigned int vertex = first;
      do
      {
        const auto step = next.find(vertex);
        if (step == next.end() || cap.vertices.size() == next.size())
          return false;
        cap.vertices.push_back(vertex);
        vertex = step->second;
      } while (vertex != first);
      if (cap.vertices.size() != next.size())
        return false;
      if (cap.vertices.size() > 2)
        faces.push_back(std::move(cap));
    }
    if (faces.size() < 4)
      return false;
    vertices_ = std::move(vertices);
    faces_ = std::move(faces);
    drop_unused_vertices();
    return true;
  }

  void ClippedPolyhedron::drop_unused_vertices()
  {
    constexpr unsigned int unused = std::numeric_limits<unsigned int>::max();
    std::vector<unsigned int> number(vertices_.size(), unused);
    std::vector<Point<3>> used;
    for (Face &face : faces_)
      for (unsigned int &vertex : face.vertices)
      {
        if (number[vertex] == unused)
        {
          number[vertex] = static_cast<unsigned int>(used.size());
          used.push_back(vertices_[vertex]);
        }
        vertex = number[vertex];
      }
    vertices_ = std::move(used);
  }
} // namespace plumbline::geometry
