#include "grow.h"

#include "base/communicator.h"
#include "base/error.h"
#include "methods.h"
#include "output_folder.h"
#include "report/formats.h"
#include "report/growth_page.h"
#include "run_parts.h"
#include "study/growth_analysis.h"

#include <filesystem>
#include <iostream>
#include <optional>

namespace plumbline::app
{
  namespace fs = std::filesystem;

  int grow(const GrowOptions &options)
  {
    const scene::Scene scene = read_alone(options);
    if (!scene.fracture.is_there())
      throw InputError("scene '" + scene.name +
                       "': Fracture/toughness is empty, so that nothing breaks; give it, or use "
                       "'plumbline run' ('plumbline crack' where Crack/notch is given)");
    study::check_growth_size(scene);
    const fs::path folder = output_folder(options, scene);
    std::optional<OutputFolder> output; // once nothing is refused any more
    const study::GrowthResults results = study::grow_body(
        scene, all_methods(), folder / "checkpoint.h5",
        [&]
        {
          output.emplace(folder, OutputFolder::Owner{"grow", scene.name, scene.text},
                         base::Communicator::alone());
          report::write_file(folder / "grow.md", ""); // can it be written?
        });
    if (!options.quiet && results.growth.n_resumed > 0)
      std::cerr << "continued from event " << results.growth.n_resumed << " of '"
                << (folder / "checkpoint.h5").string() << "'\n";
    const std::vector<std::string> faults = growth_faults(results, scene.expected);
    for (const std::string &warning : results.warnings)
      std::cerr << "warning: " << warning << '\n';
    report::write_growth(results, faults, folder);
    std::error_code code;
    fs::remove(folder / "checkpoint.h5", code); // what is complete is done again, as its user asks
    if (options.json)
      std::cout << report::growth_json(results);
    else if (!options.quiet)
      std::cout << report::growth_text(results) << "\nwritten: " << (folder / "grow.html").string()
                << '\n';
    if (!options.check || faults.empty())
      return 0;
    for (const std::string &fault : faults)
      std::cerr << fault << '\n';
    return 1;
  }
} // namespace plumbline::app
