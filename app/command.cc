#include "command.h"

#include "arguments.h"
#include "base/communicator.h"
#include "base/error.h"
#include "base/number_list.h"
#include "base/workers.h"
#include "check/moduli.h"
#include "check/requirements.h"
#include "check/rule_weights.h"
#include "driver/certify.h"
#include "driver/check.h"
#include "driver/run.h"
#include "driver/sample.h"
#include "grade.h"
#include "io/results_json.h"
#include "list.h"
#include "new.h"
#include "parser_text.h"
#include "probe.h"
#include "scene/new_scene.h"
#include "scene_argument.h"
#include "unexpected.h"

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/multithread_info.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <iostream>
#include <memory>
#include <type_traits>

namespace plumbline::app
{
  using namespace driver;

  namespace
  {
    constexpr unsigned int most_levels = 1000; ///< more than any study has

    std::vector<scene::Override> to_overrides(const std::vector<std::string> &settings)
    {
      std::vector<scene::Override> overrides;
      for (const std::string &setting : settings)
      {
        const auto equals = setting.find('=');
        if (equals == std::string::npos)
          throw InputError("--set '" + setting + "' has no '='; write --set Section/key=value");
        overrides.push_back({setting.substr(0, equals), setting.substr(equals + 1)});
      }
      return overrides;
    }

    /// On several ranks one of them says what all of them found.
    int fail(const std::string &message, int exit_code)
    {
      if (base::Communicator::all().rank() == 0)
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
              "; the output is incomplete. Free some disk space or redirect it",
          3);
    }

    /// What the command line asks for.
    struct Request
    {
      std::vector<std::string> arguments; ///< as given
      std::vector<std::string> settings;  ///< of --set
      unsigned int n_threads = 0;         ///< 0: one for each core
      bool is_for_all_ranks = false;      ///< else the first rank does it
      std::function<int()> action;        ///< gives the exit code
    };

    /// Of --set and of options in place of keys, whose values are not in a line of the scene.
    template <class Options>
    std::vector<scene::Override> all_overrides(const Options &options)
    {
      std::vector<scene::Override> overrides = options.overrides;
      if constexpr (std::is_base_of_v<SceneOptions, Options>)
        if (!options.methods.empty())
          overrides.push_back({"Methods/names", options.methods});
      if constexpr (std::is_base_of_v<RunOptions, Options>)
        if (!options.model.empty())
          overrides.push_back({"Solver/model", options.model});
      return overrides;
    }

    /// What a command that is chosen does.
    void set_action(CLI::App &command, Request &request, const std::function<int()> &action,
                    bool is_for_all_ranks = false)
    {
      command.callback(
          [=, &request]
          {
            request.is_for_all_ranks = is_for_all_ranks;
            request.action = action;
          });
    }

    /// The same of one that reads a scene, whose keys --set overrides.
    template <class Options, class Action>
    void set_action(CLI::App &command, Request &request, const std::shared_ptr<Options> &options,
                    Action action, bool is_for_all_ranks = false)
    {
      set_action(
          command, request,
          [=, &request]
          {
            options->overrides = to_overrides(request.settings);
            if constexpr (std::is_base_of_v<SceneOptions, Options>)
            {
              if (options->is_worker)
                base::end_with_parent();
              options->arguments = request.arguments;
              options->n_threads = request.n_threads;
            }
            return with_scene(options->scene_file, all_overrides(*options),
                              [&] { return action(*options); });
          },
          is_for_all_ranks);
    }

    int print(const std::string &text)
    {
      std::cout << text;
      return 0;
    }

    constexpr auto pdf_help = "Also draw charts and maps as PDF, beside the SVG files";

    void add_threads(CLI::App &command, Request &request)
    {
      command.add_option("--threads", request.n_threads, "Threads (default: all cores)");
    }

    /// Of a command whose work several processes can share.
    void add_jobs(CLI::App &command, Request &request, SceneOptions &options)
    {
      command
          .add_option("--jobs", options.n_jobs,
                      "Number of processes that share the work (default: 1)")
          ->check(CLI::Range(1u, 4096u));
      command.add_option("--threads", request.n_threads,
                         "Threads of each process (default: all cores, divided among them)");
      command.add_flag("--worker", options.is_worker)->group(""); // set in its workers
    }

