#include "geometry/convex_polyhedron.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <utility>

namespace plumbline::geometry
{
  namespace
  {
    using dealii::Point;
    using dealii::Tensor;
    using Extended = ConvexPolyhedron::ExtendedVector;

    /// Relative to the diameter: how far a vertex may be off the plane of a face.
    constexpr double flatness = 1e-10;

    /// Relative to the coordinates, which small polyhedra feel.
    constexpr double rounding = 1e-15;

    Extended difference(const Point<3> &a, const Point<3> &b)
    {
      Extended d;
      for (unsigned int k = 0; k < 3; ++k)
        d[k] = static_cast<long double>(a[k]) - b[k];
      return d;
    }

    std::string words(const Point<3> &x)
    {
      std::ostringstream text;
      text.precision(12);
      text << '(' << x[0] << ", " << x[1] << ", " << x[2] << ')';
      return text.str();
    }

    double diameter_of(const std::vector<Point<3>> &points)
    {
      double largest = 0;
      for (std::size_t i = 0; i < points.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
          largest = std::max(largest, points[i].distance(points[j]));
      return largest;
    }

    double largest_coordinate(const std::vector<Point<3>> &points)
    {
      double largest = 0;
      for (const Point<3> &x : points)
        for (unsigned int d = 0; d < 3; ++d)
          largest = std::max(largest, std::abs(x[d]));
      return largest;
    }
  } // namespace

  ConvexPolyhedron::ConvexPolyhedron(std::vector<Point<3>> vertices, std::vector<Indices> faces,
                                     const std::vector<Tensor<1, 3>> &normals)
      : vertices_(std::move(vertices))
  {
    if (vertices_.size() < 4 || faces.size() < 4)
      throw InputError("a polyhedron has at least 4 vertices and 4 faces, not " +
                       std::to_string(vertices_.size()) + " and " + std::to_string(faces.size()));
    for (const Point<3> &x : vertices_)
      if (!std::isfinite(x[0]) || !std::isfinite(x[1]) || !std::isfinite(x[2]))
        throw InputError("a vertex of a polyhedron is not finite: " + words(x));
    for (Indices &face : faces)
    {
      if (face.size() < 3)
        throw InputError("a face of a polyhedron has at least 3 vertices");
      for (const unsigned int vertex : face)
        if (vertex >= vertices_.size())
          throw InputError("a face of a polyhedron names vertex " + std::to_string(vertex) +
                           " of " + std::to_string(vertices_.size()) + "; count from 0");
      faces_.push_back({std::move(face), {}, {}, 0});
    }
    find_edges();
    find_planes(normals);
    measure();
    find_box();
  }

  void ConvexPolyhedron::find_edges()
  {
    std::map<std::array<unsigned int, 2>, unsigned int> known; // as the first face runs it
    std::vector<unsigned int> n_faces;
    for (Face &face : faces_)
      for (std::size_t k = 0; k < face.vertices.size(); ++k)
      {
        const unsigned int a = face.vertices[k], b = face.vertices[(k + 1) % face.vertices.size()];
        const auto reversed = known.find({b, a});
        if (known.count({a, b}) > 0)
          throw InputError("two faces of a polyhedron run the edge from vertex " +
                           std::to_string(a) + " to " + std::to_string(b) +
                           " alike; write each face counter-clockwise seen from outside");
        if (reversed == known.end())
        {
          known[{a, b}] = static_cast<unsigned int>(edges_.size());
          face.sides.push_back({static_cast<unsigned int>(edges_.size()), true});
          edges_.push_back({a, b});
          n_faces.push_back(1);
        }
        else
        {
          face.sides.push_back({reversed->second, false});
          ++n_faces[reversed->second];
        }
      }
    for (std::size_t e = 0; e < edges_.size(); ++e)
      if (n_faces[e] != 2)
        throw InputError("the faces of a polyhedron do not close: the edge from vertex " +
                         std::to_string(edges_[e][0]) + " to " + std::to_string(edges_[e][1]) +
                         " belongs to " + std::to_string(n_faces[e]) + ", not to 2");
  }

