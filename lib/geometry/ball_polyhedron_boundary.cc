#include "geometry/ball_polyhedron_boundary.h"

#include <limits>

namespace plumbline::geometry
{
  namespace
  {
    using dealii::Point;
    using dealii::Tensor;
    using Vector = Tensor<1, 3>;
    using Extended = ConvexPolyhedron::ExtendedVector; ///< about the centre, where digits cancel

    constexpr double pi = 3.14159265358979323846;

    Vector rounded(const Extended &x)
    {
      return Vector(
          {static_cast<double>(x[0]), static_cast<double>(x[1]), static_cast<double>(x[2])});
    }

    /// The part of an edge in the ball.
    struct Inside
    {
      bool is_there = false;
      Vector from, to;                                  ///< about the apex, along the edge
      bool is_cut_before = false, is_cut_after = false; ///< else it begins, ends at a vertex
    };

    class Cutter
    {
    public:
      Cutter(const Point<3> &centre, double radius, const ConvexPolyhedron &cell)
          : cell_(cell), radius_(radius)
      {
        const long double square = static_cast<long double>(radius) * radius;
        for (const Point<3> &vertex : cell.vertices())
        {
          Extended y;
          for (unsigned int k = 0; k < 3; ++k)
            y[k] = static_cast<long double>(vertex[k]) - centre[k];
          positions_.push_back(y);
          powers_.push_back(y * y - square);
        }
        for (const ConvexPolyhedron::Face &face : cell.faces())
          distances_.push_back(face.normal * positions_[face.vertices.front()]);
      }

      Overlap cut(CutBoundary &boundary)
      {
        if (std::all_of(powers_.begin(), powers_.end(),
                        [](const long double power) { return power <= 0; }))
          return Overlap::cell;
        apex_ = nearest();
        const long double square = static_cast<long double>(radius_) * radius_,
                          power = apex_ * apex_ - square;
        boundary.apex = rounded(apex_);
        boundary.apex_power = static_cast<double>(power);
        if (power >= 0)
          return Overlap::none;
        if (boundary.apex.norm() <= closed_form_within * radius_)
          apex_ = Extended();
        for (std::size_t e = 0; e < cell_.edges().size(); ++e)
          edges_.push_back(inside(cell_.edges()[e]));
        boundary.faces.clear();
        for (std::size_t f = 0; f < cell_.faces().size(); ++f)
          boundary.faces.push_back(cut_face(f));
        return Overlap::part;
      }

    private:
      /// Of the cell to the centre.
      Extended nearest() const
      {
        Extended best;
        long double least = std::numeric_limits<long double>::infinity();
        const auto take = [&](const Extended &x)
        {
          if (x * x < least)
          {
            least = x * x;
            best = x;
          }
        };
        for (std::size_t f = 0; f < distances_.size(); ++f)
          if (distances_[f] < 0)
          {
            const ConvexPolyhedron::Face &face = cell_.faces()[f];
            const Extended foot = distances_[f] * face.normal;
            bool is_in_face = true;
            for (std::size_t k = 0; k < face.vertices.size(); ++k)
            {
              const Extended &a = positions_[face.vertices[k]],
                             &b = positions_[face.vertices[(k + 1) % face.vertices.size()]],
                             along = b - a;
              is_in_face =
                  is_in_face && face.normal * cross_product_3d(along, Extended(foot - a)) >= 0;
              const long double t = -(a * along) / (along * along);
              take(t <= 0 ? a : t >= 1 ? b : Extended(a + t * along));
            }
            if (is_in_face)
              return foot;
          }
        return best; // the centre itself, where it is inside
      }

      /// Found once for both faces, which must agree.
      Inside inside(const std::array<unsigned int, 2> &edge) const
      {
        const Extended &a = positions_[edge[0]], &b = positions_[edge[1]], along = b - a;
        const long double at_a = powers_[edge[0]], at_b = powers_[edge[1]], slope = a * along,
                          square = along * along, root = slope * slope - square * at_a;
        long double from = 0, to = 1; // of the power's zeros along the edge
        Inside part;
        part.is_cut_before = at_a > 0;
        part.is_cut_after = at_b > 0;
        if (part.is_cut_before && part.is_cut_after &&
            (root <= 0 || slope >= 0 || slope + square <= 0))
          return part;
        const long double width = std::sqrt(std::max(root, 0.L));
        if (part.is_cut_before)
          from = at_a / (width - slope);
        if (part.is_cut_after)
          to = slope <= 0 ? (width - slope) / square : -at_a / (width + slope);
        from = std::clamp(from, 0.L, 1.L);
        to = std::clamp(to, from, 1.L);
        part.is_there = true;
        part.from = rounded(a - apex_ + from * along);
        part.to = rounded(to < 1 ? a - apex_ + to * along : b - apex_);
        return part;
      }

