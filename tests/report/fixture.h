#pragma once

#include "report/plot.h"
#include "study/solution_record.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <utility>
#include <vector>

/// Results such as a δ-convergence study leaves behind, from formulas: 2 problems × 2 series × 5
/// methods × 5 levels, with everything that is awkward to print.
namespace plumbline::report::fixture
{
  struct Model
  {
    std::string method;
    study::MethodFamily family;
    double plateau, factor, rate; ///< error = plateau + factor horizon^rate
    double cost;                  ///< CPU seconds per unknown
    unsigned int iterations;
  };

  inline std::vector<Model> models()
  {
    return {{"FA", study::MethodFamily::meshfree, 7.4e-3, .05, 1, 2e-7, 12},
            {"IPA-AC", study::MethodFamily::meshfree, 1.26e-2, .3, 2, 4e-7, 12},
            {"IPA-AC recalibrated", study::MethodFamily::meshfree, 0, .31, 2, 5e-7, 12},
            {"P0", study::MethodFamily::reference, 6.6e-3, .4, 2, 3e-6, 16},
            {"Q1", study::MethodFamily::reference, 0, .2, 2, 6e-6, 16}};
  }

  inline study::StudyResults make(const std::vector<std::string> &problems,
                                  const std::vector<double> &ratios,
                                  const std::vector<Model> &models, unsigned int n_levels)
  {
    study::StudyResults results;
    results.scene_name = "compatibility_scalar";
    results.purpose =
        "Which quadrature rules stay right as the horizon δ goes to 0 with δ/h fixed?";
    results.regime = scene::Regime::delta;
    results.scene_text = "# Compatibility\nsubsection Kernel\n  set profile = "
                         "<script>alert(1)</script> & \"quoted\"\nend\n";
    results.provenance = {{"version", "0.1.0"},
                          {"libraries", "deal.II 9.4.1, FFTW 3.3.10"},
                          {"machine", "2 cores & 8 GB"}};
    results.decisive_error = "nodal Linf | exact";
    results.is_complete = true;
    double scale = 1;
    for (const std::string &problem : problems)
    {
      for (const double m : ratios)
      {
        const std::string series = "m = " + std::to_string(static_cast<int>(m));
        for (const Model &model : models)
        {
          study::Trend trend{model.method,
                             model.family,
                             problem,
                             series,
                             results.decisive_error,
                             study::Axis::horizon,
                             {},
                             {},
                             1,
                             {},
                             model.rate,
                             .03,
                             scale * model.plateau / m,
                             2e-5,
                             model.plateau > 0 ? study::Outcome::stalls : study::Outcome::converges,
                             model.plateau > 0 ? "not AC" : "AC",
                             "the error tends to a plateau of " +
                                 std::to_string(scale * model.plateau / m) + " ± 0.00002"};
          for (unsigned int level = 0; level < n_levels; ++level)
          {
            study::Record run;
            run.key.method = model.method;
            run.key.family = model.family;
            run.key.problem = problem;
            run.key.series = series;
            run.key.level = level;
            run.key.h = .1 / std::pow(2., level);
            run.key.horizon = m * run.key.h;
            run.cost.n_unknowns = static_cast<std::size_t>(std::pow(1 / run.key.h - 1, 2));
            run.cost.n_bonds = static_cast<std::uint64_t>(3.14 * m * m) * run.cost.n_unknowns;
            run.cost.setup_seconds = model.cost * static_cast<double>(run.cost.n_bonds);
            run.cost.solve_seconds = 2e-7 * static_cast<double>(run.cost.n_unknowns);
            run.cost.peak_bytes = 2000000 + 80 * run.cost.n_unknowns;
            run.cost.n_iterations = model.iterations + level;
            method::Diagnostics diagnostics;
            diagnostics.n_neighbours = static_cast<unsigned int>(3.14 * m * m);
            diagnostics.smallest_weight_ratio =
                model.family == study::MethodFamily::meshfree ? .87 : 1;
            diagnostics.relative_residual = 3e-13;
            diagnostics.operator_backend = "fft";
            diagnostics.n_geometry_checks = 40;
            diagnostics.geometry_difference = 2e-15;
            study::set_diagnostics(run, diagnostics);
            const double error =
                scale * (model.plateau + model.factor * std::pow(run.key.horizon, model.rate)) / m;
            run.set(results.decisive_error, error);
            run.set("averages L2 | reference", .6 * error);
            trend.x.push_back(run.key.horizon);
            trend.values.push_back(error);
            if (level > 0)
              trend.rates.push_back(std::log2(trend.values[level - 1] / error));
            results.records.push_back(run);
          }
          results.trends.push_back(trend);
        }
        for (unsigned int level = 0; level < n_levels; ++level)
          results.references.push_back({problem, series, "Q2", level, .1 / std::pow(2., level),
                                        m * .1 / std::pow(2., level), 3e-5, 1e-5, 2e-6, 3e-5, 4});
        results.references.back().field_estimate = 4e-5;
        results.advice.push_back({problem,
                                  series,
                                  {{1e-2, "IPA-AC recalibrated", .1, 6.2e-3, 5.1e-4},
                                   {1e-4, "IPA-AC recalibrated", .0125, 9.7e-5, 3.2, {"Q1"}},
                                   {1e-6, "Q1", .003125, 4.4e-7, 77}},
                                  {"FA", "IPA-AC", "P0"}});
      }
      scale *= .4;
    }
    for (const Model &model : models)
    {
      study::ErrorMap map{model.method,
                          problems.front(),
                          "m = 3",
                          "cell averages",
                          "xy",
                          .1,
                          .3,
                          {0, -1},
                          {2, 1},
                          4,
                          3,
                          1,
                          {}};
      for (unsigned int i = 0; i < 12; ++i)
        map.values.push_back(model.factor * std::pow(.1, i));
      map.values[3] = std::numeric_limits<double>::quiet_NaN(); // a corner outside the domain
      map.values[8] = 0;
      results.maps.push_back(map);
    }
    results.warnings = {"solution & load contradict each other"};
    results.omissions = {{"outer quadrature", "the lattice has exact entries", "9 of 10 CPU s"},
                         {"the matrix", "one stencil <serves> all nodes", "memory of 1e6 bonds"}};
    base::Cost cheap, dear;
    cheap.solve_seconds = 2e-4;
    cheap.n_bonds = 2800;
    dear.setup_seconds = .05;
    dear.n_bonds = 2801;
    results.savings = {{"FA", .1, .3, cheap, dear, 3e-14}};
    results.left_out = {"Q1, case1, m = 4, h = 0.00625: some 77 CPU s"};
    results.expectations = {{"IPA-AC, case1, m = 3", "not AC", "not AC", true},
                            {"FA, case1, m = 3", "AC", "not AC", false}};
    return results;
  }

