#include "geometry/ball_box.h"

#include "geometry/ball_polyhedron_boundary.h"
#include "geometry/even_rule.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

namespace plumbline::geometry
{
  namespace
  {
    using dealii::Point;
    using dealii::Tensor;
    using Vector = Tensor<1, 3>;

    constexpr double pi = 3.14159265358979323846;
    constexpr long double two_pi = 6.28318530717958647692528676655900577L;

    /// In the plane of a face, whose two axes follow the face's own in cyclic order.
    struct Flat
    {
      double x, y;
    };

    Flat operator+(const Flat &a, const Flat &b)
    {
      return {a.x + b.x, a.y + b.y};
    }
    Flat operator-(const Flat &a, const Flat &b)
    {
      return {a.x - b.x, a.y - b.y};
    }
    Flat operator*(double t, const Flat &a)
    {
      return {t * a.x, t * a.y};
    }
    double dot(const Flat &a, const Flat &b)
    {
      return a.x * b.x + a.y * b.y;
    }
    double cross(const Flat &a, const Flat &b)
    {
      return a.x * b.y - a.y * b.x;
    }

    /// The part of an edge in the ball.
    struct Edge
    {
      double from = 0, to = 0; ///< along its axis, about the apex
      bool is_there = false;
      bool is_cut_before = false, is_cut_after = false; ///< else it begins, ends at a vertex
    };

    /// What the ball leaves of a side of a face, run counter-clockwise about the positive axis.
    struct Chord
    {
      Flat from, to;
      double height; ///< of the circle's centre over the side, positive inside
      bool is_cut_before, is_cut_after;
    };

    /// What the ball leaves of the face on side s across axis k.
    struct Face
    {
      unsigned int k;
      double sign, at; ///< outward normal: sign × axis; coordinate along the axis
      double circle;   ///< radius in which the plane cuts the sphere; 0: it does not
      Flat middle;     ///< of that circle
      unsigned int n_chords = 0;
      std::array<Chord, 4> chords;
    };

    /// Planes, vertices and edges of the box about the centre, where digits cancel, and then about
    /// an apex.
    class CutBox
    {
    public:
      CutBox(const SolidBall &ball, const Point<3> &lower, const Point<3> &upper)
          : square_(static_cast<long double>(ball.radius) * ball.radius)
      {
        long double nearest = 0, farthest = 0;
        for (unsigned int k = 0; k < 3; ++k)
        {
          planes_[k] = {static_cast<long double>(lower[k]) - ball.centre[k],
                        static_cast<long double>(upper[k]) - ball.centre[k]};
          for (unsigned int s = 0; s < 2; ++s)
            squares_[k][s] = planes_[k][s] * planes_[k][s];
          apex_[k] = std::clamp(0.L, planes_[k][0], planes_[k][1]);
          nearest += apex_[k] * apex_[k];
          farthest += std::max(squares_[k][0], squares_[k][1]);
        }
        power_ = static_cast<double>(nearest - square_);
        is_whole_ = farthest <= square_;
      }

      bool is_whole() const { return is_whole_; }     ///< the ball holds the box
      double power_of_apex() const { return power_; } ///< |apex|^2 - radius^2
      Vector apex() const ///< about the centre; at first the box's nearest point to it
      {
        return Vector({static_cast<double>(apex_[0]), static_cast<double>(apex_[1]),
                       static_cast<double>(apex_[2])});
      }
      void take_centre_as_apex() { apex_ = {}; }

