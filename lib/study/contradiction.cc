#include "study/contradiction.h"

#include "base/error.h"
#include "physics/gauss.h"
#include "physics/load.h"
#include "problem/manufactured_load.h"
#include "study/comparison.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <sstream>

namespace plumbline::study
{
  namespace
  {
    using dealii::Point;
    using Values = std::function<double(const Point<2> &, unsigned int)>;

    /// Twice the area of a triangle, positive counter-clockwise.
    double turn(const Point<2> &a, const Point<2> &b, const Point<2> &c)
    {
      return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    }

    bool is_cut(const problem::Damage<2> &damage, const Point<2> &x, const Point<2> &y)
    {
      for (const auto &crack : damage.cracks)
        for (std::size_t i = 1; i < crack.size(); ++i)
          if (turn(crack[i - 1], crack[i], x) * turn(crack[i - 1], crack[i], y) < 0 &&
              turn(x, y, crack[i - 1]) * turn(x, y, crack[i]) < 0)
            return true;
      return false;
    }

    double distance_to_cracks(const problem::Damage<2> &damage, const Point<2> &x)
    {
      double least = std::numeric_limits<double>::infinity();
      for (const auto &crack : damage.cracks)
        for (std::size_t i = 1; i < crack.size(); ++i)
        {
          const dealii::Tensor<1, 2> side = crack[i] - crack[i - 1];
          const double t =
              std::clamp((x - crack[i - 1]) * side / std::max(side.norm_square(), 1e-300), 0., 1.);
          least = std::min(least, x.distance(crack[i - 1] + t * side));
        }
      return least;
    }

    /// L u at a point, and how exactly it is known.
    struct Value
    {
      double value = 0, noise = 0;
    };

    /// L u of bonds that no crack cuts: midpoints in the angle see a cut to one of them.
    Value with_cuts(const problem::Problem<2> &problem, const Values &u, const Point<2> &x,
                    unsigned int component)
    {
      constexpr unsigned int n_radii = 16, n_angles = 256;
      const physics::Kernel<2> &kernel = problem.kernel;
      const bool is_scalar = kernel.structure() == physics::Structure::scalar;
      const double a0 = problem.coefficient ? problem.coefficient->at(x) : 1;
      constexpr double cut_part = .02; // of all bonds' forces
      Value sum;
      for (unsigned int q = 0; q < n_radii; ++q)
      {
        const double r = kernel.horizon() * physics::gauss(n_radii).point(q)[0];
        const double weight =
            physics::gauss(n_radii).weight(q) * kernel.horizon() * r * 2 * M_PI / n_angles;
        for (unsigned int k = 0; k < n_angles; ++k)
        {
          const double angle = 2 * M_PI * (k + .5) / n_angles;
          const Point<2> xi(r * std::cos(angle), r * std::sin(angle)), y = x + xi;
          if (is_cut(problem.damage, x, y))
            continue;
          const double a =
              problem.coefficient ? problem.coefficient->mean(a0, problem.coefficient->at(y)) : 1;
          for (unsigned int b = 0; b < kernel.n_components(); ++b)
          {
            const unsigned int of_u = is_scalar ? component : b;
            const double force = weight * a * kernel.radial(r) * (u(y, of_u) - u(x, of_u)) *
                                 (is_scalar ? 1. : kernel.direction_factor(component, b, xi));
            sum.value -= force;
            sum.noise += cut_part * std::abs(force);
          }
        }
      }
      return sum;
    }

    /// λ = μ: what cuts do to dilatations does not matter.
    bool is_of_bonds(const problem::Problem<2> &problem, const Point<2> &x)
    {
      constexpr double same = 1e-12;
      if (!problem.dilatation)
        return true;
      const physics::Lame lame = problem.dilatation->material(x);
      return std::abs(lame.lambda - lame.mu) <= same * lame.mu;
    }

    /// At most n of them, evenly.
    std::vector<Point<2>> some(const std::vector<Point<2>> &points, std::size_t n)
    {
      std::vector<Point<2>> result;
      for (std::size_t i = 0; i < std::min(n, points.size()); ++i)
        result.push_back(points[(2 * i + 1) * points.size() / (2 * std::min(n, points.size()))]);
      return result;
    }
  } // namespace

  bool Contradiction::is_clear() const
  {
    constexpr double part = .01;
    return difference > part * std::max(of_operator, load);
  }

  std::string Contradiction::text() const
  {
    std::ostringstream text;
    text << "solution and load contradict each other: at " << n_points
         << " points |L u - b| is up to " << difference << " (at " << where << "), |L u| up to "
         << of_operator << ", |b| up to " << load
         << ", so errors against the solution say nothing; leave out Problem/load, which is made "
            "from the solution then, or write a local limit's solution as Problem/local solution, "
            "or take the target reference or own finest level (Study/decisive error)";
    return text.str();
  }

  std::optional<Contradiction> measure_contradiction(const problem::Problem<2> &problem)
  {
    if (!problem.is_load_given || !problem.solution || problem.damage.outside)
      return {};
    constexpr std::size_t n_points = 16;
    constexpr double round_off = 1e-10; // of the operator's scale times u
    const double horizon = problem.horizon();
    std::vector<Point<2>> whole, cut;
    for (const Point<2> &x : comparison_points(problem))
      if (const double d = distance_to_cracks(problem.damage, x); d > 2 * horizon)
        whole.push_back(x);
      else if (d < .75 * horizon && is_of_bonds(problem, x))
        cut.push_back(x);
    const Values u = problem.solution->value;
    const auto lu = problem::plain_load(problem);
    double size = 0;
    for (const Point<2> &x : comparison_points(problem))
      for (unsigned int c = 0; c < problem.n_components; ++c)
        size = std::max(size, std::abs(u(x, c)));
    const double noise = round_off * physics::operator_scale(problem.kernel) * size;
    Contradiction result;
    const auto add = [&](const std::vector<Point<2>> &points, const auto &operator_of_u)
    {
      for (const Point<2> &x : points)
        for (unsigned int c = 0; c < problem.n_components; ++c)
        {
          const Value a = operator_of_u(x, c);
          const double b = problem.load.value(x, c), difference = std::abs(a.value - b);
          result.of_operator = std::max(result.of_operator, std::abs(a.value));
          result.load = std::max(result.load, std::abs(b));
          if (difference <= std::max(a.noise, result.difference))
            continue;
          result.difference = difference;
          result.where = x;
        }
      result.n_points += points.size();
    };
    try
    {
      add(some(whole, n_points),
          [&](const Point<2> &x, unsigned int c) {
            return Value{lu(x, c), noise};
          });
      add(some(cut, n_points),
          [&](const Point<2> &x, unsigned int c) { return with_cuts(problem, u, x, c); });
    }
    catch (const NumericalError &)
    {
      return {}; // u is not smooth in some ball
    }
    return result;
  }
} // namespace plumbline::study
