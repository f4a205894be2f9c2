#include "reference/geometry_check.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace plumbline::reference
{
  namespace
  {
    using geometry::Ball;
    using geometry::Point;

    void compare(const Ball &ball, geometry::ArrayView<const Point<2>> polygon, double area,
                 GeometryCheck &check)
    {
      const auto fast = geometry::intersect(ball, polygon);
      const auto exact = geometry::intersect(ball, polygon, geometry::Backend::cgal);
      const double moments =
          (fast.area * (fast.centroid - ball.centre) - exact.area * (exact.centroid - ball.centre))
              .norm();
      ++check.n_checked;
      check.worst_difference =
          std::max({check.worst_difference, std::abs(fast.area - exact.area) / area,
                    moments / (area * ball.radius)});
    }
  } // namespace

  GeometryCheck check_geometry(double horizon, double h, unsigned int n_checks, unsigned int seed)
  {
    std::vector<std::array<int, 2>> cut;
    const int n = static_cast<int>(std::ceil(horizon / h));
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        if (h * std::hypot(i, j) < horizon && h * std::hypot(i + 1, j + 1) > horizon)
          cut.push_back({i, j});
    std::shuffle(cut.begin(), cut.end(), std::mt19937(seed));
    cut.resize(std::min<std::size_t>(cut.size(), n_checks));

    GeometryCheck check{0, 0};
    for (const auto &[i, j] : cut)
      compare({Point<2>(), horizon}, geometry::view(geometry::square(Point<2>(i * h, j * h), h)),
              h * h, check);
    return check;
  }

  GeometryCheck check_geometry(const MeshCells &cells, double horizon, unsigned int n_checks,
                               unsigned int seed)
  {
    GeometryCheck check{0, 0};
    std::mt19937 random(seed);
    std::vector<unsigned int> near;
    for (unsigned int trial = 0; trial < 4 * n_checks && check.n_checked < n_checks; ++trial)
    {
      const std::size_t centre = random() % cells.size();
      cells.find_near(centre, horizon, near);
      const Ball ball{cells.centroid(centre), horizon};
      const std::size_t first = random();
      for (std::size_t k = 0; k < near.size(); ++k)
      {
        const unsigned int cell = near[(first + k) % near.size()];
        const geometry::ConvexCell &one = cells.part(cells.first_part(cell));
        const auto polygon = one.vertices();
        const auto is_in = [&](const Point<2> &v) { return v.distance(ball.centre) < horizon; };
        const auto n_in = std::count_if(polygon.begin(), polygon.end(), is_in);
        if (n_in == 0 || n_in == static_cast<std::ptrdiff_t>(polygon.size()))
          continue;
        compare(ball, polygon, one.moments().area, check);
        break;
      }
    }
    return check;
  }
} // namespace plumbline::reference
