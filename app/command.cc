#include "command.h"

#include "arguments.h"
#include "base/communicator.h"
#include "base/error.h"
#include "check.h"
#include "crack.h"
#include "dispersion.h"
#include "grow.h"
#include "list.h"
#include "requirements.h"
#include "run.h"
#include "sample.h"
#include "stability.h"
#include "strip.h"
#include "unexpected.h"

#include <deal.II/base/mpi.h>
#include <deal.II/base/multithread_info.h>

#include <CLI/CLI.hpp>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <iostream>

namespace
{
  std::vector<plumbline::scene::Override> to_overrides(const std::vector<std::string> &settings)
  {
    std::vector<plumbline::scene::Override> overrides;
    for (const std::string &setting : settings)
    {
      const auto equals = setting.find('=');
      if (equals == std::string::npos)
        throw plumbline::InputError("--set '" + setting +
                                    "' has no '='; write --set Section/key=value");
      overrides.push_back({setting.substr(0, equals), setting.substr(equals + 1)});
    }
    return overrides;
  }

  /// On several ranks one of them says what all of them found.
  int fail(const std::string &message, int exit_code)
  {
    if (plumbline::base::Communicator::all().rank() == 0)
      std::cerr << "plumbline: " << message << '\n';
    return exit_code;
  }

  /// What was printed has to be out before the exit code says that all is good.
  int finish_output(int exit_code)
  {
    errno = 0;
    std::cout.flush();
    if (std::cout)
      return exit_code;
    if (errno == 0) // it failed before: ask again why
    {
      std::cout.clear();
      std::cout << ' ' << std::flush;
    }
    const int reason = errno;
    return fail(
        "standard output cannot be written" +
            (reason == 0 ? std::string() : std::string(" (") + std::strerror(reason) + ")") +
            ", what was printed is not whole; free some space, or send it elsewhere",
        3);
  }

  /// What `stability`, `dispersion`, `crack`, `grow`, `strip` and `sample` take.
  void add_options(CLI::App &command, plumbline::app::MeasureOptions &options,
                   std::vector<std::string> &settings)
  {
    command.add_option("SCENE", options.scene_file, "Scene file (.prm or .json)")->required();
    command.add_option("-o,--output", options.output, "Output folder (default: results/<scene>)");
    command.add_option("--set", settings, "Section/key=value, instead of what the file says");
    command.add_option("--methods", options.methods, "Methods, instead of the scene's");
    command.add_option("--levels", options.n_levels, "The first so many levels of each sweep");
    command.add_flag("--quiet", options.quiet, "Print nothing but errors");
    command.add_flag("--json", options.json,
                     "Print " + command.get_name() + ".json instead of the table");
  }
} // namespace

