#include "crack.h"

#include "base/communicator.h"
#include "base/error.h"
#include "base/number_text.h"
#include "methods.h"
#include "output_folder.h"
#include "report/crack_page.h"
#include "report/formats.h"
#include "report/frames.h"
#include "study/crack_analysis.h"

#include <filesystem>
#include <iostream>
#include <optional>

namespace plumbline::app
{
  namespace fs = std::filesystem;

  namespace
  {
    study::WriteStrip frame_writer(const fs::path &folder)
    {
      return [folder](const std::vector<double> &times, const std::vector<dealii::Point<2>> &nodes,
                      const study::Vector &u_of_nodes, const study::Vector &damage_of_nodes)
      {
        const auto u = [&](std::size_t node, unsigned int component)
        { return u_of_nodes[component * nodes.size() + node]; };
        const auto damage = [&](std::size_t node, unsigned int) { return damage_of_nodes[node]; };
        report::write_frame(folder / "frames", "frame", times, nodes,
                            {{"u", true, u}, {"damage", false, damage}});
      };
    }
  } // namespace

  int crack(const CrackOptions &options)
  {
    const scene::Scene scene = read_alone(options);
    if (!scene.crack.is_there())
      throw InputError("scene '" + scene.name +
                       "': Crack/notch = 0, so there is no crack to follow; give its length, or "
                       "use 'plumbline run'");
    const fs::path folder = output_folder(options, scene);
    std::optional<OutputFolder> output; // once nothing is refused any more
    study::check_crack_size(scene, options.n_levels, folder);
    const study::CrackResults results = study::move_crack(
        scene, all_methods(), options.n_levels, folder, frame_writer(folder),
        [&]
        {
          output.emplace(folder, OutputFolder::Owner{"crack", scene.name, scene.text},
                         base::Communicator::alone());
          report::write_file(folder / "crack.md", ""); // can it be written?
        });
    if (!options.quiet && results.history.resumed_at > 0)
      std::cerr << "continued from t = " << base::to_text(results.history.resumed_at, 4) << ", of '"
                << results.plan.checkpoint.string() << "'\n";
    report::write_crack(results, folder);
    for (const std::string &warning : results.warnings())
      std::cerr << "warning: " << warning << '\n';
    std::error_code code;
    fs::remove(results.plan.checkpoint, code); // what is complete is done again, as its user asks
    if (options.json)
      std::cout << report::crack_json(results);
    else if (!options.quiet)
      std::cout << report::crack_text(results) << "\nwritten: " << (folder / "crack.html").string()
                << '\n';
    if (options.check && !results.is_as_expected())
    {
      std::cerr << "Expected/crack = " << base::word(results.expected) << ", but it "
                << report::crack_outcome_words(results.motion.outcome) << '\n';
      return 1;
    }
    return 0;
  }
} // namespace plumbline::app