      /// Found once for both faces, which must agree.
      void find_edges()
      {
        for (unsigned int k = 0; k < 3; ++k)
          for (unsigned int s = 0; s < 2; ++s)
            about_apex_[k][s] = static_cast<double>(planes_[k][s] - apex_[k]);
        std::array<bool, 8> is_out;
        for (unsigned int v = 0; v < 8; ++v)
          is_out[v] =
              squares_[0][v & 1u] + squares_[1][v >> 1 & 1u] + squares_[2][v >> 2] > square_;
        for (unsigned int k = 0; k < 3; ++k)
          for (unsigned int i = 0; i < 2; ++i)
            for (unsigned int j = 0; j < 2; ++j)
            {
              const unsigned int k1 = (k + 1) % 3, k2 = (k + 2) % 3, v = i << k1 | j << k2;
              Edge &edge = edges_[k][i][j];
              edge.is_cut_before = is_out[v];
              edge.is_cut_after = is_out[v | 1u << k];
              edge.from = about_apex_[k][0];
              edge.to = about_apex_[k][1];
              edge.is_there = true;
              if (!edge.is_cut_before && !edge.is_cut_after)
                continue;
              const long double half = square_ - squares_[k1][i] - squares_[k2][j];
              if (edge.is_cut_before && edge.is_cut_after &&
                  (half <= 0 || planes_[k][0] >= 0 || planes_[k][1] <= 0))
              {
                edge.is_there = false;
                continue;
              }
              const long double width = std::sqrt(std::max(half, 0.L));
              if (edge.is_cut_before)
                edge.from = std::clamp(static_cast<double>(-width - apex_[k]), edge.from, edge.to);
              if (edge.is_cut_after)
                edge.to = std::clamp(static_cast<double>(width - apex_[k]), edge.from, edge.to);
            }
      }

      Face face(unsigned int k, unsigned int s) const
      {
        const unsigned int k1 = (k + 1) % 3, k2 = (k + 2) % 3;
        Face face;
        face.k = k;
        face.sign = s == 1 ? 1 : -1;
        face.at = about_apex_[k][s];
        face.circle = std::sqrt(static_cast<double>(std::max(square_ - squares_[k][s], 0.L)));
        face.middle = {-static_cast<double>(apex_[k1]), -static_cast<double>(apex_[k2])};
        const auto &x = about_apex_[k1], &y = about_apex_[k2];
        const auto add = [&](const Edge &edge, bool is_forward, const auto &at, double height)
        {
          if (!edge.is_there)
            return;
          const Flat from = at(edge.from), to = at(edge.to);
          face.chords[face.n_chords++] =
              is_forward ? Chord{from, to, height, edge.is_cut_before, edge.is_cut_after}
                         : Chord{to, from, height, edge.is_cut_after, edge.is_cut_before};
        };
        add(
            edges_[k1][0][s], true,
            [&](double u) {
              return Flat{u, y[0]};
            },
            face.middle.y - y[0]);
        add(
            edges_[k2][s][1], true,
            [&](double u) {
              return Flat{x[1], u};
            },
            x[1] - face.middle.x);
        add(
            edges_[k1][1][s], false,
            [&](double u) {
              return Flat{u, y[1]};
            },
            y[1] - face.middle.y);
        add(
            edges_[k2][s][0], false,
            [&](double u) {
              return Flat{x[0], u};
            },
            face.middle.x - x[0]);
        return face;
      }

      /// Of all directions from the centre, those into the box: 1 inside, 1/2 in a face, 1/4 in an
      /// edge, 1/8 in a vertex, 0 outside.
      double share_of_centre() const
      {
        double share = 1;
        for (const auto &[from, to] : planes_)
          share *= from > 0 || to < 0 ? 0 : from < 0 && to > 0 ? 1 : .5;
        return share;
      }

      bool holds_middle(const Face &face) const
      {
        const unsigned int k1 = (face.k + 1) % 3, k2 = (face.k + 2) % 3;
        return planes_[k1][0] <= 0 && planes_[k1][1] >= 0 && planes_[k2][0] <= 0 &&
               planes_[k2][1] >= 0;
      }

    private:
      long double square_;                                         ///< of the radius
      std::array<std::array<long double, 2>, 3> planes_, squares_; ///< about the centre
      std::array<long double, 3> apex_;
      double power_;
      bool is_whole_;
      std::array<std::array<double, 2>, 3> about_apex_;
      /// along an axis, on the sides across the two axes that follow it
      std::array<std::array<std::array<Edge, 2>, 2>, 3> edges_;
    };

