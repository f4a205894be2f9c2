#include "geometry/curved_mesh.h"

#include "base/error.h"
#include "base/number_text.h"

#include <algorithm>
#include <cmath>

namespace plumbline::geometry
{
  namespace
  {
    using Vector = dealii::Tensor<1, 2>;

    constexpr unsigned int n_parts = 4; ///< of a side

    /// A side whose points are nearer to it than this fraction of its length is straight.
    constexpr double straight = 1e-9;

    double cross(const Vector &a, const Vector &b)
    {
      return a[0] * b[1] - a[1] * b[0];
    }

    bool is_bent(const std::vector<Point<2>> &curve)
    {
      const Vector side = curve.back() - curve.front();
      return std::any_of(
          curve.begin(), curve.end(),
          [&](const Point<2> &x)
          { return std::abs(cross(side, x - curve.front())) > straight * side.norm_square(); });
    }

    /// The polynomial through points at equal steps of its parameter, 0 to 1, and its derivative.
    struct Position
    {
      Vector value, derivative;
    };
    Position at(const std::vector<Point<2>> &points, double t)
    {
      const double steps = static_cast<double>(points.size() - 1);
      Position result;
      for (std::size_t i = 0; i < points.size(); ++i)
      {
        double value = 1, derivative = 0; // of Lagrange's polynomial
        for (std::size_t j = 0; j < points.size(); ++j)
          if (j != i)
          {
            const double slope = steps / (static_cast<double>(i) - static_cast<double>(j)),
                         factor = slope * (t - static_cast<double>(j) / steps);
            derivative = derivative * factor + value * slope;
            value *= factor;
          }
        result.value += value * Vector(points[i]);
        result.derivative += derivative * Vector(points[i]);
      }
      return result;
    }

    /// Between the curve and its side, positive where the curve lies on the right.
    double area_under(const std::vector<Point<2>> &curve)
    {
      // Gauss's rule of five points, exact to degree 9: curves are of degree 4 at most
      constexpr double x[] = {0, .5384693101056831, .9061798459386640},
                       w[] = {.5688888888888889, .4786286704993665, .2369268850561891};
      double sum = 0;
      for (const int i : {-2, -1, 0, 1, 2})
      {
        const double t = .5 + (i < 0 ? -.5 : .5) * x[std::abs(i)];
        const auto [value, derivative] = at(curve, t);
        sum += .25 * w[std::abs(i)] * cross(value - Vector(curve.front()), derivative);
      }
      return sum;
    }

    /// The inner corners of a polygon in place of the curve.
    std::vector<Point<2>> corners(const std::vector<Point<2>> &curve)
    {
      const Point<2> &from = curve.front();
      const Vector side = curve.back() - from;
      std::vector<Point<2>> polygon = {from};
      for (unsigned int k = 1; k < n_parts; ++k)
        polygon.emplace_back(at(curve, static_cast<double>(k) / n_parts).value);
      polygon.push_back(curve.back());
      double area = 0;
      for (unsigned int k = 0; k < n_parts; ++k)
        area += .5 * cross(polygon[k] - from, polygon[k + 1] - from);
      // what moving all inner corners by the length of the side adds
      const double width = .5 * (side * (side + (polygon[n_parts - 1] - polygon[1])));
      const double distance = (area_under(curve) - area) / width;
      polygon.pop_back();
      polygon.erase(polygon.begin());
      for (Point<2> &x : polygon)
        x += distance * Point<2>(side[1], -side[0]);
      return polygon;
    }

    /// Numbers of the inner corners of sides that are bent.
    class BentSides
    {
    public:
      BentSides(const SideCurves &curves, std::vector<Point<2>> &vertices)
      {
        for (const auto &[ends, inner] : curves)
        {
          std::vector<Point<2>> curve = {vertices[ends.first]};
          curve.insert(curve.end(), inner.begin(), inner.end());
          curve.push_back(vertices[ends.second]);
          if (!is_bent(curve))
            continue;
          middle_.emplace(ends, at(curve, .5).value);
          first_[ends] = static_cast<unsigned int>(vertices.size());
          for (const Point<2> &x : corners(curve))
            vertices.push_back(x);
        }
      }

