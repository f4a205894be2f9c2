#include "reference/tetrahedra/jump_pairs.h"

#include "reference/tetrahedra/face_sides.h"

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumbline::reference
{
  namespace
  {
    using dealii::Point;
    using dealii::Tensor;

    /// The vertices of a face in an order that depends on names alone: those of the other first.
    struct Order
    {
      Order(const PairFace &face, const PairFace &other)
      {
        const auto key = [&](unsigned int k)
        {
          const unsigned int name = face.names()[k];
          const bool is_shared = std::count(other.names().begin(), other.names().end(), name) > 0;
          return std::pair(!is_shared, name);
        };
        std::sort(of.begin(), of.end(),
                  [&](unsigned int a, unsigned int b) { return key(a) < key(b); });
        while (n_shared < 3 && !key(of[n_shared]).first)
          ++n_shared;
      }

      std::array<unsigned int, 3> of = {0, 1, 2};
      unsigned int n_shared = 0;
    };
  } // namespace

  JumpPairs::JumpPairs(const PotentialKernel &kernel, double tolerance) : tolerance_(tolerance)
  {
    for (const PotentialTerms &terms : kernel.terms)
      parts_.push_back({{terms, 2}, {terms, 3}});
    for (const unsigned int n : {3, 5, 7})
      rules_[0].push_back(make_rule(n));
    for (unsigned int k = 0; k < 2; ++k)
      rules_[0].push_back(on_quarters(rules_[0].back()));
    for (unsigned int n_shared = 1; n_shared <= 3; ++n_shared)
      for (const unsigned int n : {4, 6, 9, 13, 19, 28})
        rules_[n_shared].push_back(make_touching_rule(n_shared, n));
  }

  JumpIntegrals JumpPairs::operator()(const PairFace &f, const PairFace &g) const
  {
    JumpIntegrals result;
    if (are_out_of_reach(f, g))
      return result;
    const FaceIntegrals over_f = integrate_over(f, g), over_g = integrate_over(g, f);
    for (unsigned int a = 0; a < 3; ++a)
      for (unsigned int b = 0; b < 3; ++b)
      {
        constexpr double half = .5;
        result.values[a][b] = half * (over_f.values[a][b] + over_g.values[b][a]);
      }
    result.open = std::max(over_f.open, over_g.open);
    if (f.names() != g.names()) // else in its own plane
    {
      result.first = over_f.slopes;
      result.second = over_g.slopes;
    }
    return result;
  }

  JumpPairs::FaceIntegrals JumpPairs::integrate_over(const PairFace &outer,
                                                     const PairFace &inner) const
  {
    const Order order(outer, inner);
    const FaceSides face(inner);
    const std::vector<Rule> &rules = rules_[order.n_shared];
    FaceIntegrals integrals = integrate_over(outer, face, order.of, rules.front());
    for (std::size_t level = 1; level < rules.size(); ++level)
    {
      const FaceIntegrals finer = integrate_over(outer, face, order.of, rules[level]);
      double change = 0, sum = 0; // the sum is finite if all of them are
      const auto compare = [&](double last, double before, double unit)
      {
        change = std::max(change, std::abs(last - before) / unit);
        sum += std::abs(last);
      };
      for (unsigned int a = 0; a < 3; ++a)
      {
        compare(finer.slopes[a], integrals.slopes[a], outer.radius());
        for (unsigned int b = 0; b < 3; ++b)
          compare(finer.values[a][b], integrals.values[a][b], 1);
      }
      integrals = finer;
      integrals.open = std::isfinite(sum) ? change : std::numeric_limits<double>::infinity();
      if (integrals.open <= tolerance_)
      {
        integrals.open = 0;
        break;
      }
    }
    return integrals;
  }

  JumpPairs::FaceIntegrals JumpPairs::integrate_over(const PairFace &outer, const FaceSides &inner,
                                                     const std::array<unsigned int, 3> &order,
                                                     const Rule &rule) const
  {
    FaceIntegrals integrals;
    for (std::size_t q = 0; q < rule.points.size(); ++q)
    {
      std::array<double, 3> s{};
      Point<3> x;
      for (unsigned int k = 0; k < 3; ++k)
      {
        s[order[k]] = rule.points[q][k];
        x += rule.points[q][k] * outer.vertices()[order[k]];
      }
      const PointIntegrals at_x = integrals_at(x, inner);
      const double weight = rule.weights[q] * outer.area();
      for (unsigned int a = 0; a < 3; ++a)
      {
        integrals.slopes[a] += weight * s[a] * at_x.slope;
        for (unsigned int b = 0; b < 3; ++b)
          integrals.values[a][b] += weight * s[a] * at_x.values[b];
      }
    }
    return integrals;
  }

  JumpPairs::PointIntegrals JumpPairs::integrals_at(const Point<3> &point,
                                                    const FaceSides &face) const
  {
    constexpr double flat = 1e-13; // a height that is none
    PointIntegrals integrals;
    const Tensor<1, 3> first = face.x[0] - point;
    const double height = -(face.normal * first), distance = std::abs(height);
    std::array<double, 3> at_foot{}; // λ_b
    for (unsigned int b = 0; b < 3; ++b)
      at_foot[b] = (b == 0 ? 1. : 0.) - face.slope[b] * first;
    for (const Part &part : parts_)
    {
      if (distance >= part.end())
        continue;
      Values foot;
      const double nearest = std::max(distance, flat);
      values(part, &nearest, &foot.harmonic, &foot.biharmonic, 1);
      Values whole;
      for (unsigned int k = 0; k < 3; ++k)
      {
        const Tensor<1, 3> start = face.x[k] - point;
        Side side;
        side.kappa = face.outward[k] * start;
        side.from = face.along[k] * start;
        side.to = side.from + face.length[k];
        double moment = 0;
        add_side(part, side, distance, foot, whole, moment);
        for (unsigned int b = 0; b < 3; ++b)
          integrals.values[b] += (face.slope[b] * face.outward[k]) * moment;
      }
      for (unsigned int b = 0; b < 3; ++b)
        integrals.values[b] += at_foot[b] * whole.harmonic;
      if (distance > flat)
        integrals.slope += height * whole.biharmonic;
    }
    return integrals;
  }

  void JumpPairs::add_side(const Part &part, const Side &side, double distance, const Values &foot,
                           Values &whole, double &moment) const
  {
    const double kappa = side.kappa, of_kappa = kappa * kappa,
                 square = of_kappa + distance * distance,
                 reach = std::sqrt(std::max(0., part.end() * part.end() - square));
    const auto angle = [&](double from, double to)
    { return std::atan2(kappa * (to - from), of_kappa + from * to); };
    const double from = std::max(side.from, -reach), to = std::min(side.to, reach);
    if (from < to)
    {
      const LinePoints points(from, to, square, part.biharmonic.extra_points(to - from));
      std::array<double, LinePoints::most> harmonic, biharmonic; // filled up to n
      values(part, points.r.data(), harmonic.data(), biharmonic.data(), points.n);
      double of_harmonic = 0, of_biharmonic = 0;
      for (unsigned int q = 0; q < points.n; ++q)
      {
        const double share = points.weight[q] / (of_kappa + points.tau[q] * points.tau[q]);
        moment += points.weight[q] * harmonic[q];
        of_harmonic += share * (harmonic[q] - foot.harmonic);
        of_biharmonic += share * (biharmonic[q] - foot.biharmonic);
      }
      if (kappa != 0)
      {
        whole.harmonic += kappa * of_harmonic;
        whole.biharmonic += kappa * of_biharmonic;
      }
    }
    if (kappa != 0 && (from > side.from || to < side.to)) // beyond the horizon, where H = 0
    {
      const double beyond = angle(side.from, side.to) - (from < to ? angle(from, to) : 0);
      whole.harmonic -= foot.harmonic * beyond;
      whole.biharmonic -= foot.biharmonic * beyond;
    }
  }

  void JumpPairs::values(const Part &part, const double *r, double *harmonic, double *biharmonic,
                         unsigned int n)
  {
    constexpr unsigned int at_once = RadialPolynomial<double>::most_radii;
    for (unsigned int first = 0; first < n; first += at_once)
    {
      const unsigned int size = std::min(at_once, n - first);
      part.harmonic.potential().evaluate(r + first, harmonic + first, size);
      part.biharmonic.potential().evaluate(r + first, biharmonic + first, size);
    }
    for (unsigned int q = 0; q < n; ++q)
      harmonic[q] = -harmonic[q];
    for (unsigned int q = 0; q < n; ++q)
      biharmonic[q] /= r[q];
  }

  JumpPairs::Rule JumpPairs::make_rule(unsigned int n_points)
  {
    const dealii::QWitherdenVincentSimplex<2> symmetric(n_points);
    Rule rule;
    constexpr double twice = 2; // the area of the triangle that deal.II has is 1/2
    for (unsigned int q = 0; q < symmetric.size(); ++q)
    {
      const auto &s = symmetric.point(q);
      rule.points.push_back({1 - s[0] - s[1], s[0], s[1]});
      rule.weights.push_back(twice * symmetric.weight(q));
    }
    return rule;
  }

  JumpPairs::Rule JumpPairs::on_quarters(const Rule &whole)
  {
    // the four triangles that the middles of the sides make
    Rule rule;
    constexpr double half = .5, quarter = .25;
    for (unsigned int part = 0; part < 4; ++part)
      for (std::size_t q = 0; q < whole.points.size(); ++q)
      {
        std::array<double, 3> s{};
        for (unsigned int k = 0; k < 3; ++k)
          s[k] = half *
                 (part == 3 ? 1 - whole.points[q][k] : whole.points[q][k] + (k == part ? 1 : 0));
        rule.points.push_back(s);
        rule.weights.push_back(quarter * whole.weights[q]);
      }
    return rule;
  }

  JumpPairs::Rule JumpPairs::make_touching_rule(unsigned int n_shared, unsigned int n_points)
  {
    // triangles by their corners: of a vertex that is shared, along a side that is, if one is
    constexpr double third = 1. / 3, half = .5;
    using Corner = std::array<double, 3>;
    const Corner first = {1, 0, 0}, second = {0, 1, 0}, last = {0, 0, 1};
    std::vector<std::array<Corner, 3>> triangles;
    if (n_shared == 1)
      triangles = {{first, second, last}};
    else if (n_shared == 2)
      triangles = {{first, {half, half, 0}, last}, {second, {half, half, 0}, last}};
    else
      for (const auto &[a, b] : {std::pair(first, second),
                                 {second, first},
                                 {second, last},
                                 {last, second},
                                 {last, first},
                                 {first, last}})
        triangles.push_back({a,
                             {half * (a[0] + b[0]), half * (a[1] + b[1]), half * (a[2] + b[2])},
                             {third, third, third}});
    // a along rays from the vertex, where functions are like a and a log a, and b from the side
    // on, where they are like b log b
    const LineRule &line = line_rule(n_points);
    Rule rule;
    for (const auto &[apex, near, far] : triangles)
      for (unsigned int i = 0; i < n_points; ++i)
        for (unsigned int j = 0; j < n_points; ++j)
        {
          const double alpha = line.points[i], beta = line.points[j];
          const double a = alpha * alpha, b = n_shared == 1 ? beta : beta * beta * beta;
          Corner s{};
          for (unsigned int k = 0; k < 3; ++k)
            s[k] = (1 - a) * apex[k] + a * ((1 - b) * near[k] + b * far[k]);
          rule.points.push_back(s);
          const double stretch = 2 * alpha * (n_shared == 1 ? 1 : 3 * beta * beta);
          rule.weights.push_back(line.weights[i] * line.weights[j] * 2 * a * stretch /
                                 static_cast<double>(triangles.size()));
        }
    return rule;
  }
} // namespace plumbline::reference