      CutFace cut_face(std::size_t f) const
      {
        const ConvexPolyhedron::Face &face = cell_.faces()[f];
        const Extended foot = distances_[f] * face.normal;
        const long double circle = (radius_ - distances_[f]) * (radius_ + distances_[f]);
        CutFace result;
        result.normal = rounded(face.normal);
        result.distance = static_cast<double>(distances_[f] - face.normal * apex_);
        result.circle = static_cast<double>(std::sqrt(std::max(circle, 0.L)));
        result.middle = rounded(foot - apex_);
        Few<std::size_t> sides; // of the segments
        Few<std::array<bool, 2>> is_cut;
        for (std::size_t k = 0; k < face.sides.size(); ++k)
        {
          const Inside &edge = edges_[face.sides[k].edge];
          if (!edge.is_there)
            continue;
          const bool is_forward = face.sides[k].is_forward;
          result.segments.push_back(is_forward ? Segment{edge.from, edge.to}
                                               : Segment{edge.to, edge.from});
          is_cut.push_back({is_forward ? edge.is_cut_before : edge.is_cut_after,
                            is_forward ? edge.is_cut_after : edge.is_cut_before});
          sides.push_back(k);
        }
        if (sides.empty())
        {
          if (circle > 0 && holds(face, foot))
            result.arcs.push_back(full_circle(result));
          return result;
        }
        for (std::size_t k = 0; k < sides.size(); ++k)
          if (is_cut[k][1])
          {
            const std::size_t next = (k + 1) % sides.size();
            Arc arc{result.segments[k].to, result.segments[next].from, 0};
            arc.angle = angle_of(arc, result, face, foot, sides[k], sides[next], sides.size() == 1);
            if (arc.angle > 0 || arc.from != arc.to) // a gap would cost its length
              result.arcs.push_back(arc);
          }
        return result;
      }

      bool holds(const ConvexPolyhedron::Face &face, const Extended &foot) const
      {
        for (std::size_t k = 0; k < face.vertices.size(); ++k)
          if (height(face, k, foot) < 0)
            return false;
        return true;
      }

      /// Of a point in the plane over a side, positive inside [length].
      long double height(const ConvexPolyhedron::Face &face, std::size_t side,
                         const Extended &x) const
      {
        const Extended &a = positions_[face.vertices[side]],
                       along = positions_[face.vertices[(side + 1) % face.vertices.size()]] - a;
        return face.normal * cross_product_3d(along, Extended(x - a)) / along.norm();
      }

      Arc full_circle(const CutFace &face) const
      {
        const Vector &n = face.normal;
        const unsigned int k = std::abs(n[0]) < .6 ? 0 : 1;
        Vector start;
        start[k] = 1;
        start -= n[k] * n;
        const Vector from = face.middle + face.circle / start.norm() * start;
        return {from, from, 2 * pi};
      }

      /// From the point where the circle leaves by a side to where it enters by another.
      double angle_of(const Arc &arc, const CutFace &cut, const ConvexPolyhedron::Face &face,
                      const Extended &foot, std::size_t leaves, std::size_t enters,
                      bool is_alone) const
      {
        const Vector chord = arc.to - arc.from, x = arc.from - cut.middle;
        const double sine = cut.normal * cross_product_3d(x, chord),
                     cosine = cut.circle * cut.circle + x * chord, angle = std::atan2(sine, cosine);
        constexpr double is_short = .01; // of a circle, where round-off may turn the chord around
        if (cut.circle > face.diameter)
          return std::max(angle, 0.); // it is far from a full turn
        if (chord.norm() > is_short * cut.circle)
          return angle < 0 ? angle + 2 * pi : angle;
        const double about = turn(face, leaves, enters, is_alone) -
                             half_angle(cut, face, foot, leaves) -
                             half_angle(cut, face, foot, enters);
        return about > pi ? angle + 2 * pi : std::max(angle, 0.);
      }

