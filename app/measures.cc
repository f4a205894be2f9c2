#include "measures.h"

#include "base/error.h"
#include "methods.h"
#include "study/method_names.h"

#include <algorithm>

namespace plumbline::app
{
  scene::Scene scene_of_file(const std::string &file, std::vector<scene::Override> overrides,
                             const std::string &methods)
  {
    if (!methods.empty())
      overrides.push_back({"Methods/names", methods});
    return study::with_names_of(scene::read_scene(file, overrides), all_methods());
  }

  scene::Scene read_alone(const MeasureOptions &options)
  {
    scene::Scene scene = scene_of_file(options.scene_file, options.overrides, options.methods);
    scene.reference.method.reset();
    scene.reference.estimate = scene::Estimate::none;
    return scene;
  }

  std::filesystem::path output_folder(const std::string &output, const scene::Scene &scene)
  {
    return output.empty() ? std::filesystem::path("results") / scene.name
                          : std::filesystem::path(output);
  }
} // namespace plumbline::app
