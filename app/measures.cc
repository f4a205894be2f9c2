#include "measures.h"

#include "base/error.h"

#include <algorithm>

namespace plumbline::app
{
  scene::Scene read_alone(const MeasureOptions &options)
  {
    auto overrides = options.overrides;
    if (!options.methods.empty())
      overrides.push_back({"Methods/names", options.methods});
    scene::Scene scene = scene::read_scene(options.scene_file, overrides);
    scene.reference.method.reset();
    scene.reference.estimate = scene::Estimate::none;
    return scene;
  }

  std::filesystem::path output_folder(const MeasureOptions &options, const scene::Scene &scene)
  {
    return options.output.empty() ? std::filesystem::path("results") / scene.name
                                  : std::filesystem::path(options.output);
  }

  meshfree::Rule find_rule(const std::string &name)
  {
    std::string known;
    for (const meshfree::Rule &rule : meshfree::rules())
    {
      if (rule.name == name)
        return rule;
      known += (known.empty() ? "" : ", ") + rule.name;
    }
    throw InputError("Methods/names = '" + name +
                     "' is no meshfree rule, but cracks are open to those alone (Galerkin "
                     "fields would need jumps); take one of " +
                     known);
  }

  void for_each_level(
      const scene::Scene &scene, unsigned int n_levels,
      const std::function<void(const problem::Series &, const problem::Level &, bool is_finest)> &visit,
      const ShouldStop &should_stop)
  {
    for (const auto &series : scene.study.series)
    {
      const std::size_t n_all = series.levels.size(),
                        n = n_levels == 0 ? n_all : std::min<std::size_t>(n_levels, n_all);
      for (std::size_t level = 0; level < n; ++level)
      {
        if (should_stop && should_stop())
          return;
        visit(series, series.levels[level], level + 1 == n);
      }
    }
  }

  ShouldStop noting(const ShouldStop &should_stop, bool &is_complete)
  {
    return [should_stop, &is_complete]
    {
      is_complete = is_complete && !(should_stop && should_stop());
      return !is_complete;
    };
  }
} // namespace plumbline::app
