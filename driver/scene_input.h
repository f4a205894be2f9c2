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
    unsigned int n_jobs = 1;            ///< processes that share the work; in `sample` per rank
    unsigned int n_threads = 0;         ///< of each process; 0: all cores, divided among them
    bool is_worker = false;             ///< this process is a worker
    std::vector<std::string> arguments; ///< of the command, passed on to the workers
  };

  /// The scene with its overrides, and names of methods as the methods write them.
  scene::Scene read_scene(const SceneOptions &options);

  /// Prints a note on standard error.
  void note(const std::string &text);

  /// The folder for results.
  std::filesystem::path output_folder(const SceneOptions &options, const scene::Scene &scene);
} // namespace plumbline::driver
