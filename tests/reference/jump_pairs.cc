// Integrals over pairs of faces that touch against quadrature refined by hand; pairs whose own
// quadrature does not reach its tolerance.
#include "reference/tetrahedra/jump_pairs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace
{
  using namespace plumbline;
  using namespace plumbline::reference;
  using dealii::Point;
  using dealii::Tensor;
  using Triangle = PairFace::Vertices;

  physics::Kernel<3> constant_kernel()
  {
    return physics::Kernel<3>::with_diffusion(physics::kernel_type("constant").profile, 1, 1);
  }

  /// r Λ = ∫_r^1 t (t - r) dt.
  double harmonic(double r)
  {
    return (1. / 3 - r / 2 + r * r * r / 6) / r;
  }

  /// Ψ'/r with r Ψ = ∫_r^1 t (t - r)³/6 dt, by u = t - r.
  double slope(double r)
  {
    const double u = 1 - r, whole = u * u * u * u * (u / 5 + r / 4) / 6,
                 change = -u * u * u * (u / 4 + r / 3) / 2;
    return (change - whole / r) / (r * r);
  }

  /// Gauss's rule with 5 points on [from, to].
  template <class Visit>
  void for_points(double from, double to, const Visit &visit)
  {
    const double near = std::sqrt(5 - 2 * std::sqrt(10. / 7)) / 3,
                 far = std::sqrt(5 + 2 * std::sqrt(10. / 7)) / 3,
                 of_near = (322 + 13 * std::sqrt(70.)) / 1800,
                 of_far = (322 - 13 * std::sqrt(70.)) / 1800;
    for (const auto &[x, weight] : {std::pair(0., 64. / 225),
                                    {near, of_near},
                                    {-near, of_near},
                                    {far, of_far},
                                    {-far, of_far}})
      visit((from + to) / 2 + (to - from) / 2 * x, (to - from) * weight);
  }

  /// The rule on pieces of [0, end] that double in length from the first one on.
  template <class Visit>
  void for_doubled(double first, double end, const Visit &visit)
  {
    for (double from = 0, to = first; from < end; from = to, to *= 2)
      for_points(from, std::min(to, end), visit);
  }

  Tensor<1, 3> area_of(const Triangle &t)
  {
    return cross_product_3d(t[1] - t[0], t[2] - t[0]);
  }

  std::array<double, 3> barycentric(const Triangle &t, const Point<3> &x)
  {
    const Tensor<1, 3> area = area_of(t);
    std::array<double, 3> s{};
    for (unsigned int k = 0; k < 3; ++k)
      s[k] = area * cross_product_3d(t[(k + 1) % 3] - x, t[(k + 2) % 3] - x) / area.norm_square();
    return s;
  }

  struct Inner
  {
    std::array<double, 3> values{}; ///< ∫ λ_b Λ
    double slope = 0;               ///< h ∫ Ψ'/r
  };

  /// In polar coordinates about the foot of a point, by triangles of the foot and a side: along the
  /// side in pieces that double from the foot on, along rays in pieces that double from the height
  /// on.
  Inner inner(const Triangle &t, const Point<3> &x)
  {
    const Tensor<1, 3> normal = area_of(t) / area_of(t).norm();
    const double height = normal * (x - t[0]), distance = std::abs(height);
    const bool is_above = distance > 1e-12;
    const Point<3> foot = x - height * normal;
    Inner result;
    for (unsigned int k = 0; k < 3; ++k)
    {
      const Tensor<1, 3> start = t[k] - foot, side = t[(k + 1) % 3] - t[k];
      const Tensor<1, 3> along = side / side.norm();
      const double kappa = cross_product_3d(along, normal) * start, first = along * start,
                   last = first + side.norm();
      if (std::abs(kappa) < 1e-14)
        continue;
      const Point<3> nearest = foot + (start - first * along);
      const auto add = [&](double tau, double weight)
      {
        const Tensor<1, 3> to_side = nearest + tau * along - foot;
        const double length = to_side.norm(), angle = weight * kappa / (length * length);
        for_doubled(is_above ? std::min(distance, length) : length, length,
                    [&](double rho, double w)
                    {
                      const double r = std::sqrt(rho * rho + height * height);
                      const auto s = barycentric(t, foot + rho / length * to_side);
                      for (unsigned int b = 0; b < 3; ++b)
                        result.values[b] += angle * w * rho * s[b] * harmonic(r);
                      if (is_above)
                        result.slope += angle * w * rho * height * slope(r);
                    });
      };
      // from the foot to both ends, less where both are on one side
      for (const auto &[end, sign] : {std::pair(last, 1.), {first, -1.}})
        if (end != 0)
          for_doubled(std::min(std::abs(kappa), std::abs(end)), std::abs(end),
                      [&, way = end < 0 ? -1. : 1., s = sign](double tau, double weight)
                      { add(way * tau, s * way * weight); });
    }
    return result;
  }

  /// Points of a triangle that crowd to its sides and vertices: three triangles of the centroid and
  /// a side, halved towards the side and both of its ends.
  template <class Visit>
  void for_crowded(const Triangle &t, const Visit &visit)
  {
    constexpr double first = 1. / 512;
    const double area = area_of(t).norm() / 2;
    for (unsigned int k = 0; k < 3; ++k)
      for_doubled(first, 1,
                  [&](double b, double w)
                  {
                    for_doubled(first, .5,
                                [&](double a, double v)
                                {
                                  for (const double at : {a, 1 - a})
                                  {
                                    std::array<double, 3> s{};
                                    s[k] = (1 - b) * (1 - at) + b / 3;
                                    s[(k + 1) % 3] = (1 - b) * at + b / 3;
                                    s[(k + 2) % 3] = b / 3;
                                    visit(s, 2 * area / 3 * (1 - b) * w * v);
                                  }
                                });
                  });
  }

  struct Outer
  {
    std::array<std::array<double, 3>, 3> values{};
    std::array<double, 3> slopes{};
  };

  Outer by_hand(const Triangle &outer, const Triangle &face)
  {
    Outer result;
    for_crowded(outer,
                [&](const std::array<double, 3> &s, double weight)
                {
                  const Inner at =
                      inner(face, Point<3>(s[0] * outer[0] + s[1] * outer[1] + s[2] * outer[2]));
                  for (unsigned int a = 0; a < 3; ++a)
                  {
                    result.slopes[a] += weight * s[a] * at.slope;
                    for (unsigned int b = 0; b < 3; ++b)
                      result.values[a][b] += weight * s[a] * at.values[b];
                  }
                });
    return result;
  }

  const Point<3> origin, along(.3, .02, .05), across(.03, .25, -.02);

  struct Touching
  {
    std::string name;
    Triangle first, second;
    std::array<unsigned int, 3> names; ///< of the second's; the first's are 0, 1, 2
  };

  /// By the vertices that both have; all within the horizon.
  std::vector<Touching> touching()
  {
    const Triangle first = {origin, along, across};
    return {
        {"vertex", first, {Point<3>(-.2, -.05, .1), Point<3>(-.05, -.2, .15), origin}, {3, 4, 0}},
        {"side", first, {along, Point<3>(.2, -.1, .22), origin}, {1, 3, 0}},
        {"side in one plane",
         first,
         {along, origin, Point<3>(.5 * along - .8 * across)},
         {1, 0, 3}},
        {"the same", first, first, {0, 1, 2}}};
  }
} // namespace

