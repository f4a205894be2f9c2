#include "strip.h"

#include "base/error.h"
#include "methods.h"
#include "report/formats.h"
#include "report/strip_page.h"
#include "study/preflight.h"

#include <iostream>
#include <iterator>

namespace plumbline::app
{
  namespace fs = std::filesystem;

  namespace
  {
    method::Methods choose(const scene::Scene &scene)
    {
      const method::Methods available = all_methods();
      method::Methods methods;
      for (const std::string &name : scene.methods.names)
      {
        methods.push_back(study::find_method(available, name, "Methods/names"));
        if (methods.back()->can().count(method::Capability::lattice) == 0)
          throw InputError("Methods/names: " + name +
                           " is not for lattices, as strips are (Strip/length); take Galerkin "
                           "methods on quadrilaterals (Q1, DGQ1, ...) and meshfree rules");
      }
      return methods;
    }
  } // namespace

  int strip(const StripOptions &options)
  {
    const scene::Scene scene = read_alone(options);
    if (!scene.strip.is_there())
      throw InputError("scene '" + scene.name +
                       "': Strip/length is 0, so that there is no strip; give it and Strip/crack, "
                       "or use 'plumbline run'");
    const method::Methods methods = choose(scene);
    const fs::path folder = output_folder(options, scene);
    report::write_file(folder / "strip.md", ""); // before the work: can it be written?

    study::StripResults results{
        scene.name, scene.purpose, scene.strip, scene.material.lame()({}).mu, {}, {}};
    for (const auto &method : methods)
      for_each_level(scene, options.n_levels,
                     [&](const scene::Series &series, const scene::Level &level, bool) {
                       results.rows.push_back(study::stand_crack(*method, scene, series, level));
                     });
    results.limits = study::strip_limits(results.rows);
    const std::vector<std::string> faults = study::strip_faults(results, scene.expected);
    report::write_strip(results, faults, folder);
    if (options.json)
      std::cout << report::strip_json(results);
    else if (!options.quiet)
      std::cout << report::strip_text(results) << "\nwritten: " << (folder / "strip.html").string()
                << '\n';
    if (!options.check || faults.empty())
      return 0;
    for (const std::string &fault : faults)
      std::cerr << fault << '\n';
    return 1;
  }
} // namespace plumbline::app