    void add_run(CLI::App &app, Request &request)
    {
      const auto options = std::make_shared<RunOptions>();
      auto &run = *app.add_subcommand("run", "Run a scene and write its report");
      run.add_option("SCENE", options->scene_file, "Scene file (.prm or .json)")->required();
      run.add_option("-o,--output", options->output, "Output folder (default: results/<scene>)");
      run.add_option("--set", request.settings, "Section/key=value, overrides the scene file");
      run.add_option("--methods", options->methods,
                     "Methods, comma separated; overrides Methods/names");
      run.add_option("--model", options->model, "smallest (only what the scene needs) or full");
      run.add_option("--levels", options->n_levels, "Only the first N levels of each sweep")
          ->check(CLI::Range(1u, most_levels));
      run.add_option(
          "--budget", options->budget,
          "Skip a method at a level if it is expected to take more CPU seconds than this");
      add_jobs(run, request, *options);
      run.add_flag("--check", options->check, "Exit with 1 if the Expected section does not hold");
      run.add_flag("--quiet", options->quiet, "Print nothing but errors");
      run.add_flag("--json", options->json, "Print results.json instead of the verdict table");
      run.add_flag("--pdf", options->pdf, pdf_help);
      run.add_flag("--estimate", options->is_estimate,
                   "Print the estimated peak memory of each rank by method and level, on several "
                   "ranks also the time of an iteration, and exit without running");
      run.add_option("--ranks", options->n_ranks,
                     "With --estimate: number of ranks to predict for (default: those that run)")
          ->check(CLI::Range(1u, 1000000u));
      set_action(run, request, options, driver::run, true);
    }

    void add_check(CLI::App &app, Request &request)
    {
      const auto options = std::make_shared<CheckOptions>();
      auto &check = *app.add_subcommand(
          "check", "Check the weights of another code and report their defects");
      check
          .add_option(
              "NODES", options->nodes_file,
              "Its nodes: CSV with id,x,y,volume; with {h} in the name, a file for each level")
          ->required();
      check.add_option("BONDS", options->bonds_file, "Its bonds: CSV with i,j,weight[,qx,qy]")
          ->required();
      check.add_option("--scene", options->scene_file, "Scene file (.prm or .json)")->required();
      check.add_option(
          "-o,--output", options->output,
          "Output folder (default: results/check_<scene>; with --json or --quiet: none)");
      check.add_option(
          "--bonds-are", options->bonds_are,
          "What the column weight holds: weights (default), stiffness (C weight: force "
          "density per length) or 'force constants' (V_i C weight: force per length)");
      check.add_option(
          "--boundary", options->boundary,
          "constrained (default): u is prescribed around the domain. free: the boundary "
          "of the domain is a free surface, where families are truncated. periodic: opposite "
          "sides of the domain, one box, are joined");
      check
          .add_option("--crack", options->cracks,
                      "A crack that no bond may cross: 'x0, y0 : x1, y1', with more points for "
                      "bends; may be repeated")
          ->allow_extra_args(false);
      check.add_option("--require", options->required, check::requirements_help)
          ->allow_extra_args(false);
      check.add_option("--set", request.settings, "Section/key=value, overrides the scene file");
      check.add_option("--budget", options->budget,
                       "For a series of files: skip a level if its weights are expected to take "
                       "more CPU seconds than this");
      add_threads(check, request);
      check.add_flag("--quiet", options->quiet,
                     "Print nothing but errors, write nothing without -o");
      check.add_flag("--json", options->json, "Print a JSON object, write nothing without -o");
      check.add_flag("--pdf", options->pdf, pdf_help);
      set_action(check, request, options, driver::check, true);
    }

