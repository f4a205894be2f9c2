#include "uq/boolean_covariance.h"

#include "base/error.h"
#include "physics/gauss.h"

#include <algorithm>
#include <cmath>

namespace plumbline::uq
{
  double set_covariance(std::array<double, 2> semi_axes, double r)
  {
    const auto [b, a] = std::minmax(semi_axes[0], semi_axes[1]);
    if (r >= 2 * a)
      return 0;
    // the ellipses meet for angles from the larger axis up to `last`
    const double room = 4 - r * r / (a * a), narrow = r * r * (1 / (b * b) - 1 / (a * a));
    const double last = room < narrow ? std::asin(std::sqrt(room / narrow)) : M_PI / 2;
    // near it the overlap goes like (last - θ)^(3/2), smooth in s where θ = last (1 - s²)
    const auto &rule = physics::gauss(64);
    double sum = 0;
    for (unsigned int q = 0; q < rule.size(); ++q)
    {
      const double s = rule.point(q)[0], theta = last * (1 - s * s);
      const double half =
          std::min(1., r / 2 * std::hypot(std::cos(theta) / a, std::sin(theta) / b));
      sum += rule.weight(q) * 2 * s * (std::acos(half) - half * std::sqrt(1 - half * half));
    }
    return last * sum * 4 / (M_PI * M_PI);
  }

  CovarianceFunction boolean_covariance(const EllipseModel &model)
  {
    check(model);
    if (!model.overlap)
      throw InputError(
          "the covariance of ellipses that do not overlap has no closed form; let them "
          "overlap, or take principal components of drawn samples");
    const double rate = -std::log1p(-model.fraction);
    const double both_free = (1 - model.fraction) * (1 - model.fraction);
    return [axes = model.semi_axes, rate, both_free](double dx, double dy)
    { return both_free * std::expm1(rate * set_covariance(axes, std::hypot(dx, dy))); };
  }
} // namespace plumbline::uq