    /// Counter-clockwise from where the circle leaves by one side to where it enters by another.
    double angle_of(const Face &face, const Chord &leaves, const Chord &enters)
    {
      const Flat x = leaves.to - face.middle, chord = enters.from - leaves.to;
      const double angle = std::atan2(cross(x, chord), face.circle * face.circle + dot(x, chord));
      constexpr double is_short = .01; // of a circle, where round-off may turn the chord around
      if (dot(chord, chord) > is_short * is_short * face.circle * face.circle)
        return angle < 0 ? angle + 2 * pi : angle;
      // a short chord spans nearly the whole circle only where one side cuts little off
      return face.n_chords == 1 && leaves.height > 0 ? (angle > 0 ? angle : angle + 2 * pi)
                                                     : std::max(angle, 0.);
    }

    /// Calls use(from, to, angle) for arcs of the face's boundary.
    template <class Use>
    void for_arcs(const CutBox &box, const Face &face, const Use &use)
    {
      if (!(face.circle > 0))
        return;
      if (face.n_chords == 0 && box.holds_middle(face))
      {
        const Flat start = face.middle + Flat{face.circle, 0};
        use(start, start, 2 * pi);
      }
      for (unsigned int i = 0; i < face.n_chords; ++i)
        if (face.chords[i].is_cut_after)
        {
          const Chord &leaves = face.chords[i], &enters = face.chords[(i + 1) % face.n_chords];
          const double angle = angle_of(face, leaves, enters);
          if (angle > 0)
            use(leaves.to, enters.from, angle);
        }
    }

    /// ∫ 1 and r about the apex.
    struct Raw
    {
      double zeroth = 0;
      Vector first;
    };

    /// What t and -t of a rule give, side by side in a register.
    using Pair = double __attribute__((vector_size(2 * sizeof(double))));

    double sum(const Pair &pair)
    {
      return pair[0] + pair[1];
    }

    /// Of the region of a face: ∫ 1, η and η ⊗ η, η from the foot of the apex; and of the part of
    /// the sphere that its arcs bound, ∫ q(r) r·n for q = 1 and ê·r.
    struct Region
    {
      double area = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
      double patch = 0, patch_along = 0;

      void add_segment(const Flat &p, const Flat &q)
      {
        const double kappa = cross(p, q);
        area += kappa / 2;
        x += kappa / 6 * (p.x + q.x);
        y += kappa / 6 * (p.y + q.y);
        xx += kappa / 12 * (p.x * p.x + q.x * q.x + p.x * q.x);
        yy += kappa / 12 * (p.y * p.y + q.y * q.y + p.y * q.y);
        xy += kappa / 12 * (p.x * p.y + q.x * q.y + .5 * (p.x * q.y + q.x * p.y));
      }
    };

    /// Cones from the box's point nearest to the centre, from where the part of the sphere is a
    /// graph over the plane across the pole ê = apex / |apex|: its height is z = ê·r.
    class Cones
    {
    public:
      Cones(const CutBox &box, double radius)
          : radius_(radius), distance_(box.apex().norm()),
            rest_(-box.power_of_apex() / (radius + distance_)), pole_(box.apex() / distance_)
      {
      }

      Raw integrate(const CutBox &box) const
      {
        double zeroth = 0, along = 0;
        Vector turned;
        for (unsigned int k = 0; k < 3; ++k)
          for (unsigned int s = 0; s < 2; ++s)
          {
            const Face face = box.face(k, s);
            if (face.n_chords == 0 && !(face.circle > 0))
              continue;
            Region region;
            for (unsigned int i = 0; i < face.n_chords; ++i)
              region.add_segment(face.chords[i].from, face.chords[i].to);
            for_arcs(box, face,
                     [&](const Flat &from, const Flat &to) { add_arc(from, to, face, region); });
            const unsigned int k1 = (k + 1) % 3, k2 = (k + 2) % 3;
            const double p1 = pole_[k1], p2 = pole_[k2], depth = face.sign * face.at;
            zeroth += depth * region.area - face.sign * region.patch;
            along += depth * (pole_[k] * face.at * region.area + p1 * region.x + p2 * region.y) -
                     face.sign * region.patch_along;
            // r_i ê × r is tangential to the sphere, and its divergence is that component of ê × r
            turned[k] += depth * (p1 * region.y - p2 * region.x);
            turned[k1] += face.sign * (p1 * region.xy - p2 * region.xx);
            turned[k2] += face.sign * (p1 * region.yy - p2 * region.xy);
          }
        return {zeroth / 3, cross_product_3d(turned, pole_) + along / 4 * pole_};
      }