  /// The awkward cases: an error that is zero, one that is not a number, a level without solution.
  inline study::StudyResults results()
  {
    study::StudyResults results = make({"case1", "case_2 δ"}, {3, 4}, models(), 5);
    const auto run = [&](const std::string &method, unsigned int level) -> study::Record &
    {
      for (study::Record &one : results.records)
        if (one.key.method == method && one.key.level == level && one.key.problem == "case1")
          return one;
      std::abort();
    };
    run("Q1", 0).set(results.decisive_error, 0);
    run("Q1", 1).set(results.decisive_error, 3e-13);
    run("P0", 2).set(results.decisive_error, std::numeric_limits<double>::quiet_NaN());
    run("FA", 4).failure = "family of node 17 is singular, \"rank\" 17 < 18";
    run("FA", 4).scalars.clear();
    run("IPA-AC", 3).notes = {"kernel clipped at <0>, 12 nodes"};
    run("IPA-AC", 3).set("negative weights", 2);
    study::set_tip_forces(run("IPA-AC", 3), {{{0, .5}, {3e-3, -4e-3}, .1, 5e-3, .05}});
    return results;
  }

  /// A folder that goes away with the test.
  class Folder
  {
  public:
    Folder()
    {
      std::string name = (std::filesystem::temp_directory_path() / "plumbline-XXXXXX").string();
      path_ = mkdtemp(name.data());
    }
    ~Folder() { std::filesystem::remove_all(path_); }
    Folder(const Folder &) = delete;
    const std::filesystem::path &path() const { return path_; }

  private:
    std::filesystem::path path_;
  };

  inline std::string read(const std::filesystem::path &file)
  {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  /// Both axes have a unit, or a ratio.
  inline bool has_units(const Plot &plot)
  {
    const auto has = [](const std::string &label)
    {
      for (const char *const mark : {"[", "relative", " over "})
        if (label.find(mark) != std::string::npos)
          return true;
      return false;
    };
    return has(plot.x_label) && has(plot.y_label);
  }

  inline std::size_t count(const std::string &text, const std::string &part)
  {
    std::size_t n = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
      ++n;
    return n;
  }
} // namespace plumbline::report::fixture
