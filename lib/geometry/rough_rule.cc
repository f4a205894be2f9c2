#include "geometry/rough_rule.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace plumbline::geometry
{
  namespace
  {
    Point<2> middle(const Point<2> &a, const Point<2> &b)
    {
      return a + .5 * (b - a);
    }

    /// Triangles and quadrilaterals by the middles of their sides into four of their kind; of
    /// others the triangles of a fan, each into four.
    std::vector<Polygon> quarters(const Polygon &p)
    {
      std::vector<Polygon> parts;
      const std::size_t n = p.size();
      if (n > 4)
        for (std::size_t i = 1; i + 1 < n; ++i)
          for (Polygon &quarter : quarters({p[0], p[i], p[i + 1]}))
            parts.push_back(std::move(quarter));
      else if (n == 3)
      {
        const Point<2> a = middle(p[0], p[1]), b = middle(p[1], p[2]), c = middle(p[2], p[0]);
        parts = {{p[0], a, c}, {a, p[1], b}, {c, b, p[2]}, {a, b, c}};
      }
      else
      {
        const Point<2> centre = middle(middle(p[0], p[1]), middle(p[2], p[3]));
        for (std::size_t i = 0; i < n; ++i)
          parts.push_back(
              {p[i], middle(p[i], p[(i + 1) % n]), centre, middle(p[(i + n - 1) % n], p[i])});
      }
      return parts;
    }
  } // namespace

  /// A polygon and its rule with values.
  struct RoughRule::Part
  {
    Polygon polygon;
    Sampled sampled;

    /// ∫ |f|
    double size() const
    {
      double sum = 0;
      for (std::size_t q = 0; q < sampled.values.size(); ++q)
        sum += sampled.rule.weights[q] * std::abs(sampled.values[q]);
      return sum;
    }

    /// += ∫ f and ∫ f (x - origin) / length
    void add_moments(const Point<2> &origin, double length, std::array<double, 3> &moments) const
    {
      for (std::size_t q = 0; q < sampled.values.size(); ++q)
      {
        const double value = sampled.rule.weights[q] * sampled.values[q];
        moments[0] += value;
        for (unsigned int axis = 0; axis < 2; ++axis)
          moments[1 + axis] += value * (sampled.rule.points[q][axis] - origin[axis]) / length;
      }
    }

    void append_to(Sampled &all) const
    {
      const auto append = [](auto &to, const auto &from)
      { to.insert(to.end(), from.begin(), from.end()); };
      append(all.rule.points, sampled.rule.points);
      append(all.rule.weights, sampled.rule.weights);
      append(all.values, sampled.values);
    }
  };

  RoughRule::Part RoughRule::part(Polygon polygon, const Value &f) const
  {
    Part result;
    result.sampled.rule = polygon_rule(view(polygon), degree_);
    for (const Point<2> &x : result.sampled.rule.points)
      result.sampled.values.push_back(f(x));
    result.polygon = std::move(polygon);
    return result;
  }

  RoughRule::RoughRule(unsigned int degree, std::size_t n_cells,
                       const std::function<Polygon(std::size_t)> &cell, const Value &f)
      : degree_(degree)
  {
    constexpr std::size_t most_seen = 400;
    constexpr double most_points = 1e6, negligible = 1e-10; // of the largest mean of |f|
    constexpr unsigned int deepest = 8;
    const std::size_t n_seen = std::min(n_cells, most_seen);
    const double n_each =
        static_cast<double>(n_cells) / static_cast<double>(std::max<std::size_t>(n_seen, 1));
    std::vector<Polygon> seen;
    double largest = 0;
    for (std::size_t k = 0; k < n_seen; ++k)
    {
      seen.push_back(cell((2 * k + 1) * n_cells / (2 * n_seen)));
      largest = std::max(largest, part(seen.back(), f).size() / area(view(seen.back())));
    }
    negligible_ = negligible * largest;
    // points of rough cells, once cut and twice cut: along lines they double, elsewhere they become
    // four times as many
    double n_line = 0, n_once = 0, n_twice = 0;
    Sampled sampled;
    for (const Polygon &polygon : seen)
    {
      const auto n_plain = static_cast<double>(polygon_rule(view(polygon), degree_).points.size());
      n_line = std::max(n_line, 4 * n_plain * std::sqrt(static_cast<double>(n_cells)));
      depth_ = 1;
      sample(polygon, f, sampled);
      const auto n = static_cast<double>(sampled.values.size());
      if (n <= n_plain)
        continue;
      depth_ = 2;
      sample(polygon, f, sampled);
      n_once += n_each * n;
      n_twice += n_each * static_cast<double>(sampled.values.size());
    }
    const double growth = n_once > 0 ? std::clamp(n_twice / n_once, 2., 4.) : 2;
    const double n_first = std::max({n_once, n_line, 1.}); // at least a line of cells
    depth_ = static_cast<unsigned int>(std::clamp(
        1 + std::floor(std::log(most_points / n_first) / std::log(growth)), 1., double{deepest}));
  }

  void RoughRule::sample(const Polygon &cell, const Value &f, Sampled &result) const
  {
    result = {};
    const Part whole = part(cell, f);
    if (depth_ == 0)
      whole.append_to(result);
    else
      refine(whole, f, 0, 0, result);
  }

  void RoughRule::refine(const Part &whole, const Value &f, double tolerance, unsigned int depth,
                         Sampled &result) const
  {
    constexpr double same = 1e-8; // of ∫ |f| over the cell
    std::vector<Part> parts;
    for (Polygon &quarter : quarters(whole.polygon))
      parts.push_back(part(std::move(quarter), f));
    const Point<2> &origin = whole.polygon[0];
    const double length = std::sqrt(area(view(whole.polygon)));
    std::array<double, 3> of_whole{}, of_parts{};
    double size = 0;
    whole.add_moments(origin, length, of_whole);
    for (const Part &one : parts)
    {
      one.add_moments(origin, length, of_parts);
      size += one.size();
    }
    if (depth == 0)
      tolerance =
          std::max(same * std::max(size, whole.size()), negligible_ * area(view(whole.polygon)));
    bool is_smooth = true;
    for (unsigned int k = 0; k < 3; ++k)
      is_smooth = is_smooth && std::abs(of_whole[k] - of_parts[k]) <= tolerance;
    if (is_smooth)
      whole.append_to(result);
    else
      for (const Part &one : parts)
        if (depth + 1 < depth_)
          refine(one, f, tolerance, depth + 1, result);
        else
          one.append_to(result);
  }

  double RoughRule::integral(const Polygon &cell, const Value &f) const
  {
    Sampled sampled;
    sample(cell, f, sampled);
    double sum = 0;
    for (std::size_t q = 0; q < sampled.values.size(); ++q)
      sum += sampled.rule.weights[q] * sampled.values[q];
    return sum;
  }
} // namespace plumbline::geometry
