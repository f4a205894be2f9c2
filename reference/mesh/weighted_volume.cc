#include "reference/mesh/weighted_volume.h"

#include "physics/chebyshev_basis.h"
#include "physics/gauss.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace plumbline::reference
{
  namespace
  {
    using geometry::Point;

    constexpr unsigned int n_chords = 8, n_of_chord = 32;

    /// Sides of one cell only.
    std::vector<std::array<Point<2>, 2>> outer_sides(const geometry::Mesh &mesh)
    {
      std::map<std::array<unsigned int, 2>, bool> is_outer; // from, to
      for (const geometry::MeshCell &cell : mesh.cells)
        for (unsigned int v = 0; v < cell.n_vertices; ++v)
        {
          const unsigned int from = cell.vertex[v], to = cell.vertex[(v + 1) % cell.n_vertices];
          if (const auto neighbour = is_outer.find({to, from}); neighbour != is_outer.end())
            neighbour->second = false;
          else
            is_outer[{from, to}] = true;
        }
      std::map<unsigned int, std::vector<unsigned int>> next, last; // along the boundary
      for (const auto &[vertices, is] : is_outer)
        if (is)
        {
          next[vertices[0]].push_back(vertices[1]);
          last[vertices[1]].push_back(vertices[0]);
        }
      // sides on a line are one
      const auto is_straight = [&](unsigned int v)
      {
        if (next[v].size() != 1 || last[v].size() != 1)
          return false;
        const auto before = mesh.vertices[v] - mesh.vertices[last[v][0]];
        const auto after = mesh.vertices[next[v][0]] - mesh.vertices[v];
        return std::abs(before[0] * after[1] - before[1] * after[0]) <= 1e-14 * (before * after);
      };
      std::vector<std::array<Point<2>, 2>> sides;
      for (const auto &[first, ends] : next)
        for (unsigned int end : is_straight(first) ? std::vector<unsigned int>() : ends)
        {
          while (is_straight(end))
            end = next[end][0];
          sides.push_back({mesh.vertices[first], mesh.vertices[end]});
        }
      return sides;
    }

    std::vector<geometry::Box> boxes(const std::vector<std::array<Point<2>, 2>> &sides)
    {
      std::vector<geometry::Box> result;
      for (const auto &side : sides)
        result.push_back(geometry::bounding_box({side.data(), side.size()}));
      return result;
    }

    /// ∫ (d² + s²)^(n/2) ds, odd in s. n >= 0
    double power_integral(int n, double d, double s)
    {
      const double r = std::hypot(d, s);
      double power = n % 2 == 0 ? 1 : r; // r^(k - 2), k from 2 or 3
      double value = n % 2 == 0 ? s : .5 * (s * r + (d > 0 ? d * d * std::asinh(s / d) : 0));
      for (int k = n % 2 + 2; k <= n; k += 2)
      {
        power *= r * r;
        value = (s * power + k * d * d * value) / (k + 1);
      }
      return value;
    }

    /// ∫ [G(δ) - G(|ξ|)] dφ over a segment from s0 to s1 at the distance d.
    double missing_of_powers(const physics::Kernel<2> &kernel, double d, double s0, double s1)
    {
      const double delta = kernel.horizon();
      double value = 0;
      for (const physics::PowerTerm &term : kernel.profile().powers())
      {
        // K = c t^e, so that G = c r^(e+4) / (e+4) δ^e and dφ = d ds / r²
        const int e = term.exponent;
        const double c = kernel.constant() * term.coefficient / ((e + 4) * std::pow(delta, e));
        value += c * (std::pow(delta, e + 4) * (std::atan2(s1, d) - std::atan2(s0, d)) -
                      d * (power_integral(e + 2, d, s1) - power_integral(e + 2, d, s0)));
      }
      return value;
    }
  } // namespace

  WeightedVolume::Part WeightedVolume::part_of(const physics::Kernel<2> &kernel)
  {
    Part part{kernel, {}, {}};
    const physics::RadialProfile &profile = kernel.profile();
    if (!profile.is_function())
      return part;
    constexpr unsigned int n_more = 4; // of s³ and the integral
    const unsigned int n = profile.degree() +
                           static_cast<unsigned int>(std::max(0, profile.lowest_exponent())) +
                           n_more + 1;
    part.moment = series([&](double t) { return profile.moment(3, t); }, 0, 1, n);
    // smooth in τ, but for τ = 1 where the influence function is not smooth at its centre
    for (unsigned int k = 0; k < n_chords; ++k)
      part.chords.push_back(series(
          [&](double tau)
          {
            const double delta = kernel.horizon(), d = delta * (1 - tau * tau),
                         half_chord = delta * tau * std::sqrt(2 - tau * tau);
            return missing_of_function(part, d, -half_chord, half_chord);
          },
          1. * k / n_chords, (k + 1.) / n_chords, n_of_chord));
    return part;
  }

  double WeightedVolume::missing_of_chord(const Part &part, double d)
  {
    const double s = std::sqrt(std::max(0., 1 - d / part.kernel.horizon())) * n_chords;
    const unsigned int k = std::min(static_cast<unsigned int>(s), n_chords - 1);
    return physics::chebyshev_sum(part.chords[k], &Term::coefficient, 2 * (s - k) - 1);
  }

  WeightedVolume::Series WeightedVolume::series(const std::function<double(double)> &f, double from,
                                                double to, unsigned int n)
  {
    const std::vector<double> transform = physics::chebyshev_transform(n);
    std::vector<double> values;
    for (unsigned int i = 0; i < n; ++i)
      values.push_back(f(from + (to - from) * (.5 + .5 * std::cos(M_PI * (i + .5) / n))));
    Series terms;
    for (unsigned int k = 0; k < n; ++k)
      terms.push_back(
          {std::inner_product(values.begin(), values.end(), transform.begin() + k * n, 0.)});
    return terms;
  }

  /// As missing_of_powers(), along s = d sinh(u), where G is smooth in r = d cosh(u) and dφ = du /
  /// cosh(u).
  double WeightedVolume::missing_of_function(const Part &part, double d, double s0, double s1)
  {
    constexpr double tiny = 1e-15; // of δ: what is left there is an angle
    constexpr double widest = 1;   // 20 points suffice for 1 / cosh(u), measured
    const physics::RadialProfile &profile = part.kernel.profile();
    const double delta = part.kernel.horizon(), scale = part.kernel.constant() * std::pow(delta, 4);
    if (d <= tiny * delta)
      return s0 < 0 && s1 > 0 ? scale * profile.moment(3) * M_PI : 0;
    const double first = std::asinh(s0 / d), last = std::asinh(s1 / d);
    const auto n_parts = static_cast<unsigned int>(std::ceil((last - first) / widest));
    const auto &gauss = physics::gauss(20 + profile.degree() / 2);
    const double length = (last - first) / n_parts;
    double value = 0;
    for (unsigned int k = 0; k < n_parts; ++k)
      for (unsigned int q = 0; q < gauss.size(); ++q)
      {
        const double cosh_u = std::cosh(first + length * (k + gauss.point(q)[0]));
        value += length * gauss.weight(q) / cosh_u *
                 physics::chebyshev_sum(part.moment, &Term::coefficient,
                                        2 * std::min(1., d * cosh_u / delta) - 1);
      }
    return scale * value;
  }

  WeightedVolume::WeightedVolume(const geometry::Mesh &mesh, const physics::Kernel<2> &kernel)
      : WeightedVolume(outer_sides(mesh), kernel)
  {
  }

  WeightedVolume::WeightedVolume(std::vector<Side> outer_sides, const physics::Kernel<2> &kernel)
      : horizon_(kernel.horizon()), full_(kernel.moment({2, 0}) + kernel.moment({0, 2})),
        sides_(std::move(outer_sides)), search_(boxes(sides_))
  {
    for (const physics::Kernel<2> &part : kernel.parts())
      parts_.push_back(part_of(part));
  }

  double WeightedVolume::operator()(const Point<2> &x) const
  {
    const dealii::Tensor<1, 2> reach({horizon_, horizon_});
    thread_local std::vector<unsigned int> near; // asked at every quadrature point
    search_.find({x - reach, x + reach}, near);
    double value = full_;
    for (const unsigned int side : near)
      value -= missing(sides_[side][0] - x, sides_[side][1] - x);
    return value;
  }

  /// ∫ [G(δ) - G(|ξ|)] dφ over a side's part in the ball, relative to its centre.
  double WeightedVolume::missing(const dealii::Tensor<1, 2> &from,
                                 const dealii::Tensor<1, 2> &to) const
  {
    const double length = (to - from).norm();
    const dealii::Tensor<1, 2> along = (to - from) / length;
    const double height = from[0] * along[1] - from[1] * along[0], d = std::abs(height);
    double value = 0;
    for (const Part &part : parts_)
    {
      const double radius = part.kernel.horizon();
      if (d >= radius)
        continue;
      const double half_chord = std::sqrt((radius - d) * (radius + d));
      const double s0 = std::max(from * along, -half_chord), s1 = std::min(to * along, half_chord);
      if (s0 < s1)
        value += part.moment.empty()                     ? missing_of_powers(part.kernel, d, s0, s1)
                 : s0 == -half_chord && s1 == half_chord ? missing_of_chord(part, d)
                                                         : missing_of_function(part, d, s0, s1);
    }
    // rounding does not put a point of the boundary outside
    const double sign = height < -1e-14 * (from.norm() + to.norm()) ? -1 : 1;
    return sign * value;
  }
} // namespace plumbline::reference
