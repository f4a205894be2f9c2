#include "physics/load_in_space.h"

#include "base/error.h"
#include "physics/dilatation_in_space.h"
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

  double operator_scale(const Dilatation<3> &dilatation)
  {
    // ∫|C(w)| dw <= (∫ K |ξ| dξ)², by the triangle inequality
    const Kernel<3> &influence = dilatation.influence;
    const double moment = operator_scale(influence) * influence.horizon(); // |ξ| <= δ
    const Lame lame = dilatation.material({});
    return std::abs(dilatation.factor(lame, lame)) * moment * moment;
  }

  namespace
  {
    /// f(ξ, |ξ|, weight) for one half of the shell between two radii.
    template <class Function>
    void for_each_point(double inner, double outer, unsigned int n_radii, unsigned int degree,
                        const Function &f)
    {
      const auto &radial = gauss(n_radii);
      const unsigned int n_heights = degree / 4 + 1; // of one half, exact to degree 4 n - 1 on both
      const auto &heights = gauss(2 * n_heights);
      const unsigned int n_angles = degree + 1;
      for (unsigned int i = 0; i < n_radii; ++i)
      {
        const double width = outer - inner, r = inner + width * radial.point(i)[0];
        const double of_radius = radial.weight(i) * width * r * r;
        for (unsigned int j = 0; j < n_heights; ++j)
        {
          const double z = 2 * heights.point(n_heights + j)[0] - 1, s = std::sqrt(1 - z * z);
          const double weight = of_radius * 2 * heights.weight(n_heights + j) * 2 * M_PI / n_angles;
          for (unsigned int k = 0; k < n_angles; ++k)
          {
            const double angle = 2 * M_PI * (k + .5) / n_angles;
            f(Point<3>(r * s * std::cos(angle), r * s * std::sin(angle), r * z), r, weight);
          }
        }
      }
    }
  } // namespace

  std::vector<LoadInSpace::BondPoint>
  LoadInSpace::rule(const Kernel<3> &kernel, const std::optional<Dilatation<3>> &dilatation,
                    unsigned int degree)
  {
    std::vector<double> ends = kernel.breaks();
    ends.insert(ends.begin(), 0);
    ends.push_back(kernel.horizon());
    const bool is_scalar = kernel.structure() == Structure::scalar;
    const unsigned int n_radii = degree / 2 + 4;
    std::vector<BondPoint> points;
    for (std::size_t part = 0; part + 1 < ends.size(); ++part)
      for_each_point(ends[part], ends[part + 1], n_radii, degree,
                     [&](const Point<3> &xi, double r, double weight)
                     {
                       const double value = weight * kernel.radial(r);
                       points.push_back({xi, is_scalar ? value : 0, is_scalar ? 0 : value});
                     });
    if (!dilatation)
      return points;
    const DilatationInSpace of_dilatation(dilatation->influence);
    const Lame lame = dilatation->material({});
    const double factor = dilatation->factor(lame, lame), horizon = of_dilatation.horizon();
    const unsigned int of_profile = dilatation->influence.profile().degree() / 2;
    for (const double inner : {0., horizon})
      for_each_point(
          inner, inner + horizon, n_radii + of_profile, degree,
          [&](const Point<3> &xi, double r, double weight)
          {
            const DilatationInSpace::Value value = of_dilatation(r);
            points.push_back({xi, weight * factor * value.across, weight * factor * value.excess});
          });
    return points;
  }

  LoadInSpace::LoadInSpace(const Kernel<3> &kernel, const std::optional<Dilatation<3>> &dilatation,
                           Field u, const std::vector<Point<3>> &samples)
      : n_components_(kernel.n_components()), u_(std::move(u))
  {
    constexpr std::array<unsigned int, 7> degrees = {4, 8, 12, 18, 26, 38, 54};
    constexpr double relative = 1e-13, rounding = 4 * std::numeric_limits<double>::epsilon();
    double largest_u = 0;
    for (const Point<3> &x : samples)
      for (unsigned int c = 0; c < n_components_; ++c)
        largest_u = std::max(largest_u, std::abs(u_(x, c)));
    const double scale = operator_scale(kernel) + (dilatation ? operator_scale(*dilatation) : 0);
    noise_ = rounding * scale * largest_u;
    const auto all = [&](const std::vector<BondPoint> &points)
    {
      std::vector<double> values;
      for (const Point<3> &x : samples)
        for (unsigned int c = 0; c < n_components_; ++c)
          values.push_back(integral(points, x, c));
      return values;
    };
    rule_ = rule(kernel, dilatation, degrees.front());
    std::vector<double> before = all(rule_);
    for (std::size_t i = 1; i < degrees.size(); ++i)
    {
      auto finer = rule(kernel, dilatation, degrees[i]);
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
    std::array<double, 3> twice_here{};
    for (unsigned int b = 0; b < n_components_; ++b)
      twice_here[b] = 2 * u_(x, b);
    double sum = 0;
    for (const BondPoint &bond : rule)
    {
      const Point<3> ahead = x + bond.xi, behind = x - dealii::Tensor<1, 3>(bond.xi);
      double value = 0;
      const auto add = [&](unsigned int b, double factor)
      { value += factor * (u_(ahead, b) + u_(behind, b) - twice_here[b]); };
      if (bond.excess == 0)
        add(component, bond.across);
      else
        for (unsigned int b = 0; b < n_components_; ++b)
          add(b, bond.excess * bond.xi[component] * bond.xi[b] / bond.xi.square() +
                     (b == component ? bond.across : 0));
      sum -= value;
    }
    return sum;
  }

  double LoadInSpace::operator()(const Point<3> &x, unsigned int component) const
  {
    return integral(rule_, x, component);
  }
} // namespace plumbline::physics
