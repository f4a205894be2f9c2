#include "meshfree/scattered/faces.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace plumbline::meshfree
{
  namespace
  {
    /// Places are the same within this fraction of the horizon.
    constexpr double rounding = geometry::on_crack;

    /// Sine of 15 degrees: the force that is left at a bend is in proportion to its angle, and that
    /// of smaller ones is of the order of the curvature.
    constexpr double sharp = .2588;

    /// Sine of the angle up to which one face is the straight continuation of another.
    constexpr double straight = 1e-9;

    Tensor<1, 2> direction(const Face &face)
    {
      const Tensor<1, 2> d = face.last - face.first;
      return d / d.norm();
    }

    double sine(const Tensor<1, 2> &a, const Tensor<1, 2> &b)
    {
      return std::abs(a[0] * b[1] - a[1] * b[0]);
    }

    Point<2> nearest(const Face &face, const Point<2> &x)
    {
      const Tensor<1, 2> d = face.last - face.first;
      return face.first + std::clamp((x - face.first) * d / d.norm_square(), 0., 1.) * d;
    }

    geometry::Box around(const Point<2> &x, double reach)
    {
      geometry::Box box{x, x};
      for (unsigned int d = 0; d < 2; ++d)
      {
        box.lower[d] -= reach;
        box.upper[d] += reach;
      }
      return box;
    }

    std::vector<geometry::Box> boxes(const std::vector<Face> &faces)
    {
      std::vector<geometry::Box> result;
      for (const Face &face : faces)
      {
        const std::array<Point<2>, 2> ends{face.first, face.last};
        result.push_back(geometry::bounding_box({ends.data(), 2}));
      }
      return result;
    }
  } // namespace

  std::vector<Face> faces_of(const std::vector<geometry::Polyline> &lines)
  {
    std::vector<Face> faces;
    for (const geometry::Polyline &line : lines)
      for (std::size_t i = 1; i < line.size(); ++i)
        faces.push_back({line[i - 1], line[i]});
    return faces;
  }

  std::vector<Face> zero_line(const std::function<double(const Point<2> &)> &function,
                              const geometry::Box &box, double step)
  {
    // off the corners of cells, where functions of round numbers vanish
    constexpr double offset = .381966;
    const Point<2> origin(box.lower[0] - (1 + offset) * step, box.lower[1] - (1 + offset) * step);
    const auto count = [&](unsigned int d)
    { return static_cast<int>(std::ceil((box.upper[d] - origin[d]) / step)) + 2; };
    const int n1 = count(0), n2 = count(1);
    const auto at = [&](int i, int j)
    { return Point<2>(origin[0] + i * step, origin[1] + j * step); };
    std::vector<double> lower(static_cast<std::size_t>(n1)), upper = lower;
    const auto fill = [&](int j, std::vector<double> &row)
    {
      for (int i = 0; i < n1; ++i)
        row[static_cast<std::size_t>(i)] = function(at(i, j));
    };
    std::vector<Face> faces;
    fill(0, lower);
    for (int j = 0; j + 1 < n2; ++j, std::swap(lower, upper))
    {
      fill(j + 1, upper);
      for (int i = 0; i + 1 < n1; ++i)
      {
        const auto k = static_cast<std::size_t>(i);
        const std::array<Point<2>, 4> corners{at(i, j), at(i + 1, j), at(i + 1, j + 1),
                                              at(i, j + 1)};
        const std::array<double, 4> values{lower[k], lower[k + 1], upper[k + 1], upper[k]};
        std::array<Point<2>, 4> crossings;
        std::size_t n = 0;
        if (std::any_of(values.begin(), values.end(), [](double v) { return std::isnan(v); }))
          continue;
        for (std::size_t a = 0; a < 4; ++a)
          if (const std::size_t b = (a + 1) % 4; (values[a] > 0) != (values[b] > 0))
            crossings[n++] =
                corners[a] + values[a] / (values[a] - values[b]) * (corners[b] - corners[a]);
        for (std::size_t a = 0; a + 1 < n; a += 2)
          if (crossings[a].distance(crossings[a + 1]) > rounding * step)
            faces.push_back({crossings[a], crossings[a + 1]});
      }
    }
    return faces;
  }

  Faces::Faces(std::vector<Face> faces, std::vector<Point<2>> ends, double horizon)
      : faces_(std::move(faces)), ends_(std::move(ends)), horizon_(horizon), search_(boxes(faces_))
  {
  }

  std::optional<Faces::Foot> Faces::foot(const Point<2> &x, double reach) const
  {
    std::vector<unsigned int> near;
    search_.find(around(x, reach), near);
    const Face *best = nullptr;
    Foot foot;
    for (const unsigned int f : near)
    {
      const Point<2> place = nearest(faces_[f], x);
      if (best == nullptr || x.distance(place) < x.distance(foot.place) - rounding * horizon_)
      {
        best = &faces_[f];
        foot.place = place;
      }
    }
    if (best == nullptr)
      return {};
    const Tensor<1, 2> d = direction(*best);
    foot.normal[0] = -d[1];
    foot.normal[1] = d[0];
    if (foot.normal * (foot.place - x) < 0)
      foot.normal *= -1;
    foot.is_near_end = is_near_end(foot.place, d);
    return foot;
  }

  bool Faces::is_near_end(const Point<2> &place, const Tensor<1, 2> &d) const
  {
    const double reach = (1 - rounding) * horizon_;
    for (const Point<2> &end : ends_)
      if (place.distance(end) < reach)
        return true;
    std::vector<unsigned int> near;
    search_.find(around(place, reach), near);
    return std::any_of(near.begin(), near.end(),
                       [&](unsigned int f)
                       {
                         return sine(direction(faces_[f]), d) > sharp &&
                                place.distance(nearest(faces_[f], place)) < reach;
                       });
  }

  std::vector<Point<2>> tips_of(const std::vector<geometry::Polyline> &lines,
                                const std::vector<Face> &faces, double horizon, double gap,
                                const std::function<bool(const Point<2> &)> &is_in_body)
  {
    const double touching = rounding * horizon;
    std::vector<Point<2>> tips;
    const auto add = [&](const Point<2> &end, const Point<2> &before)
    {
      if (!is_in_body(end))
        return;
      const Face own{before, end};
      const auto goes_on = [&](const Face &other)
      {
        const Point<2> place = nearest(other, end);
        if (std::min(end.distance(other.first) + before.distance(other.last),
                     end.distance(other.last) + before.distance(other.first)) <= touching)
          return false; // its own
        return end.distance(place) <= touching ||
               (end.distance(place) < gap && sine(direction(other), direction(own)) < straight);
      };
      if (std::none_of(faces.begin(), faces.end(), goes_on))
        tips.push_back(end);
    };
    for (const geometry::Polyline &line : lines)
      if (line.size() > 1 && line.front().distance(line.back()) > touching)
      {
        add(line.front(), line[1]);
        add(line.back(), line[line.size() - 2]);
      }
    return tips;
  }
} // namespace plumbline::meshfree
