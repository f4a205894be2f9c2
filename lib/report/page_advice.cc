#include "report/page_parts.h"

#include "report/formats.h"
#include "study/trend.h"

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

    /// Others that cost the same.
    std::string tie(const study::Choice &choice)
    {
      std::string names;
      for (const std::string &method : choice.tied)
        join(names, escape_html(method));
      return names.empty() ? "" : "<small> a tie with " + names + "</small>";
    }

    /// One row for each run; neighbouring targets that it serves stand together.
    std::string rows(const std::vector<study::Choice> &choices,
                     const std::vector<MethodName> &methods)
    {
      std::string text;
      for (std::size_t first = 0, last = 0; first < choices.size(); first = ++last)
      {
        while (last + 1 < choices.size() && is_same_run(choices[first], choices[last + 1]))
          ++last;
        const study::Choice &choice = choices[first];
        text += "<tr><td>error ≤ " + short_power(choice.target) +
                (last > first ? " … " + short_power(choices[last].target) : "") + "</td><td>→ " +
                marker(style_of(methods, choice.method)) + "<b>" + escape_html(choice.method) +
                "</b>" + tie(choice) + "</td><td>h = " + rounded(choice.h) +
                "</td><td title=\"its error is " + rounded_error(choice.error) + "\">" +
                rounded_seconds(choice.seconds) + "</td></tr>\n";
      }
      return text;
    }

    std::string card(const study::Results &results, const study::Advice &advice,
                     const std::vector<MethodName> &methods)
    {
      const Case place{advice.problem, advice.series, ""};
      std::string text = "<div class=\"card\"><h3>" + escape_html(place.title()) + "</h3>\n";
      if (!advice.choices.empty())
        text += "<table>" + rows(advice.choices, methods) + "</table>\n";
      else
      {
        const bool has_good =
            std::any_of(methods.begin(), methods.end(),
                        [&](const MethodName &method)
                        {
                          const study::Trend *trend = decisive_trend(results, method.name, place);
                          return trend != nullptr && trend->outcome == study::Outcome::converges;
                        });
        text += has_good ? "<p>No converging method is accurate enough yet; refine.</p>\n"
                         : "<p>No method of this run is known to converge.</p>\n";
      }
      std::string stalling;
      for (const std::string &method : advice.stalling)
        join(stalling, escape_html(method));
      if (!stalling.empty())
        text += "<p class=\"avoid\">✗ stalls: " + stalling + "</p>\n";
      std::string blind;
      for (const std::string &method : advice.field_only)
        join(blind, escape_html(method));
      if (!blind.empty())
        text += "<p class=\"avoid\">✗ right for this field only: " + blind + "</p>\n";
      return text + "</div>\n";
    }

    /// How often a method has each outcome, over the cases of the cards.
    struct Tally
    {
      std::string method;
      std::size_t n = 0, n_converge = 0, n_field_only = 0, n_stall = 0, n_fail = 0;
      std::size_t n_levels = study::levels_for_verdict; ///< the fewest of an undecided trend
    };

    std::vector<Tally> tally(const study::Results &results, const std::vector<MethodName> &methods)
    {
      std::vector<Tally> tallies;
      for (const MethodName &method : methods)
      {
        Tally one;
        one.method = method.name;
        for (const study::Advice &advice : results.advice)
          if (const study::Trend *trend =
                  decisive_trend(results, method.name, Case{advice.problem, advice.series, ""}))
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

    /// The answer where only the horizon varies: whose largest error is least.
    std::string ranking(const study::Results &results, const std::vector<MethodName> &methods)
    {
      std::vector<std::pair<double, std::string>> largest;
      for (const MethodName &method : methods)
      {
        double error = -1;
        for (const study::Run &run : results.runs)
          if (run.method == method.name)
            error = std::max(error, decisive_error(results, run)); // NaN loses
        if (error >= 0)
          largest.emplace_back(error, escape_html(method.name));
      }
      std::stable_sort(largest.begin(), largest.end(),
                       [](const auto &a, const auto &b) { return a.first < b.first; });
      std::string list;
      for (const auto &[error, name] : largest)
        join(list, name + " (" + rounded_error(error) + ")");
      return "<p class=\"answer\"><b>Largest error over all horizons and problems, the best method "
             "first: " +
             list + ".</b></p>\n";
    }

    /// The answer for a reader of nothing else: each method in the worst class that it belongs to.
    /// @param is_own  held against own finest levels: whether there is a limit, not which
    std::string summary(const study::Results &results, const std::vector<MethodName> &methods,
                        bool is_own = false)
    {
      std::string good, bad, mixed, blind, failed, open;
      std::map<std::size_t, std::string> too_few; // by the number of levels there are
      for (const Tally &one : tally(results, methods))
      {
        const std::string name = escape_html(one.method);
        if (one.n_converge == one.n)
          join(good, name);
        else if (one.n_stall == one.n)
          join(bad, name);
        else if (one.n_stall > 0)
          join(mixed,
               name + " (" + std::to_string(one.n_stall) + " of " + std::to_string(one.n) + ")");
        else if (one.n_field_only > 0)
          join(blind, name);
        else if (one.n_fail > 0)
          join(failed, name);
        else if (one.n_levels < study::levels_for_verdict)
          join(too_few[one.n_levels], name);
        else
          join(open, name);
      }
      const bool is_one = results.advice.size() == 1;
      const std::string n_cases = std::to_string(results.advice.size());
      const std::string everywhere = is_one ? "" : " in all " + n_cases + " cases";
      const bool is_open = !open.empty() || !too_few.empty();
      std::string text;
      if (!good.empty())
        text = std::string("<b>✓ ") + (is_own ? "Have a limit" : "Converge") +
               (is_one ? ": " : " everywhere: ") + good + ".</b>";
      else if (!is_open)
        text = "<b>No method converges" + everywhere + ".</b>";
      else if (!bad.empty() || !mixed.empty() || !blind.empty())
        text = "<b>No method is known yet to converge" + everywhere + ".</b>";
      else
        text = "<b>?&nbsp;Not decided yet" + everywhere + ".</b>";
      if (!bad.empty())
        text += (is_one ? " <b class=\"no\">✗ Stall, however fine the mesh: "
                        : " <b class=\"no\">✗ Stall everywhere, however fine the mesh: ") +
                bad + ".</b>";
      if (!mixed.empty())
        text += " <b class=\"no\">✗ Stall in some cases: " + mixed + ".</b>";
      if (!blind.empty())
        text += std::string(" <b class=\"no\">✗ ") +
                (is_own ? "Have a limit" : "Right for this field only") +
                ", their second moments are wrong: " + blind + ".</b>";
      if (!failed.empty())
        text += " –&nbsp;No solution at some level: " + failed + ".";
      for (const auto &[n_levels, names] : too_few)
        text += " ?&nbsp;Not decided, " + std::to_string(n_levels) + " of the " +
                std::to_string(study::levels_for_verdict) +
                " levels that a verdict needs: " + names + ".";
      if (!open.empty())
        text += " ?&nbsp;Undecided" + std::string(is_one ? "" : " in some cases") +
                ", one finer level would help: " + open + ".";
      return "<p class=\"answer\">" + text + "</p>\n";
    }
  } // namespace

  std::string advice(const study::Results &results)
  {
    if (results.advice.empty())
      return "";
    const std::vector<MethodName> names = methods(results);
    if (study::is_against(results.decisive_error, scene::Target::finest))
      return section("advice", "Which method?",
                     summary(results, names, true) +
                         "<p class=\"soft\">Each method is held against its own finest level. How "
                         "near it is to itself does not make it better than another, so none is "
                         "advised: for that take a case with a known solution, or a reference "
                         "(Study/decisive error).</p>\n");
    if (results.regime ==
        scene::Regime::horizon) // nothing is refined here, so nothing converges or stalls
      return section("advice", "Which method?", ranking(results, names));
    std::string open, more;
    for (std::size_t i = 0; i < results.advice.size(); ++i)
      (i < n_open_cards ? open : more) += card(results, results.advice[i], names);
    std::string text =
        summary(results, names) +
        "<p class=\"soft\">The cheapest run for an error of that size: method, mesh "
        "size, CPU time of setup and solve (the best of three below 0.02 s). What costs at "
        "most 20 % or 50 µs more than the cheapest is a tie, of which the method with the fewest "
        "unknowns comes first. Only methods that converge, and whose second moments are not known "
        "to be wrong, are named.</p>\n<div class=\"cards\">\n" +
        open + "</div>\n";
    if (!more.empty())
      text += folded(std::to_string(results.advice.size() - n_open_cards) + " more cases",
                     "<div class=\"cards\">\n" + more + "</div>\n");
    return section("advice", "Which method?", text);
  }
} // namespace plumbline::report::page
