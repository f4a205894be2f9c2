#include "report/selection.h"

#include "report/formats.h"
#include "report/plot.h"
#include "study/solution_record.h"
#include "study/trend.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumbline::report
{
  namespace
  {
    constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

    void add_case(std::vector<Case> &found, const std::string &problem, const std::string &series)
    {
      for (const Case &one : found)
        if (one.problem == problem && one.series == series)
          return;
      const std::string plain = slug(problem) + "_" + slug(series);
      std::string unique = plain;
      const auto is_taken = [&](const Case &one) { return one.slug == unique; };
      for (unsigned int n = 2; std::any_of(found.begin(), found.end(), is_taken); ++n)
        unique = plain + "_" + std::to_string(n);
      found.push_back({problem, series, unique});
    }

    void add_method(std::vector<MethodName> &found, const std::string &name,
                    study::MethodFamily family)
    {
      for (const MethodName &method : found)
        if (method.name == name)
          return;
      found.push_back({name, family});
    }
  } // namespace

  std::vector<Case> cases(const study::StudyResults &results)
  {
    std::vector<Case> found;
    for (const study::Record &run : results.records)
      add_case(found, run.key.problem, run.key.series);
    for (const study::Trend &trend : results.trends)
      add_case(found, trend.problem, trend.series);
    return found;
  }

  std::vector<MethodName> methods(const study::StudyResults &results)
  {
    std::vector<MethodName> found;
    for (const study::Record &run : results.records)
      add_method(found, run.key.method, run.key.family);
    for (const study::Trend &trend : results.trends)
      add_method(found, trend.method, trend.family);
    return found;
  }

  const study::Trend *decisive_trend(const study::StudyResults &results, const std::string &method,
                                     const Case &one)
  {
    for (const study::Trend &trend : results.trends)
      if (trend.method == method && trend.problem == one.problem && trend.series == one.series &&
          trend.error == results.decisive_error)
        return &trend;
    return nullptr;
  }

  std::vector<const study::Record *> runs_of(const study::StudyResults &results,
                                             const std::string &method, const Case &one)
  {
    std::vector<const study::Record *> found;
    for (const study::Record &run : results.records)
      if (run.key.method == method && run.key.problem == one.problem &&
          run.key.series == one.series)
        found.push_back(&run);
    std::stable_sort(found.begin(), found.end(),
                     [](const study::Record *a, const study::Record *b)
                     { return a->key.level < b->key.level; });
    return found;
  }

  double decisive_error(const study::StudyResults &results, const study::Record &run)
  {
    return run.failure.empty() ? run[results.decisive_error] : not_a_number;
  }

  std::string telling_problem(const study::StudyResults &results)
  {
    const auto noise = [&](const study::Record &run)
    {
      const double size = study::size_of(run, results.decisive_error);
      return round_off *
             (size > 0 ? size : study::norm_of_one(results.decisive_error, study::area_of(run)));
    };
    std::string best;
    std::size_t most = 0;
    for (const Case &one : cases(results))
    {
      const auto n = static_cast<std::size_t>(std::count_if(
          results.records.begin(), results.records.end(),
          [&](const study::Record &run)
          { return run.key.problem == one.problem && decisive_error(results, run) > noise(run); }));
      if (best.empty() || n > most)
      {
        best = one.problem;
        most = n;
      }
    }
    return best;
  }

  double rate_at(const study::Trend &trend, double x)
  {
    for (std::size_t i = 1; i < trend.x.size(); ++i)
      if (std::abs(trend.x[i] - x) <= same_length * std::abs(x))
        return study::observed_rate(trend, i);
    return not_a_number;
  }

  study::Axis axis_of(const study::StudyResults &results, const Case &one)
  {
    for (const study::Trend &trend : results.trends)
      if (trend.problem == one.problem && trend.series == one.series)
        return trend.axis;
    return study::Axis::mesh_size;
  }

  std::string unit_of_errors(const study::StudyResults &results)
  {
    if (study::is_energy(results.decisive_error))
      return "root of the unit of energy";
    return study::is_truncation(results.decisive_error) ? "unit of the load"
                                                        : "unit of the solution";
  }

  std::string error_words(const std::string &error)
  {
    std::string words = error;
    if (const std::size_t bar = words.find(" | "); bar != std::string::npos)
      words.replace(bar, 3, " against ");
    if (const std::size_t inf = words.find("Linf"); inf != std::string::npos)
      words.replace(inf, 4, "L∞");
    return words;
  }

  std::string outcome_symbol(study::Outcome outcome)
  {
    switch (outcome)
    {
    case study::Outcome::converges:
      return "✓";
    case study::Outcome::stalls:
    case study::Outcome::field_only:
      return "✗";
    case study::Outcome::undecided:
      return "?";
    case study::Outcome::failed:
      break;
    }
    return "–";
  }

  std::string verdict_words(const study::Trend &trend)
  {
    if (!trend.verdict.empty())
      return trend.verdict;
    switch (trend.outcome)
    {
    case study::Outcome::converges:
      return "converges";
    case study::Outcome::stalls:
      return "stalls";
    case study::Outcome::field_only:
      return "converges for this field only";
    case study::Outcome::undecided:
      return "undecided";
    case study::Outcome::failed:
      break;
    }
    return "failed";
  }
} // namespace plumbline::report
