#include "driver/scene_input.h"

#include "driver/methods.h"
#include "study/method_names.h"

#include <iostream>

namespace plumbline::driver
{
  scene::Scene read_scene(const SceneOptions &options)
  {
    auto overrides = options.overrides;
    if (!options.methods.empty())
      overrides.push_back({"Methods/names", options.methods});
    return study::with_names_of(scene::read_scene(options.scene_file, overrides), all_methods());
  }

  void note(const std::string &text)
  {
    std::cerr << "note: " << text << '\n';
  }

  std::filesystem::path output_folder(const SceneOptions &options, const scene::Scene &scene)
  {
    return options.output.empty() ? std::filesystem::path("results") / scene.name
                                  : std::filesystem::path(options.output);
  }
} // namespace plumbline::driver
