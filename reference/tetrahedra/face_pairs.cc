#include "reference/tetrahedra/face_pairs.h"

#include "physics/gauss.h"

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace plumbline::reference
{
  namespace
  {
    using Point = dealii::Point<3>;

    constexpr unsigned int most_along_line = 7; ///< of the symmetric rules that there are

    Point at(const PairFace::Vertices &vertices, const std::array<double, 3> &barycentric)
    {
      return Point(barycentric[0] * vertices[0] + barycentric[1] * vertices[1] +
                   barycentric[2] * vertices[2]);
    }

    /// The four triangles that the middles of the sides make.
    std::array<PairFace, 4> quarters(const PairFace &face)
    {
      const auto &[a, b, c] = face.vertices();
      const Point ab(.5 * (a + b)), bc(.5 * (b + c)), ca(.5 * (c + a));
      const auto &names = face.names();
      return {PairFace({a, ab, ca}, names), PairFace({ab, b, bc}, names),
              PairFace({ca, bc, c}, names), PairFace({ab, bc, ca}, names)};
    }

    unsigned int count_shared(const std::array<unsigned int, 3> &a,
                              const std::array<unsigned int, 3> &b)
    {
      unsigned int n = 0;
      for (const unsigned int one : a)
        n += static_cast<unsigned int>(std::count(b.begin(), b.end(), one));
      return n;
    }

    /// Vertices, shared ones first, in the order of their names.
    PairFace::Vertices shared_first(const PairFace &face, const PairFace &other)
    {
      std::array<unsigned int, 3> order = {0, 1, 2};
      const auto key = [&](unsigned int k)
      {
        const unsigned int name = face.names()[k];
        const bool is_shared = std::count(other.names().begin(), other.names().end(), name) > 0;
        return std::pair(!is_shared, name);
      };
      std::sort(order.begin(), order.end(),
                [&](unsigned int a, unsigned int b) { return key(a) < key(b); });
      return {face.vertices()[order[0]], face.vertices()[order[1]], face.vertices()[order[2]]};
    }
  } // namespace

  PairFace::PairFace(const Vertices &vertices, const std::array<unsigned int, 3> &names)
      : vertices_(vertices), names_(names)
  {
    constexpr double third = 1. / 3;
    centre_ = at(vertices, {third, third, third});
    for (const Point &x : vertices)
      radius_ = std::max(radius_, x.distance(centre_));
    area_ = .5 * cross_product_3d(vertices[1] - vertices[0], vertices[2] - vertices[0]).norm();
  }

  geometry::Cuboid PairFace::box() const
  {
    geometry::Cuboid box{vertices_[0], vertices_[0]};
    for (const dealii::Point<3> &vertex : vertices_)
      for (unsigned int d = 0; d < 3; ++d)
      {
        box.lower[d] = std::min(box.lower[d], vertex[d]);
        box.upper[d] = std::max(box.upper[d], vertex[d]);
      }
    return box;
  }

  bool are_out_of_reach(const PairFace &f, const PairFace &g)
  {
    const dealii::Tensor<1, 3> line = g.centre() - f.centre();
    const double distance = line.norm();
    if (distance < 1)
      return false;
    double last = -distance, first = 2 * distance; // along the line, from the centre of f
    for (unsigned int k = 0; k < 3; ++k)
    {
      last = std::max(last, line * (f.vertices()[k] - f.centre()) / distance);
      first = std::min(first, line * (g.vertices()[k] - f.centre()) / distance);
    }
    return first - last >= 1;
  }

  FacePairs::FacePairs(const FacePotential &potential, unsigned int refinement)
      : potential_(potential), ends_(potential.ends()), refinement_(refinement)
  {
    for (unsigned int n = 1; n <= most_along_line; ++n)
      rules_.push_back(make_rule(n));
    for (unsigned int n_shared = 1; n_shared <= 3; ++n_shared)
      touching_rules_[n_shared - 1] = make_touching_rule(n_shared, refinement);
  }

  FacePairs::Rule FacePairs::make_rule(unsigned int n_points)
  {
    const dealii::QWitherdenVincentSimplex<2> quadrature(n_points);
    constexpr double whole = 2; // the triangle's area is 1/2
    Rule rule;
    for (unsigned int q = 0; q < quadrature.size(); ++q)
    {
      const auto &x = quadrature.point(q);
      rule.points.push_back({1 - x[0] - x[1], x[0], x[1]});
      rule.weights.push_back(whole * quadrature.weight(q));
    }
    return rule;
  }

  FacePairs::TouchingRule FacePairs::make_touching_rule(unsigned int n_shared,
                                                        unsigned int refinement)
  {
    TouchingRule rule;
    constexpr double whole = 4; // of both triangles 0 <= ξ2 <= ξ1 <= 1
    double weight = 0;
    const auto add = [&](double factor, std::array<double, 2> x, std::array<double, 2> y)
    {
      rule.points.push_back({x[0], x[1], y[0], y[1]});
      rule.weights.push_back(whole * weight * factor);
    };
    const auto add_both = [&](double factor, std::array<double, 2> x, std::array<double, 2> y)
    {
      add(factor, x, y);
      add(factor, y, x);
    };
    constexpr unsigned int n_along_line = 6;
    const auto &gauss = physics::gauss(n_along_line + refinement);
    for (unsigned int j = 0; j < gauss.size(); ++j)
      for (unsigned int k = 0; k < gauss.size(); ++k)
        for (unsigned int l = 0; l < gauss.size(); ++l)
        {
          const double a = gauss.point(j)[0], b = gauss.point(k)[0], c = gauss.point(l)[0];
          weight = gauss.weight(j) * gauss.weight(k) * gauss.weight(l);
          if (n_shared == 3) // sec. 5.2.1
          {
            const double factor = a * a * b;
            add_both(factor, {1, 1 - a + a * b}, {1 - a * b * c, 1 - a});
            add_both(factor, {1, a * (1 - b + b * c)}, {1 - a * b, a * (1 - b)});
            add_both(factor, {1 - a * b * c, a * (1 - b * c)}, {1, a * (1 - b)});
          }
          else if (n_shared == 2) // sec. 5.2.2
          {
            const double factor = a * a;
            add(factor, {1, a * c}, {1 - a * b, a * (1 - b)});
            add(factor * b, {1, a}, {1 - a * b * c, a * b * (1 - c)});
            add(factor * b, {1 - a * b, a * (1 - b)}, {1, a * b * c});
            add(factor * b, {1 - a * b * c, a * b * (1 - c)}, {1, a});
            add(factor * b, {1 - a * b * c, a * (1 - b * c)}, {1, a * b});
          }
          else // sec. 5.2.3
            add_both(b, {1, a}, {b, b * c});
        }
    return rule;
  }

  double FacePairs::operator()(const PairFace &f, const PairFace &g) const
  {
    if (f.centre().distance(g.centre()) - f.radius() - g.radius() >= 1)
      return 0;
    const bool is_first = f.names() <= g.names();
    const PairFace &first = is_first ? f : g, &second = is_first ? g : f;
    const unsigned int n_shared = count_shared(f.names(), g.names());
    return n_shared == 0 ? product(first, second, 0) : touching(first, second, n_shared);
  }

  double FacePairs::touching(const PairFace &f, const PairFace &g, unsigned int n_shared) const
  {
    const PairFace::Vertices x = shared_first(f, g), y = shared_first(g, f);
    const TouchingRule &rule = touching_rules_[n_shared - 1];
    std::array<double, FacePotential::most_points> squares;
    double sum = 0;
    for (std::size_t first = 0; first < rule.points.size(); first += squares.size())
    {
      const std::size_t n = std::min(squares.size(), rule.points.size() - first);
      for (std::size_t q = 0; q < n; ++q)
      {
        const auto &[x1, x2, y1, y2] = rule.points[first + q];
        squares[q] =
            (x1 * (x[1] - x[0]) + x2 * (x[2] - x[1]) - y1 * (y[1] - y[0]) - y2 * (y[2] - y[1]))
                .norm_square();
      }
      sum += potential_.sum_of_rays(squares.data(), &rule.weights[first],
                                    static_cast<unsigned int>(n));
    }
    return f.area() * g.area() * sum;
  }

  const FacePairs::Rule &FacePairs::rule_for(const PairFace &f, const PairFace &g) const
  {
    // 1/r is the smoother, the farther they are; no two distances of a lattice are in these ratios,
    // so that rounding cannot decide
    static constexpr std::array<double, 3> ratios = {2.013, 1.417, 1.119};
    constexpr unsigned int n_at_least = 2, n_at_end = 3;
    constexpr double touches_end = 1.0037;
    const double distance = f.centre().distance(g.centre()), reach = f.radius() + g.radius();
    unsigned int n = n_at_least;
    for (const double ratio : ratios)
      n += distance < ratio * reach ? 1 : 0;
    for (const double end : ends_)
      if (std::abs(distance - end) < touches_end * reach)
        n = std::max(n, n_at_end);
    return rules_[std::min(n + refinement_, most_along_line) - 1];
  }

  double FacePairs::product(const PairFace &f, const PairFace &g, unsigned int depth) const
  {
    constexpr unsigned int most_depth = 3;
    constexpr double near = .517; // as thin cells have them
    if (depth < most_depth && f.centre().distance(g.centre()) < near * (f.radius() + g.radius()))
    {
      constexpr double alike = .9987; // of equal ones the first is cut, whatever rounding says
      const bool cuts_first = f.radius() > alike * g.radius();
      double sum = 0;
      for (const PairFace &part : quarters(cuts_first ? f : g))
        sum += product(cuts_first ? part : f, cuts_first ? g : part, depth + 1);
      return sum;
    }
    const Rule &rule = rule_for(f, g);
    const std::size_t n = rule.points.size();
    std::array<Point, FacePotential::most_points> y;
    for (std::size_t q = 0; q < n; ++q)
      y[q] = at(g.vertices(), rule.points[q]);
    std::array<double, FacePotential::most_points> squares;
    double sum = 0;
    for (std::size_t p = 0; p < n; ++p)
    {
      const Point x = at(f.vertices(), rule.points[p]);
      for (std::size_t q = 0; q < n; ++q)
        squares[q] = x.distance_square(y[q]);
      sum += rule.weights[p] *
             potential_.sum(squares.data(), rule.weights.data(), static_cast<unsigned int>(n));
    }
    return f.area() * g.area() * sum;
  }
} // namespace plumbline::reference
