#include "report/plot.h"

#include <algorithm>
#include <cmath>

namespace plumbline::report
{
  namespace
  {
    // Of the height of the picture: rows far enough apart for their symbols, but never half of it.
    constexpr double margin = .05, row_height = .022, largest = .4;

    bool is_same(const Style &a, const Style &b)
    {
      return a.colour == b.colour && a.symbol == b.symbol && a.is_dashed == b.is_dashed;
    }
  } // namespace

  Strip make_strip(const std::vector<Line> &lines, const Range &y, double noise)
  {
    Strip strip;
    strip.noise = noise;
    for (const Line &line : lines)
      if (std::any_of(line.points.begin(), line.points.end(),
                      [&](const Vertex &v) { return v.y < noise; }) &&
          std::none_of(strip.rows.begin(), strip.rows.end(),
                       [&](const Style &style) { return is_same(style, line.style); }))
        strip.rows.push_back(line.style);
    const double part =
        std::min(largest, margin + row_height * static_cast<double>(strip.rows.size()));
    strip.range = {y.low * std::pow(y.high / y.low, -part / (1 - part)), y.low};
    return strip;
  }

  std::vector<Vertex> Strip::enter(const Line &line) const
  {
    const auto row = std::find_if(rows.begin(), rows.end(),
                                  [&](const Style &style) { return is_same(style, line.style); });
    const double depth =
        (static_cast<double>(row - rows.begin()) + 1) / (static_cast<double>(rows.size()) + 1);
    std::vector<Vertex> points = line.points;
    for (Vertex &v : points)
      if (v.y < noise)
        v.y = range.high * std::pow(range.low / range.high, depth);
    return points;
  }

  std::vector<Vertex> Strip::cut(const std::vector<Vertex> &points) const
  {
    std::vector<Vertex> result;
    for (const Vertex &v : points)
      if (v.y >= noise)
        result.push_back(v);
      else
      {
        result.push_back({v.x, range.high});
        result.push_back({v.x, range.low});
      }
    return result;
  }
} // namespace plumbline::report