      /// Of the outward normal from one side to another, counter-clockwise [rad].
      double turn(const ConvexPolyhedron::Face &face, std::size_t from, std::size_t to,
                  bool is_alone) const
      {
        if (is_alone)
          return 2 * pi;
        const auto along = [&](std::size_t side)
        {
          return rounded(positions_[face.vertices[(side + 1) % face.vertices.size()]] -
                         positions_[face.vertices[side]]);
        };
        const Vector a = along(from), b = along(to);
        const double angle = std::atan2(rounded(face.normal) * cross_product_3d(a, b), a * b);
        return angle < 0 ? angle + 2 * pi : angle;
      }

      /// Between a side's outward normal and where the circle meets the side, seen from its middle.
      double half_angle(const CutFace &cut, const ConvexPolyhedron::Face &face,
                        const Extended &foot, std::size_t side) const
      {
        return std::acos(
            std::clamp(static_cast<double>(height(face, side, foot)) / cut.circle, -1., 1.));
      }

      const ConvexPolyhedron &cell_;
      double radius_;
      Extended apex_;
      Few<Extended> positions_; ///< of vertices, about the centre
      Few<long double> powers_, distances_;
      boost::container::small_vector<Inside, 12> edges_;
    };

    /// Of the spherical triangle of three unit vectors, signed (van Oosterom and Strackee 1983,
    /// doi:10.1109/TBME.1983.325207) [sr].
    double triangle(const Vector &a, const Vector &b, const Vector &c)
    {
      return 2 * std::atan2(a * cross_product_3d(b, c), 1 + a * b + b * c + c * a);
    }

    /// A part of an arc that is short enough for triangles, on the sphere of radius 1.
    struct Part
    {
      const CutFace *face;
      Vector from, to;
      double angle;
    };

    Few<Part> parts_of(const CutBoundary &boundary, double radius)
    {
      constexpr double longest = 1.8; // [rad]
      Few<Part> parts;
      for (const CutFace &face : boundary.faces)
        for (const Arc &arc : face.arcs)
        {
          const auto n = std::max(1u, static_cast<unsigned int>(std::ceil(arc.angle / longest)));
          const Vector x = arc.from - face.middle, y = cross_product_3d(face.normal, x);
          Vector from = arc.from;
          for (unsigned int k = 1; k <= n; ++k)
          {
            const double angle = arc.angle * k / n;
            const Vector to =
                k == n ? arc.to : Vector(face.middle + std::cos(angle) * x + std::sin(angle) * y);
            parts.push_back({&face, from / radius, to / radius, arc.angle / n});
            from = to;
          }
        }
      return parts;
    }

    /// A direction whose opposite is far from all arcs: of those to the corners, the middles of the
    /// sides and of the faces of a cube.
    Vector find_pole(const Few<Part> &parts)
    {
      Vector best;
      double largest = -2;
      for (int k = 0; k < 27; ++k)
      {
        if (k == 13)
          continue;
        Vector pole({k % 3 - 1., k / 3 % 3 - 1., k / 9 - 1.});
        pole /= pole.norm();
        double least = 1;
        for (const Part &part : parts)
          least = std::min(least, pole * part.from);
        if (least > largest)
        {
          largest = least;
          best = pole;
        }
      }
      return best;
    }
  } // namespace

  Overlap cut(const Point<3> &centre, double radius, const ConvexPolyhedron &cell,
              CutBoundary &boundary)
  {
    return Cutter(centre, radius, cell).cut(boundary);
  }

  double solid_angle(const CutBoundary &boundary, double radius)
  {
    const Few<Part> parts = parts_of(boundary, radius);
    const Vector pole = find_pole(parts);
    double outside = 0; // of the patch, but for whole turns
    for (const Part &part : parts)
      outside += (1 - part.face->distance / radius) * part.angle +
                 triangle(pole, part.from, part.to) -
                 triangle(part.face->normal, part.from, part.to);
    // near 0 or 4π round-off must not decide: a patch is nearly all of the sphere where all planes
    // that cut it are nearly tangent
    constexpr double nearly = 1e-6;
    const bool is_nearly_all = std::all_of(
        boundary.faces.begin(), boundary.faces.end(),
        [&](const CutFace &face) { return face.arcs.empty() || face.distance > .99 * radius; });
    const double turns = 4 * pi, patch = -outside - turns * std::floor(-outside / turns);
    if (patch < nearly && is_nearly_all)
      return patch + turns;
    if (patch > turns - nearly && !is_nearly_all)
      return patch - turns;
    return patch;
  }
} // namespace plumbline::geometry