    void add_probe(CLI::App &app, Request &request)
    {
      const auto options = std::make_shared<ProbeOptions>();
      auto &probe = *app.add_subcommand(
          "probe", "Derive bonds for 'check' from the forces of another program");
      probe.add_option("NODES", options->nodes_file, "Its nodes: CSV with id,x,y[,z],volume")
          ->required();
      probe
          .add_option("--command", options->command,
                      "Computes forces: reads the file {nodes} (id,x,y[,z],ux,uy[,uz]) and writes "
                      "the file {forces} ([id,]fx,fy[,fz])")
          ->required();
      probe.add_option("--horizon", options->horizon, "Length of the longest bonds")->required();
      probe.add_option("-o,--output", options->output, "Bonds file (default: bonds.csv)");
      probe.add_option(
          "--nodes", options->n_nodes,
          "Number of nodes to displace, those nearest to the centre; nodes at the same "
          "distance as the last one are included (default: 2)");
      probe.add_flag("--all", options->all, "Displace all nodes");
      probe.add_option("--step", options->step,
                       "Length of the displacements (default: 1e-5 horizons)");
      probe.add_option("--forces-are", options->forces_are,
                       "forces (default) or densities: forces per volume");
      probe.add_flag("--quiet", options->quiet, "Print nothing but errors");
      probe.add_flag("--json", options->json, "Print a JSON object instead of the text");
      set_action(probe, request, [=] { return app::probe(*options); });
    }

    /// `stability`, `dispersion`, `crack`, `grow`, `strip` and `sample` take the same.
    CLI::App &add_measuring(CLI::App &app, const std::string &name, const std::string &help,
                            SceneOptions &options, Request &request)
    {
      auto &command = *app.add_subcommand(name, help);
      command.add_option("SCENE", options.scene_file, "Scene file (.prm or .json)")->required();
      command.add_option("-o,--output", options.output, "Output folder (default: results/<scene>)");
      command.add_option("--set", request.settings, "Section/key=value, overrides the scene file");
      command.add_option("--methods", options.methods,
                         "Methods, comma separated; overrides Methods/names");
      command.add_option("--levels", options.n_levels, "Only the first N levels of each sweep")
          ->check(CLI::Range(1u, most_levels));
      command.add_flag("--quiet", options.quiet, "Print nothing but errors");
      command.add_flag("--json", options.json, "Print " + name + ".json instead of the table");
      command.add_flag("--pdf", options.pdf, pdf_help);
      return command;
    }

    constexpr auto angles_option = "--angles", directions_option = "--directions";

    /// The directions of waves, as the command line gives them.
    struct DirectionWords
    {
      std::vector<std::string> angles, vectors;

      study::AskedDirections read() const
      {
        study::AskedDirections asked;
        if (!angles.empty())
          asked.angles = base::to_numbers(angles_option, angles);
        if (!vectors.empty())
          asked.vectors = base::to_vectors(directions_option, vectors);
        return asked;
      }
    };

    void add_directions(CLI::App &command, DirectionWords &words)
    {
      command
          .add_option(
              angles_option, words.angles,
              "In two dimensions: directions in degrees, separated by commas, semicolons or "
              "blanks (default: 0,22.5,45); may be repeated")
          ->allow_extra_args(false);
      command
          .add_option(directions_option, words.vectors,
                      "In three dimensions: direction vectors, three numbers each (default: 1,0,0 "
                      "1,1,0 1,1,1); may be repeated")
          ->allow_extra_args(false);
    }

    void add_analysis(CLI::App &app, Request &request, const AnalysisRow &row)
    {
      const auto options = std::make_shared<AnalyseOptions>();
      const auto words = std::make_shared<DirectionWords>();
      auto &command = add_measuring(app, row.name, row.help, *options, request);
      command.add_flag("--check", options->check, "Exit with 1 if " + row.expected);
      command.add_option(
          "--budget", options->budget,
          "Skip a method at a level if it is expected to take more CPU seconds than this");
      if (row.has_checkpoint) // one method follows one crack
        add_threads(command, request);
      else
        add_jobs(command, request, *options);
      if (row.takes_directions)
        add_directions(command, *words);
      set_action(
          command, request, options,
          [&row, words](AnalyseOptions given)
          {
            given.directions = words->read();
            return analyse(row, given);
          },
          !row.has_checkpoint);
    }

