// Which method to take.
#include "base/number_text.h"
#include "report/counted.h"
#include "report/statics_view.h"
#include "scene/choices.h"
#include "study/cheapest.h"
#include "study/target_words.h"
#include "study/trend.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

namespace plumbline::report
{
  namespace
  {
    constexpr int n_digits = 3; // on the terminal

    void join(std::string &list, const std::string &item)
    {
      list += (list.empty() ? "" : ", ") + item;
    }

    bool is_same_run(const study::Choice &a, const study::Choice &b)
    {
      return a.method == b.method && a.h == b.h && a.error == b.error && a.tied == b.tied;
    }

    std::string joined(const std::vector<std::string> &names)
    {
      std::string list;
      for (const std::string &name : names)
        join(list, name);
      return list;
    }

    /// One row for each run; neighbouring targets that it serves stand together.
    Table choice_table(const std::vector<study::Choice> &choices,
                       const std::vector<MethodName> &methods, const std::string &unit)
    {
      Table table;
      table.columns = {"target", "method", "h", "CPU time"};
      for (std::size_t first = 0, last = 0; first < choices.size(); first = ++last)
      {
        while (last + 1 < choices.size() && is_same_run(choices[first], choices[last + 1]))
          ++last;
        const study::Choice &choice = choices[first];
        Cell method = text_cell(choice.method),
             seconds = text_cell(rounded_seconds(choice.seconds));
        method.is_strong = true;
        method.marker = page::marker(style_of(methods, choice.method));
        if (!choice.tied.empty())
          method.notes = {"a tie with " + joined(choice.tied)};
        seconds.hint = "its error is " + rounded_error(choice.error) + " in the " + unit;
        table.rows.push_back(
            {text_cell("relative error ≤ " + short_power(choice.target) +
                       (last > first ? " … " + short_power(choices[last].target) : "")),
             method, text_cell("h = " + rounded(choice.h)), seconds});
      }
      return table;
    }

    /// Without a word where it is not known that a method converges.
    Card card(const StudyResults &results, const study::Advice &advice,
              const std::vector<MethodName> &methods)
    {
      const Case place{advice.problem, advice.series, ""};
      Card card{place.title(), choice_table(advice.choices, methods, unit_of_errors(results))};
      const auto converges = [&](const MethodName &method)
      {
        const study::Trend *trend = decisive_trend(results, method.name, place);
        return trend != nullptr && trend->outcome == study::Outcome::converges;
      };
      if (advice.choices.empty() && std::any_of(methods.begin(), methods.end(), converges))
        card.words = "No converging method is accurate enough yet; refine.";
      if (!advice.stalling.empty())
        card.warnings.push_back("✗ stalls: " + joined(advice.stalling));
      if (!advice.field_only.empty())
        card.warnings.push_back("✗ right for this field only: " + joined(advice.field_only));
      return card;
    }

    /// How often a method has each outcome, over the cases of the cards.
    struct Tally
    {
      std::string method;
      std::size_t n = 0, n_converge = 0, n_field_only = 0, n_stall = 0, n_fail = 0;
      std::size_t n_levels = study::levels_for_verdict; ///< the fewest of an undecided trend
    };

    /// Without advice on costs, as for weights of another code, all cases.
    std::vector<Case> judged_cases(const StudyResults &results)
    {
      if (results.advice.empty())
        return cases(results);
      std::vector<Case> places;
      for (const study::Advice &advice : results.advice)
        places.push_back({advice.problem, advice.series, ""});
      return places;
    }

