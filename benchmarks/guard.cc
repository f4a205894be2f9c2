// Does the library still take as few instructions as it did? Clocks on shared machines are off by a
// tenth or more; the instructions of one build are the same each time, whatever else runs.
//
// Options of build/release/benchmarks/guard, which compares with benchmarks/instructions.json:
// - `--write` stores what is counted now
// - `--list` names the kernels, `--only "ball-cell fast"` counts one
// - `--plant 1.25` lets each do a quarter more: it must fail
//
// Runs itself under valgrind's callgrind. Each kernel does n passes and then 2 n of them, with a
// dump before and after: a unit costs the difference over those of n passes, so that whatever
// happens once cancels. Exit codes: 0 good; 1 more instructions than stored, a kernel that is not
// stored, or a ratio that does not hold; 3 nothing counted. Fewer instructions pass, with a note to
// store them.
// Stored counts hold for one compiler and one kind of vector unit (the loader picks clones of the
// inner loops and of libm by it); on others only the ratios are judged, which are of one run.

#include "guard_kernels.h"

#include <deal.II/base/multithread_info.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <stdexcept>

/// Callgrind dumps its counts before each call.
extern "C" __attribute__((noinline)) void plumbline_guard_mark()
{
  asm volatile("" ::: "memory");
}

namespace
{
  using json = nlohmann::ordered_json;
  using plumbline::benchmarks::GuardKernel;
  namespace fs = std::filesystem;

  /// Counts are the same in every run of a build, to all digits printed; the allocator moves them
  /// by up to 1 % from build to build, what the compiler inlines by some percent. On processors
  /// without AVX2 libm takes up to 8 % more. A lost optimisation costs more than this.
  constexpr double tolerance = .1;

  /// Holds on any compiler and machine, with about twice the room that one needs: what is said of
  /// the methods, and a refactoring must not lose.
  struct Ratio
  {
    const char *of, *over;
    double at_most;
    const char *reason;
  };
  const Ratio ratios[] = {
      {"ball-cell fast", "ball-cell exact", .01, "double precision instead of exact arithmetic"},
      // without wide vectors each register holds two nodes instead of four
      {"stencil apply", "rows apply", .4, "opposite bonds together, a register's worth of nodes"},
      {"family IPA-AC", "family FA", 3, "at m = 3 the circle cuts every other cell"},
      {"family IPA-AC-R2", "family IPA-AC", 2.5, "a small system of moments"},
      {"pairs P1 constant, whole", "pairs P1 constant, cut", .3, "products of integrals"},
      {"dilatation Q1, striped", "dilatation Q1, varying", .3, "rows once for alike surroundings"},
      {"sides P1 tensor, cut", "sides P1 constant, cut", 5, "three entries and their potentials"},
  };

  struct Options
  {
    std::string counts = PLUMBLINE_GUARD_COUNTS;
    std::string only;  ///< a kernel's name; empty: all
    std::string child; ///< where to work, under callgrind
    double plant = 1;  ///< times as many passes as said
    bool is_write = false, is_list = false;
  };

  std::string vectors()
  {
#ifdef __x86_64__
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") ? "AVX2 and FMA"
                                                                           : "baseline";
#else
    return "other";
#endif
  }

  std::vector<GuardKernel> chosen(const Options &options)
  {
    std::vector<GuardKernel> result;
    for (GuardKernel &kernel : plumbline::benchmarks::guard_kernels())
      if (options.only.empty() || options.only == kernel.name)
        result.push_back(std::move(kernel));
    if (result.empty())
      throw std::runtime_error("--only " + options.only + " is no kernel; see guard --list");
    return result;
  }

  /// Under callgrind: three dumps for each kernel, before it, after n passes and after 2 n more.
  void run_kernels(const Options &options)
  {
    json done = json::array();
    for (const GuardKernel &kernel : chosen(options))
    {
      kernel.pass(); // memory and tables of the first time
      const auto n = static_cast<unsigned int>(std::lround(kernel.n_passes * options.plant));
      for (const unsigned int passes : {n, 2 * n})
      {
        plumbline_guard_mark();
        for (unsigned int i = 0; i < passes; ++i)
          kernel.pass();
      }
      plumbline_guard_mark();
      done.push_back({{"name", kernel.name},
                      {"unit", kernel.unit},
                      {"units", kernel.units_per_pass * kernel.n_passes}});
    }
    std::ofstream(options.child + "/kernels.json")
        << json{{"vectors", vectors()}, {"kernels", done}};
  }

  double dumped_instructions(const std::string &file)
  {
    std::ifstream dump(file);
    for (std::string line; std::getline(dump, line);)
      for (const std::string key : {"summary: ", "totals: "})
        if (line.rfind(key, 0) == 0)
          return std::stod(line.substr(key.size()));
    throw std::runtime_error(file + ": callgrind left no counts; is valgrind installed?");
  }

  /// Of dumps, gone at the end.
  struct Folder
  {
    std::string path = (fs::temp_directory_path() / "plumbline_guard_XXXXXX").string();

    Folder()
    {
      if (mkdtemp(path.data()) == nullptr)
        throw std::runtime_error("no folder can be made like " + path);
    }
    Folder(const Folder &) = delete;
    ~Folder()
    {
      std::error_code ignored;
      fs::remove_all(path, ignored);
    }
  };

  double six_digits(double value)
  {
    char text[32];
    std::snprintf(text, sizeof(text), "%.6g", value);
    return std::stod(text);
  }