    void add_sample(CLI::App &app, Request &request)
    {
      const auto options = std::make_shared<SampleOptions>();
      auto &command = add_measuring(
          app, "sample", "Uncertainty quantification: means, deviations, errors and costs",
          *options, request);
      command.add_flag("--check", options->check, "Exit with 1 if Expected/sampling fails");
      add_jobs(command, request, *options);
      command.add_option("--growth-solver", options->growth_solver)->group("");
      set_action(command, request, options, sample, true);
    }

    void add_moduli(CLI::App &app, Request &request)
    {
      const auto options = std::make_shared<check::ModuliOptions>();
      const auto is_json = std::make_shared<bool>(false);
      auto &command = *app.add_subcommand(
          "moduli", "Elastic constants of meshfree rules on square or cubic lattices");
      command.add_option("--kernel", options->kernel,
                         "bond-tensor (default), 'bond-tensor constant' or 'bond-tensor conical'");
      command.add_option(
          "--state", options->state,
          "strain (plane strain, the default as in scenes), stress (plane stress) or 3D; "
          "plane-stress and plane-strain are accepted, too");
      command
          .add_option(check::ratios_option, options->ratios,
                      "Ratios m = horizon / h, separated by commas, semicolons or blanks (default: "
                      "2,3,4,5); may be repeated")
          ->allow_extra_args(false);
      command.add_option("--E", options->E, "Young's modulus of the material (default: 1)");
      command.add_option("--rules", options->rules, "Rules, comma separated (default: all)");
      command.add_flag("--json", *is_json, "Print records instead of the table");
      set_action(command, request,
                 [=]
                 {
                   std::replace(options->state.begin(), options->state.end(), '-', ' ');
                   const auto found = check::moduli_of_rules(*options);
                   return print(*is_json ? io::to_json(found)
                                         : report::study_text(check::moduli_view(found), found));
                 });
    }

    void add_weights(CLI::App &app, Request &request)
    {
      const auto options = std::make_shared<check::RuleOnLattice>();
      auto &command =
          *app.add_subcommand("weights", "Weights of a rule on a square or cubic lattice, as CSV");
      command.add_option("RULE", options->rule, "Rule, see 'plumbline list methods'")->required();
      command.add_option("--m", options->m, "Horizon over mesh size (default: 3)");
      command.add_option("--h", options->h, "Mesh size (default: 1)");
      command.add_option("--kernel", options->kernel,
                         "Kernel type (default: linear-decay), see 'plumbline list kernels'");
      command.add_option("--dimension", options->dimension, "2 (default) or 3");
      set_action(command, request, [=] { return print(check::weights_csv(*options)); });
    }

    void add_certify(CLI::App &app, Request &request)
    {
      const auto options = std::make_shared<CertifyOptions>();
      auto &command = *app.add_subcommand(
          "certify", "Certify values of a solution by two independent methods with error bounds");
      command
          .add_option("SCENE", options->scene_file,
                      "Scene file (.prm or .json) with Output/points, Reference/method and a "
                      "meshfree rule")
          ->required();
      command.add_option("-o,--output", options->output,
                         "Output folder (default: results/<scene>)");
      command.add_option("--set", request.settings, "Section/key=value, overrides the scene file");
      command
          .add_option("--reference-level", options->reference_level,
                      "Level of the scene whose mesh size the Galerkin method takes; 1 is the "
                      "coarsest (default: the finest)")
          ->check(CLI::Range(1u, most_levels));
      add_threads(command, request);
      command.add_flag("--quiet", options->quiet, "Print nothing but errors");
      command.add_flag("--json", options->json, "Print certificate.json instead of the table");
      set_action(command, request, options, certify, true);
    }

