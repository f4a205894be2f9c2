#include "check.h"

#include "base/communicator.h"
#include "base/error.h"
#include "check_files.h"
#include "check_text.h"
#include "output_folder.h"

#include <iostream>

namespace plumbline::app
{
  namespace fs = std::filesystem;

  int check(const CheckOptions &options)
  {
    const Requirements required = parse_requirements(options.required);
    const scene::Scene scene = scene::read_scene(options.scene_file, options.overrides);
    if (scene.study.regime == scene::Regime::variable)
      throw InputError("Study/regime = variable: weights are those of one value of " +
                       scene.study.variable +
                       "; give it as Random/values, with another regime (and no Study/variable)");
    const Findings found = find(scene, options);
    const bool is_wrong = !complaints(found, required).empty();
    if (!is_wrong)
      for (const CaseCheck &one : found.cases)
        if (!one.failure.empty())
          throw NumericalError("no solution of " + one.name + ": " + one.failure);
    const int exit_code = is_wrong ? 1 : 0;
    if (base::Communicator::all().rank() != 0)
      return exit_code;
    const bool is_silent = options.quiet || options.json;
    if (options.json)
      std::cout << check_json(found, required, options, exit_code);
    else if (!options.quiet)
      std::cout << check_text(found, required, options);
    if (is_silent && options.output.empty())
      return exit_code;
    const fs::path folder = options.output.empty() ? fs::path("results") / ("check_" + scene.name)
                                                   : fs::path(options.output);
    const OutputFolder output(folder, {"check", scene.name, scene.text},
                              base::Communicator::alone());
    write_check(found, required, options, exit_code, folder);
    if (!is_silent)
      std::cout << "written: " << (folder / "report.html").string() << '\n';
    return exit_code;
  }
} // namespace plumbline::app
