#include "check.h"

#include "base/communicator.h"
#include "base/error.h"
#include "check_body.h"
#include "check_files.h"
#include "check_in_space.h"
#include "check_series.h"
#include "check_text.h"
#include "methods.h"
#include "output_folder.h"
#include "run_parts.h"
#include "scene/scene_keys.h"
#include "study/method_names.h"

#include <array>
#include <iostream>

namespace plumbline::app
{
  namespace fs = std::filesystem;

  namespace
  {
    /// Scenes of bodies with cracks or free surfaces are refused before anything else of them is
    /// looked at: here these are options.
    void refuse_other_bodies(const CheckOptions &options)
    {
      const auto value_of = [&](const std::string &key)
      { return scene::value_of_key(options.scene_file, options.overrides, key); };
      for (const auto &[key, name, remedy] :
           {std::array{"Domain/cracks", "cracks of scenes", "--crack 'x0, y0 : x1, y1'"},
            std::array{"Domain/outside", "free surfaces by an expression",
                       "the body as Domain/boxes or Domain/mesh, and --boundary free"}})
        if (!value_of(key).empty())
          throw InputError("'plumbline check' does not support " + std::string(name) + ": " + key +
                           " is given; clear it, and give " + remedy);
      if (value_of("Domain/boundary") == "free")
        throw InputError("'plumbline check' does not support free bodies of scenes: "
                         "Domain/boundary = free; write constrained, and give --boundary free");
    }

    /// Free surfaces and cracks are known in the plane, at one level.
    void check_body_options(const CheckOptions &options, bool is_in_space)
    {
      const bool is_free = is_free_boundary(options.boundary, "--boundary");
      if (!is_free && options.cracks.empty())
        return;
      const std::string given = is_free ? "--boundary free" : "--crack";
      if (is_in_space)
        throw InputError(given + " is for two dimensions; leave it out where Domain/dimension = 3");
      if (is_series(options))
        throw InputError(given + " is for the files of one level; give names without {h}");
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
    check_body_options(options, scene.domain.is_in_space());
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
