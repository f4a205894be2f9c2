#include "measures.h"

#include "base/error.h"
#include "methods.h"
#include "study/method_names.h"

#include <algorithm>

namespace plumbline::app
{
  scene::Scene read_alone(const MeasureOptions &options)
  {
    auto overrides = options.overrides;
    if (!options.methods.empty())
      overrides.push_back({"Methods/names", options.methods});
    scene::Scene scene =
        study::with_names_of(scene::read_scene(options.scene_file, overrides), all_methods());
    scene.reference.method.reset();
    scene.reference.estimate = scene::Estimate::none;
    return scene;
  }

  std::filesystem::path output_folder(const MeasureOptions &options, const scene::Scene &scene)
  {
    return options.output.empty() ? std::filesystem::path("results") / scene.name
                                  : std::filesystem::path(options.output);
  }
} // namespace plumbline::app
