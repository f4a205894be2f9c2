#include "study/tip_forces.h"

#include "base/number_text.h"
#include "study/solution_record.h"
#include "study/trend.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace plumbline::study
{
  namespace
  {
    const std::string net_force = "the surface terms exert a net force at the tip";

    /// Of one method about one tip, coarse to fine.
    struct History
    {
      std::vector<double> horizons, forces;
      double over_root = 0; ///< at the last level
      bool is_rounding = false;
    };

    /// Problem, series, and the tip as it is printed: it has its place on all levels.
    using Place = std::tuple<std::string, std::string, std::string>;

    std::string words_of(const method::TipForce &force)
    {
      return "(" + base::to_text(force.tip[0], 4) + ", " + base::to_text(force.tip[1], 4) + ")";
    }

    bool tends_to_a_root(const History &history)
    {
      constexpr std::size_t n_levels = 3;
      constexpr double tolerance = .15; // of the power
      if (history.is_rounding || history.forces.size() < n_levels)
        return false;
      const auto last = [](const std::vector<double> &all)
      { return std::vector<double>(all.end() - n_levels, all.end()); };
      const Slope slope = fit_slope(last(history.horizons), last(history.forces));
      return std::abs(slope.value - .5) < tolerance;
    }
  } // namespace

  std::vector<std::string> tip_force_findings(const StudyResults &results)
  {
    constexpr double rounding = 1e-6; // of the sum of the forces' norms
    if (results.regime != scene::Regime::delta)
      return {};
    std::map<Place, std::map<std::string, History>> all;
    for (const Record &run : results.records)
      for (const method::TipForce &force : tip_forces_of(run))
      {
        History &history = all[{run.key.problem, run.key.series, words_of(force)}][run.key.method];
        history.horizons.push_back(run.key.horizon);
        history.forces.push_back(force.norm);
        history.over_root = force.over_root;
        history.is_rounding = history.is_rounding || force.norm <= rounding * force.sum_of_norms;
      }
    std::vector<std::string> findings;
    for (const auto &[place, methods] : all)
    {
      const auto &[problem, series, tip] = place;
      std::string list;
      for (const auto &[method, history] : methods)
        if (tends_to_a_root(history))
          list += (list.empty() ? "" : ", ") + method +
                  " F = " + base::to_text(history.over_root, 3) + " sqrt(horizon)";
      if (!list.empty())
        findings.push_back(problem + ", " + series + ": " + net_force + " " + tip +
                           "; the order tends to 1/2 (" + list +
                           "). Material/surface terms = consistent or none avoids it");
    }
    return findings;
  }

  void warn_of_tip_forces(StudyResults &results)
  {
    std::vector<std::string> &warnings = results.warnings;
    warnings.erase(std::remove_if(warnings.begin(), warnings.end(),
                                  [](const std::string &text)
                                  { return text.find(net_force) != std::string::npos; }),
                   warnings.end());
    for (const std::string &finding : tip_force_findings(results))
      warnings.push_back(finding);
  }
} // namespace plumbline::study