TEST(JumpPairs, that_touch_are_those_of_quadrature_by_hand)
{
  const JumpPairs pairs(constant_kernel(), 1e-12);
  for (const auto &[name, x, y, names] : touching())
  {
    SCOPED_TRACE(name);
    const JumpIntegrals found = pairs(PairFace(x, {0, 1, 2}), PairFace(y, names));
    const Outer of_first = by_hand(x, y), of_second = by_hand(y, x);
    double size = 0, of_slopes = 0;
    for (unsigned int a = 0; a < 3; ++a)
    {
      of_slopes =
          std::max({of_slopes, std::abs(of_first.slopes[a]), std::abs(of_second.slopes[a])});
      for (unsigned int b = 0; b < 3; ++b)
        size = std::max(size, of_first.values[a][b]);
    }
    double worst = 0, worst_slope = 0;
    for (unsigned int a = 0; a < 3; ++a)
    {
      worst_slope = std::max({worst_slope, std::abs(found.first[a] - of_first.slopes[a]),
                              std::abs(found.second[a] - of_second.slopes[a])});
      for (unsigned int b = 0; b < 3; ++b)
        worst = std::max(worst, std::abs(found.values[a][b] - of_first.values[a][b]));
    }
    // what five points err by: with twice as many pieces differences are 3e-8 or less
    EXPECT_LT(worst, 3e-7 * size);
    if (names[2] == 3 || name == "the same") // in one plane
      EXPECT_EQ(worst_slope, 0);
    else
      EXPECT_LT(worst_slope, 1e-6 * of_slopes);
    RecordProperty(name, std::to_string(worst / size * 1e9) + "e-9 " +
                             std::to_string(worst_slope * 1e9) + "e-9 " +
                             std::to_string(of_slopes));
  }
}

TEST(JumpPairs, say_where_they_do_not_reach_their_tolerance)
{
  const JumpPairs possible(constant_kernel(), 1e-6), impossible(constant_kernel(), 1e-30);
  for (const auto &[name, x, y, names] : touching())
  {
    const PairFace f(x, {0, 1, 2}), g(y, names);
    EXPECT_EQ(possible(f, g).open, 0) << name;
    EXPECT_GT(impossible(f, g).open, 1e-30) << name;
    EXPECT_LT(impossible(f, g).open, 1e-8) << name; // the last change
  }
  const Triangle flat = {origin, along, Point<3>(.5 * along)}; // no normal
  EXPECT_EQ(possible(PairFace(touching()[0].second, {3, 4, 5}), PairFace(flat, {0, 1, 2})).open,
            std::numeric_limits<double>::infinity());
}
