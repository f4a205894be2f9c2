#pragma once

#include "run_parts.h"
#include "scene/scene.h"

#include <filesystem>
#include <functional>
#include <vector>

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
} // namespace plumbline::app
