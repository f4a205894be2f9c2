#pragma once

#include "run_parts.h"
#include "scene/scene.h"

#include <filesystem>
#include <functional>
#include <vector>

// What commands that read a scene have in common.
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

  /// The scene with its overrides, and names of methods as the methods write them.
  /// @param methods  comma separated, instead of the scene's; empty: those
  scene::Scene scene_of_file(const std::string &file, std::vector<scene::Override> overrides,
                             const std::string &methods = "");

  /// Without a reference: nothing is held against one.
  scene::Scene read_alone(const MeasureOptions &options);

  /// @param output  empty: results/NAME of the scene
  std::filesystem::path output_folder(const std::string &output, const scene::Scene &scene);
} // namespace plumbline::app
