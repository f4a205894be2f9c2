#include "geometry/hexahedron.h"

#include "base/error.h"

#include <deal.II/base/geometry_info.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

namespace plumbline::geometry
{
  namespace
  {
    using dealii::Point;
    using dealii::Tensor;
    using Cube = dealii::GeometryInfo<3>;

    constexpr unsigned int n_corners = Cube::vertices_per_cell;

    std::array<Point<3>, n_corners> corners_of(const TetrahedralMesh &mesh, std::size_t hexahedron)
    {
      std::array<Point<3>, n_corners> corners;
      for (unsigned int k = 0; k < n_corners; ++k)
        corners[k] = mesh.vertices[mesh.hexahedra[hexahedron][k]];
      return corners;
    }

    /// The vertices of the face where coordinate `axis` is 0 or 1, counter-clockwise seen from
    /// outside.
    std::array<unsigned int, 4> around_face(const std::array<unsigned int, n_corners> &cell,
                                            unsigned int axis, bool is_upper)
    {
      const unsigned int first = is_upper ? 1U << axis : 0, u = 1U << (axis + 1) % 3,
                         v = 1U << (axis + 2) % 3;
      return {cell[first], cell[first + (is_upper ? u : v)], cell[first + u + v],
              cell[first + (is_upper ? v : u)]};
    }

    double longest_edge(const std::array<Point<3>, n_corners> &corners)
    {
      double longest = 0;
      for (const auto &[a, b] : std::vector<std::array<unsigned int, 2>>{{0, 1},
                                                                         {2, 3},
                                                                         {4, 5},
                                                                         {6, 7},
                                                                         {0, 2},
                                                                         {1, 3},
                                                                         {4, 6},
                                                                         {5, 7},
                                                                         {0, 4},
                                                                         {1, 5},
                                                                         {2, 6},
                                                                         {3, 7}})
        longest = std::max(longest, corners[a].distance(corners[b]));
      return longest;
    }
  } // namespace

  Hexahedron::Hexahedron(const TetrahedralMesh &mesh, std::size_t hexahedron)
      : corners_(corners_of(mesh, hexahedron))
  {
  }

  Hexahedron::Values Hexahedron::values(const Point<3> &s)
  {
    Values values{};
    for (unsigned int k = 0; k < n_corners; ++k)
      values[k] = Cube::d_linear_shape_function(s, k);
    return values;
  }

  Point<3> Hexahedron::at(const Point<3> &s) const
  {
    const Values functions = values(s);
    Point<3> x;
    for (unsigned int k = 0; k < n_corners; ++k)
      x += functions[k] * corners_[k];
    return x;
  }

  Tensor<2, 3> Hexahedron::jacobian(const Point<3> &s) const
  {
    Tensor<2, 3> result;
    for (unsigned int k = 0; k < n_corners; ++k)
      result += outer_product(corners_[k], Cube::d_linear_shape_function_gradient(s, k));
    return result;
  }

  Hexahedron::Slopes Hexahedron::slopes(const Point<3> &s) const
  {
    const Tensor<2, 3> inverse = invert(jacobian(s));
    Slopes result;
    for (unsigned int k = 0; k < n_corners; ++k)
      result[k] = Cube::d_linear_shape_function_gradient(s, k) * inverse;
    return result;
  }

  Point<3> Hexahedron::place(const Point<3> &x) const
  {
    constexpr unsigned int most_steps = 50;
    constexpr double accuracy = 1e-14, far = 10; // of the unit cube
    std::array<Point<3>, n_corners> local; // about the first corner: far away, digits are lost
    for (unsigned int k = 0; k < n_corners; ++k)
      local[k] = Point<3>(corners_[k] - corners_[0]);
    const Hexahedron near_origin(local);
    const Point<3> target(x - corners_[0]);
    Point<3> s(.5, .5, .5);
    for (unsigned int step = 0; step < most_steps; ++step)
    {
      const Tensor<1, 3> change = invert(jacobian(s)) * (target - near_origin.at(s));
      s += change;
      if (change.norm() < accuracy)
        return s;
      if (!(s.norm() < far))
        break;
    }
    if (const double missed =
            target.distance(near_origin.at(s)) / corners_[0].distance(corners_[n_corners - 1]);
        missed < 1e-12) // NOLINT: Newton's method went to and fro between rounded numbers
      return s;
    std::ostringstream message;
    message << "(" << x << ") has no reference coordinates in any hexahedron; give cells that are "
            << "less distorted";
    throw NumericalError(message.str());
  }

  double Hexahedron::least_determinant() const
  {
    // of degree 2 along each axis: from values at 0, 1/2, 1 to coefficients, one axis after another
    std::array<double, 27> values{};
    for (unsigned int k = 0; k < values.size(); ++k)
      values[k] = determinant(jacobian(Point<3>(k % 3 / 2., k / 3 % 3 / 2., k / 9 / 2.)));
    for (const unsigned int step : {1U, 3U, 9U})
      for (unsigned int k = 0; k < values.size(); ++k)
        if (k / step % 3 == 1)
          values[k] = 2 * values[k] - (values[k - step] + values[k + step]) / 2;
    return *std::min_element(values.begin(), values.end());
  }

