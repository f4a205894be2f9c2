#include "physics/load_in_space.h"

#include "base/error.h"
#include "physics/gauss.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace plumbline::physics
{
  double operator_scale(const Kernel<3> &kernel)
  {
    // ∫ t² |ρ| <= ∫ t |ρ|
    return std::abs(kernel.constant()) * kernel.profile().size() * 4 * M_PI *
           std::pow(kernel.horizon(), 3);
  }

  std::vector<LoadInSpace::BondPoint> LoadInSpace::rule(const Kernel<3> &kernel,
                                                        unsigned int degree)
  {
    std::vector<double> ends = kernel.breaks();
    ends.insert(ends.begin(), 0);
    ends.push_back(kernel.horizon());
    const auto &radial = gauss(degree / 2 + 4);
    const unsigned int n_heights = degree / 4 + 1; // of one half, exact to degree 4 n - 1 on both
    const auto &heights = gauss(2 * n_heights);
    const unsigned int n_angles = degree + 1;
    std::vector<BondPoint> points;
    for (std::size_t part = 0; part + 1 < ends.size(); ++part)
      for (unsigned int i = 0; i < radial.size(); ++i)
      {
        const double width = ends[part + 1] - ends[part];
        const double r = ends[part] + width * radial.point(i)[0];
        const double of_radius = radial.weight(i) * width * r * r * kernel.radial(r);
        for (unsigned int j = 0; j < n_heights; ++j)
        {
          const double z = 2 * heights.point(n_heights + j)[0] - 1, s = std::sqrt(1 - z * z);
          const double weight = of_radius * 2 * heights.weight(n_heights + j) * 2 * M_PI / n_angles;
          for (unsigned int k = 0; k < n_angles; ++k)
          {
            const double angle = 2 * M_PI * (k + .5) / n_angles;
            points.push_back(
                {Point<3>(r * s * std::cos(angle), r * s * std::sin(angle), r * z), weight});
          }
        }
      }
    return points;
  }

  LoadInSpace::LoadInSpace(const Kernel<3> &kernel, Field u, const std::vector<Point<3>> &samples)
      : kernel_(kernel), u_(std::move(u))
  {
    constexpr std::array<unsigned int, 7> degrees = {4, 8, 12, 18, 26, 38, 54};
    constexpr double relative = 1e-13, rounding = 4 * std::numeric_limits<double>::epsilon();
    double largest_u = 0;
    for (const Point<3> &x : samples)
      for (unsigned int c = 0; c < kernel.n_components(); ++c)
        largest_u = std::max(largest_u, std::abs(u_(x, c)));
    noise_ = rounding * operator_scale(kernel) * largest_u;
    const auto all = [&](const std::vector<BondPoint> &points)
    {
      std::vector<double> values;
      for (const Point<3> &x : samples)
        for (unsigned int c = 0; c < kernel.n_components(); ++c)
          values.push_back(integral(points, x, c));
      return values;
    };
    rule_ = rule(kernel, degrees.front());
    std::vector<double> before = all(rule_);
    for (std::size_t i = 1; i < degrees.size(); ++i)
    {
      auto finer = rule(kernel, degrees[i]);
      const std::vector<double> values = all(finer);
      double change = 0, largest = 0;
      for (std::size_t k = 0; k < values.size(); ++k)
      {
        change = std::max(change, std::abs(values[k] - before[k]));
        largest = std::max(largest, std::abs(values[k]));
      }
      if (change <= relative * largest + noise_)
        return;
      rule_ = std::move(finer);
      before = values;
    }
    throw NumericalError("the load L u cannot be integrated to 1e-13: the solution is not smooth "
                         "within a horizon; give Problem/load");
  }

  double LoadInSpace::integral(const std::vector<BondPoint> &rule, const Point<3> &x,
                               unsigned int component) const
  {
    const bool is_scalar = kernel_.structure() == Structure::scalar;
    const unsigned int n = kernel_.n_components();
    std::array<double, 3> twice_here{};
    for (unsigned int b = 0; b < n; ++b)
      twice_here[b] = 2 * u_(x, b);
    double sum = 0;
    for (const BondPoint &bond : rule)
    {
      const Point<3> ahead = x + bond.xi, behind = x - dealii::Tensor<1, 3>(bond.xi);
      double value = 0;
      for (unsigned int b = is_scalar ? component : 0; b < (is_scalar ? component + 1 : n); ++b)
        value += (is_scalar ? 1 : kernel_.direction_factor(component, b, bond.xi)) *
                 (u_(ahead, b) + u_(behind, b) - twice_here[b]);
      sum -= bond.weight * value;
    }
    return sum;
  }

  double LoadInSpace::operator()(const Point<3> &x, unsigned int component) const
  {
    return integral(rule_, x, component);
  }
} // namespace plumbline::physics
