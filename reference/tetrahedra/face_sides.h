#pragma once

#include "reference/tetrahedra/face_pairs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace plumbline::reference
{
  /// A face with its sides, from vertex k to vertex k + 1, for integrals over the face of functions
  /// of the distance from a point.
  class FaceSides
  {
  public:
    explicit FaceSides(const PairFace &face);

    PairFace::Vertices x;
    dealii::Tensor<1, 3> normal;
    std::array<double, 3> length{};
    std::array<dealii::Tensor<1, 3>, 3> along, outward;
    std::array<dealii::Tensor<1, 3>, 3> slope; ///< ∇λ of the vertices
  };

  /// Gauss points on [0, 1].
  struct LineRule
  {
    static constexpr unsigned int most_points = 200; ///< see LinePoints
    std::vector<double> points, weights;
  };
  const LineRule &line_rule(unsigned int n_points);

  /// Quadrature points along a side for functions of τ and of r = √(square + τ²).
  struct LinePoints
  {
    static constexpr unsigned int most = LineRule::most_points;

    /// @param extra  additional points that the functions need
    LinePoints(double from, double to, double square, unsigned int extra)
    {
      // r is singular at τ = ± iη, η = √square. Far from there: Gauss points in τ. Else: in s,
      // τ = η sinh s, of which r is analytic for |Im s| < π/2; at most 195 points for |τ| < 1
      constexpr double least_axis = 1.25, least_eta = 1e-14;
      const double axis =
          (std::sqrt(from * from + square) + std::sqrt(to * to + square)) / (to - from);
      if (axis > least_axis)
      {
        const LineRule &rule = choose(axis + std::sqrt(axis * axis - 1), extra);
        for (unsigned int q = 0; q < n; ++q)
        {
          tau[q] = from + (to - from) * rule.points[q];
          weight[q] = (to - from) * rule.weights[q];
        }
      }
      else
      {
        const double eta = std::max(std::sqrt(square), least_eta), first = std::asinh(from / eta),
                     size = std::asinh(to / eta) - first, width = M_PI / size;
        const LineRule &rule = choose(width + std::sqrt(1 + width * width), extra);
        for (unsigned int q = 0; q < n; ++q)
        {
          tau[q] = eta * std::sinh(first + size * rule.points[q]);
          weight[q] = size * rule.weights[q] * std::sqrt(eta * eta + tau[q] * tau[q]);
        }
      }
      for (unsigned int q = 0; q < n; ++q)
        r[q] = std::sqrt(square + tau[q] * tau[q]);
    }

    unsigned int n = 0;
    std::array<double, most> tau, weight, r; // filled up to n

  private:
    /// For 1e-8 of functions that are analytic in the ellipse about [-1, 1] whose semi-axes have
    /// this sum: Trefethen 2013, Approximation Theory and Approximation Practice, th. 19.3.
    const LineRule &choose(double ellipse, unsigned int extra)
    {
      constexpr double half_of_digits = 9.2;
      n = 2 + extra + static_cast<unsigned int>(half_of_digits / std::log(ellipse));
      if (!(n <= most)) // not for sides within the horizon
        n = most;
      return line_rule(n);
    }
  };
} // namespace plumbline::reference
