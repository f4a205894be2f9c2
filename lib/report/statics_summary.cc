#include "report/statics_summary.h"

#include "base/number_text.h"
#include "report/counted.h"
#include "report/report_parts.h"
#include "report/text_table.h"
#include "report/view.h"
#include "study/cheapest.h"
#include "study/model_facts.h"
#include "study/target_words.h"
#include "study/trend.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <sstream>
#include <tuple>

namespace plumbline::report
{
  namespace
  {
    using study::Outcome;
    using study::StudyResults;

    constexpr std::size_t n_columns = 120;

    void print(std::ostream &out, const std::string &line)
    {
      out << fitted(line, n_columns) << '\n';
    }

    /// Why there is this verdict: in short where a proof stands beside the errors.
    std::string reason_of(const study::Trend &trend)
    {
      constexpr int n_digits = 3;
      const bool is_open = trend.outcome == Outcome::undecided;
      if (trend.outcome == Outcome::failed || trend.values.empty() ||
          (trend.proof.reason.empty() && !is_open) ||
          (is_open && trend.reason.find("last error") != std::string::npos))
        return trend.reason;
      std::string text = "last error " + base::to_text(trend.values.back(), n_digits);
      if (trend.values.back() <= trend.round_off)
        text += " (round-off)";
      else if (const double rate = study::last_rate(trend); std::isfinite(rate))
        text += ", rate " + base::to_text(rate, n_digits);
      return text + "; " + (is_open ? trend.reason : trend.proof.reason);
    }

    /// A row for each method, problem and series.
    void print_trends(std::ostream &out, const StudyResults &results)
    {
      constexpr std::size_t most = 9;
      std::array<std::size_t, 4> width{};
      std::vector<std::array<std::string, 5>> rows;
      for (const study::Trend &trend : results.trends)
        if (trend.error == results.decisive_error)
          rows.push_back(
              {trend.method, trend.problem, trend.series, trend.verdict, reason_of(trend)});
      const std::size_t n = std::min(most, rows.size());
      for (std::size_t row = 0; row < n; ++row)
        for (unsigned int c = 0; c < width.size(); ++c)
          width[c] = std::max(width[c], rows[row][c].size() + 2);
      for (std::size_t row = 0; row < n; ++row)
      {
        std::string line = "  ";
        for (unsigned int c = 0; c < width.size(); ++c)
          line += rows[row][c] + std::string(width[c] - rows[row][c].size(), ' ');
        print(out, line + rows[row][4]);
      }
      if (rows.size() > n)
        print(out, "  ... and " + std::to_string(rows.size() - n) + " more in the report");
    }

    /// Methods by what became of them, each in the worst class that it belongs to.
    void print_answer(std::ostream &out, const StudyResults &results)
    {
      // from good to bad
      const std::vector<std::pair<Outcome, std::string>> classes = {
          {Outcome::converges, "Converge: "},
          {Outcome::undecided, "Undecided: "},
          {Outcome::field_only, "Converge for this field only: "},
          {Outcome::failed, "No solution: "},
          {Outcome::stalls, "Stall, however fine the mesh: "}};
      const auto rank = [&](Outcome outcome)
      {
        return std::find_if(classes.begin(), classes.end(),
                            [&](const auto &one) { return one.first == outcome; }) -
               classes.begin();
      };
      std::vector<std::string> methods;
      std::map<std::string, std::map<Outcome, std::size_t>> found;
      for (const study::Trend &trend : results.trends)
        if (trend.error == results.decisive_error && trend.axis == study::Axis::mesh_size)
        {
          if (found.count(trend.method) == 0)
            methods.push_back(trend.method);
          ++found[trend.method][trend.outcome];
        }
      for (const auto &[outcome, words] : classes)
      {
        std::string names;
        for (const std::string &method : methods)
        {
          const auto &outcomes = found[method];
          const auto worst = std::max_element(outcomes.begin(), outcomes.end(),
                                              [&](const auto &a, const auto &b)
                                              { return rank(a.first) < rank(b.first); });
          if (worst->first != outcome)
            continue;
          std::size_t n = 0;
          for (const auto &one : outcomes)
            n += one.second;
          names += (names.empty() ? "" : ", ") + method +
                   (worst->second < n ? " (in " + std::to_string(worst->second) + " of " +
                                            std::to_string(n) + " cases)"
                                      : "");
        }
        if (!names.empty())
          print(out, words + names);
      }
    }

