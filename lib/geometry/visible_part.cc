#include "geometry/visible_part.h"

#include <algorithm>
#include <cmath>

namespace plumbline::geometry
{
  namespace
  {
    using dealii::Tensor;

    /// Of the ball's area: smaller parts are rounding of polygons.
    constexpr double no_part = 1e-10;
    /// Of the ball's area: a difference of two sums of parts.
    constexpr double no_difference = 1e-9;

    double cross(const Tensor<1, 2> &a, const Tensor<1, 2> &b)
    {
      return a[0] * b[1] - a[1] * b[0];
    }

    double area_in(const Ball &ball, const std::vector<Polygon> &polygons)
    {
      double sum = 0;
      for (const Polygon &polygon : polygons)
        sum += intersect(ball, ConvexCell(polygon)).area;
      return sum;
    }

    std::vector<Box> boxes_of(const std::vector<Polygon> &polygons)
    {
      std::vector<Box> boxes;
      for (const Polygon &polygon : polygons)
        boxes.push_back(bounding_box(view(polygon)));
      return boxes;
    }

    std::vector<Box> boxes_of(const std::vector<Cut> &cuts)
    {
      std::vector<Box> boxes;
      for (const Cut &cut : cuts)
        boxes.push_back(bounding_box({cut.data(), cut.size()}));
      return boxes;
    }

    double distance(const Point<2> &x, const Point<2> &p, const Point<2> &q)
    {
      const Tensor<1, 2> d = q - p;
      return x.distance(p + std::clamp((x - p) * d / d.norm_square(), 0., 1.) * d);
    }

    /// Whether two segments have a point in common, which for parallel ones counts as none. A bend
    /// of a crack belongs to both of its sides, so that no bond slips through.
    bool meet(const Cut &cut, const Point<2> &p, const Point<2> &q)
    {
      constexpr double parallel = 1e-9, bend = 1e-12;
      const Tensor<1, 2> d = cut[1] - cut[0], r = q - p, from = p - cut[0];
      const double turn = cross(d, r);
      if (std::abs(turn) <= parallel * d.norm() * r.norm())
        return false;
      const double on_bond = cross(from, d) / turn, on_cut = cross(from, r) / turn;
      return on_bond > 0 && on_bond < 1 && on_cut > -bend && on_cut < 1 + bend;
    }

    /// How much of a segment lies in a convex polygon, as a fraction of it.
    double share(const Polygon &polygon, const Point<2> &p, const Point<2> &q)
    {
      double first = 0, last = 1;
      for (std::size_t i = 0; i < polygon.size(); ++i)
      {
        const Tensor<1, 2> side = polygon[(i + 1) % polygon.size()] - polygon[i];
        const double at_p = cross(side, p - polygon[i]), at_q = cross(side, q - polygon[i]);
        if (at_p < 0 && at_q < 0)
          return 0;
        if (at_p < 0)
          first = std::max(first, at_p / (at_p - at_q));
        else if (at_q < 0)
          last = std::min(last, at_p / (at_p - at_q));
      }
      return std::max(0., last - first);
    }
  } // namespace

  VisibleBody::VisibleBody(std::vector<Polygon> parts, const std::vector<Polyline> &cracks,
                           double tolerance)
      : parts_(std::move(parts)), cuts_(straight_parts(cracks)), tolerance_(tolerance),
        part_search_(boxes_of(parts_)), cut_search_(boxes_of(cuts_))
  {
    const auto goes_on = [&](std::size_t crack, const Point<2> &end)
    {
      for (std::size_t other = 0; other < cracks.size(); ++other)
        for (std::size_t k = 1; other != crack && k < cracks[other].size(); ++k)
          if (distance(end, cracks[other][k - 1], cracks[other][k]) <= tolerance)
            return true;
      return false;
    };
    for (std::size_t k = 0; k < cracks.size(); ++k)
      for (const Point<2> &end : {cracks[k].front(), cracks[k].back()})
        if (cracks[k].front().distance(cracks[k].back()) > tolerance && !goes_on(k, end))
          ends_.push_back(end);
  }

