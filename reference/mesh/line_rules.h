#pragma once

#include "physics/gauss.h"

#include <cmath>
#include <vector>

namespace plumbline::reference
{
  /// Rules on a part of a side for radial functions, analytic but at z = 0: n points err by
  /// B^(-2n), B = x + √(x² - 1) of Bernstein's ellipse, x the distance from 0 to the part's middle
  /// in halves of its length. Accuracy: 1e-18 of the largest value there.
  class LineRules
  {
  public:
    LineRules()
    {
      for (const unsigned int n_points : {5, 6, 7, 8, 9, 10, 11, 12, 14, 16, 20, 24, 32, 50})
      {
        constexpr double error = 1e-18;
        const double ellipse = std::pow(error, -.5 / n_points),
                     distance = .25 * (ellipse + 1 / ellipse); // in lengths
        rules_.push_back({distance * distance, &physics::gauss(n_points)});
      }
    }

    /// @param square  of the distance [length^2]
    const dealii::Quadrature<1> &of(double square, double length) const
    {
      for (const Rule &rule : rules_)
        if (square > rule.least_square * (length * length))
          return *rule.points;
      return *rules_.back().points;
    }

  private:
    struct Rule
    {
      double least_square = 0;
      const dealii::Quadrature<1> *points = nullptr;
    };
    std::vector<Rule> rules_;
  };

  inline const LineRules &line_rules()
  {
    static const LineRules all;
    return all;
  }
} // namespace plumbline::reference