  void ConvexPolyhedron::find_planes(const std::vector<Tensor<1, 3>> &normals)
  {
    const double diameter = diameter_of(vertices_),
                 off = flatness * diameter + rounding * largest_coordinate(vertices_);
    for (std::size_t f = 0; f < faces_.size(); ++f)
    {
      Face &face = faces_[f];
      const Point<3> &first = vertices_[face.vertices.front()];
      std::vector<Point<3>> corners;
      Extended area;
      for (std::size_t k = 0; k < face.vertices.size(); ++k)
      {
        corners.push_back(vertices_[face.vertices[k]]);
        if (k > 1)
          area +=
              cross_product_3d(difference(corners[k - 1], first), difference(corners[k], first));
      }
      face.diameter = diameter_of(corners);
      if (!normals.empty())
        area = difference(Point<3>(normals[f]), Point<3>());
      const long double size = area.norm();
      if (normals.empty() && !(size > flatness * diameter * face.diameter))
        throw InputError("a face of a polyhedron at " + words(first) + " has no area");
      face.normal = area / size;
      for (const unsigned int vertex : face.vertices)
        if (std::abs(face.normal * difference(vertices_[vertex], first)) > off)
          throw InputError("a face of a polyhedron is not plane: vertex " + std::to_string(vertex) +
                           " at " + words(vertices_[vertex]) +
                           " is off; split the face into triangles");
      for (const Point<3> &x : vertices_)
        if (face.normal * difference(x, first) > off)
          throw InputError("a polyhedron is not convex, or a face is written clockwise: " +
                           words(x) + " lies outside of the face at " + words(first));
    }
  }

  void ConvexPolyhedron::measure()
  {
    const Point<3> &apex = vertices_.front();
    long double volume = 0;
    Tensor<1, 3> first;
    dealii::SymmetricTensor<2, 3> second;
    for (const Face &face : faces_)
      for (std::size_t k = 2; k < face.vertices.size(); ++k)
      {
        // a tetrahedron: ∫ r r = volume (Σ r_i r_i + s s) / 20, s = Σ r_i, with a corner at 0
        const Tensor<1, 3> a = vertices_[face.vertices[0]] - apex,
                           b = vertices_[face.vertices[k - 1]] - apex,
                           c = vertices_[face.vertices[k]] - apex, sum = a + b + c;
        const double part = a * cross_product_3d(b, c) / 6;
        volume += part;
        first += part / 4 * sum;
        second += part / 20 *
                  symmetrize(outer_product(a, a) + outer_product(b, b) + outer_product(c, c) +
                             outer_product(sum, sum));
      }
    moments_.volume = static_cast<double>(volume);
    const Tensor<1, 3> mean = first / moments_.volume;
    moments_.centroid = apex + mean;
    moments_.second = second - moments_.volume * symmetrize(outer_product(mean, mean));
  }

  void ConvexPolyhedron::find_box()
  {
    lower_ = upper_ = vertices_.front();
    for (const Point<3> &x : vertices_)
      for (unsigned int d = 0; d < 3; ++d)
      {
        lower_[d] = std::min(lower_[d], x[d]);
        upper_[d] = std::max(upper_[d], x[d]);
      }
    std::array<bool, 8> is_there{}; // each corner of the smallest box
    is_box_ = vertices_.size() == is_there.size();
    for (const Point<3> &x : vertices_)
    {
      unsigned int corner = 0;
      for (unsigned int d = 0; d < 3; ++d)
      {
        corner |= (x[d] == upper_[d] ? 1u : 0u) << d;
        is_box_ = is_box_ && (x[d] == lower_[d] || x[d] == upper_[d]);
      }
      is_there[corner] = true;
    }
    is_box_ = is_box_ && std::all_of(is_there.begin(), is_there.end(), [](bool it) { return it; });
  }

  ConvexPolyhedron ConvexPolyhedron::box(const Point<3> &lower, const Point<3> &upper)
  {
    std::vector<Point<3>> vertices;
    for (unsigned int i = 0; i < 8; ++i)
      vertices.emplace_back((i & 1u) ? upper[0] : lower[0], (i & 2u) ? upper[1] : lower[1],
                            (i & 4u) ? upper[2] : lower[2]);
    return {std::move(vertices),
            {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  }

  ConvexPolyhedron ConvexPolyhedron::tetrahedron(std::array<Point<3>, 4> vertices)
  {
    const Tensor<1, 3> a = vertices[1] - vertices[0], b = vertices[2] - vertices[0],
                       c = vertices[3] - vertices[0];
    if (a * cross_product_3d(b, c) < 0)
      std::swap(vertices[2], vertices[3]);
    return {{vertices.begin(), vertices.end()}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
  }
} // namespace plumbline::geometry
