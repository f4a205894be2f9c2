#include "report/maps.h"
#include "report/page_parts.h"
#include "report/report_parts.h"
#include "study/solution_record.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <utility>

namespace plumbline::report::page
{
  namespace
  {
    /// With more charts than this the page shows the first of a kind large and the rest small.
    constexpr std::size_t n_large = 6;

    /// The names of kinds in the template of charts.
    struct Group
    {
      ChartKind kind;
      const char *name;
      bool is_minor; ///< folded, all of them small
    };

    const Group groups[] = {
        {ChartKind::work_precision, "work", false}, {ChartKind::convergence, "convergence", false},
        {ChartKind::solution, "solution", false},   {ChartKind::error_map, "maps", false},
        {ChartKind::memory, "memory", true},        {ChartKind::pairs, "pairs", true},
        {ChartKind::iterations, "iterations", true}};

    /// What is in no method's work: meshes, and cells of nodes, of the dearest level.
    std::string geometry_words(const study::StudyResults &results)
    {
      double of_mesh = 0, of_nodes = 0;
      for (const study::Record &run : results.records)
      {
        double &most = run.key.family == study::MethodFamily::meshfree ? of_nodes : of_mesh;
        most = std::max(most, study::geometry_seconds(run));
      }
      std::string text;
      if (of_mesh > 0)
        text = "the mesh of Galerkin methods, up to " + rounded_seconds(of_mesh) + " a level";
      if (of_nodes > 0)
        text += (text.empty() ? "" : "; ") +
                ("mesh and cells of meshfree nodes, up to " + rounded_seconds(of_nodes)) +
                " a level";
      return text;
    }
  } // namespace

  Data chart_groups(const study::StudyResults &results, const std::filesystem::path &dir)
  {
    const std::vector<Chart> all = list_charts(results);
    const std::string main_problem = telling_problem(results);
    std::vector<Case> of_overall;
    for (const Case &one : cases(results))
      if (one.problem == main_problem)
        of_overall.push_back(one);
    const bool are_many = all.size() > n_large;

    Data data = Data::object();
    std::size_t number = 0;
    for (const Group &group : groups)
    {
      Data large = Data::array(), small = Data::array();
      for (const Chart &chart : all)
      {
        if (chart.kind != group.kind)
          continue;
        // With one series the overall chart is this very picture.
        if (group.kind == ChartKind::work_precision && !is_overall(chart) &&
            of_overall.size() == 1 && chart.problem == of_overall.front().problem &&
            is_overall(all.front()))
          continue;
        const bool is_main = group.kind == ChartKind::error_map ||
                             group.kind == ChartKind::solution || chart.problem == main_problem;
        const bool is_large = !group.is_minor && (!are_many || (is_main && large.empty()));
        (is_large ? large : small)
            .push_back(figure({dir / "charts" / (chart.name + ".svg"),
                               "c" + std::to_string(number++) + "-", chart.title, "", "Data",
                               "charts/" + chart.name + ".csv", is_large,
                               "call plumbline report on this folder"}));
      }
      const std::size_t n_small = small.size();
      if (large.empty() && small.empty())
        data[group.name] = Data();
      else
        data[group.name] = {{"large", std::move(large)},
                            {"charts", std::move(small)},
                            {"n_small", n_small == 0 ? Data() : Data(n_small)},
                            {"is_open", n_small <= n_large},
                            {"is_curve", !results.maps.empty() && is_curve(results.maps.front())},
                            {"geometry", geometry_words(results)}};
    }
    return data;
  }
} // namespace plumbline::report::page