    private:
      /// By the chord, rationally in tan τ/2 = most × t, as integrate_short() of polyhedra; the
      /// integrands on the sphere are those of Patch there.
      void add_arc(const Flat &from, const Flat &to, const Face &face, Region &region) const
      {
        const Flat chord = to - from, middle = .5 * (from + to);
        const double length = std::sqrt(dot(chord, chord));
        if (!(length > 0))
          return;
        const Flat tangent = (1 / length) * chord, side{tangent.y, -tangent.x};
        const double sine = std::min(1., length / (2 * face.circle)),
                     most = sine / (1 + std::sqrt(1 - sine * sine)), // tan β/2
            scale = .5 * length * (1 + most * most), bulge = .5 * length * most, p = pole_[face.k],
                     p1 = pole_[(face.k + 1) % 3], p2 = pole_[(face.k + 2) % 3], at = face.at;
        const EvenRule &rule = most < .04  ? even_rules::six
                               : most < .1 ? even_rules::eight
                                           : even_rules::ten;
        Pair area{}, x{}, y{}, xx{}, xy{}, yy{}, patch{}, patch_along{};
        for (unsigned int i = 0; i < rule.n; ++i)
        {
          const Pair t = {rule.t[i], -rule.t[i]};
          const double u = rule.t[i] * most, below = 1 / (1 + u * u),
                       rate = scale * rule.weight[i] * below * below,
                       height = bulge * (1 - rule.t[i] * rule.t[i]) * below;
          const Pair a = scale * below * t, turn = 2 * rate * most * t;
          const double ahead = rate * (1 - u * u);
          const Pair rx = middle.x + height * side.x + a * tangent.x,
                     ry = middle.y + height * side.y + a * tangent.y,
                     dx = ahead * tangent.x - turn * side.x, dy = ahead * tangent.y - turn * side.y,
                     kappa = rx * dy - ry * dx;
          area += kappa;
          x += kappa * rx;
          y += kappa * ry;
          xx += kappa * rx * rx;
          xy += kappa * rx * ry;
          yy += kappa * ry * ry;
          const Pair z = p * at + p1 * rx + p2 * ry,
                     square = (at * at + rx * rx + ry * ry - z * z) / (radius_ * radius_),
                     q = radius_ / (radius_ + distance_ + z), v = square * q, // 1 - cos γ
              step = (p * kappa + at * (p2 * dx - p1 * dy)) * q;
          patch += step * (rest_ + .5 * distance_ * v);
          patch_along += step * (rest_ * rest_ * (1 - .5 * v) - radius_ * distance_ / 3 * v * v);
        }
        region.area += sum(area) / 2;
        region.x += sum(x) / 3;
        region.y += sum(y) / 3;
        region.xx += sum(xx) / 4;
        region.xy += sum(xy) / 4;
        region.yy += sum(yy) / 4;
        region.patch += sum(patch);
        region.patch_along += sum(patch_along);
      }

      /// Calls use(from, to) for pieces of the face's arcs that ten points integrate.
      template <class Use>
      static void for_arcs(const CutBox &box, const Face &face, const Use &use)
      {
        geometry::for_arcs(
            box, face,
            [&](const Flat &from, const Flat &to, double angle)
            {
              constexpr double longest = .8; // [rad]
              const auto n = static_cast<unsigned int>(std::ceil(angle / longest));
              const Flat x = from - face.middle;
              Flat last = from;
              for (unsigned int i = 1; i < n; ++i)
              {
                const double c = std::cos(angle * i / n), s = std::sin(angle * i / n);
                const Flat next = face.middle + Flat{c * x.x - s * x.y, s * x.x + c * x.y};
                use(last, next);
                last = next;
              }
              use(last, to);
            });
      }

