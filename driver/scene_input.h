#pragma once

#include "scene/scene.h"

#include <filesystem>
#include <string>
#include <vector>

namespace plumbline::driver
{
  /// Options of all commands that read a scene.
  struct SceneOptions
  {
    std::string scene_file, output; ///< output empty: results/NAME of the scene
    std::vector<scene::Override> overrides;
    std::string methods; ///< comma separated, instead of the scene's; empty: those
    unsigned int n_levels = 0;
    bool quiet = false, json = false;
    bool pdf = false; ///< charts as PDF, besides SVG
    // worker processes, see driver/jobs.h
    unsigned int n_jobs = 1;            ///< that share the work; of each rank in `sample`
    unsigned int n_threads = 0;         ///< of each process; 0: the machine's, shared among them
    bool is_worker = false;             ///< this is one
    std::vector<std::string> arguments; ///< of the command, which workers are given again
  };

  /// The scene with its overrides, and names of methods as the methods write them.
  scene::Scene read_scene(const SceneOptions &options);

  /// Prints a note on standard error.
  void note(const std::string &text);

  /// The folder for results.
  std::filesystem::path output_folder(const SceneOptions &options, const scene::Scene &scene);
} // namespace plumbline::driver
