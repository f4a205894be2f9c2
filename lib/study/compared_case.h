#pragma once

#include "study/analysis.h"
#include "study/results.h"

#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace plumbline::study
{
  /// A case of a level in one or three dimensions, and the averages over cells that its solutions
  /// are compared with. (Those of a rank without cells are empty.)
  template <class Problem>
  struct ComparedCase
  {
    std::string name;
    Problem problem;
    std::optional<std::vector<double>> exact = {}, local = {}, reference = {};

    /// use(target, averages) for each that there is.
    template <class Use>
    void for_each_target(const Use &use) const
    {
      for (const auto &[target, averages] :
           {std::pair(scene::Target::exact, &exact), std::pair(scene::Target::local, &local),
            std::pair(scene::Target::reference, &reference)})
        if (*averages)
          use(target, **averages);
    }

    /// Those of the error that is drawn, if any.
    const std::optional<std::vector<double>> &drawn() const { return exact ? exact : reference; }
  };

  /// The cases of a scene at a level.
  /// @param make       (case index, cases before it) -> problem
  /// @param average    (field, problem) -> averages
  /// @param reference  (case) -> averages of the reference
  template <class Problem, class Make, class Average, class Reference>
  std::vector<ComparedCase<Problem>> open_cases(const scene::Scene &scene, const Make &make,
                                                const Average &average, const Reference &reference)
  {
    std::vector<ComparedCase<Problem>> cases;
    const auto names = scene.problem.case_names();
    for (unsigned int c = 0; c < names.size(); ++c)
    {
      ComparedCase<Problem> one{names[c], make(c, cases)};
      if (one.problem.solution)
        one.exact = average(*one.problem.solution, one.problem);
      if (one.problem.local_solution)
        one.local = average(*one.problem.local_solution, one.problem);
      if (scene.reference.method)
        one.reference = reference(one);
      cases.push_back(std::move(one));
    }
    return cases;
  }

  /// Whether errors of a solution are drawn: those of the last case and the first series.
  bool is_drawn(const Place &place, const Record &run);

  /// Add a picture of a solution to the results.
  void add_map(const Place &place, ErrorMap map, const Record &run);

  /// Add the grid of a solution in space, unless a method of the same family has one.
  void add_grid(const Place &place, const std::function<SolutionGrid()> &make, const Record &run);
} // namespace plumbline::study