    /// Of solutions by the reference, or else by Galerkin methods, at the finest levels of the
    /// first problems and series.
    void print_estimates(std::ostream &out, const StudyResults &results)
    {
      constexpr std::size_t most = 2;
      constexpr int n_digits = 3;
      const auto &all = results.references.empty() ? results.estimates : results.references;
      std::vector<const study::ErrorEstimate *> finest;
      for (const study::ErrorEstimate &one : all)
      {
        const auto same =
            std::find_if(finest.begin(), finest.end(),
                         [&](const study::ErrorEstimate *other)
                         {
                           return std::tie(other->problem, other->series, other->method) ==
                                  std::tie(one.problem, one.series, one.method);
                         });
        if (same == finest.end())
          finest.push_back(&one);
        else if (one.level > (*same)->level)
          *same = &one;
      }
      std::size_t n = 0;
      for (const study::ErrorEstimate *one : finest)
        if (one->estimate > 0 && n++ < most)
          print(out, "Estimated error of " + one->method + ", " + one->problem + ", " +
                         one->series + ", h = " + base::to_text(one->h, n_digits) + ": " +
                         base::to_text(one->estimate, n_digits) + " (averages, L2)" +
                         (one->field_estimate > 0
                              ? ", " + base::to_text(one->field_estimate, n_digits) + " (field, L2)"
                              : "") +
                         "; " + counted(one->certified_digits, "certified digit"));
    }

    void print_ranking(std::ostream &out, const StudyResults &results)
    {
      constexpr std::size_t most = 3;
      if (const std::string list = page::ranking(results); !list.empty())
        for (const std::string &line :
             short_lines("Largest error over all " + page::ranked_over(results) +
                             " and problems, the best method first: " + list,
                         most))
          out << line << '\n';
    }

    /// Of the first problems and series.
    void print_cheapest(std::ostream &out, const StudyResults &results)
    {
      constexpr std::size_t most = 2, most_targets = 2, most_lines = 2;
      constexpr int n_digits = 3;
      std::size_t n = 0;
      for (const study::Advice &advice : results.advice)
        if (!advice.choices.empty() && n++ < most)
        {
          std::string line = results.advice.size() > 1
                                 ? advice.problem + ", " + advice.series + ": cheapest"
                                 : "Cheapest";
          for (std::size_t i = 0; i < std::min(most_targets, advice.choices.size()); ++i)
          {
            const study::Choice &choice = advice.choices[i];
            line += (i == 0 ? " to a relative error of " : "; of ") +
                    base::to_text(choice.target, n_digits) + ": " + choice.method +
                    " at h = " + base::to_text(choice.h, n_digits) + ", " +
                    base::to_text(choice.seconds, n_digits) + " CPU s";
            for (std::size_t k = 0; k < choice.tied.size(); ++k)
              line += (k == 0 ? ", a tie with " : ", ") + choice.tied[k];
          }
          for (const std::string &part : short_lines(line, most_lines))
            out << part << '\n';
        }
    }
  } // namespace

  std::vector<std::string> expectation_lines(const StudyResults &results, std::size_t most)
  {
    std::vector<std::string> lines;
    std::size_t n_missed = 0;
    for (const study::Expectation &one : results.expectations)
      if (!one.holds && ++n_missed <= most)
        lines.push_back("not as expected: " + one.subject + ": expected " + one.expected +
                        ", found " + one.found);
    if (n_missed > most)
      lines.push_back("not as expected: " + std::to_string(n_missed - most) +
                      " more in the report");
    if (!results.expectations.empty())
      lines.push_back("expectations: " + std::to_string(results.expectations.size() - n_missed) +
                      " of " + std::to_string(results.expectations.size()) + " hold");
    return lines;
  }

  std::string statics_summary(const StudyResults &results, const std::filesystem::path &folder)
  {
    constexpr std::size_t most_missed = 2;
    std::ostringstream out;
    print(out, heading(results.scene_name, results.purpose));
    bool has_constants = false;
    for (const auto &[what, value] : results.facts)
      if (!study::is_of_equation(what) && what != study::assumption_1_fact) // on the page
      {
        print(out, what + ": " + value);
        has_constants = true;
      }
    if (!has_constants)
      out << '\n';
    print(out, results.decisive_error + " (compared with " + study::target_words(results) + ")");
    print_trends(out, results);
    out << '\n';
    for (const std::string &line : expectation_lines(results, most_missed))
      print(out, line);
    out << "report: " << (folder / "report.html").string() << "\n\n";
    print_answer(out, results);
    print_ranking(out, results);
    print_cheapest(out, results);
    if (std::all_of(results.advice.begin(), results.advice.end(),
                    [](const study::Advice &advice) { return advice.choices.empty(); }))
      print_estimates(out, results);
    return out.str();
  }
} // namespace plumbline::report
