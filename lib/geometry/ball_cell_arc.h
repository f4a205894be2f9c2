#pragma once

#include "geometry/ball_cell_tables.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

/// The rule on an arc, private to ball_cell.cc.
namespace plumbline::geometry::detail
{
  /// Gauss's rules for trigonometric polynomials on an arc of at most a half circle. With α half
  /// the arc's angle, κ = sin(α/2) and angles ψ = 2 asin(κ x) from its middle,
  ///   ∫ f(ψ) dψ = Σ 2κ w f(ψ),
  /// where x and w are Gauss's rule for the weight 1/√(1-κ²x²) on [-1, 1]: n points are exact for
  /// degree n - 1, whatever α. They depend smoothly on κ²: here they are piecewise polynomials in
  /// it, exact to rounding.
  /// Source: Da Fies and Vianello 2012, Trigonometric Gaussian quadrature on subintervals of the
  /// period, ETNA 39.
  class ArcRule
  {
  public:
    explicit ArcRule(unsigned int n) : n_(n), coefficients_(n_parts * n_pairs())
    {
      for (unsigned int part = 0; part < n_parts; ++part)
      {
        std::array<std::vector<Node>, n_terms> samples;
        for (unsigned int k = 0; k < n_terms; ++k)
          samples[k] = nodes((part + place(k)) * part_length);
        for (unsigned int i = 0; i < n_pairs(); ++i)
        {
          // divided differences, in place
          for (unsigned int order = 1; order < n_terms; ++order)
            for (unsigned int k = n_terms - 1; k >= order; --k)
            {
              const double d = 1 / place(order);
              samples[k][i] = {d * (samples[k][i].at - samples[k - 1][i].at),
                               d * (samples[k][i].weight - samples[k - 1][i].weight)};
            }
          for (unsigned int k = 0; k < n_terms; ++k)
            coefficients_[part * n_pairs() + i][k] = samples[k][i];
        }
      }
    }

    /// Hands x and w of all n points to `use`.
    template <class Use>
    void operator()(double kappa_square, Use use) const
    {
      const double t = kappa_square / part_length;
      const unsigned int part = std::min(n_parts - 1, static_cast<unsigned int>(t));
      std::array<double, n_terms> step;
      for (unsigned int k = 0; k < n_terms; ++k)
        step[k] = t - part - place(k);
      for (unsigned int i = 0; i < n_pairs(); ++i)
      {
        const auto &c = coefficients_[part * n_pairs() + i];
        Node node = c[n_terms - 1];
        for (unsigned int k = n_terms - 1; k-- > 0;)
          node = {node.at * step[k] + c[k].at, node.weight * step[k] + c[k].weight};
        if (2 * i + 1 == n_)
          use(0., node.weight);
        else
        {
          use(-node.at, node.weight);
          use(node.at, node.weight);
        }
      }
    }

  private:
    struct Node
    {
      double at, weight;
    };

    unsigned int n_pairs() const { return (n_ + 1) / 2; } ///< ± x, or the middle

    /// The nodes x >= 0.
    std::vector<Node> nodes(double kappa_square) const
    {
      // recurrence p_k+1 = x p_k - b_k p_k-1 by the scalar products, on a fine Gauss rule
      const Gauss &fine = table<Gauss>(n_ + 32);
      std::vector<double> b(n_), x, w, p(fine.at.size(), 1.), last(fine.at.size(), 0.);
      double norm = 1, last_norm = 1;
      for (std::size_t q = 0; q < fine.at.size(); ++q)
      {
        x.push_back(2 * fine.at[q] - 1);
        w.push_back(2 * fine.weight[q] / std::sqrt(1 - kappa_square * x[q] * x[q]));
      }
      for (unsigned int k = 0; k < n_; ++k)
      {
        norm = 0;
        for (std::size_t q = 0; q < x.size(); ++q)
          norm += w[q] * p[q] * p[q];
        b[k] = k == 0 ? 0 : norm / last_norm;
        last_norm = norm;
        for (std::size_t q = 0; q < x.size(); ++q)
        {
          const double next = x[q] * p[q] - b[k] * last[q];
          last[q] = p[q];
          p[q] = next;
        }
      }
      std::vector<Node> result;
      for (unsigned int i = 0; i < n_pairs(); ++i)
      {
        double z = std::cos(pi * (i + .75) / (n_ + .5)), slope = 1, before = 1;
        for (int step = 0; step < 8; ++step) // Newton, from Legendre's roots
        {
          double value = 1, value_slope = 0;
          before = slope = 0;
          for (unsigned int k = 0; k < n_; ++k)
          {
            const double next = z * value - b[k] * before;
            const double next_slope = value + z * value_slope - b[k] * slope;
            before = value, slope = value_slope;
            value = next, value_slope = next_slope;
          }
          slope = value_slope;
          z -= value / slope;
        }
        result.push_back({z, norm / (before * slope)});
      }
      return result;
    }

    static constexpr unsigned int n_parts = 64, n_terms = 6;
    static constexpr double part_length = .5 / n_parts; ///< of κ² in [0, 1/2]
    /// Where a part is sampled, in units of its length.
    static constexpr double place(unsigned int k) { return k / (n_terms - 1.); }

    unsigned int n_;
    std::vector<std::array<Node, n_terms>> coefficients_; ///< shape (n_parts, n_pairs)
  };
} // namespace plumbline::geometry::detail
