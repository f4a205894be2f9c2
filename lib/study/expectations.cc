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

    using Check = std::function<Expectation(const scene::Expected &, const Trend &)>;

    void check_all(const scene::Scene &scene, scene::ExpectedKind kind, Results &results,
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
          result.subject = trend.method + ", " + trend.problem + ", " + trend.series + ": " + what;
          results.expectations.push_back(result);
        }
        if (!is_found)
          results.expectations.push_back(
              {expected.text, what, "no such method, case or series was run", false});
      }
    }
  } // namespace

  void check_expectations(const scene::Scene &scene, Results &results)
  {
    results.expectations.clear();
    check_all(scene, scene::ExpectedKind::verdicts, results, "verdict",
              [](const scene::Expected &expected, const Trend &trend) {
                return Expectation{"", expected.verdict, trend.verdict,
                                   expected.verdict == trend.verdict};
              });
    check_all(scene, scene::ExpectedKind::errors, results, "errors",
              [&](const scene::Expected &expected, const Trend &trend)
              {
                // a shortened sweep is checked as far as it goes
                bool holds = !trend.values.empty() && trend.values.size() <= expected.values.size();
                for (std::size_t i = 0; i < trend.values.size() && holds; ++i)
                  holds = std::abs(trend.values[i] / expected.values[i] - 1) <=
                          scene.expected.error_tolerance;
                return Expectation{"", join(expected.values), join(trend.values), holds};
              });
    check_all(scene, scene::ExpectedKind::rates, results, "rate of the last two levels",
              [&](const scene::Expected &expected, const Trend &trend)
              {
                const double rate = trend.rates.empty() ? 0 : trend.rates.back();
                return Expectation{
                    "",
                    join(expected.values) + " ± " + base::to_text(scene.expected.rate_tolerance, 4),
                    base::to_text(rate, 4),
                    !trend.rates.empty() && expected.values.size() == 1 &&
                        std::abs(rate - expected.values[0]) <= scene.expected.rate_tolerance};
              });
    check_all(
        scene, scene::ExpectedKind::bounds, results, "largest error",
        [](const scene::Expected &expected, const Trend &trend)
        {
          const double largest = trend.values.empty()
                                     ? 0
                                     : *std::max_element(trend.values.begin(), trend.values.end());
          return Expectation{"", "<= " + join(expected.values), base::to_text(largest, 4),
                             !trend.values.empty() && trend.outcome != Outcome::failed &&
                                 expected.values.size() == 1 && largest <= expected.values[0]};
        });
    check_all(
        scene, scene::ExpectedKind::monotone, results, "error falls at every level",
        [](const scene::Expected &expected, const Trend &trend)
        {
          const bool falls = std::is_sorted(trend.values.rbegin(), trend.values.rend());
          const std::string found = trend.values.size() < 2 ? "one level" : falls ? "yes" : "no";
          return Expectation{"", expected.verdict, found, found == expected.verdict};
        });
    check_all(scene, scene::ExpectedKind::jitter, results,
              "rises of the error over its first value",
              [](const scene::Expected &expected, const Trend &trend)
              {
                double rises = 0;
                for (std::size_t i = 1; i < trend.values.size(); ++i)
                  rises += std::max(0., trend.values[i] - trend.values[i - 1]);
                if (!trend.values.empty())
                  rises /= trend.values.front();
                const bool is_range = expected.values.size() == 2;
                return Expectation{"", is_range ? join(expected.values) : "least and most",
                                   base::to_text(rises, 4),
                                   is_range && trend.values.size() > 1 &&
                                       expected.values[0] <= rises && rises <= expected.values[1]};
              });
  }
} // namespace plumbline::study
