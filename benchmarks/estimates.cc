// Whether error estimates of Galerkin solutions are bounds: every shipped scene with a known
// solution, and loads without one against h/8 and one more degree, by every Galerkin method that
// can do them. Run: build/release/benchmarks/estimates [--seconds S] [SCENE ...]
//   --seconds S  leave out levels that are expected to be dearer, to solve for once (default: 3 CPU
//   s)
// Exit code 1: an error is above its estimate, or nothing was audited. Takes half an hour.

#include "base/error.h"
#include "estimate_audit.h"
#include "method/another_operator.h"
#include "reference/method.h"
#include "scene/problem.h"
#include "study/refusal.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>

using namespace plumbline;
namespace fs = std::filesystem;

namespace
{
  /// The load of that case is not that of its solution: to be shown.
  bool is_wrong_on_purpose(const std::string &scene, const std::string &problem)
  {
    return scene == "failures/horizon_beyond_domain" && problem == "local";
  }

  class Audit
  {
  public:
    explicit Audit(double seconds) : seconds_(seconds) {}

    void add(const fs::path &file)
    {
      try
      {
        const scene::Scene scene = scene::read_scene(file.string());
        if (scene.is_no_problem())
          return; // estimates are of statics
        const std::string name =
            file.parent_path().filename().string() + "/" + file.stem().string();
        for (unsigned int c = 0; c < scene.problem.case_names().size(); ++c)
          if (!is_wrong_on_purpose(name, scene.problem.case_names()[c]))
            for (const auto &series : scene.study.series)
              for (const auto &method : reference::methods())
                if (method::is_reference(*method))
                  add(name, scene, c, series, *method);
      }
      catch (const InputError &error)
      {
        std::printf("%s: %s\n", file.c_str(), error.what());
      }
    }

    /// @return  whether all is well
    bool conclude() const
    {
      std::size_t n_good = 0, n = 0;
      std::vector<audit::Entry> all;
      for (const auto &[kind, entries] : entries_)
      {
        const auto good = std::count_if(entries.begin(), entries.end(),
                                        [](const audit::Entry &e) { return e.is_bound(); });
        std::printf("%-16s true <= estimate in %td of %zu, median ratio %.3g\n", kind.c_str(), good,
                    entries.size(), median_ratio(entries));
        n_good += static_cast<std::size_t>(good);
        n += entries.size();
        all.insert(all.end(), entries.begin(), entries.end());
      }
      std::printf("true <= estimate in %zu of %zu, median ratio %.3g\n", n_good, n,
                  median_ratio(all));
      return n > 0 && n_good == n;
    }

  private:
    /// The levels of a series as far as they are cheap.
    void add(const std::string &name, const scene::Scene &scene, unsigned int c,
             const problem::Series &series, const method::Method &method)
    {
      constexpr unsigned int much_finer = 8;
      constexpr double growth = 16; // of the finer solutions of an estimate
      double seconds = 0;
      try
      {
        for (const auto &level : series.levels)
        {
          if (seconds * growth > seconds_)
            return;
          const scene::Case one = make_case(scene, c, level);
          if (!study::refusal(method, scene, one.problem, {}).empty())
            return;
          for (const auto &entry : audit::audit(one, method, much_finer, seconds))
            print(name + " " + series.name, entry);
        }
      }
      catch (const std::runtime_error &error)
      {
        std::printf("%s %s %s: %s\n", name.c_str(), series.name.c_str(), method.name().c_str(),
                    error.what());
      }
    }

    void print(const std::string &scene, const audit::Entry &entry)
    {
      std::printf("%-50s %-20s %-5s h = %-8.3g %-8s true %9.3e estimate %9.3e ratio %7.3f%s\n",
                  scene.c_str(), entry.problem.c_str(), entry.method.c_str(), entry.h,
                  entry.norm.c_str(), entry.truth, entry.estimate, entry.ratio(),
                  entry.is_bound() ? "" : "  TOO SMALL");
      std::fflush(stdout);
      const bool is_cheap = entry.problem.find("2 h") != std::string::npos;
      entries_[entry.norm + (is_cheap ? ", by 2 h" : "")].push_back(entry);
    }

    double seconds_;
    std::map<std::string, std::vector<audit::Entry>> entries_;
  };
} // namespace

int main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  double seconds = 3;
  std::vector<fs::path> files;
  for (int i = 1; i < argc; ++i)
    if (std::string(argv[i]) == "--seconds" && i + 1 < argc)
      seconds = std::atof(argv[++i]);
    else
      files.emplace_back(argv[i]);
  if (files.empty())
    for (const auto &entry : fs::recursive_directory_iterator(PLUMBLINE_SCENES))
      if (entry.path().extension() == ".prm")
        files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  Audit audit(seconds);
  for (const fs::path &file : files)
    audit.add(file);
  return audit.conclude() ? 0 : 1;
}
