#include "report/plot.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumbline::report
{
  namespace
  {
    /// Lengths below are fractions of the picture's width and height, as the eye sees them.
    constexpr double clearance = .035;       // between a triangle and the nearest line
    constexpr double smallest_height = .045; // flatter than that the slope cannot be read
    constexpr double largest_height = .4;
    constexpr double border = .05; // room for the figures beside the legs
    constexpr double same_slope = .3;

    struct Segment
    {
      Vertex a, b;
      double slope;
    };

    double distance(const Vertex &p, const Segment &s)
    {
      const double dx = s.b.x - s.a.x, dy = s.b.y - s.a.y, square = dx * dx + dy * dy;
      const double t =
          square > 0 ? std::clamp(((p.x - s.a.x) * dx + (p.y - s.a.y) * dy) / square, 0., 1.) : 0.;
      return std::hypot(p.x - s.a.x - t * dx, p.y - s.a.y - t * dy);
    }

    /// Outline and inside of a triangle as points, dense enough for the clearance.
    std::vector<Vertex> samples(double x, double y, double width, double height)
    {
      std::vector<Vertex> points;
      constexpr unsigned int n = 5;
      for (unsigned int i = 0; i <= n; ++i)
        for (unsigned int j = 0; j <= i; ++j)
          points.push_back({x + width * i / n, y + height * j / n});
      return points;
    }
  } // namespace

  std::optional<SlopeTriangle> place_slope(unsigned int slope, const std::vector<Line> &lines,
                                           const Range &x, const Range &y,
                                           const std::vector<SlopeTriangle> &taken)
  {
    const double x_span = std::log(x.high / x.low), y_span = std::log(y.high / y.low);
    const auto place = [&](const Vertex &v) {
      return Vertex{std::log(v.x / x.low) / x_span, std::log(v.y / y.low) / y_span};
    };
    std::vector<Segment> segments;
    for (const Line &line : lines)
      for (std::size_t i = 0; i < line.points.size(); ++i)
      {
        const Vertex &p = line.points[i], &q = line.points[i > 0 ? i - 1 : 0];
        segments.push_back({place(q), place(p), std::log(p.y / q.y) / std::log(p.x / q.x)});
      }
    for (const SlopeTriangle &other : taken)
    {
      const Vertex a = place({other.x0, other.y0}), b = place({other.x1, other.y0}),
                   c = place({other.x1, other.y1});
      segments.push_back({a, b, 0});
      segments.push_back({b, c, 0});
      segments.push_back({a, c, 0});
    }

    std::optional<SlopeTriangle> best;
    double best_distance = std::numeric_limits<double>::max();
    for (const double width : {.16, .24})
    {
      const double height = slope * width * x_span / y_span;
      if (height < smallest_height || height > largest_height || best)
        continue;
      for (double left = border; left + width + border <= 1; left += .02)
        for (double bottom = border; bottom + height <= .98; bottom += .02)
        {
          // The nearest line counts for the clearance; the nearest of like slope for the choice.
          double nearest = std::numeric_limits<double>::max(), nearest_alike = nearest;
          for (const Vertex &p : samples(left, bottom, width, height))
            for (const Segment &segment : segments)
            {
              const double d = distance(p, segment);
              nearest = std::min(nearest, d);
              if (std::abs(segment.slope - slope) < same_slope)
                nearest_alike = std::min(nearest_alike, d);
            }
          const double wanted = std::min(nearest_alike, 1 + nearest);
          if (nearest >= clearance && wanted < best_distance)
          {
            best_distance = wanted;
            const auto x_at = [&](double t) { return x.low * std::exp(t * x_span); };
            const auto y_at = [&](double t) { return y.low * std::exp(t * y_span); };
            best = SlopeTriangle{slope, x_at(left), y_at(bottom), x_at(left + width),
                                 y_at(bottom + height)};
          }
        }
    }
    return best;
  }
} // namespace plumbline::report