  TetrahedralMesh six_per_hexahedron(std::vector<Point<3>> vertices, Hexahedra hexahedra,
                                     const std::vector<char> &is_inside,
                                     const std::vector<unsigned int> &group)
  {
    TetrahedralMesh mesh{std::move(vertices), {}, {}, std::move(hexahedra)};
    for (std::size_t k = 0; k < mesh.hexahedra.size(); ++k)
    {
      const auto &cell = mesh.hexahedra[k];
      const unsigned int apex = *std::min_element(cell.begin(), cell.end());
      for (unsigned int axis = 0; axis < 3; ++axis)
        for (const bool is_upper : {false, true})
        {
          std::array<unsigned int, 4> ring = around_face(cell, axis, is_upper);
          if (std::find(ring.begin(), ring.end(), apex) != ring.end())
            continue;
          std::rotate(ring.begin(), std::min_element(ring.begin(), ring.end()), ring.end());
          for (const unsigned int second : {1U, 2U})
          {
            mesh.cells.push_back({apex, ring[0], ring[second], ring[second + 1]});
            mesh.is_inside.push_back(is_inside[k]);
            if (!group.empty())
              mesh.group.push_back(group[k]);
          }
        }
    }
    return mesh;
  }

  void check_hexahedra(const TetrahedralMesh &mesh)
  {
    constexpr double flat =
        1e-10; // of the longest edge cubed: as many digits of gradients are lost
    for (std::size_t k = 0; k < mesh.hexahedra.size(); ++k)
    {
      const auto corners = corners_of(mesh, k);
      const Hexahedron hexahedron(corners);
      double least = hexahedron.least_determinant();
      for (std::size_t part = 0; part < n_in_hexahedron; ++part)
        least = std::min(least, determinant(mesh, n_in_hexahedron * k + part));
      if (least > flat * std::pow(longest_edge(corners), 3)) // false for NaN
        continue;
      std::ostringstream message;
      message << "hexahedron " << k << " at (" << hexahedron.at(Point<3>(.5, .5, .5))
              << ") is degenerate, or so distorted that it may be inverted in parts: the "
                 "determinant of its trilinear map or of a tetrahedron in it may be as small as "
              << least << "; move its vertices, or refine the mesh";
      throw InputError(message.str());
    }
  }

  TetrahedralMesh refine_hexahedra(const TetrahedralMesh &mesh)
  {
    std::vector<Point<3>> vertices = mesh.vertices;
    Hexahedra hexahedra;
    std::vector<char> is_inside;
    std::vector<unsigned int> group;
    std::map<std::vector<unsigned int>, unsigned int> middles; // of edges, faces and cells
    for (std::size_t k = 0; k < mesh.hexahedra.size(); ++k)
    {
      const auto &cell = mesh.hexahedra[k];
      // the vertex in the middle of the corners that agree with a point of {0, 1, 2}³ where it is
      // 0 or 2
      const auto vertex_at = [&](const std::array<unsigned int, 3> &at)
      {
        std::vector<unsigned int> among;
        for (unsigned int corner = 0; corner < n_corners; ++corner)
        {
          bool is_near = true;
          for (unsigned int d = 0; d < 3; ++d)
            is_near = is_near && (at[d] == 1 || at[d] / 2 == (corner >> d) % 2);
          if (is_near)
            among.push_back(cell[corner]);
        }
        if (among.size() == 1)
          return among.front();
        std::sort(among.begin(), among.end());
        const auto [found, is_new] =
            middles.emplace(among, static_cast<unsigned int>(vertices.size()));
        if (is_new)
        {
          Tensor<1, 3> sum;
          for (const unsigned int vertex : among)
            sum += vertices[vertex];
          vertices.emplace_back(sum / static_cast<double>(among.size()));
        }
        return found->second;
      };
      for (unsigned int part = 0; part < n_corners; ++part)
      {
        hexahedra.emplace_back();
        for (unsigned int corner = 0; corner < n_corners; ++corner)
        {
          std::array<unsigned int, 3> at{};
          for (unsigned int d = 0; d < 3; ++d)
            at[d] = (part >> d) % 2 + (corner >> d) % 2;
          hexahedra.back()[corner] = vertex_at(at);
        }
        is_inside.push_back(mesh.is_inside[n_in_hexahedron * k]);
        if (!mesh.group.empty())
          group.push_back(mesh.group[n_in_hexahedron * k]);
      }
    }
    TetrahedralMesh fine =
        six_per_hexahedron(std::move(vertices), std::move(hexahedra), is_inside, group);
    fine.groups = mesh.groups;
    return fine;
  }
} // namespace plumbline::geometry