    std::vector<Tally> tally(const StudyResults &results, const std::vector<Case> &places,
                             const std::vector<MethodName> &methods)
    {
      std::vector<Tally> tallies;
      for (const MethodName &method : methods)
      {
        Tally one;
        one.method = method.name;
        for (const Case &place : places)
          if (const study::Trend *trend = decisive_trend(results, method.name, place))
          {
            ++one.n;
            one.n_converge += trend->outcome == study::Outcome::converges ? 1 : 0;
            one.n_stall += trend->outcome == study::Outcome::stalls ? 1 : 0;
            one.n_fail += trend->outcome == study::Outcome::failed ? 1 : 0;
            one.n_field_only += trend->outcome == study::Outcome::field_only ? 1 : 0;
            if (trend->outcome == study::Outcome::undecided)
              one.n_levels = std::min(one.n_levels, trend->x.size());
          }
        if (one.n > 0)
          tallies.push_back(one);
      }
      return tallies;
    }

    /// Of each case one; none where they say no more than that no method is known to converge.
    std::vector<Card> cards(const StudyResults &results, const std::vector<MethodName> &methods)
    {
      std::vector<Card> all;
      bool says_something = false;
      for (const study::Advice &advice : results.advice)
      {
        Card &one = all.emplace_back(card(results, advice, methods));
        says_something = says_something || !one.table.rows.empty() || !one.words.empty() ||
                         !one.warnings.empty();
        if (one.table.rows.empty() && one.words.empty())
          one.words = "No method of this run is known to converge.";
      }
      return says_something ? all : std::vector<Card>();
    }

    /// Methods with their largest errors, the smallest first.
    std::string ranking(const StudyResults &results, const std::vector<MethodName> &methods)
    {
      std::vector<std::pair<double, std::string>> largest;
      for (const MethodName &method : methods)
      {
        double error = -1;
        for (const study::Record &run : results.records)
          if (run.key.method == method.name)
            error = std::max(error, decisive_error(results, run)); // NaN loses
        if (error >= 0)
          largest.emplace_back(error, method.name);
      }
      std::stable_sort(largest.begin(), largest.end(),
                       [](const auto &a, const auto &b) { return a.first < b.first; });
      std::string list;
      for (const auto &[error, name] : largest)
        join(list, name + " (" + rounded_error(error) + ")");
      return list;
    }

    /// The answer for a reader of nothing else: each method in the worst class that it belongs to.
    /// @param is_own  held against own finest levels: whether there is a limit, not which
    std::vector<Statement> statements(const StudyResults &results,
                                      const std::vector<Tally> &tallies, std::size_t n_cases,
                                      bool is_own)
    {
      std::string good, bad, mixed, blind, failed, open;
      std::map<std::size_t, std::string> too_few; // by the number of levels there are
      for (const Tally &one : tallies)
        if (one.n_converge == one.n)
          join(good, one.method);
        else if (one.n_stall == one.n)
          join(bad, one.method);
        else if (one.n_stall > 0)
          join(mixed, one.method + " (" + std::to_string(one.n_stall) + " of " +
                          std::to_string(one.n) + ")");
        else if (one.n_field_only > 0)
          join(blind, one.method);
        else if (one.n_fail > 0)
          join(failed, one.method);
        else if (one.n_levels < study::levels_for_verdict)
          join(too_few[one.n_levels], one.method);
        else
          join(open, one.method);
      const bool is_one = n_cases == 1, is_open = !open.empty() || !too_few.empty();
      const bool is_other = !bad.empty() || !mixed.empty() || !blind.empty();
      const std::string everywhere = is_one ? "" : " everywhere",
                        in_all = is_one ? "" : " in all " + std::to_string(n_cases) + " cases",
                        moments = results.regime == scene::Regime::delta
                                      ? "their second moments are"
                                      : "the moments of their weights are";
      std::vector<Statement> all;
      const auto say = [&](const std::string &what, const std::string &names, bool is_bad = false)
      {
        if (!names.empty())
          all.push_back({what + ": " + names + ".", is_bad});
      };
      say((is_own ? "✓ Have a limit" : "✓ Converge") + everywhere, good);
      if (good.empty() && !is_open)
        all.push_back({"No method converges" + in_all + "."});
      else if (good.empty() && is_other)
        all.push_back({"No method is known yet to converge" + in_all + "."});
      say("✗ Stall" + everywhere + ", however fine the mesh", bad, true);
      say("✗ Stall in some cases", mixed, true);
      say((is_own ? "✗ Have a limit, " : "✗ Right for this field only, ") + moments + " wrong",
          blind, true);
      say("– No solution at some level", failed);
      const bool is_undecided = good.empty() && is_open && !is_other;
      for (const auto &[n_levels, names] : too_few)
        say("? Not decided" + (is_undecided ? " yet" + in_all : "") + ", " +
                std::to_string(n_levels) + " of the " + std::to_string(study::levels_for_verdict) +
                " levels that a verdict needs",
            names);
      say(std::string("? Undecided") + (is_one ? "" : " in some cases") +
              ", one finer level would help",
          open);
      return all;
    }

