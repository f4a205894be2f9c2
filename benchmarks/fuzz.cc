// Broken input for every reader: what comes out is a result or one of our two errors, soon.
//   fuzz [--inputs N] [--seed S] [--scenes DIR] [--store DIR] [--input NUMBER]
//        [--seconds S] [--plant crash|hang|exception]
// Inputs are numbered, and each number makes the same input again. They run in processes of many,
// so that a crash or a hang costs one input; it is stored, printed, and the exit code is 1.

#include "base/csv.h"
#include "base/error.h"
#include "fuzz_inputs.h"
#include "geometry/gmsh_script.h"
#include "geometry/mesh_input.h"
#include "io/results_json.h"
#include "meshfree/check/bond_file.h"
#include "scene/mesh.h"

#include <deal.II/base/multithread_info.h>

#include <CLI/CLI.hpp>

#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>

namespace
{
  using namespace plumbline;
  using namespace plumbline::benchmarks;
  namespace fs = std::filesystem;

  /// Inputs of one process.
  constexpr std::uint64_t batch = 1000;

  /// Words of the libraries beneath us, which no user should have to read.
  constexpr std::array foreign = {"json.exception",
                                  "boost",
                                  "Boost",
                                  "dealii",
                                  "CGAL",
                                  "muParser error",
                                  "std::",
                                  "Violated condition",
                                  "Exception on processing",
                                  "terminate"};

  /// The nodes and cells of scenes/check, which bonds are read for.
  struct BondContext
  {
    meshfree::GivenNodes<2> nodes;
    geometry::NodeCells<2> cells;
  };

  BondContext make_context(const std::string &scenes)
  {
    const std::string nodes = scenes + "/check/nodes.csv";
    scene::Scene scene = scene::read_scene(scenes + "/check/check.prm");
    if (scene.domain.mesh.is_lattice())
      scene.domain.mesh.name = "squares";
    scene.methods.nodes = {fs::absolute(nodes).string()};
    for (const problem::Series &series : scene.study.series)
      for (const problem::Level &level : series.levels)
        try // levels of other nodes have other collars
        {
          const geometry::Mesh mesh = scene::make_mesh(scene, level);
          return {meshfree::read_given_nodes<2>(nodes), scene::make_node_cells(scene, level, mesh)};
        }
        catch (const InputError &)
        {
        }
    throw std::runtime_error("no level of scenes/check/check.prm fits its nodes");
  }

  /// A file that is written anew for each input.
  std::string stored(const Input &input, const fs::path &folder, const std::string &name)
  {
    const std::string file =
        (folder / (name + shares[static_cast<unsigned int>(input.reader)].ending)).string();
    std::ofstream(file, std::ios::binary) << input.text;
    return file;
  }

  void read(const Input &input, const fs::path &folder, const BondContext &context)
  {
    const auto file = [&] { return stored(input, folder, "fuzz"); };
    switch (input.reader)
    {
    case Reader::scene:
    {
      const std::string text = scene::parse_scene((folder / "fuzz.prm").string(), input.text).text;
      if (scene::parse_scene((folder / "fuzz.prm").string(), text).text != text)
        throw std::logic_error("a scene that is printed back parses to another one");
      break;
    }
    case Reader::json_scene:
      (void)scene::read_scene(file());
      break;
    case Reader::mesh:
    case Reader::meshed:
      (void)geometry::collar_width(geometry::read_mesh(file(), .5, .5));
      break;
    case Reader::tetrahedra:
      (void)geometry::read_tetrahedra(file(), 1, .5);
      break;
    case Reader::nodes:
    {
      const std::string name = file();
      (void)scene::read_nodes(name);
      (void)meshfree::read_given_nodes<2>(name);
      break;
    }
    case Reader::bonds:
      (void)meshfree::read_given_families(file(), context.nodes, context.cells);
      break;
    case Reader::pictures:
      (void)base::read_number_grid(file());
      break;
    case Reader::results:
      (void)io::read_results(file());
      break;
    case Reader::script:
      geometry::check_script(file());
      break;
    }
  }

  struct Options
  {
    std::uint64_t n_inputs = 100000, seed = 1;
    /// One input takes a thousandth of it; sanitizers and busy machines take their part.
    unsigned int seconds = 30;
    std::string plant; ///< a fault at the tenth input, to show that it is found
    std::string scenes = PLUMBLINE_SCENES, store = "fuzz-failures", input;
  };

  void plant_fault(const std::string &kind)
  {
    if (kind == "crash")
      std::abort();
    while (kind == "hang")
      sleep(1);
    if (kind == "exception")
      throw std::logic_error("planted");
  }

  /// @return  what is wrong with how it ended; empty: nothing
  std::string fault(const Input &input, const fs::path &folder, const BondContext &context,
                    const std::string &plant, bool &is_sound)
  {
    std::string message;
    is_sound = false;
    try
    {
      plant_fault(plant);
      read(input, folder, context);
      is_sound = true;
      return "";
    }
    catch (const InputError &error)
    {
      message = error.what();
    }
    catch (const NumericalError &error)
    {
      message = error.what();
    }
    catch (const std::exception &error)
    {
      return std::string("another exception than ours: ") + error.what();
    }
    for (const char *word : foreign)
      if (message.find(word) != std::string::npos)
        return "a message in a library's words: " + message;
    return message.size() > 20 ? "" : "a message that says nothing: '" + message + "'";
  }