    void add_grade(CLI::App &app, Request &request)
    {
      const auto options = std::make_shared<GradeOptions>();
      auto &command = *app.add_subcommand(
          "grade", "Grade the values of another code against a certificate: digits, order, limit");
      command.add_option("FILE", options->files,
                         "Values of your code at the certified points: CSV with x,y,u of a scalar, "
                         "x,y,u,v or x,y,u1,u2 of a vector, in three dimensions x,y,z and u or "
                         "u1,u2,u3, in one dimension x,u; a file for each grid");
      command
          .add_option("--problem", options->problem,
                      "A problem of the certified set, e.g. NLB-07 ('plumbline list problems'), or "
                      "certificate.json of 'certify'")
          ->required();
      command
          .add_option(sizes_option, options->h,
                      "Mesh size of each file, separated by commas, semicolons or blanks; may be "
                      "repeated")
          ->allow_extra_args(false);
      command
          .add_option("--require", options->required,
                      "digits=N, order=P, limit=certified, separated by commas: exit with 1 if one "
                      "does not hold on the finest grid")
          ->allow_extra_args(false);
      command.add_flag("--points", options->is_points,
                       "Print the points of the problem as CSV, for your code to read");
      command.add_flag("--scene", options->is_scene, "Print the scene of the problem");
      command.add_flag("--quiet", options->quiet, "Print nothing but errors");
      set_action(command, request, [=] { return grade(*options); });
    }

    enum class Words
    {
      one,
      several ///< a phrase, with or without quotes
    };

    /// What takes one word or phrase and prints or writes something about it.
    void add_word(CLI::App &app, Request &request, const std::string &name, const std::string &help,
                  const std::string &word, const std::string &word_help,
                  const std::function<int(const std::string &)> &action, Words words = Words::one)
    {
      const auto all = std::make_shared<std::vector<std::string>>();
      auto &command = *app.add_subcommand(name, help);
      auto &option = *command.add_option(word, *all, word_help)->required();
      if (words == Words::one)
        option.expected(1);
      set_action(command, request,
                 [=]
                 {
                   std::string text;
                   for (const std::string &one : *all)
                     text += (text.empty() ? "" : " ") + one;
                   return action(text);
                 });
    }

    void add_words(CLI::App &app, Request &request)
    {
      const auto is_pdf = std::make_shared<bool>(false);
      add_word(app, request, "report",
               "Rebuild tables, charts and page from the numbers of a run, also of one that was "
               "killed",
               "DIR", "Output folder of a run",
               [=](const std::string &folder) { return driver::rebuild_report(folder, *is_pdf); });
      app.get_subcommand("report")->add_flag("--pdf", *is_pdf, pdf_help);
      const auto as_matrix = std::make_shared<bool>(false);
      add_word(app, request, "list",
               "List methods, models, analyses, kernels, scenes or certified problems", "WHAT",
               "methods, models, analyses, kernels, scenes or problems",
               [=](const std::string &what)
               {
                 list(what, *as_matrix);
                 return 0;
               });
      app.get_subcommand("list")->add_flag("--matrix", *as_matrix,
                                           "Capabilities of methods, as a table");
      const auto is_short = std::make_shared<bool>(false);
      add_word(app, request, "template", "Print a scene with every key and its help", "MODEL",
               "scalar, tensor, LPS, variational, double-well or crack",
               [=](const std::string &model) {
                 return print(*is_short ? scene::short_template(model)
                                        : scene::scene_template(model));
               });
      app.get_subcommand("template")->add_flag("--short", *is_short, "A scene of at most 20 lines");
      add_word(
          app, request, "describe", "Print meaning, default and allowed values of keys", "KEY",
          "Section/key, Section, or words to search for in the help of all keys",
          [](const std::string &key) { return print(scene::describe(key)); }, Words::several);
    }

    void add_new(CLI::App &app, Request &request)
    {
      const auto options = std::make_shared<scene::NewSceneOptions>();
      auto &command = *app.add_subcommand("new", "Write a short scene to start from");
      command.add_option("NAME", options->name, "Scene file; .prm may be left out")->required();
      command.add_option("--kind", options->kind,
                         "scalar (default), elastic, LPS, variational, double-well, or crack: "
                         "dynamic fracture in SI units");
      command.add_option("--domain", options->domain,
                         "square (default), cube, or a mesh file (.geo or .msh)");
      command.add_option("--kernel", options->kernel, "Kernel type, see 'plumbline list kernels'");
      command.add_option("--methods", options->methods,
                         "Methods, comma separated, see 'plumbline list methods'");
      set_action(command, request, [=] { return print(write_scene(*options)); });
    }

    /// @param topic  a command, what 'plumbline list' lists, a key, or words
    int help(const CLI::App &app, const std::string &topic)
    {
      const std::string text = help_text(app, topic);
      if (text.empty() && is_listed(topic))
      {
        list(topic, false);
        return 0;
      }
      return print(text.empty() ? scene::describe(topic) : text);
    }