      double radius_, distance_;
      double rest_; ///< -power of the apex / (radius + distance): how far the sphere is above it
      Vector pole_;
    };

    /// Closed forms about the centre. With g = (|y|^2 - R^2) / 2, which is 0 on the sphere, the
    /// first moment is ∫ g n over the faces. The part of the sphere is seen where no face is, and a
    /// face is fans of triangles and of sectors about the foot of the centre.
    Raw about_centre(const CutBox &box, double radius)
    {
      const double square = radius * radius;
      double volume = 0, solid_angle = 4 * pi * box.share_of_centre();
      std::complex<long double> product = 1; // its angle: half of that of the segments' triangles
      int turns = 0;
      const auto multiply = [&](const std::complex<long double> &factor) // of angle <= π/2
      {
        const long double before = product.imag();
        product = {product.real() * factor.real() - product.imag() * factor.imag(),
                   product.real() * factor.imag() + product.imag() * factor.real()};
        if (before > 0 && factor.imag() > 0 && product.imag() < 0)
          ++turns;
        if (before < 0 && factor.imag() < 0 && product.imag() > 0)
          --turns;
      };
      Raw raw;
      for (unsigned int k = 0; k < 3; ++k)
        for (unsigned int s = 0; s < 2; ++s)
        {
          const Face face = box.face(k, s);
          if (face.n_chords == 0 && !(face.circle > 0))
            continue;
          const double distance = face.sign * face.at, depth = std::abs(distance),
                       circle = face.circle * face.circle,
                       side = distance < 0   ? -1
                              : distance > 0 ? 1
                                             : 0; // that is seen
          double area = 0, g = 0;
          for (unsigned int i = 0; i < face.n_chords; ++i)
          {
            const Chord &chord = face.chords[i];
            const Flat p = chord.from, q = chord.to, step = q - p;
            const double kappa = cross(p, q), pp = dot(p, p), qq = dot(q, q), pq = dot(p, q);
            area += .5 * kappa;
            g += kappa * ((pp + qq + pq) / 24 - circle / 4);
            if (kappa == 0 || distance == 0)
              continue;
            // van Oosterom and Strackee 1983, doi:10.1109/TBME.1983.325207
            const double rp = std::sqrt(pp + depth * depth), rq = std::sqrt(qq + depth * depth),
                         cosine = pq + depth * depth,
                         level = cosine >= 0 ? rp * rq + cosine
                                             : (chord.height * chord.height + depth * depth) *
                                                   dot(step, step) / (rp * rq - cosine);
            multiply({(level + depth * (rp + rq)) / square, side * kappa / square});
          }
          for_arcs(box, face,
                   [&](const Flat &, const Flat &, double angle)
                   {
                     area += .5 * circle * angle;
                     g -= circle * circle * angle / 8;
                     solid_angle -= side * (1 - depth / radius) * angle;
                   });
          volume += distance * area;
          raw.first[k] += face.sign * g;
        }
      solid_angle -= 2 * static_cast<double>(std::arg(product) + turns * two_pi);
      raw.zeroth = (volume + square * radius * solid_angle) / 3;
      return raw;
    }
  } // namespace

  SolidMoments intersect_box(const SolidBall &ball, const Point<3> &lower, const Point<3> &upper,
                             const SolidMoments &whole)
  {
    const double radius = ball.radius;
    CutBox box(ball, lower, upper);
    if (box.is_whole())
      return whole;
    const Vector apex = box.apex();
    SolidMoments result;
    result.centroid = ball.centre + apex;
    if (box.power_of_apex() >= 0)
      return result;
    const bool is_about_centre = apex.norm() <= closed_form_within * radius;
    if (is_about_centre)
      box.take_centre_as_apex();
    box.find_edges();
    const Raw raw = is_about_centre ? about_centre(box, radius) : Cones(box, radius).integrate(box);
    if (!(raw.zeroth > 0))
      return result;
    result.volume = std::min(raw.zeroth, whole.volume);
    result.centroid = (is_about_centre ? ball.centre : result.centroid) + raw.first / raw.zeroth;
    return result;
  }
} // namespace plumbline::geometry
