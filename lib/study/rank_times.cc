#include "study/rank_times.h"

#include "base/error.h"
#include "method/discretisation_in_space.h"
#include "scene/problem.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace plumbline::study
{
  namespace
  {
    /// A method on a few cells of a level: its stencil is that of the whole box.
    struct Sample
    {
      algebra::Stencil stencil;
      int n_fewer; ///< nodes than cells along an axis
      algebra::OperatorBackend backend;
    };

    Sample sample_of(const scene::Scene &scene, const Method &method, const problem::Level &level)
    {
      constexpr int n_cells = 4;
      scene::Scene small = scene;
      geometry::Cuboid box = scene.domain.cubes(level.h).cuboid();
      for (unsigned int d = 0; d < 3; ++d)
        box.upper[d] = box.lower[d] + n_cells * level.h;
      small.domain.solid = {{box}, {}};
      const problem::Problem<3> problem = scene::make_problem_in_space(small, 0, level);
      const auto discretisation = method.discretise_in_space(problem);
      const auto waves = discretisation->waves();
      const double n_nodes =
          static_cast<double>(discretisation->n_unknowns()) / scene.n_components();
      return {waves->stiffness, n_cells - static_cast<int>(std::lround(std::cbrt(n_nodes))),
              problem.settings.solver.operator_backend};
    }

    TimeOfLevel predict(const scene::Scene &scene, const Method &method, const std::string &series,
                        const problem::Level &level, unsigned int n_ranks,
                        const algebra::Rates &rates)
    {
      const Sample sample = sample_of(scene, method, level);
      const std::array<int, 3> n_cells = scene.domain.cubes(level.h).n_cells();
      std::array<int, 3> n = n_cells;
      for (int &length : n)
        length -= sample.n_fewer;
      auto layout = algebra::SlabLayout::of(sample.stencil, n, n_ranks, n_cells[2]);
      layout.backend = sample.backend;
      TimeOfLevel time{method.name(), series, level, layout, {}, {}, {}};
      time.apply = operator_time(layout, sample.stencil, rates);
      if (!scene.time.is_dynamic())
      {
        time.precondition = preconditioner_time(layout, rates);
        time.iteration = iteration_time(layout, sample.stencil, rates);
      }
      return time;
    }
  } // namespace

  std::vector<TimeOfLevel> predict_times(const scene::Scene &scene, const Methods &methods,
                                         unsigned int n_levels, unsigned int n_ranks,
                                         const algebra::Rates &rates)
  {
    const Methods repeated = repeated_by_ranks(scene, methods);
    std::vector<TimeOfLevel> found;
    for (const auto &method : methods)
    {
      if (std::find(repeated.begin(), repeated.end(), method) != repeated.end())
        continue;
      if (!scene.domain.cubes(scene.study.series.front().levels.front().h).is_box())
        continue; // the model has one sine transform
      for (const auto &series : scene.study.series)
        for (std::size_t i = 0; i < series.levels.size() && (n_levels == 0 || i < n_levels); ++i)
          try
          {
            found.push_back(predict(scene, *method, series.name, series.levels[i], n_ranks, rates));
          }
          catch (const NumericalError &) // no row: a finding of the run
          {
          }
    }
    return found;
  }
} // namespace plumbline::study
