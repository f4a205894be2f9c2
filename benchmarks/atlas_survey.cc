#include "atlas_survey.h"

#include "io/record_journal.h"
#include "report/plot.h"
#include "study/cheapest.h"
#include "study/solution_record.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

namespace plumbline::atlas
{
  std::vector<Entry> read_entries(const fs::path &atlas, const std::string &below)
  {
    std::vector<Entry> entries;
    if (!fs::is_directory(atlas / below))
      return entries;
    for (const auto &file : fs::recursive_directory_iterator(atlas / below))
      if (file.path().filename() == "finished")
      {
        const fs::path folder = file.path().parent_path();
        Entry entry{folder.parent_path().filename().string(),
                    folder.filename().string(),
                    fs::relative(folder, atlas),
                    {},
                    ""};
        if (fs::exists(io::results_file(folder)))
          entry.results = io::results_in(folder);
        else
        {
          std::ifstream in(folder / "messages");
          entry.refusal = {std::istreambuf_iterator<char>(in), {}};
          const std::string prefix = "plumbline: ";
          if (entry.refusal.compare(0, prefix.size(), prefix) == 0)
            entry.refusal.erase(0, prefix.size());
        }
        entries.push_back(entry);
      }
    std::sort(entries.begin(), entries.end(),
              [](const Entry &a, const Entry &b) { return a.folder < b.folder; });
    return entries;
  }

  double relative_error(const study::StudyResults &results, const study::Record &run)
  {
    return report::decisive_error(results, run) / study::size_of(run);
  }

  std::vector<const study::Record *> runs_of(const Question &question)
  {
    std::vector<const study::Record *> runs;
    for (const study::Record &run : question.results->records)
      if (run.key.family != study::MethodFamily::local && run.key.problem == question.problem &&
          (question.series.empty() || run.key.series == question.series))
        runs.push_back(&run);
    return runs;
  }

  study::Outcome outcome_of(const Question &question, const std::string &method)
  {
    using study::Outcome;
    std::vector<Outcome> found;
    for (const study::Trend &trend : question.results->trends)
      if (trend.error == question.results->decisive_error && trend.method == method &&
          trend.problem == question.problem &&
          (question.series.empty() || trend.series == question.series))
        // a limit that is wrong for other fields is no better than a stall
        found.push_back(trend.outcome == Outcome::field_only ? Outcome::stalls : trend.outcome);
    for (const Outcome outcome : {Outcome::failed, Outcome::stalls, Outcome::undecided})
      if (std::count(found.begin(), found.end(), outcome) > 0)
        return outcome;
    return found.empty() ? Outcome::undecided : Outcome::converges;
  }

  std::vector<std::string> with_outcome(const Question &question, study::Outcome outcome)
  {
    std::vector<std::string> names;
    for (const study::Record *run : runs_of(question))
      if (std::count(names.begin(), names.end(), run->key.method) == 0 &&
          outcome_of(question, run->key.method) == outcome)
        names.push_back(run->key.method);
    return names;
  }

  const study::Record *cheapest(const Question &question, double target)
  {
    for (const auto wanted : {study::Outcome::converges, study::Outcome::undecided})
    {
      std::vector<const study::Record *> runs;
      for (const study::Record *run : runs_of(question))
        if (outcome_of(question, run->key.method) == wanted &&
            relative_error(*question.results, *run) <= target)
          runs.push_back(run);
      if (!runs.empty())
        return study::cheapest(runs).front();
    }
    return nullptr;
  }

  std::vector<const study::Record *> front(const Question &question)
  {
    constexpr double clearly_cheaper = .9; // CPU times repeat to some 5 %
    constexpr double least_accuracy = .1;
    struct Point
    {
      const study::Record *run;
      double seconds, error;
    };
    std::vector<Point> points;
    for (const study::Record *run : runs_of(question))
      if (const double error = relative_error(*question.results, *run);
          error <= least_accuracy && run->cost.seconds() > 0)
        points.push_back({run, run->cost.seconds(), std::max(error, report::round_off)});
    std::sort(points.begin(), points.end(),
              [](const Point &a, const Point &b) { return a.seconds < b.seconds; });
    std::vector<const study::Record *> result;
    for (const Point &point : points)
      if (std::none_of(points.begin(), points.end(),
                       [&](const Point &other) {
                         return other.error <= point.error &&
                                other.seconds < clearly_cheaper * point.seconds;
                       }))
        result.push_back(point.run);
    return result;
  }

  std::vector<std::string> methods_on_front(const Question &question)
  {
    std::vector<std::string> names;
    for (const study::Record *run : front(question))
      if (std::count(names.begin(), names.end(), run->key.method) == 0)
        names.push_back(run->key.method);
    return names;
  }

  bool is_stalling(const Question &question, const std::string &method)
  {
    const study::Outcome outcome = outcome_of(question, method);
    return outcome == study::Outcome::stalls || outcome == study::Outcome::failed;
  }

  std::map<std::string, Tally> tally(const std::vector<Question> &questions)
  {
    std::map<std::string, Tally> tallies;
    for (const Question &question : questions)
    {
      for (const auto outcome : {study::Outcome::converges, study::Outcome::stalls,
                                 study::Outcome::undecided, study::Outcome::failed})
        for (const std::string &method : with_outcome(question, outcome))
        {
          ++tallies[method].n;
          ++tallies[method].n_outcome[outcome];
        }
      for (const std::string &method : methods_on_front(question))
        ++(is_stalling(question, method) ? tallies[method].n_front_stalling
                                         : tallies[method].n_front);
      for (const double target : targets)
        if (const study::Record *run = cheapest(question, target))
          ++tallies[run->key.method].n_cheapest[target];
    }
    return tallies;
  }
} // namespace plumbline::atlas