  /// @return  compiler, vectors, and of each kernel its unit and instructions a unit
  json measure(const Options &options, const std::string &program)
  {
    const Folder folder;
    const std::string &where = folder.path;
    const std::string command =
        "valgrind --tool=callgrind --quiet --dump-before=plumbline_guard_mark "
        "--callgrind-out-file='" +
        where + "/dump' '" + program + "' --child '" + where + "' --plant " +
        std::to_string(options.plant) +
        (options.only.empty() ? "" : " --only '" + options.only + "'") + " 2> '" + where + "/log'";
    if (std::system(command.c_str()) != 0)
    {
      std::ifstream log(where + "/log");
      std::cerr << log.rdbuf();
      throw std::runtime_error("it failed: " + command);
    }
    json result = json::parse(std::ifstream(where + "/kernels.json"));
    json counts = json::object();
    int dump = 0;
    for (const json &kernel : result["kernels"])
    {
      const double once = dumped_instructions(where + "/dump." + std::to_string(dump + 2));
      const double twice = dumped_instructions(where + "/dump." + std::to_string(dump + 3));
      dump += 3;
      counts[kernel["name"].get<std::string>()] = {
          {"unit", kernel["unit"]},
          {"instructions", six_digits((twice - once) / kernel["units"].get<double>())}};
    }
    return {{"compiler", __VERSION__}, {"vectors", result["vectors"]}, {"counts", counts}};
  }

  void write(const Options &options, json measured)
  {
    if (!options.only.empty() || options.plant != 1)
      throw std::runtime_error(
          "--write stores all kernels as they are: without --only and --plant");
    const std::time_t now = std::time(nullptr);
    char date[32];
    std::strftime(date, sizeof(date), "%Y-%m-%d", std::localtime(&now));
    measured["date"] = date;
    std::ofstream(options.counts) << measured.dump(2) << '\n';
    std::cout << "written: " << options.counts << '\n';
  }

  /// @return  whether nothing takes more than it should
  bool compare(const json &measured, const json &stored)
  {
    const bool is_comparable = stored.value("compiler", "") == measured["compiler"] &&
                               stored.value("vectors", "") == measured["vectors"];
    std::printf("instructions, compiler %s, vectors: %s\n",
                measured["compiler"].get<std::string>().c_str(),
                measured["vectors"].get<std::string>().c_str());
    if (!is_comparable)
      std::printf("the stored ones are of compiler %s, vectors: %s: not compared\n",
                  stored.value("compiler", "none").c_str(),
                  stored.value("vectors", "none").c_str());
    bool is_good = true;
    for (const auto &[name, one] : measured["counts"].items())
    {
      const double count = one["instructions"];
      std::printf("  %-28s %12.5g a %-8s", name.c_str(), count,
                  one["unit"].get<std::string>().c_str());
      if (is_comparable)
      {
        const double before =
            stored["counts"].value(name, json::object()).value("instructions", 0.);
        const char *verdict = "";
        if (before == 0)
        {
          verdict = "  NOT STORED";
          is_good = false;
        }
        else if (count > before * (1 + tolerance))
        {
          verdict = "  MORE instructions than stored";
          is_good = false;
        }
        else if (count < before * (1 - tolerance))
          verdict = "  fewer than stored: store them by guard --write";
        std::printf(" stored %12.5g %+7.2f %%%s", before,
                    before == 0 ? 0 : 100 * (count / before - 1), verdict);
      }
      std::printf("\n");
    }
    std::printf("ratios of this run\n");
    for (const Ratio &ratio : ratios)
    {
      const json &counts = measured["counts"];
      if (!counts.contains(ratio.of) || !counts.contains(ratio.over))
        continue;
      const double value = counts[ratio.of]["instructions"].get<double>() /
                           counts[ratio.over]["instructions"].get<double>();
      const bool holds = value <= ratio.at_most;
      is_good = is_good && holds;
      std::printf("  %s over %s: %.3g, at most %g (%s)%s\n", ratio.of, ratio.over, value,
                  ratio.at_most, ratio.reason, holds ? "" : "  DOES NOT HOLD");
    }
    if (!is_good)
      std::printf("if that is meant, store what is counted now: guard --write\n");
    return is_good;
  }

  Options parse(int argc, char **argv)
  {
    Options options;
    for (int i = 1; i < argc; ++i)
    {
      const std::string word = argv[i];
      const auto value = [&]
      {
        if (i + 1 >= argc)
          throw std::runtime_error(word + " wants a value");
        return std::string(argv[++i]);
      };
      if (word == "--write")
        options.is_write = true;
      else if (word == "--list")
        options.is_list = true;
      else if (word == "--only")
        options.only = value();
      else if (word == "--plant")
      {
        const std::string text = value();
        std::size_t end = 0;
        try
        {
          options.plant = std::stod(text, &end);
        }
        catch (const std::logic_error &)
        {
        }
        if (end != text.size() || !(options.plant > 0))
          throw std::runtime_error("--plant " + text + " is not a factor > 0 like 1.25");
      }
      else if (word == "--child")
        options.child = value();
      else if (word == "--counts")
        options.counts = value();
      else
        throw std::runtime_error(
            word + " is not known; choose --write, --list, --only, --plant, --counts");
    }
    return options;
  }
} // namespace

int main(int argc, char **argv)
try
{
  // helpers of the thread pool would spin, and count
  dealii::MultithreadInfo::set_thread_limit(1);
  const Options options = parse(argc, argv);
  if (options.is_list)
    for (const GuardKernel &kernel : chosen(options))
      std::cout << kernel.name << '\n';
  else if (!options.child.empty())
    run_kernels(options);
  else if (const json measured = measure(options, fs::canonical("/proc/self/exe").string());
           options.is_write)
    write(options, measured);
  else
  {
    std::ifstream file(options.counts);
    return compare(measured, file.good() ? json::parse(file) : json::object()) ? 0 : 1;
  }
  return 0;
}
catch (const std::exception &error)
{
  std::cerr << "guard: " << error.what() << '\n';
  return 3;
}