    /// Commands about the command itself.
    void add_own(CLI::App &app, Request &request)
    {
      add_word(
          app, request, "help", "Print the help of a command, a list, or keys", "TOPIC",
          "A command, methods, models, analyses, kernels, scenes, problems, or a key as in "
          "describe",
          [&app](const std::string &topic) { return help(app, topic); }, Words::several);
      app.get_subcommand("help")->get_option("TOPIC")->required(false);
      add_word(app, request, "completion", "Print a script that completes commands and options",
               "SHELL", "bash or zsh",
               [&app](const std::string &shell) { return print(completion(app, shell)); });
      set_action(*app.add_subcommand("man", "Print the manual page"), request,
                 [&app] { return print(man_page(app, PLUMBLINE_VERSION)); });
    }

    void add_commands(CLI::App &app, Request &request)
    {
      app.set_version_flag("--version", PLUMBLINE_VERSION);
      app.require_subcommand(1);
      app.ignore_case(); // of commands, as they are added
      add_run(app, request);
      add_check(app, request);
      add_probe(app, request);
      for (const AnalysisRow &row : analyses())
        add_analysis(app, request, row);
      add_sample(app, request);
      add_certify(app, request);
      add_grade(app, request);
      add_moduli(app, request);
      add_weights(app, request);
      add_words(app, request);
      add_new(app, request);
      add_own(app, request);
    }

    /// What is asked for, by all ranks or the first, and its exit code.
    int act(const Request &request)
    {
      // whatever one rank alone fails at, all of them end with it
      const base::SeparateCommunicator ranks(base::Communicator::all());
      constexpr double patience = 30; // of a rank that failed, with others that wait for it [s]
      int exit_code = 0;
      try
      {
        ranks.communicator().together(
            [&]
            {
              if (request.is_for_all_ranks || ranks.communicator().rank() == 0)
                exit_code = request.action();
            },
            patience);
      }
      catch (const InputError &error)
      {
        exit_code = fail(error.what(), 2);
      }
      catch (const NumericalError &error)
      {
        exit_code = fail(error.what(), 3);
      }
      catch (const std::exception &error)
      {
        exit_code = fail(explain_unexpected(error.what()), 3);
      }
      return exit_code;
    }

    /// By mpirun or a batch system's launcher, perhaps as one of several ranks.
    bool is_launched()
    {
      const auto names = {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK"};
      return std::any_of(names.begin(), names.end(),
                         [](const char *name) { return getenv(name) != nullptr; });
    }
  } // namespace

  int command(int argc, char **argv)
  {
    CLI::App app("Plumbline: verification of discretisations of nonlocal models and peridynamics.");
    Request request;
    add_commands(app, request);
    try
    {
      // CLI11 takes the last argument first, and no name with them
      app.name(argv[0]);
      std::vector<std::string> arguments =
          join_numbers(join_numbers({argv + 1, argv + argc}, angles_option), directions_option);
      request.arguments = arguments;
      std::reverse(arguments.begin(), arguments.end());
      app.parse(std::move(arguments));
    }
    catch (const CLI::Success &answer) // --help, --version
    {
      return finish_output(app.exit(answer));
    }
    catch (const CLI::ParseError &error)
    {
      std::cerr << "plumbline: " << explain(error, app) << '\n';
      return 2;
    }
    // without mpirun: no daemon beside it, nor a shared folder, which one that ends may remove as
    // another begins, nor network libraries, one of which spends a fifth of a second on timing
    setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
    if (!is_launched())
    {
      setenv("OMPI_MCA_orte_create_session_dirs", "false", 0);
      setenv("OMPI_MCA_pml", "ob1", 0);
    }
    // what deal.II's debug build finds is an error that is told, as of other builds
    dealii::deal_II_exceptions::disable_abort_on_exception();
    const dealii::Utilities::MPI::MPI_InitFinalize mpi(
        argc, argv,
        request.n_threads == 0 ? dealii::numbers::invalid_unsigned_int : request.n_threads);
    return finish_output(act(request));
  }
} // namespace plumbline::app