  /// What a process of many inputs tells the one that watches it.
  struct Progress
  {
    std::uint64_t next; ///< input it is at, or behind its last
    std::uint64_t n_sound;
    std::array<std::uint64_t, n_readers> n;
    char fault[400];
  };

  [[noreturn]] void work(const Options &options, std::uint64_t end, const Corpus &corpus,
                         const BondContext &context, const fs::path &folder, Progress &progress)
  {
    for (; progress.next < end; ++progress.next)
    {
      alarm(options.seconds);
      const Input input = make_input(corpus, progress.next);
      ++progress.n[static_cast<unsigned int>(input.reader)];
      bool is_sound = false;
      const bool is_planted = progress.next % batch == 10;
      const std::string found =
          fault(input, folder, context, is_planted ? options.plant : "", is_sound);
      progress.n_sound += is_sound ? 1 : 0;
      if (!found.empty())
      {
        found.copy(progress.fault, sizeof progress.fault - 1);
        _exit(1);
      }
    }
    _exit(0);
  }

  /// How a process ended that did not come to its end.
  std::string description(const Options &options, int status, const Progress &progress)
  {
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM)
      return "took more than " + std::to_string(options.seconds) + " s";
    if (WIFSIGNALED(status))
      return "crashed by signal " + std::to_string(WTERMSIG(status));
    return progress.fault[0] != '\0'
               ? std::string(progress.fault)
               : "ended with exit code " + std::to_string(WEXITSTATUS(status));
  }

  int run_all(const Options &options, const Corpus &corpus, const BondContext &context,
              const fs::path &folder)
  {
    auto *const progress = static_cast<Progress *>(
        mmap(nullptr, sizeof(Progress), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0));
    const std::uint64_t first = options.seed * 1'000'000'000, end = first + options.n_inputs;
    const auto start = std::chrono::steady_clock::now();
    unsigned int n_failures = 0;
    for (progress->next = first; progress->next < end;)
    {
      progress->fault[0] = '\0';
      std::cout.flush();
      const pid_t child = fork();
      if (child == 0)
        work(options, std::min(end, progress->next + batch), corpus, context, folder, *progress);
      int status = 0;
      waitpid(child, &status, 0);
      if (WIFEXITED(status) && WEXITSTATUS(status) == 0)
        continue;
      ++n_failures;
      const Input input = make_input(corpus, progress->next);
      fs::create_directories(options.store);
      const std::string file = stored(input, options.store, std::to_string(progress->next));
      std::cout << "input " << progress->next << " ("
                << shares[static_cast<unsigned int>(input.reader)].name
                << "): " << description(options, status, *progress) << "\n  stored as " << file
                << '\n';
      ++progress->next;
    }
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    std::cout << options.n_inputs << " inputs from " << first << " on in " << seconds.count()
              << " s, " << progress->n_sound << " of them sound:";
    for (unsigned int r = 0; r < n_readers; ++r)
      std::cout << ' ' << progress->n[r] << ' ' << shares[r].name << (r + 1 < n_readers ? "," : "");
    std::cout << "\nfailures: " << n_failures << '\n';
    return n_failures > 0 ? 1 : 0;
  }

  /// One input again, in this process, for a debugger.
  int run_one(const Options &options, const Corpus &corpus, const BondContext &context,
              const fs::path &folder)
  {
    const Input input = make_input(corpus, std::stoull(options.input));
    bool is_sound = false;
    const std::string found = fault(input, folder, context, "", is_sound);
    std::cout << (is_sound ? "sound" : found.empty() ? "refused" : found) << '\n';
    return found.empty() ? 0 : 1;
  }
} // namespace

int main(int argc, char **argv)
{
  Options options;
  CLI::App app("Broken input for every reader of Plumbline.");
  app.add_option("--inputs", options.n_inputs, "How many");
  app.add_option("--seed", options.seed, "Where their numbers begin, in 1e9");
  app.add_option("--scenes", options.scenes, "Sound scenes and meshes");
  app.add_option("--store", options.store, "Folder for inputs that fail");
  app.add_option("--seconds", options.seconds, "Longest time of one input");
  app.add_option("--plant", options.plant, "crash, hang or exception in the tenth input");
  app.add_option("--input", options.input, "The number of one input, to run it alone");
  CLI11_PARSE(app, argc, argv);

  dealii::MultithreadInfo::set_thread_limit(1); // threads do not survive a fork
  setenv("PLUMBLINE_GMSH_SECONDS", "2", 1);
  const fs::path folder =
      fs::temp_directory_path() / ("plumbline_fuzz_" + std::to_string(getpid()));
  fs::create_directories(folder);
  const Corpus corpus = make_corpus(options.scenes);
  const BondContext context = make_context(options.scenes);
  const int code = options.input.empty() ? run_all(options, corpus, context, folder)
                                         : run_one(options, corpus, context, folder);
  fs::remove_all(folder);
  return code;
}
