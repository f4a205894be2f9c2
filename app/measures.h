#pragma once

#include "meshfree/rules/rules.h"
#include "scene/scene.h"

#include <filesystem>
#include <functional>

// What the commands that measure operators, and solve nothing, have in common.
namespace plumbline::app
{
  struct MeasureOptions
  {
    std::string scene_file, output; ///< output empty: results/NAME of the scene
    std::vector<scene::Override> overrides;
    std::string methods; ///< comma separated, instead of the scene's
    unsigned int n_levels = 0;
    bool quiet = false, json = false;
  };

  /// The scene with its overrides, without a reference: nothing is held against one.
  scene::Scene read_alone(const MeasureOptions &options);

  std::filesystem::path output_folder(const MeasureOptions &options, const scene::Scene &scene);

  /// @throws InputError  no meshfree rule; cracks are open to those alone
  meshfree::Rule find_rule(const std::string &name);

  using ShouldStop = std::function<bool()>; ///< empty: never

  /// The first n_levels of each series, coarse to fine; 0: all.
  /// @param should_stop  asked before each
  void for_each_level(
      const scene::Scene &scene, unsigned int n_levels,
      const std::function<void(const scene::Series &, const scene::Level &, bool is_finest)> &visit,
      const ShouldStop &should_stop = {});

  /// The same, noting that it said so, and saying so from then on.
  /// @param is_complete  outlives it
  ShouldStop noting(const ShouldStop &should_stop, bool &is_complete);
} // namespace plumbline::app
