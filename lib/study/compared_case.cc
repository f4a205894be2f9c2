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

  void add_blocks(const Place &place, const std::function<SolutionBlocks()> &make,
                  const Record &run)
  {
    StudyResults &results = place.results();
    const auto is_of_family = [&](const SolutionBlocks &one)
    {
      return std::any_of(results.records.begin(), results.records.end(),
                         [&](const Record &record) {
                           return record.key.method == one.method &&
                                  record.key.family == run.key.family;
                         });
    };
    if (std::any_of(results.solution_blocks.begin(), results.solution_blocks.end(), is_of_family))
      return;
    SolutionBlocks blocks = make();
    blocks.method = run.key.method;
    blocks.problem = run.key.problem;
    blocks.series = run.key.series;
    results.solution_blocks.push_back(std::move(blocks));
  }
} // namespace plumbline::study
