#include "study/compared_case.h"

#include "study/solution_record.h"

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
} // namespace plumbline::study
