#include "uq/sample_points.h"

#include "uq/generator.h"
#include "uq/smolyak_terms.h"

#include <boost/math/distributions/normal.hpp>
#include <boost/random/sobol.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>

namespace plumbline::uq
{
  namespace
  {
    /// More than this are counted as this many.
    constexpr double endless = 1e300;

    double binomial(std::size_t n, std::size_t k)
    {
      double result = 1;
      for (std::size_t i = 1; i <= k; ++i)
        result = result * static_cast<double>(n - k + i) / static_cast<double>(i);
      return std::round(result);
    }

    /// Calls f(point, weight) for each combination of the rules' points.
    template <class F>
    void for_each_combination(const std::vector<const LineRule *> &rules, const F &f)
    {
      std::vector<std::size_t> index(rules.size(), 0);
      std::vector<double> point(rules.size());
      while (true)
      {
        double weight = 1;
        for (std::size_t d = 0; d < rules.size(); ++d)
        {
          point[d] = rules[d]->nodes[index[d]];
          weight *= rules[d]->weights[index[d]];
        }
        f(point, weight);
        std::size_t d = 0;
        while (d < rules.size() && ++index[d] == rules[d]->nodes.size())
          index[d++] = 0;
        if (d == rules.size())
          return;
      }
    }

    SamplePoints combinations(const std::vector<LineRule> &of)
    {
      std::vector<const LineRule *> rules;
      for (const LineRule &rule : of)
        rules.push_back(&rule);
      SamplePoints result;
      for_each_combination(rules,
                           [&](const std::vector<double> &point, double weight)
                           {
                             result.points.push_back(point);
                             result.weights.push_back(weight);
                           });
      return result;
    }

    /// Calls f(excess) for all ways to distribute a sum over n places.
    void for_each_partition(std::size_t n, unsigned int sum,
                            const std::function<void(const std::vector<unsigned int> &)> &f)
    {
      std::vector<unsigned int> excess(n, 0);
      const std::function<void(std::size_t, unsigned int)> fill =
          [&](std::size_t d, unsigned int left)
      {
        if (d + 1 == n)
        {
          excess[d] = left;
          f(excess);
          excess[d] = 0;
          return;
        }
        for (unsigned int e = 0; e <= left; ++e)
        {
          excess[d] = e;
          fill(d + 1, left - e);
        }
        excess[d] = 0;
      };
      fill(0, sum);
    }

    /// The value below which a standard variable is with probability p.
    double quantile(Law law, double p)
    {
      return law == Law::uniform ? 2 * p - 1 : boost::math::quantile(boost::math::normal(), p);
    }

    /// Of equal weights.
    SamplePoints random_points(const std::vector<Law> &laws, std::size_t n,
                               const std::function<double(Law)> &next)
    {
      SamplePoints result;
      for (std::size_t i = 0; i < n; ++i)
      {
        std::vector<double> point;
        for (const Law law : laws)
          point.push_back(next(law));
        result.points.push_back(std::move(point));
      }
      result.weights.assign(n, 1. / static_cast<double>(n));
      return result;
    }
  } // namespace

  LineRule line_rule(Law law, Growth growth, unsigned int level)
  {
    if (growth == Growth::nested && law == Law::normal)
      return genz_keister_rule(level);
    const auto n = static_cast<unsigned int>(n_line_points(law, growth, level));
    return growth == Growth::nested ? clenshaw_curtis_rule(n) : gauss_rule(law, n);
  }

  void
  for_each_smolyak_term(std::size_t n_variables, unsigned int level,
                        const std::function<void(double, const std::vector<unsigned int> &)> &f)
  {
    for (unsigned int below = 0; below <= std::min<std::size_t>(level, n_variables - 1); ++below)
    {
      const double factor = (below % 2 == 0 ? 1 : -1) * binomial(n_variables - 1, below);
      for_each_partition(n_variables, level - below,
                         [&](const std::vector<unsigned int> &excess) { f(factor, excess); });
    }
  }

  double SamplePoints::sum_of_sizes() const
  {
    double sum = 0;
    for (const double w : weights)
      sum += std::abs(w);
    return sum;
  }

  double SamplePoints::noise() const
  {
    double sum = 0;
    for (const double w : weights)
      sum += w * w;
    return std::sqrt(sum);
  }

  double n_line_points(Law law, Growth growth, unsigned int level)
  {
    const double l = level;
    switch (growth)
    {
    case Growth::linear:
      return l;
    case Growth::odd:
      return 2 * l - 1;
    case Growth::doubling:
      return std::min(endless, std::exp2(l) - 1);
    default:
      if (law == Law::normal)
        return std::array{1., 3., 9., 19., 35.}.at(level - 1);
      return level == 1 ? 1 : std::min(endless, std::exp2(l - 1) + 1);
    }
  }

