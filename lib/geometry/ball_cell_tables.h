#pragma once

#include "geometry/ball_cell_plane.h"

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

/// The rules that polar_rule and cut_rule are made of, private to ball_cell.cc.
namespace plumbline::geometry::detail
{
  /// T(n), which each thread makes at first use.
  template <class T>
  const T &table(unsigned int n)
  {
    thread_local std::vector<std::unique_ptr<const T>> known;
    if (n >= known.size())
      known.resize(n + 1);
    if (!known[n])
      known[n] = std::make_unique<const T>(n);
    return *known[n];
  }

  /// Gauss's rule with n points on [0, 1].
  struct Gauss
  {
    std::vector<double> at, weight;

    explicit Gauss(unsigned int n) : at(n), weight(n)
    {
      for (unsigned int i = 0; i < n; ++i)
      {
        double x = std::cos(pi * (i + .75) / (n + .5)), slope = 1;
        for (int step = 0; step < 8; ++step) // Newton, from a guess good to two digits or more
        {
          double last = 1, value = x;
          for (unsigned int k = 2; k <= n; ++k)
          {
            const double next = ((2 * k - 1) * x * value - (k - 1) * last) / k;
            last = value;
            value = next;
          }
          slope = n * (x * value - last) / (x * x - 1);
          x -= value / slope;
        }
        at[i] = .5 * (1 - x);
        weight[i] = 1 / ((1 - x * x) * slope * slope);
      }
    }
  };

  /// As many points as a polynomial needs.
  inline const Gauss &gauss_of_degree(unsigned int degree)
  {
    return table<Gauss>(degree / 2 + 1);
  }

  struct PlaneRule
  {
    std::vector<Vec> at;
    std::vector<double> weight;
  };

  /// Exact for polynomials of a degree on the triangle (0,0), (1,0), (0,1): Witherden and Vincent's
  /// symmetric rules where there are any, else Gauss's on rays from a corner.
  struct TriangleRule : PlaneRule
  {
    explicit TriangleRule(unsigned int degree)
    {
      constexpr unsigned int largest = 14;
      if (degree <= largest)
      {
        const bool is_odd = degree % 2 || degree == 0;
        const dealii::QWitherdenVincentSimplex<2> rule(std::max(1u, (degree + 1) / 2), is_odd);
        for (const auto &p : rule.get_points())
          at.push_back(vec(p));
        weight = rule.get_weights();
        return;
      }
      const Gauss &along = gauss_of_degree(degree + 1), &across = gauss_of_degree(degree);
      for (std::size_t i = 0; i < along.at.size(); ++i)
        for (std::size_t j = 0; j < across.at.size(); ++j)
        {
          at.push_back(along.at[i] * Vec{1 - across.at[j], across.at[j]});
          weight.push_back(along.weight[i] * along.at[i] * across.weight[j]);
        }
    }
  };

  /// Exact for polynomials of a degree on the unit disc: equal angles, and Gauss's rule in the
  /// square of the radius, because the angles leave none but its even powers.
  struct DiscRule : PlaneRule
  {
    explicit DiscRule(unsigned int degree)
    {
      const Gauss &square = gauss_of_degree(degree / 2);
      const unsigned int n_angles = degree + 1;
      for (unsigned int i = 0; i < n_angles; ++i)
        for (std::size_t j = 0; j < square.at.size(); ++j)
        {
          const double angle = 2 * pi * i / n_angles;
          at.push_back(std::sqrt(square.at[j]) * Vec{std::cos(angle), std::sin(angle)});
          weight.push_back(pi / n_angles * square.weight[j]);
        }
    }
  };
} // namespace plumbline::geometry::detail
