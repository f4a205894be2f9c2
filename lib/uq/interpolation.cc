#include "uq/interpolation.h"

#include "uq/smolyak_terms.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace plumbline::uq
{
  namespace
  {
    /// Two nodes as close as this are one.
    constexpr double same = 1e-14;

    /// The maximum of a function with one in [a, b].
    template <class F>
    std::pair<double, double> golden_maximum(double a, double b, const F &f)
    {
      const double ratio = .5 * (std::sqrt(5.) - 1);
      constexpr double tolerance = 1e-9;
      double c = b - ratio * (b - a), d = a + ratio * (b - a), at_c = f(c), at_d = f(d);
      while (b - a > tolerance)
        if (at_c > at_d)
        {
          b = d;
          d = c;
          at_d = at_c;
          c = b - ratio * (b - a);
          at_c = f(c);
        }
        else
        {
          a = c;
          c = d;
          at_c = at_d;
          d = a + ratio * (b - a);
          at_d = f(d);
        }
      return at_c > at_d ? std::pair(c, at_c) : std::pair(d, at_d);
    }
  } // namespace

  std::vector<double> Interpolant::Line::values(double x) const
  {
    std::vector<double> values(nodes.size(), 0);
    double sum = 0;
    for (std::size_t i = 0; i < nodes.size(); ++i)
    {
      const double difference = x - nodes[i];
      if (std::abs(difference) <= same)
      {
        std::fill(values.begin(), values.end(), 0);
        values[i] = 1;
        return values;
      }
      values[i] = weights[i] / difference;
      sum += values[i];
    }
    for (double &value : values)
      value /= sum;
    return values;
  }

  double Interpolant::Line::sum_of_sizes(double x) const
  {
    double sum = 0;
    for (const double value : values(x))
      sum += std::abs(value);
    return sum;
  }

  std::pair<double, double> Interpolant::Line::largest() const
  {
    std::vector<double> ends = nodes; // between neighbours and ends there is one maximum each
    ends.insert(ends.begin(), -1);
    ends.push_back(1);
    std::pair<double, double> largest(-1, sum_of_sizes(-1)); // outside the nodes it is at the ends
    for (std::size_t i = 0; i + 1 < ends.size(); ++i)
      if (ends[i + 1] - ends[i] > same)
      {
        const auto found =
            golden_maximum(ends[i], ends[i + 1], [this](double x) { return sum_of_sizes(x); });
        if (found.second > largest.second)
          largest = found;
      }
    return largest;
  }

  void Interpolant::add(double factor, const std::vector<Rule> &rules,
                        const std::function<LineRule(Rule)> &make)
  {
    for (const Rule &rule : rules)
      if (lines_.count(rule) == 0)
      {
        Line line;
        line.nodes = make(rule).nodes;
        // relative to the largest, by logarithms: products of many differences leave the range
        std::vector<double> logarithm(line.nodes.size(), 0);
        for (std::size_t i = 0; i < line.nodes.size(); ++i)
        {
          double sign = 1;
          for (std::size_t j = 0; j < line.nodes.size(); ++j)
            if (j != i)
            {
              logarithm[i] -= std::log(std::abs(line.nodes[i] - line.nodes[j]));
              if (j > i)
                sign = -sign;
            }
          line.weights.push_back(sign);
        }
        const double largest = *std::max_element(logarithm.begin(), logarithm.end());
        for (std::size_t i = 0; i < line.nodes.size(); ++i)
          line.weights[i] *= std::exp(logarithm[i] - largest);
        lines_.emplace(rule, std::move(line));
      }
    Product product{factor, rules, {}};
    std::vector<std::size_t> index(rules.size(), 0);
    std::vector<double> point(rules.size());
    std::size_t variable = 0;
    while (variable < rules.size())
    {
      for (std::size_t d = 0; d < rules.size(); ++d)
        point[d] = lines_.at(rules[d]).nodes[index[d]];
      const auto [place, is_new] = place_of_.emplace(point, points_.size());
      if (is_new)
        points_.push_back(point);
      product.places.push_back(place->second);
      variable = 0;
      while (variable < rules.size() &&
             ++index[variable] == lines_.at(rules[variable]).nodes.size())
        index[variable++] = 0;
    }
    products_.push_back(std::move(product));
  }

  Interpolant Interpolant::tensor(const std::vector<Law> &laws, unsigned int n)
  {
    Interpolant result;
    std::vector<Rule> rules;
    for (const Law law : laws)
      rules.emplace_back(law, n);
    result.add(1, rules, [](Rule rule) { return gauss_rule(rule.first, rule.second); });
    return result;
  }

  Interpolant Interpolant::chebyshev(std::size_t n_variables, unsigned int n)
  {
    Interpolant result;
    result.add(1, std::vector<Rule>(n_variables, {Law::uniform, n}),
               [](Rule rule) { return fejer_rule(rule.second); });
    return result;
  }

  Interpolant Interpolant::smolyak(const std::vector<Law> &laws, unsigned int level, Growth growth)
  {
    Interpolant result;
    for_each_smolyak_term(laws.size(), level,
                          [&](double factor, const std::vector<unsigned int> &excess)
                          {
                            std::vector<Rule> rules;
                            for (std::size_t d = 0; d < laws.size(); ++d)
                              rules.emplace_back(laws[d], excess[d] + 1);
                            result.add(factor, rules,
                                       [growth](Rule rule)
                                       { return line_rule(rule.first, growth, rule.second); });
                          });
    return result;
  }

  std::vector<double> Interpolant::coefficients(const std::vector<double> &at) const
  {
    std::vector<double> result(points_.size(), 0);
    std::map<std::pair<Rule, std::size_t>, std::vector<double>> values; // of a rule and a variable
    for (const Product &product : products_)
    {
      std::vector<const std::vector<double> *> lines;
      for (std::size_t d = 0; d < at.size(); ++d)
      {
        const auto key = std::pair(product.rules[d], d);
        auto found = values.find(key);
        if (found == values.end())
          found = values.emplace(key, lines_.at(product.rules[d]).values(at[d])).first;
        lines.push_back(&found->second);
      }
      for (std::size_t i = 0; i < product.places.size(); ++i)
      {
        double value = product.factor;
        std::size_t rest = i;
        for (const auto *line : lines)
        {
          value *= (*line)[rest % line->size()];
          rest /= line->size();
        }
        result[product.places[i]] += value;
      }
    }
    return result;
  }

  double Interpolant::sum_of_sizes(const std::vector<double> &at) const
  {
    double sum = 0;
    for (const double value : coefficients(at))
      sum += std::abs(value);
    return sum;
  }

  std::optional<Interpolant::Lebesgue> Interpolant::lebesgue() const
  {
    constexpr std::size_t n_candidates = 2000, n_starts = 8, n_parts = 9; // of a line
    constexpr double work = 4e6; // coefficients that the search may find
    std::map<Rule, std::pair<double, double>> largest;
    for (const auto &[rule, line] : lines_)
      if (rule.first != Law::uniform)
        return {};
      else
        largest[rule] = line.largest();
    Lebesgue result{0, 0};
    for (const Product &product : products_)
    {
      double size = std::abs(product.factor);
      for (const Rule &rule : product.rules)
        size *= largest.at(rule).second;
      result.bound += size;
    }
    if (products_.size() == 1)
      return Lebesgue{result.bound, result.bound};
    // from the best of many points, along one variable after another
    const std::size_t n = products_.front().rules.size();
    std::vector<double> places = {-1, 1}; // and where rules have their own maxima
    for (const auto &[rule, where] : largest)
      places.push_back(where.first);
    std::mt19937 random; // the same each time
    const auto in_range = [&random]
    { return 2 * (static_cast<double>(random()) / 4294967295.) - 1; };
    double left = work;
    const auto at_cost = [&](const std::vector<double> &at)
    {
      left -= static_cast<double>(points_.size());
      return sum_of_sizes(at);
    };
    std::vector<std::pair<double, std::vector<double>>> starts;
    for (std::size_t i = 0; i < n_candidates && (left > .5 * work || i == 0); ++i)
    {
      std::vector<double> at(n, 1);
      for (std::size_t d = 0; d < n && i > 0; ++d)
        at[d] = i % 2 == 0 ? in_range() : places[random() % places.size()];
      const double value = at_cost(at);
      starts.emplace_back(value, std::move(at));
    }
    std::sort(starts.rbegin(), starts.rend());
    starts.resize(std::min(starts.size(), n_starts));
    for (auto &[now, at] : starts)
    {
      double before = 0;
      while (now > before * (1 + 1e-9) && left > 0)
      {
        before = now;
        for (std::size_t d = 0; d < n; ++d)
        {
          const auto along = [&](double x)
          {
            std::vector<double> moved = at;
            moved[d] = x;
            return at_cost(moved);
          };
          double best = at[d];
          for (std::size_t i = 0; i < n_parts; ++i)
          {
            const double a = 2. * static_cast<double>(i) / n_parts - 1, b = a + 2. / n_parts;
            for (const auto &[x, value] :
                 {golden_maximum(a, b, along), {a, along(a)}, {b, along(b)}})
              if (value > now)
              {
                now = value;
                best = x;
              }
          }
          at[d] = best;
        }
      }
      result.found = std::max(result.found, now);
    }
    result.found = std::min(result.found, result.bound); // but for rounding
    return result;
  }
} // namespace plumbline::uq
