#include "study/expectations.h"

#include "base/number_text.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace plumbline::study
{
  namespace
  {
    std::string join(const std::vector<double> &values)
    {
      std::string text;
      for (const double value : values)
        text += (text.empty() ? "" : " ") + base::to_text(value, 7);
      return text;
    }

    std::string without_blanks(std::string text)
    {
      text.erase(std::remove(text.begin(), text.end(), ' '), text.end());
      return text;
    }

    /// Appended to what was found where --levels left the finest levels of a series out: no method
    /// has a record of the last one.
    std::string left_out(const scene::Scene &scene, const StudyResults &results,
                         const std::string &series)
    {
      for (const auto &one : scene.study.series)
      {
        if (one.name != series)
          continue;
        std::size_t n_run = 0;
        for (const Record &record : results.records)
          if (record.key.series == series)
            n_run = std::max<std::size_t>(n_run, record.key.level + 1);
        if (n_run < one.levels.size())
          return " (needs all " + std::to_string(one.levels.size()) +
                 " levels: " + std::to_string(one.levels.size() - n_run) +
                 " were left out, for example by --levels; run without it)";
      }
      return "";
    }

    /// What was found of an expectation that no trend has.
    std::string not_run(const std::string &method, const StudyResults &results)
    {
      const bool is_method_run =
          std::any_of(results.records.begin(), results.records.end(),
                      [&](const Record &record) { return record.key.method == method; });
      return is_method_run ? "no such case or series was run"
                           : "the method was not run (left out, for example, by --methods)";
    }

    using Check = std::function<Expectation(const scene::Expected &, const Trend &)>;

    void check_all(const scene::Scene &scene, scene::ExpectedKind kind, StudyResults &results,
                   const std::string &what, const Check &check)
    {
      for (const scene::Expected &expected : scene.expected.all)
      {
        if (expected.kind != kind)
          continue;
        bool is_found = false;
        for (const Trend &trend : results.trends)
        {
          if (trend.error != results.decisive_error || trend.method != expected.method ||
              (!expected.problem.empty() && trend.problem != expected.problem) ||
              (!expected.series.empty() &&
               without_blanks(trend.series) != without_blanks(expected.series)))
            continue;
          is_found = true;
          Expectation result = check(expected, trend);
          if (!result.holds)
            result.found += left_out(scene, results, trend.series);
          result.subject = trend.method + ", " + trend.problem + ", " + trend.series + ": " + what;
          results.expectations.push_back(result);
        }
        if (!is_found)
          results.expectations.push_back(
              {expected.text, what, not_run(expected.method, results), false});
      }
    }

    Expectation check_verdict(const scene::Expected &expected, const Trend &trend)
    {
      return {"", expected.verdict, trend.verdict, expected.verdict == trend.verdict};
    }

    /// A shortened sweep is checked as far as it goes.
    Expectation check_errors(const scene::Expected &expected, const Trend &trend, double tolerance)
    {
      bool holds = !trend.values.empty() && trend.values.size() <= expected.values.size();
      for (std::size_t i = 0; i < trend.values.size() && holds; ++i)
        holds = std::abs(trend.values[i] / expected.values[i] - 1) <= tolerance;
      return {"", join(expected.values), join(trend.values), holds};
    }

    Expectation check_rate(const scene::Expected &expected, const Trend &trend, double tolerance)
    {
      const double rate = trend.rates.empty() ? 0 : trend.rates.back();
      return {"", join(expected.values) + " ± " + base::to_text(tolerance, 4),
              base::to_text(rate, 4),
              !trend.rates.empty() && expected.values.size() == 1 &&
                  std::abs(rate - expected.values[0]) <= tolerance};
    }

    Expectation check_bound(const scene::Expected &expected, const Trend &trend)
    {
      const double largest =
          trend.values.empty() ? 0 : *std::max_element(trend.values.begin(), trend.values.end());
      return {"", "<= " + join(expected.values), base::to_text(largest, 4),
              !trend.values.empty() && trend.outcome != Outcome::failed &&
                  expected.values.size() == 1 && largest <= expected.values[0]};
    }

    Expectation check_fall(const scene::Expected &expected, const Trend &trend)
    {
      const bool falls = std::is_sorted(trend.values.rbegin(), trend.values.rend());
      const std::string found = trend.values.size() < 2 ? "one level" : falls ? "yes" : "no";
      return {"", expected.verdict, found, found == expected.verdict};
    }

    Expectation check_rises(const scene::Expected &expected, const Trend &trend)
    {
      double rises = 0;
      for (std::size_t i = 1; i < trend.values.size(); ++i)
        rises += std::max(0., trend.values[i] - trend.values[i - 1]);
      if (!trend.values.empty())
        rises /= trend.values.front();
      const bool is_range = expected.values.size() == 2;
      return {"", is_range ? join(expected.values) : "least and most", base::to_text(rises, 4),
              is_range && trend.values.size() > 1 && expected.values[0] <= rises &&
                  rises <= expected.values[1]};
    }
  } // namespace

  void check_expectations(const scene::Scene &scene, StudyResults &results)
  {
    using Kind = scene::ExpectedKind;
    const auto check = [&](Kind kind, const std::string &what, const Check &of_trend)
    { check_all(scene, kind, results, what, of_trend); };
    // as check_all() asks, with a tolerance of the scene
    const auto within = [](double tolerance, auto of_trend)
    {
      return [=](const scene::Expected &expected, const Trend &trend)
      { return of_trend(expected, trend, tolerance); };
    };
    results.expectations.clear();
    check(Kind::verdicts, "verdict", check_verdict);
    check(Kind::errors, "errors", within(scene.expected.error_tolerance, check_errors));
    check(Kind::rates, "rate of the last two levels",
          within(scene.expected.rate_tolerance, check_rate));
    check(Kind::bounds, "largest error", check_bound);
    check(Kind::monotone, "error falls at every level", check_fall);
    check(Kind::jitter, "rises of the error over its first value", check_rises);
  }

  namespace
  {
    /// The largest value that is expected: a number, or the record's own of another quantity.
    double bound_of(const scene::Expected &expected, const Record &record)
    {
      constexpr std::size_t sign = 3; // "<= "
      return expected.values.empty() ? record[expected.verdict.substr(sign)] : expected.values[0];
    }
  } // namespace

  void check_values(const scene::Scene &scene, StudyResults &results)
  {
    for (const scene::Expected &expected : scene.expected.all)
    {
      if (expected.kind != scene::ExpectedKind::values)
        continue;
      const std::string &quantity = expected.problem;
      const bool is_bound = !expected.verdict.empty();
      std::vector<double> found, bounds;
      bool holds = true;
      for (const Record &record : results.records)
        if (record.key.method == expected.method && record.has(quantity) &&
            (expected.series.empty() ||
             without_blanks(record.key.series) == without_blanks(expected.series)))
        {
          found.push_back(record[quantity]);
          if (is_bound)
            bounds.push_back(bound_of(expected, record));
          holds = holds &&
                  (is_bound ? std::isfinite(bound_of(expected, record)) &&
                                  found.back() <= bound_of(expected, record)
                            : found.size() <= expected.values.size() &&
                                  std::abs(found.back() / expected.values[found.size() - 1] - 1) <=
                                      scene.expected.error_tolerance);
        }
      results.expectations.push_back({expected.method + ", " + quantity,
                                      is_bound ? expected.verdict : join(expected.values),
                                      found.empty() ? "no such method, quantity or series was run"
                                      : bounds.empty() ? join(found)
                                                       : join(found) + "; bounds: " + join(bounds),
                                      holds && !found.empty()});
    }
  }
} // namespace plumbline::study