      /// From a to b; none where the side is straight.
      std::vector<unsigned int> between(unsigned int a, unsigned int b) const
      {
        std::vector<unsigned int> numbers;
        if (const auto found = first_.find(std::minmax(a, b)); found != first_.end())
          for (unsigned int k = 0; k + 1 < n_parts; ++k)
            numbers.push_back(found->second + (a < b ? k : n_parts - 2 - k));
        return numbers;
      }

      /// Of the curve, which the corners are moved off; none where the side is straight.
      const Point<2> *middle(unsigned int a, unsigned int b) const
      {
        const auto found = middle_.find(std::minmax(a, b));
        return found == middle_.end() ? nullptr : &found->second;
      }

    private:
      std::map<std::pair<unsigned int, unsigned int>, unsigned int> first_;
      std::map<std::pair<unsigned int, unsigned int>, Point<2>> middle_;
    };

    /// The parts of a cell: a fan about the corner across of its bent side, about its centroid if
    /// there are several.
    void add_parts(const MeshCell &cell, const std::vector<unsigned int> &outline,
                   unsigned int n_bent, unsigned int apex, Mesh &mesh)
    {
      if (n_bent == 0)
      {
        mesh.cells.push_back(cell);
        return;
      }
      if (n_bent > 1)
      {
        Point<2> middle;
        for (unsigned int v = 0; v < 3; ++v)
          middle += mesh.vertices[cell.vertex[v]] / 3;
        apex = static_cast<unsigned int>(mesh.vertices.size());
        mesh.vertices.push_back(middle);
      }
      for (std::size_t k = 0; k < outline.size(); ++k)
      {
        const unsigned int a = outline[k], b = outline[(k + 1) % outline.size()];
        if (a == apex || b == apex)
          continue;
        MeshCell part = cell;
        part.vertex = {apex, a, b, 0};
        mesh.cells.push_back(part);
        const Polygon polygon = mesh.polygon(mesh.cells.size() - 1);
        if (area(view(polygon)) <= 0)
          throw InputError("a side at (" + base::to_text(polygon[1][0], 6) + ", " +
                           base::to_text(polygon[1][1], 6) +
                           ") is bent so much that its triangle cannot follow it; choose a "
                           "smaller h there, or Domain/sides = straight");
      }
    }
  } // namespace

  Mesh follow_curves(const Mesh &mesh, const SideCurves &curves)
  {
    if (!mesh.is_triangles())
      throw InputError("Domain/sides = curved is for triangles, but the mesh has quadrilaterals; "
                       "take Recombine out of the file, or write Domain/sides = straight");
    Mesh result;
    result.vertices = mesh.vertices;
    result.groups = mesh.groups;
    const BentSides bent(curves, result.vertices);
    for (const MeshCell &cell : mesh.cells)
    {
      WholeCell whole{cell, result.cells.size(), {}, {}};
      unsigned int n_bent = 0, apex = 0;
      for (unsigned int k = 0; k < 3; ++k)
      {
        const unsigned int a = cell.vertex[k], b = cell.vertex[(k + 1) % 3];
        const Point<2> *const on_curve = bent.middle(a, b);
        whole.middles[k] = on_curve != nullptr
                               ? *on_curve
                               : mesh.vertices[a] + .5 * (mesh.vertices[b] - mesh.vertices[a]);
        whole.outline.push_back(a);
        const std::vector<unsigned int> inner = bent.between(a, b);
        whole.outline.insert(whole.outline.end(), inner.begin(), inner.end());
        if (!inner.empty())
        {
          ++n_bent;
          apex = cell.vertex[(k + 2) % 3];
        }
      }
      add_parts(cell, whole.outline, n_bent, apex, result);
      result.wholes.push_back(std::move(whole));
    }
    return result;
  }
} // namespace plumbline::geometry
