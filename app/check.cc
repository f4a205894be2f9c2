#include "check.h"

#include "base/communicator.h"
#include "base/error.h"
#include "check_files.h"
#include "check_in_space.h"
#include "check_series.h"
#include "check_text.h"
#include "methods.h"
#include "output_folder.h"
#include "run_parts.h"
#include "scene/scene_keys.h"
#include "study/method_names.h"

#include <iostream>

namespace plumbline::app
{
  namespace fs = std::filesystem;

  namespace
  {
    /// Bodies with cracks or free surfaces are refused before anything else of their scenes is
    /// looked at.
    void refuse_other_bodies(const CheckOptions &options)
    {
      const auto value_of = [&](const std::string &key)
      { return scene::value_of_key(options.scene_file, options.overrides, key); };
      const std::string bodies = ". Bodies must have no cracks and no free surfaces, with a "
                                 "volume constraint in the interaction domain (collar) or "
                                 "periodic boundaries";
      for (const auto &[key, name] :
           {std::pair{"Domain/cracks", "cracks"}, std::pair{"Domain/outside", "free surfaces"}})
        if (!value_of(key).empty())
          throw InputError("'plumbline check' does not support " + std::string(name) + ": " + key +
                           " is given; clear it" + bodies);
      if (value_of("Domain/boundary") == "free")
        throw InputError(
            "'plumbline check' does not support free bodies: Domain/boundary = free; write "
            "constrained" +
            bodies);
    }
  } // namespace

  int check(const CheckOptions &options)
  {
    end_at_interrupts();
    const Requirements required = parse_requirements(options.required);
    refuse_other_bodies(options);
    const scene::Scene scene = study::with_names_of(
        scene::read_scene(options.scene_file, options.overrides), all_methods());
    if (scene.study.regime == scene::Regime::variable)
      throw InputError("Study/regime = variable: weights are those of one value of " +
                       scene.study.variable +
                       "; give it as Random/values, with another regime (and no Study/variable)");
    const bool has_series = is_series(options);
    if (has_series && scene.domain.is_in_space())
      throw InputError("series of files are checked in the plane alone; give the files of one "
                       "level");
    if (has_series)
      return check_series(scene, options, required);
    if (scene.domain.is_in_space())
      return check_in_space(scene, options, required);
    const Findings found = find(scene, options);
    const bool is_wrong = !complaints(found, required).empty();
    if (!is_wrong)
      for (const CaseCheck &one : found.cases)
        if (!one.weights.failure.empty())
          throw NumericalError("no solution of " + one.name() + ": " + one.weights.failure);
    const int exit_code = is_wrong ? 1 : 0;
    if (base::Communicator::all().rank() != 0)
      return exit_code;
    const bool is_silent = options.quiet || options.json;
    const fs::path folder = options.output.empty() ? fs::path("results") / ("check_" + scene.name)
                                                   : fs::path(options.output);
    if (options.json)
      std::cout << check_json(found, required, options, exit_code);
    else if (!options.quiet)
      std::cout << check_text(found, required, options, (folder / "report.html").string());
    if (is_silent && options.output.empty())
      return exit_code;
    const OutputFolder output(folder, {"check", scene.name, scene.text},
                              base::Communicator::alone());
    write_check(found, required, options, exit_code, folder);
    return exit_code;
  }
} // namespace plumbline::app
