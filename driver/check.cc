#include "driver/check.h"

#include "base/communicator.h"
#include "base/error.h"
#include "base/first_rank.h"
#include "base/number_text.h"
#include "base/progress_line.h"
#include "base/text_file.h"
#include "check/body.h"
#include "check/files.h"
#include "check/in_space.h"
#include "check/series.h"
#include "check/text.h"
#include "driver/interrupts.h"
#include "driver/provenance.h"
#include "driver/scene_input.h"
#include "driver/writable.h"
#include "io/output_folder.h"
#include "io/record_journal.h"
#include "physics/kernel.h"
#include "reference/method.h"
#include "report/counted.h"
#include "report/pdf.h"
#include "scene/models/model.h"
#include "scene/scene_keys.h"
#include "scene/values.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <optional>

namespace plumbline::driver
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
      const std::string boundary = value_of("Domain/boundary");
      const auto known = base::from_word<scene::Boundary>(boundary);
      if (known && *known != scene::Boundary::constrained)
        throw InputError("'plumbline check' does not take free or periodic boundaries from the "
                         "scene: Domain/boundary = " +
                         boundary + "; write constrained, and give --boundary " + boundary);
    }

    /// The weights come from a file: a scene need not name rules or pose a problem. By default all
    /// rules are considered, and a smooth solution. Scenes that are pipes cannot be
    /// read twice and are left as they are.
    CheckOptions with_defaults(CheckOptions options)
    {
      std::error_code error;
      if (!fs::is_regular_file(options.scene_file, error))
        return options;
      const auto value_of = [&](const std::string &key)
      { return scene::value_of_key(options.scene_file, options.overrides, key); };
      if (value_of("Methods/names").empty())
        options.overrides.push_back({"Methods/names", scene::all});
      if (!value_of("Problem/solution").empty() || !value_of("Problem/load").empty())
        return options;
      const std::string model = value_of("Material/model");
      const int dimension = std::atoi(value_of("Domain/dimension").c_str()); // 0: not given
      const auto &types = physics::kernel_types();
      const auto type = std::find_if(types.begin(), types.end(),
                                     [name = value_of("Kernel/type")](const auto &one)
                                     { return one.name == name; });
      const bool is_vector = !(model.empty() || model == scene::bond_based().name()) ||
                             (type != types.end() && type->structure == physics::Structure::tensor),
                 is_in_space = dimension == 3;
      const std::string solution = is_in_space      ? (is_vector ? "x, y, z" : "x")
                                   : dimension == 1 ? "sin(3*x)"
                                   : is_vector      ? "sin(3*x)*cos(2*y), cos(x)*sin(3*y)"
                                                    : "sin(3*x)*cos(2*y)";
      options.overrides.push_back({"Problem/solution", solution});
      if (!is_in_space) // there nothing is solved
        options.assumption = "Problem/solution is not given: u = " + solution + " is solved for";
      return options;
    }

    /// Free surfaces and cracks are known in the plane, and with periodic boxes at one level.
    void check_body_options(const CheckOptions &options, bool is_in_space)
    {
      const scene::Boundary boundary = check::to_boundary(options.boundary, "--boundary");
      const bool is_constrained = boundary == scene::Boundary::constrained;
      if (is_constrained && options.cracks.empty())
        return;
      const std::string given = is_constrained || (is_in_space && !options.cracks.empty())
                                    ? "--crack"
                                    : "--boundary " + base::word(boundary);
      if (is_in_space && !(boundary == scene::Boundary::periodic && options.cracks.empty()))
        throw InputError(given + " is for two dimensions; leave it out where Domain/dimension = 3");
      if (check::is_series(options))
        throw InputError(given + " is for the files of one level; give names without {h}");
    }

    void check_budget(const CheckOptions &options)
    {
      if (!options.budget)
        return;
      if (!(*options.budget > 0))
        throw InputError("--budget = " + base::to_text(*options.budget, 6) +
                         " is not positive; give CPU seconds of one level, or leave it out");
      if (!check::is_series(options))
        throw InputError("--budget is for a series of files; give names with {h}, or leave it out");
    }

    /// Whether there are files.
    bool writes_files(const CheckOptions &options)
    {
      return (!options.quiet && !options.json) || !options.output.empty();
    }

    io::OutputFolder::Owner owner_of(const scene::Scene &scene)
    {
      return {"check", scene.name, scene.text, note};
    }

    /// Print the requested output.
    void print(const CheckOptions &options, const std::function<std::string()> &json,
               const std::function<std::string()> &text)
    {
      if (options.json)
        std::cout << json();
      else if (!options.quiet)
        std::cout << text();
    }

    /// Print the requested output, and write files if there are any.
    void show(const scene::Scene &scene, const CheckOptions &options, const fs::path &folder,
              const std::function<std::string()> &json, const std::function<std::string()> &text,
              const std::function<void()> &write)
    {
      print(options, json, text);
      if (!writes_files(options))
        return;
      const io::OutputFolder output(folder, owner_of(scene), base::Communicator::alone());
      write();
      if (options.pdf)
        report::draw_pdf(folder);
    }

    /// The levels of a series, from coarse to fine, and what an earlier command has left of them.
    check::Series find_levels(const check::LevelFiles &files, const CheckOptions &options,
                              std::optional<io::RecordJournal> &journal)
    {
      const base::Communicator ranks = base::Communicator::all();
      base::ProgressLine progress(!options.quiet && ranks.rank() == 0);
      study::RunControl control;
      control.ranks = ranks;
      control.budget = options.budget.value_or(0);
      if (journal)
        control.earlier = journal->earlier();
      const auto n_known = static_cast<double>(control.earlier.records.size());
      if (ranks.largest(n_known) != -ranks.largest(-n_known)) // a folder that not all ranks have
        control.earlier = {};
      if (!control.earlier.records.empty() && !options.quiet && ranks.rank() == 0)
        std::cerr << "continuing: " << report::counted(control.earlier.records.size(), "record")
                  << " already\n";
      control.earlier.provenance = provenance();
      control.should_stop = [&] { return ranks.any(is_interrupted()); };
      control.on_progress = [&](const std::string &what, double fraction)
      { progress.show(what, fraction); };
      control.on_made = [&](const study::StudyResults &made)
      {
        const study::Records &known = control.earlier.records;
        const auto is_known = [&](const study::Record &one)
        { return one.key == made.records.front().key; };
        if (journal && (made.records.empty() || std::none_of(known.begin(), known.end(), is_known)))
          base::on_first_rank(ranks, [&] { journal->append(made); });
      };
      return check::find_series(files, reference::methods(), control);
    }

    int show_series(const scene::Scene &scene, const CheckOptions &options,
                    const check::Requirements &required, const fs::path &folder)
    {
      const base::Communicator ranks = base::Communicator::all();
      const bool is_first = ranks.rank() == 0, has_files = writes_files(options);
      const check::LevelFiles files = check::find_level_files(scene, options);
      if (!files.missing.empty() && is_first)
        std::cerr << "warning: levels without files are left out: there is no " << files.missing
                  << '\n';
      watch_interrupts();
      std::optional<io::OutputFolder> output;
      std::optional<io::RecordJournal> journal;
      if (has_files)
      {
        output.emplace(folder, owner_of(scene), ranks);
        base::on_first_rank(ranks, [&] { require_writable(folder / "check.json"); });
      }
      if (const std::string subject = check::subject_of(files); has_files && !subject.empty())
        journal.emplace(folder / "check.jsonl", subject);
      const check::Series found = find_levels(files, options, journal);
      const bool is_written = is_first && !(found.levels.empty() && found.levels_in_space.empty());
      if (is_written)
        print(
            options, [&] { return check::to_json(found, files, required); },
            [&] { return check::text(found, required, (folder / "report.html").string()); });
      if (is_written && has_files)
      {
        check::write_series(found, files, required, folder);
        if (options.pdf)
          report::draw_pdf(folder);
        if (journal && found.results.is_complete)
          journal->remove();
        if (!found.results.is_complete)
          say_interrupted(folder, journal.has_value());
      }
      if (!found.results.is_complete)
        return 130;
      return check::complaints(found, required).empty() ? 0 : 1;
    }

    template <int dim>
    int show_level(const check::Findings<dim> &found, const scene::Scene &scene,
                   const CheckOptions &options, const check::Requirements &required,
                   const fs::path &folder)
    {
      const bool is_wrong = !check::complaints(found, required).empty();
      if (!is_wrong)
        for (const check::CaseCheck &one : found.cases)
          if (!one.weights.failure.empty())
            throw NumericalError("no solution of " + one.name() + ": " + one.weights.failure);
      const int exit_code = is_wrong ? 1 : 0;
      if (base::Communicator::all().rank() == 0)
        show(
            scene, options, folder,
            [&] { return check::check_json(found, required, options, exit_code); },
            [&] {
              return check::check_text(found, required, options, (folder / "report.html").string());
            },
            [&] { check::write_check(found, required, options, exit_code, folder); });
      return exit_code;
    }
  } // namespace

  int check(const CheckOptions &given)
  {
    end_at_interrupts();
    const CheckOptions options = with_defaults(given);
    const check::Requirements required = check::parse_requirements(options.required);
    if (options.pdf)
      report::require_pdf();
    refuse_other_bodies(options);
    SceneOptions input;
    input.scene_file = options.scene_file;
    input.overrides = options.overrides;
    const scene::Scene scene = read_scene(input);
    if (scene.study.regime == scene::Regime::variable)
      throw InputError("Study/regime = variable: weights are those of one value of " +
                       scene.study.variable +
                       "; give it as Random/values, with another regime (and no Study/variable)");
    check_body_options(options, scene.domain.is_in_space());
    check_budget(options);
    const fs::path folder = options.output.empty() ? fs::path("results") / ("check_" + scene.name)
                                                   : fs::path(options.output);
    if (check::is_series(options))
      return show_series(scene, options, required, folder);
    if (scene.domain.is_in_space())
      return show_level(check::find_in_space(scene, options), scene, options, required, folder);
    return show_level(check::find(scene, options, reference::methods()), scene, options, required,
                      folder);
  }
} // namespace plumbline::driver