int plumbline::app::command(int argc, char **argv)
{
  CLI::App app(
      "Plumbline: reference solutions for nonlocal models, and which meshfree rule to trust.");
  app.set_version_flag("--version", PLUMBLINE_VERSION);
  app.require_subcommand(1);

  plumbline::app::RunOptions options;
  std::vector<std::string> settings;
  unsigned int n_threads = 0;
  auto *run = app.add_subcommand("run", "Run a scene and write its report");
  run->add_option("SCENE", options.scene_file, "Scene file (.prm or .json)")->required();
  run->add_option("-o,--output", options.output, "Output folder (default: results/<scene>)");
  run->add_option("--set", settings, "Section/key=value, instead of what the file says");
  run->add_option("--methods", options.methods, "Methods, comma separated, instead of the scene's");
  run->add_option("--model", options.model, "smallest (what the scene needs) or full");
  run->add_option("--levels", options.n_levels, "The first so many levels of each sweep only");
  run->add_option("--budget", options.budget,
                  "Leave out solves that are expected to take more CPU seconds");
  run->add_option("--threads", n_threads, "Threads (default: all cores)");
  run->add_flag("--check", options.check, "Exit with 1 if the Expected section does not hold");
  run->add_flag("--quiet", options.quiet, "Print nothing but errors");
  run->add_flag("--json", options.json, "Print results.json instead of the verdict table");

  plumbline::app::CheckOptions weights;
  auto *check = app.add_subcommand("check", "Check quadrature weights of another code");
  check->add_option("NODES", weights.nodes_file, "Its nodes: CSV with id,x,y,volume")->required();
  check->add_option("BONDS", weights.bonds_file, "Its bonds: CSV with i,j,weight[,qx,qy]")
      ->required();
  check->add_option("--scene", weights.scene_file, "Scene file (.prm or .json)")->required();
  check->add_option("-o,--output", weights.output,
                    "Output folder (default: results/check_<scene>; with --json or --quiet: none)");
  check->add_option("--require", weights.required, plumbline::app::requirements_help)
      ->allow_extra_args(false);
  check->add_option("--set", settings, "Section/key=value, instead of what the file says");
  check->add_flag("--quiet", weights.quiet, "Print nothing but errors, write nothing without -o");
  check->add_flag("--json", weights.json, "Print a JSON object, write nothing without -o");

  plumbline::app::StabilityOptions measures;
  auto *stability = app.add_subcommand("stability", "Where methods fail, and how");
  add_options(*stability, measures, settings);
  stability->add_flag("--check", measures.check, "Exit with 1 if Expected/stability fails");

  plumbline::app::DispersionOptions waves;
  auto *dispersion = app.add_subcommand("dispersion", "How waves move by each method");
  add_options(*dispersion, waves, settings);
  dispersion->add_option("--angles", waves.angles, "Directions in degrees (default: 0,22.5,45)")
      ->delimiter(',')
      ->allow_extra_args(false);

  plumbline::app::CrackOptions strip;
  auto *crack = app.add_subcommand("crack", "How a crack moves through a strip, in time");
  add_options(*crack, strip, settings);
  crack->add_flag("--check", strip.check, "Exit with 1 if Expected/crack fails");

  plumbline::app::GrowOptions body;
  auto *grow = app.add_subcommand("grow", "How a crack grows in equilibrium, bond by bond");
  add_options(*grow, body, settings);
  grow->add_flag("--check", body.check, "Exit with 1 if Expected/growth fails");

  plumbline::app::StripOptions standing;
  auto *strip_command =
      app.add_subcommand("strip", "What the tip of a standing crack costs, by each method");
  add_options(*strip_command, standing, settings);
  strip_command->add_flag("--check", standing.check,
                          "Exit with 1 if Expected/strip fails, or a strip is too short");

  plumbline::app::SampleOptions random;
  auto *sample = app.add_subcommand("sample", "Take a random scene at many samples; statistics");
  add_options(*sample, random, settings);
  sample->add_flag("--check", random.check, "Exit with 1 if Expected/sampling fails");
  sample
      ->add_option("--jobs", random.n_jobs, "Processes that take samples side by side (default: 1)")
      ->check(CLI::Range(1u, 4096u));
  sample->add_option("--threads", random.n_threads,
                     "Threads of each process (default: all cores, shared among them)");
  sample->add_flag("--worker", random.is_worker)->group(""); // what it begins itself

  std::string folder, subject, model, key;
  auto *report = app.add_subcommand(
      "report",
      "Rebuild tables, charts and page from the numbers of a run, also of one that was killed");
  report->add_option("DIR", folder, "Output folder of a run")->required();
  auto *list = app.add_subcommand("list", "List methods, models, analyses, kernels or scenes");
  list->add_option("WHAT", subject, "methods, models, analyses, kernels or scenes")->required();
  bool as_matrix = false;
  list->add_flag("--matrix", as_matrix, "Methods by what they can do, as a table");
  auto *make_template =
      app.add_subcommand("template", "Print a scene with all keys and their help");
  make_template->add_option("MODEL", model, "scalar, tensor, LPS, variational or double-well")
      ->required();
  auto *describe = app.add_subcommand("describe", "What a key of a scene means");
  describe->add_option("KEY", key, "Section or Section/key")->required();

  try
  {
    app.parse(argc, argv);
  }
  catch (const CLI::Success &answer) // --help, --version
  {
    return finish_output(app.exit(answer));
  }
  catch (const CLI::ParseError &error)
  {
    std::cerr << "plumbline: " << plumbline::app::explain(error) << '\n';
    return 2;
  }

  if (random.is_worker)
    n_threads = random.n_threads;
  // without mpirun: no daemon beside it, nor a shared folder, which one that ends may remove as
  // another begins
  setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
  if (getenv("OMPI_COMM_WORLD_SIZE") == nullptr)
    setenv("OMPI_MCA_orte_create_session_dirs", "false", 0);
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(
      argc, argv, n_threads == 0 ? dealii::numbers::invalid_unsigned_int : n_threads);
  // whatever one rank alone fails at, all of them end with it
  const plumbline::base::SeparateCommunicator ranks(plumbline::base::Communicator::all());
  constexpr double patience = 30; // of a rank that failed, with others that wait for it [s]
  const bool is_first = ranks.communicator().rank() == 0;
  int exit_code = 0;
  const auto act = [&]
  {
    options.overrides = weights.overrides = measures.overrides = waves.overrides = strip.overrides =
        body.overrides = standing.overrides = random.overrides = to_overrides(settings);
    if (*run)
      exit_code = plumbline::app::run(options);
    else if (*check)
      exit_code = plumbline::app::check(weights);
    else if (*sample)
      exit_code = plumbline::app::sample(random);
    else if (!is_first)
      return; // the first rank does it
    else if (*stability)
      exit_code = plumbline::app::stability(measures);
    else if (*dispersion)
      plumbline::app::dispersion(waves);
    else if (*crack)
      exit_code = plumbline::app::crack(strip);
    else if (*grow)
      exit_code = plumbline::app::grow(body);
    else if (*strip_command)
      exit_code = plumbline::app::strip(standing);
    else if (*report)
      exit_code = plumbline::app::rebuild_report(folder);
    else if (*list)
      plumbline::app::list(subject, as_matrix);
    else if (*make_template)
      std::cout << plumbline::scene::scene_template(model);
    else if (*describe)
      std::cout << plumbline::scene::describe(key);
  };
  try
  {
    ranks.communicator().together(act, patience);
  }
  catch (const plumbline::InputError &error)
  {
    exit_code = fail(error.what(), 2);
  }
  catch (const plumbline::NumericalError &error)
  {
    exit_code = fail(error.what(), 3);
  }
  catch (const std::exception &error)
  {
    exit_code = fail(plumbline::app::explain_unexpected(error.what()), 3);
  }
  return finish_output(exit_code);
}
