#include "report/page_parts.h"

#include "report/formats.h"
#include "study/cheapest.h"
#include "study/target_words.h"
#include "study/trend.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

namespace plumbline::report::page
{
  namespace
  {
    /// So many cards are seen at one glance; the others are folded.
    constexpr std::size_t n_open_cards = 6;

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
    Data rows(const std::vector<study::Choice> &choices, const std::vector<MethodName> &methods,
              const std::string &unit)
    {
      Data list = Data::array();
      for (std::size_t first = 0, last = 0; first < choices.size(); first = ++last)
      {
        while (last + 1 < choices.size() && is_same_run(choices[first], choices[last + 1]))
          ++last;
        const study::Choice &choice = choices[first];
        list.push_back({{"target", short_power(choice.target)},
                        {"last_target", last > first ? short_power(choices[last].target) : ""},
                        {"marker", marker(style_of(methods, choice.method))},
                        {"method", choice.method},
                        {"tied", joined(choice.tied)},
                        {"h", rounded(choice.h)},
                        {"error", rounded_error(choice.error)},
                        {"unit", unit},
                        {"seconds", rounded_seconds(choice.seconds)}});
      }
      return list;
    }

    Data card(const study::StudyResults &results, const study::Advice &advice,
              const std::vector<MethodName> &methods)
    {
      const Case place{advice.problem, advice.series, ""};
      const bool has_good =
          std::any_of(methods.begin(), methods.end(),
                      [&](const MethodName &method)
                      {
                        const study::Trend *trend = decisive_trend(results, method.name, place);
                        return trend != nullptr && trend->outcome == study::Outcome::converges;
                      });
      return {{"title", place.title()},
              {"has_choices", !advice.choices.empty()},
              {"choices", rows(advice.choices, methods, unit_of_errors(results))},
              {"has_good", has_good},
              {"stalling", joined(advice.stalling)},
              {"field_only", joined(advice.field_only)}};
    }

    /// How often a method has each outcome, over the cases of the cards.
    struct Tally
    {
      std::string method;
      std::size_t n = 0, n_converge = 0, n_field_only = 0, n_stall = 0, n_fail = 0;
      std::size_t n_levels = study::levels_for_verdict; ///< the fewest of an undecided trend
    };

    /// Without advice on costs, as for weights of another code, all cases.
    std::vector<Case> judged_cases(const study::StudyResults &results)
    {
      if (results.advice.empty())
        return cases(results);
      std::vector<Case> places;
      for (const study::Advice &advice : results.advice)
        places.push_back({advice.problem, advice.series, ""});
      return places;
    }

    std::vector<Tally> tally(const study::StudyResults &results, const std::vector<Case> &places,
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

    /// Whether it says more than that no method is known to converge.
    bool is_informative(const Data &card)
    {
      return card["has_choices"] || card["has_good"] ||
             !card["stalling"].get<std::string>().empty() ||
             !card["field_only"].get<std::string>().empty();
    }

    /// Methods with their largest errors, the smallest first.
    std::string ranking(const study::StudyResults &results, const std::vector<MethodName> &methods)
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
    Data summary(const study::StudyResults &results, const std::vector<MethodName> &methods,
                 bool is_own)
    {
      const std::vector<Case> places = judged_cases(results);
      std::string good, bad, mixed, blind, failed, open;
      std::map<std::size_t, std::string> too_few; // by the number of levels there are
      for (const Tally &one : tally(results, places, methods))
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
      Data few = Data::array();
      for (const auto &[n_levels, names] : too_few)
        few.push_back(
            {{"n_levels", n_levels}, {"n_needed", study::levels_for_verdict}, {"methods", names}});
      const bool is_one = places.size() == 1;
      const bool is_open = !open.empty() || !too_few.empty();
      const bool is_other = !bad.empty() || !mixed.empty() || !blind.empty();
      return {{"is_own", is_own},
              {"moments", results.regime == scene::Regime::delta
                              ? "their second moments are"
                              : "the moments of their weights are"},
              {"target", study::target_words(results)},
              {"is_one", is_one},
              {"everywhere", is_one ? "" : " in all " + std::to_string(places.size()) + " cases"},
              {"good", good},
              {"is_none", good.empty() && !is_open},
              {"is_none_yet", good.empty() && is_open && is_other},
              {"is_not_decided", good.empty() && is_open && !is_other},
              {"bad", bad},
              {"mixed", mixed},
              {"blind", blind},
              {"failed", failed},
              {"too_few", std::move(few)},
              {"open", open}};
    }
  } // namespace

  std::string ranking(const study::StudyResults &results)
  {
    return study::is_against(results.decisive_error, scene::Target::finest) ||
                   !is_without_limit(results.regime) // methods converge or stall
               ? ""
               : ranking(results, methods(results));
  }

  std::string ranked_over(const study::StudyResults &results)
  {
    return results.variable.empty() ? "horizons" : "values of " + results.variable;
  }

  Data advice(const study::StudyResults &results)
  {
    const std::vector<MethodName> names = methods(results);
    if (tally(results, judged_cases(results), names).empty())
      return {};
    const bool is_own = study::is_against(results.decisive_error, scene::Target::finest);
    if (!is_own && is_without_limit(results.regime)) // nothing converges or stalls
      return {{"ranking", ranking(results)},
              {"is_between_models", false},
              {"target", study::target_words(results)},
              {"over", ranked_over(results)},
              {"summary", Data()}};
    if (study::is_between_models(results))
      return {{"ranking", ""},
              {"is_between_models", true},
              {"target", study::target_words(results)},
              {"over", ""},
              {"summary", Data()}};
    Data cards = Data::array(), more = Data::array();
    for (std::size_t i = 0; i < results.advice.size() && !is_own; ++i)
      (i < n_open_cards ? cards : more).push_back(card(results, results.advice[i], names));
    const auto says_something = [](const Data &list)
    { return std::any_of(list.begin(), list.end(), is_informative); };
    if (!says_something(cards) && !says_something(more)) // the answer says it
      cards = more = Data::array();
    return {{"ranking", ""},
            {"is_between_models", false},
            {"target", study::target_words(results)},
            {"over", ""},
            {"summary", summary(results, names, is_own)},
            {"has_cards", !cards.empty()},
            {"relative_to", study::relative_to(results.decisive_error)},
            {"n_more", more.empty() ? Data() : Data(more.size())},
            {"cards", std::move(cards)},
            {"more", std::move(more)}};
  }
} // namespace plumbline::report::page
