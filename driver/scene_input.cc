#include "driver/scene_input.h"

#include "driver/methods.h"
#include "study/method_names.h"

namespace plumbline::driver
{
  scene::Scene read_scene(const SceneOptions &options)
  {
    auto overrides = options.overrides;
    if (!options.methods.empty())
      overrides.push_back({"Methods/names", options.methods});
    return study::with_names_of(scene::read_scene(options.scene_file, overrides), all_methods());
  }

  scene::Scene without_reference(scene::Scene scene)
  {
    scene.reference.method.reset();
    scene.reference.estimate = scene::Estimate::none;
    return scene;
  }

  std::filesystem::path output_folder(const SceneOptions &options, const scene::Scene &scene)
  {
    return options.output.empty() ? std::filesystem::path("results") / scene.name
                                  : std::filesystem::path(options.output);
  }
} // namespace plumbline::driver