  double n_tensor_points(std::size_t n_variables, unsigned int n)
  {
    return std::min(endless, std::pow(n, static_cast<double>(n_variables)));
  }

  double n_smolyak_points(const std::vector<Law> &laws, unsigned int level, Growth growth)
  {
    for (const Law law : laws)
      if (const double n = n_line_points(law, growth, level + 1); n > most_line_points)
        return n;
    // new points of a variable at a level, if none but those of the level before come again
    const auto fresh = [growth](Law law, unsigned int l)
    {
      const bool is_nested = growth == Growth::nested && l > 0;
      return n_line_points(law, growth, l + 1) - (is_nested ? n_line_points(law, growth, l) : 0);
    };
    // of all variables, by the sum of what their levels exceed 1
    std::vector<double> of_sum(level + 1, 0);
    of_sum[0] = 1;
    double n = 1;
    for (const Law law : laws)
    {
      std::vector<double> next(level + 1, 0);
      for (unsigned int s = 0; s <= level; ++s)
        for (unsigned int e = 0; e <= s; ++e)
          next[s] += of_sum[s - e] * fresh(law, e);
      of_sum = next;
      n = std::accumulate(of_sum.begin(), of_sum.end(), 0.);
      if (n >= endless) // each variable adds to them
        return endless;
    }
    return n;
  }

  SamplePoints tensor_points(const std::vector<Law> &laws, unsigned int n)
  {
    std::vector<LineRule> rules;
    for (const Law law : laws)
      rules.push_back(gauss_rule(law, n));
    return combinations(rules);
  }

  SamplePoints chebyshev_points(std::size_t n_variables, unsigned int n)
  {
    return combinations(std::vector<LineRule>(n_variables, fejer_rule(n)));
  }

  SamplePoints equidistant_points(std::size_t n_variables, unsigned int n)
  {
    LineRule rule{{0}, {1}};
    if (n > 1)
    {
      rule = {};
      for (unsigned int i = 0; i < n; ++i)
      {
        rule.nodes.push_back(2. * i / (n - 1) - 1);
        rule.weights.push_back((i == 0 || i + 1 == n ? .5 : 1.) / (n - 1));
      }
    }
    return combinations(std::vector<LineRule>(n_variables, rule));
  }

  SamplePoints smolyak_points(const std::vector<Law> &laws, unsigned int level, Growth growth)
  {
    const std::size_t n = laws.size();
    std::map<std::pair<Law, unsigned int>, LineRule> rules; // by law and excess, where needed
    const auto rule_of = [&](Law law, unsigned int excess)
    {
      const auto key = std::pair(law, excess);
      if (rules.count(key) == 0)
        rules.emplace(key, line_rule(law, growth, excess + 1));
      return &rules.at(key);
    };
    struct Sum
    {
      double weight = 0, size = 0;
    };
    std::map<std::vector<double>, Sum> sums;
    for_each_smolyak_term(n, level,
                          [&](double factor, const std::vector<unsigned int> &excess)
                          {
                            std::vector<const LineRule *> chosen;
                            for (std::size_t d = 0; d < n; ++d)
                              chosen.push_back(rule_of(laws[d], excess[d]));
                            for_each_combination(
                                chosen,
                                [&](const std::vector<double> &point, double weight)
                                {
                                  Sum &sum = sums[point];
                                  sum.weight += factor * weight;
                                  sum.size += std::abs(factor * weight);
                                });
                          });
    constexpr double nothing = 1e-14; // rounding of weights that cancel
    SamplePoints result;
    for (const auto &[point, sum] : sums)
      if (std::abs(sum.weight) > nothing * sum.size)
      {
        result.points.push_back(point);
        result.weights.push_back(sum.weight);
      }
    return result;
  }

  SamplePoints monte_carlo_points(const std::vector<Law> &laws, std::size_t n, std::uint64_t seed)
  {
    Generator generator(seed);
    return random_points(laws, n,
                         [&](Law law) {
                           return law == Law::normal ? generator.normal()
                                                     : 2 * generator.uniform() - 1;
                         });
  }

  SamplePoints quasi_monte_carlo_points(const std::vector<Law> &laws, std::size_t n)
  {
    boost::random::sobol engine(laws.size());
    engine.discard(laws.size());
    constexpr unsigned int lower_bits = 11; // that a double has no room for
    return random_points(
        laws, n,
        [&](Law law) {
          return quantile(law, std::ldexp(static_cast<double>(engine() >> lower_bits) + .5, -53));
        });
  }
} // namespace plumbline::uq