    /// Of solutions by the reference, or else by Galerkin methods, at the finest levels of the
    /// first problems and series.
    void add_estimates(const StudyResults &results, std::vector<std::string> &lines)
    {
      constexpr std::size_t most = 2;
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
          lines.push_back(
              "Estimated error of " + one->method + ", " + one->problem + ", " + one->series +
              ", h = " + base::to_text(one->h, n_digits) + ": " +
              base::to_text(one->estimate, n_digits) + " (averages, L2)" +
              (one->field_estimate > 0
                   ? ", " + base::to_text(one->field_estimate, n_digits) + " (field, L2)"
                   : "") +
              "; " + counted(one->certified_digits, "certified digit"));
    }

    /// Of the first problems and series.
    void add_cheapest(const StudyResults &results, std::vector<std::string> &lines)
    {
      constexpr std::size_t most = 2, most_targets = 2;
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
          lines.push_back(line);
        }
    }
  } // namespace

  void add_advice(const StudyResults &results, View &view)
  {
    const std::vector<MethodName> names = methods(results);
    const std::vector<Case> places = judged_cases(results);
    const std::vector<Tally> tallies = tally(results, places, names);
    const std::string target = study::target_words(results);
    const bool is_own = study::is_against(results.decisive_error, scene::Target::finest);
    add_cheapest(results, view.advice);
    if (view.advice.empty())
      add_estimates(results, view.advice);
    if (tallies.empty())
      return;
    if (!is_own && is_without_limit(results.regime)) // nothing converges or stalls
    {
      const std::string over =
          results.variable.empty() ? "horizons" : "values of " + results.variable;
      if (const std::string list = ranking(results, names); !list.empty())
        view.statements = {{"Largest error over all " + over +
                            " and problems, the best method first: " + list + "."}};
      view.remarks = {"Methods are compared with " + target + "."};
      return;
    }
    if (study::is_between_models(results))
    {
      view.statements = {{"? No method is called convergent or not: at a fixed horizon errors "
                          "against " +
                          target +
                          " tend to the difference of the nonlocal from the local solution, "
                          "whatever the method."}};
      view.remarks = {"Compare methods with exact, reference or own finest level (Study/decisive "
                      "error), or decrease the horizon with h (Study/regime = delta or delta-m)."};
      return;
    }
    view.statements = statements(results, tallies, places.size(), is_own);
    if (is_own)
      view.remarks = {"Each method is compared with its own finest level. How near it is to itself "
                      "does not make it better than another, so none is advised: for that take a "
                      "case with a known solution, or a reference (Study/decisive error)."};
    else
      view.cards = cards(results, names);
    if (!view.cards.empty())
      view.remarks.push_back(
          "The cheapest run for an error of that size, relative to " +
          study::relative_to(results.decisive_error) + ", against " + target +
          ": method, mesh size, CPU time of setup and solve (the best of three below 0.02 s). What "
          "costs at most 20 % or 0.15 ms more than the cheapest is a tie, of which the method with "
          "the fewest unknowns comes first. Only methods that converge, and whose moments are not "
          "known to be wrong, are named.");
  }
} // namespace plumbline::report