  FamilyCut VisibleBody::find(const Ball &ball, std::vector<Polygon> &visible) const
  {
    constexpr double wider = 1.1; // than the ball, so that the frame does not cut it
    const double least = no_part * M_PI * ball.radius * ball.radius;
    const Point<2> reach(wider * ball.radius, wider * ball.radius);
    const Box around = {Point<2>(ball.centre - reach), ball.centre + reach};
    const auto square_around = square(around.lower, around.upper[0] - around.lower[0]);
    const Polygon frame(square_around.begin(), square_around.end());
    std::vector<Polygon> in_body;
    std::vector<unsigned int> near;
    if (parts_.empty())
      in_body.push_back(frame);
    part_search_.find(around, near);
    for (const unsigned int k : near)
      if (Polygon part = overlap(view(parts_[k]), view(frame));
          part.size() >= 3 && area(view(part)) > least)
        in_body.push_back(std::move(part));

    cut_search_.find(around, near);
    std::vector<Cut> cuts;
    for (const unsigned int k : near)
      cuts.push_back(cuts_[k]);
    visible.clear();
    std::vector<Polygon> seen;
    for (const Polygon &part : in_body)
    {
      find_visible(ball.centre, view(part), cuts, seen);
      for (Polygon &one : seen)
        if (area(view(one)) > least)
          visible.push_back(std::move(one));
    }

    const double whole = M_PI * ball.radius * ball.radius, allowed = no_difference * whole,
                 of_body = area_in(ball, in_body);
    if (!cuts.empty() && area_in(ball, visible) < of_body - allowed)
      return FamilyCut::crack;
    return of_body < whole - allowed ? FamilyCut::surface : FamilyCut::none;
  }

  Passage VisibleBody::passage(const Point<2> &p, const Point<2> &q) const
  {
    std::vector<unsigned int> near;
    const std::array<Point<2>, 2> bond = {p, q};
    cut_search_.find(bounding_box({bond.data(), bond.size()}), near);
    std::vector<Point<2>> touched;
    for (const Point<2> &end : ends_)
      if (distance(end, p, q) <= tolerance_)
        touched.push_back(end);
    const auto is_touched = [&](const Cut &cut)
    {
      return std::any_of(touched.begin(), touched.end(),
                         [&](const Point<2> &end)
                         { return distance(end, cut[0], cut[1]) <= tolerance_; });
    };
    // the same answer from both ends
    const bool is_ordered = std::pair(p[0], p[1]) < std::pair(q[0], q[1]);
    const Point<2> &first = is_ordered ? p : q, &last = is_ordered ? q : p;
    if (std::any_of(near.begin(), near.end(),
                    [&](unsigned int k)
                    { return !is_touched(cuts_[k]) && meet(cuts_[k], first, last); }))
      return Passage::crosses;
    return touched.empty() ? Passage::clear : Passage::touches_end;
  }

  bool VisibleBody::holds(const Point<2> &p, const Point<2> &q) const
  {
    constexpr double rounding = 1e-9;
    if (parts_.empty())
      return true;
    std::vector<unsigned int> near;
    const std::array<Point<2>, 2> bond = {p, q};
    part_search_.find(bounding_box({bond.data(), bond.size()}), near);
    double sum = 0; // a segment along a common side counts twice
    for (const unsigned int k : near)
      sum += share(parts_[k], p, q);
    return sum >= 1 - rounding;
  }

  std::vector<double> weighted_moments(const Ball &ball, const std::vector<Polygon> &polygons,
                                       const std::function<double(double)> &f, unsigned int degree)
  {
    std::vector<double> sum((degree + 1) * (degree + 2) / 2, 0.);
    for (const Polygon &polygon : polygons)
    {
      const auto of_part = weighted_moments(ball, ConvexCell(polygon), f, degree);
      for (std::size_t k = 0; k < sum.size(); ++k)
        sum[k] += of_part[k];
    }
    return sum;
  }

  std::vector<Polygon> convex_parts(const Domain &domain)
  {
    std::array<std::vector<double>, 2> at; // where boxes begin and end along each axis
    for (const auto *boxes : {&domain.include, &domain.exclude})
      for (const Box &box : *boxes)
        for (unsigned int d = 0; d < 2; ++d)
          at[d].insert(at[d].end(), {box.lower[d], box.upper[d]});
    for (std::vector<double> &values : at)
    {
      std::sort(values.begin(), values.end());
      values.erase(std::unique(values.begin(), values.end()), values.end());
    }
    const auto is_in = [](const std::vector<Box> &boxes, double x, double y)
    {
      return std::any_of(boxes.begin(), boxes.end(),
                         [&](const Box &box) {
                           return x > box.lower[0] && x < box.upper[0] && y > box.lower[1] &&
                                  y < box.upper[1];
                         });
    };
    std::vector<Polygon> parts;
    for (std::size_t j = 1; j < at[1].size(); ++j)
    {
      const double low = at[1][j - 1], high = at[1][j];
      bool goes_on = false;
      for (std::size_t i = 1; i < at[0].size(); ++i)
      {
        const double left = at[0][i - 1], right = at[0][i];
        const double x = .5 * (left + right), y = .5 * (low + high);
        const bool is_filled = is_in(domain.include, x, y) && !is_in(domain.exclude, x, y);
        if (is_filled && goes_on)
          parts.back()[1][0] = parts.back()[2][0] = right;
        else if (is_filled)
          parts.push_back({{left, low}, {right, low}, {right, high}, {left, high}});
        goes_on = is_filled;
      }
    }
    return parts;
  }
} // namespace plumbline::geometry
