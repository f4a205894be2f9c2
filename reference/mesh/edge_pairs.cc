#include "reference/mesh/edge_pairs.h"

#include "physics/gauss.h"
#include "reference/mesh/line_moments.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace plumbline::reference
{
  using geometry::PairPosition;

  namespace
  {
    double distance(const Point<2> &x, const Segment &e)
    {
      const double t = std::clamp(((x - e.start) * e.along) / e.along.norm_square(), 0., 1.);
      return x.distance(e.start + t * e.along);
    }

    Segment part(const Segment &e, const std::array<double, 2> &range)
    {
      return {e.start + range[0] * e.along, e.start + range[1] * e.along};
    }

    std::array<double, 2> halve(const std::array<double, 2> &range, unsigned int half)
    {
      const double middle = (range[0] + range[1]) / 2;
      return half == 0 ? std::array<double, 2>{range[0], middle}
                       : std::array<double, 2>{middle, range[1]};
    }

    constexpr double rounding = 1e-9; ///< of ends that two sides have in common, of their length
    /// Of what is singular, in terms of a part's length.
    constexpr double apart = .4;

    /// Parts of 0 <= v <= 1 on which |fixed - v moving|² is analytic up to a distance from each:
    /// it has two conjugate roots. One part if they are on the line, at v = 1 or outside: powers of
    /// 1 - v, whose logarithms take parts as others do if they are outside.
    std::vector<std::array<double, 2>> away_from_root(const Vector2 &fixed, const Vector2 &moving,
                                                      bool has_logarithm)
    {
      const double square = moving.norm_square();
      const double root = (fixed * moving) / square,
                   height = std::abs(cross(fixed, moving)) / square;
      std::vector<std::array<double, 2>> parts = {{0, 1}};
      if (height < rounding && (!has_logarithm || root > 0))
        return parts;
      for (std::size_t k = 0; k < parts.size();)
      {
        const auto [from, to] = parts[k];
        if (std::hypot(height, std::max({0., from - root, root - to})) >= apart * (to - from))
        {
          ++k;
          continue;
        }
        parts[k] = halve({from, to}, 0);
        parts.push_back(halve({from, to}, 1));
      }
      return parts;
    }

    /// Gauss's rule on (0, 1), or one for t^p ln t at 0 as well, p >= 2.
    struct EndRule
    {
      EndRule(bool has_logarithm, unsigned int n_points)
      {
        constexpr unsigned int least_points = 18; // t = τ³: τ^8 ln τ to 1e-16
        const auto &rule =
            physics::gauss(has_logarithm ? std::max(least_points, 3 * n_points) : n_points);
        for (unsigned int i = 0; i < rule.size(); ++i)
        {
          const double tau = rule.point(i)[0];
          point.push_back(has_logarithm ? tau * tau * tau : tau);
          weight.push_back((has_logarithm ? 3 * tau * tau : 1) * rule.weight(i));
        }
      }

      std::vector<double> point, weight;
    };

    double farthest(const Segment &e, const Segment &f)
    {
      return std::max({e.start.distance(f.start), e.start.distance(f.end), e.end.distance(f.start),
                       e.end.distance(f.end)});
    }

    /// Points of a rule on a side, for functions that are analytic up to a distance in its length.
    unsigned int points_at(double distance)
    {
      constexpr double accuracy = 1e-15;
      constexpr unsigned int most = 60;
      const double x = 2 * distance, ratio = x + std::sqrt(1 + x * x);
      return std::min(most,
                      3 + static_cast<unsigned int>(-std::log(accuracy) / (2 * std::log(ratio))));
    }

    std::vector<double> find_cuts(const Segment &e, const Segment &f, double square,
                                  std::vector<double> &tangents)
    {
      std::vector<double> cuts = {0, 1};
      const auto insert = [&](double s)
      {
        if (s > 0 && s < 1)
          cuts.push_back(s);
      };
      const double a = e.along.norm_square();
      for (const Point<2> &end : {f.start, f.end})
      {
        const Vector2 z = e.start - end;
        const double b = z * e.along, discriminant = b * b - a * (z.norm_square() - square);
        if (discriminant > 0)
          for (const double root : {-std::sqrt(discriminant), std::sqrt(discriminant)})
            insert((-b + root) / a);
      }
      const Vector2 w = f.start - e.start;
      const double turn = cross(e.along, f.along), length = f.along.norm();
      if (std::abs(turn) > 1e-12 * length * std::sqrt(a))
      {
        for (const double sign : {-1., 1.})
          tangents.push_back((cross(w, f.along) + sign * std::sqrt(square) * length) / turn);
        for (const double s : tangents)
          insert(s);
        insert((tangents[0] + tangents[1]) / 2);
      }
      std::sort(cuts.begin(), cuts.end());
      return cuts;
    }
  } // namespace

  double distance(const Segment &e, const Segment &f)
  {
    return std::min(
        {distance(e.start, f), distance(e.end, f), distance(f.start, e), distance(f.end, e)});
  }

  geometry::PairPosition position(const Segment &e, const Segment &f, double horizon)
  {
    return farthest(e, f) <= horizon   ? PairPosition::inside
           : distance(e, f) >= horizon ? PairPosition::apart
                                       : PairPosition::cut;
  }

  namespace
  {
    /// By the length of sides over δ: potentials are analytic up to |z| = 0, one δ from the circle.
    unsigned int n_points(double ratio)
    {
      return ratio < .3    ? 8
             : ratio < .5  ? 10
             : ratio < .75 ? 12
             : ratio < 1.3 ? 14
             : ratio < 2   ? 20
                           : 32;
    }
    constexpr unsigned int more_along = 2; ///< where roots are functions of s
  }                                        // namespace

  template <unsigned int n>
  EdgePairs<n>::EdgePairs(const physics::Kernel<2> &kernel, const physics::Kernel<2> &near,
                          unsigned int degree, double longest, double lowest_rho)
      : degree_(degree), circle_(kernel, lowest_rho), powers_(near),
        inner_(physics::gauss(n_points(longest / kernel.horizon()))),
        outer_(physics::gauss(inner_.size() + more_along))
  {
  }

  template <unsigned int n>
  void EdgePairs<n>::at_circle(const Segment &e, const Segment &f, EdgeMoments *in,
                               EdgeMoments *out) const
  {
    degree_ == 0   ? at_circle_as<0>(e, f, in, out)
    : degree_ == 1 ? at_circle_as<1>(e, f, in, out)
                   : at_circle_as<2>(e, f, in, out);
  }

  template <unsigned int n>
  void EdgePairs<n>::whole(const Segment &e, const Segment &f, EdgeMoments *sum) const
  {
    degree_ == 0   ? add_whole<0>(e, f, sum)
    : degree_ == 1 ? add_whole<1>(e, f, sum)
                   : add_whole<2>(e, f, sum);
  }

  template <unsigned int n>
  template <unsigned int degree>
  void EdgePairs<n>::at_circle_as(const Segment &e, const Segment &f, EdgeMoments *in,
                                  EdgeMoments *out) const
  {
    const double square = circle_.square();
    if (const auto where = position(e, f, std::sqrt(square)); where != PairPosition::cut)
    {
      EdgeMoments *const sum = where == PairPosition::inside ? in : out;
      if (sum != nullptr)
        add_smooth<degree>(e, f, sum);
      return;
    }
    std::vector<double> tangents;
    const std::vector<double> cuts = find_cuts(e, f, square, tangents);
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k)
    {
      const double from = cuts[k], to = cuts[k + 1], length = to - from;
      if (!(length > 0))
        continue;
      // the nearest place where the circle touches the line of f: roots there are like √|s - s*|
      double nearest = 4 * length, tangent = 0;
      for (const double s : tangents)
        if (const double distance = std::max(0., std::max(from - s, s - to)); distance < nearest)
        {
          nearest = distance;
          tangent = s;
        }
      if (nearest < 4 * length)
      {
        const bool is_before = tangent < .5 * (from + to);
        const double a = std::sqrt(std::max(0., is_before ? from - tangent : tangent - to)),
                     b = std::sqrt(is_before ? to - tangent : tangent - from);
        for (unsigned int i = 0; i < outer_.size(); ++i)
        {
          const double v = a + (b - a) * outer_.point(i)[0];
          add_line<degree>(e, f, is_before ? tangent + v * v : tangent - v * v,
                           2 * v * (b - a) * outer_.weight(i), in, out);
        }
      }
      else
        for (unsigned int i = 0; i < outer_.size(); ++i)
          add_line<degree>(e, f, from + length * outer_.point(i)[0], length * outer_.weight(i), in,
                           out);
    }
  }

  template <unsigned int n>
  template <unsigned int degree>
  void EdgePairs<n>::add_smooth(const Segment &e, const Segment &f, EdgeMoments *sum) const
  {
    for (unsigned int i = 0; i < inner_.size(); ++i)
    {
      const double s = inner_.point(i)[0];
      LineMoments<degree, n> line(e, f, f.start - (e.start + s * e.along));
      for (unsigned int j = 0; j < inner_.size(); ++j)
        line.add(circle_, inner_.point(j)[0], inner_.weight(j));
      line.add_to(sum, s, inner_.weight(i));
    }
  }

  template <unsigned int n>
  template <unsigned int degree>
  void EdgePairs<n>::add_line(const Segment &e, const Segment &f, double s, double weight,
                              EdgeMoments *in, EdgeMoments *out) const
  {
    const Vector2 w = f.start - (e.start + s * e.along);
    const auto [enter, leave] = SquaredDistance(w, f.along).below(circle_.square(), 0, 1);
    const auto add = [&](double from, double to, EdgeMoments *sum)
    {
      if (sum == nullptr || !(to > from))
        return;
      LineMoments<degree, n> line(e, f, w);
      for (unsigned int j = 0; j < inner_.size(); ++j)
        line.add(circle_, from + (to - from) * inner_.point(j)[0], (to - from) * inner_.weight(j));
      line.add_to(sum, s, weight);
    };
    add(0, enter, out);
    add(enter, leave, in);
    add(leave, 1, out);
  }

  template <unsigned int n>
  template <unsigned int degree>
  void EdgePairs<n>::add_whole(const Segment &e, const Segment &f, EdgeMoments *sum) const
  {
    if (distance(e, f) < rounding * std::min(e.along.norm(), f.along.norm()))
      add_corner<degree>(e, f, sum);
    else
      add_apart<degree>(e, f, {0, 1}, {0, 1}, sum);
  }

  /// Parts of the sides, halved until they are apart in terms of their lengths.
  template <unsigned int n>
  template <unsigned int degree>
  void EdgePairs<n>::add_apart(const Segment &e, const Segment &f, const Range &of_s,
                               const Range &of_t, EdgeMoments *sum) const
  {
    const Segment part_e = part(e, of_s), part_f = part(f, of_t);
    const double length_e = part_e.along.norm(), length_f = part_f.along.norm(),
                 between = distance(part_e, part_f);
    const double ds = of_s[1] - of_s[0], dt = of_t[1] - of_t[0];
    if (between < apart * std::max(length_e, length_f) && std::max(ds, dt) > rounding)
    {
      for (const unsigned int half : {0u, 1u})
        if (length_e > length_f)
          add_apart<degree>(e, f, halve(of_s, half), of_t, sum);
        else
          add_apart<degree>(e, f, of_s, halve(of_t, half), sum);
      return;
    }
    const auto &outer = physics::gauss(points_at(between / length_e));
    const auto &inner = physics::gauss(points_at(between / length_f));
    for (unsigned int i = 0; i < outer.size(); ++i)
    {
      const double s = of_s[0] + ds * outer.point(i)[0];
      LineMoments<degree, n> line(e, f, f.start - (e.start + s * e.along));
      for (unsigned int j = 0; j < inner.size(); ++j)
        line.add(powers_, of_t[0] + dt * inner.point(j)[0], dt * inner.weight(j));
      line.add_to(sum, s, ds * outer.weight(i));
    }
  }

  /// Sides that meet: (s, t) from the common corner as (u, u v) and (u v, u), for which a power of
  /// |z| is one of u times an analytic function of v; for a side with itself one of 1 - v, too.
  template <unsigned int n>
  template <unsigned int degree>
  void EdgePairs<n>::add_corner(const Segment &e, const Segment &f, EdgeMoments *sum) const
  {
    double nearest = std::numeric_limits<double>::infinity();
    double s_corner = 0, t_corner = 0;
    for (const double s : {0., 1.})
      for (const double t : {0., 1.})
        if (const double d = (e.start + s * e.along).distance(f.start + t * f.along); d < nearest)
        {
          nearest = d;
          s_corner = s;
          t_corner = t;
        }
    const Vector2 b = (1 - 2 * s_corner) * e.along, a = (1 - 2 * t_corner) * f.along;
    const bool has_logarithm = powers_.has_logarithm();
    const bool is_same = (a - b).norm() < rounding * a.norm();
    const unsigned int n_along = powers_.degree() / 2 + 2; // for polynomials
    const EndRule along(has_logarithm, n_along);
    const bool is_logarithm_of_v = has_logarithm && is_same;
    const EndRule across(is_logarithm_of_v, is_logarithm_of_v ? n_along + 2 : points_at(apart));
    for (const bool is_upper : {false, true})
      for (const auto &[from, to] :
           away_from_root(is_upper ? a : b, is_upper ? b : a, has_logarithm))
        for (unsigned int i = 0; i < along.point.size(); ++i)
          for (unsigned int j = 0; j < across.point.size(); ++j)
          {
            const double u = along.point[i], v = to - (to - from) * across.point[j];
            const double s = is_upper ? u * v : u, t = is_upper ? u : u * v;
            LineMoments<degree, n> point(e, f, {});
            point.add_at(powers_, t * a - s * b, std::abs(t_corner - t), 1);
            point.add_to(sum, std::abs(s_corner - s),
                         u * along.weight[i] * (to - from) * across.weight[j]);
          }
  }

  template class EdgePairs<1>;
  template class EdgePairs<3>;
} // namespace plumbline::reference
