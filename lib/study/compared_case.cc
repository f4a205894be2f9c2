#include "study/compared_case.h"

#include "study/solution_record.h"

#include <algorithm>
#include <utility>

namespace plumbline::study
{
  bool is_drawn(const Place &place, const Record &run)
  {
    const scene::Scene &scene = place.scene();
    return run.key.problem == scene.problem.case_names().back() &&
           place.series().name == scene.study.series.front().name;
  }

  void add_map(const Place &place, ErrorMap map, const Record &run)
  {
    map.method = run.key.method;
    map.problem = run.key.problem;
    map.series = run.key.series;
    map.size = size_of(run);
    place.results().maps.push_back(std::move(map));
  }

  void add_grid(const Place &place, const std::function<SolutionGrid()> &make, const Record &run)
  {
    StudyResults &results = place.results();
    const auto is_of_family = [&](const SolutionGrid &one)
    {
      return std::any_of(results.records.begin(), results.records.end(),
                         [&](const Record &record) {
                           return record.key.method == one.method &&
                                  record.key.family == run.key.family;
                         });
    };
    if (std::any_of(results.solution_grids.begin(), results.solution_grids.end(), is_of_family))
      return;
    SolutionGrid grid = make();
    grid.method = run.key.method;
    grid.problem = run.key.problem;
    grid.series = run.key.series;
    results.solution_grids.push_back(std::move(grid));
  }
} // namespace plumbline::study
