#include "stability.h"

#include "base/error.h"
#include "methods.h"
#include "meshfree/vtu.h"
#include "study/stability.h"
#include "study/sweep.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <sstream>

namespace plumbline::app
{
  namespace fs = std::filesystem;
  using study::StabilityRow;

  namespace
  {
    using Table = std::vector<std::vector<std::string>>; ///< the first row is its head

    std::string number(double value)
    {
      std::ostringstream text;
      text << std::setprecision(4) << value;
      return text.str();
    }

    std::vector<std::string> line(const StabilityRow &row)
    {
      const study::Stability &s = row.stability;
      if (!row.failure.empty())
        return {row.method, number(row.m()), number(row.h), row.failure};
      const auto &d = s.diagnostics;
      const auto known = [](bool is, const std::string &text) { return is ? text : "-"; };
      const auto &c = row.consistency;
      return {
          row.method,
          number(row.m()),
          number(row.h),
          std::to_string(s.n_unknowns),
          number(s.smallest),
          number(s.largest),
          std::to_string(s.n_zero),
          known(s.has_signs, number(s.signs.asymmetry)),
          known(s.has_signs, s.signs.is_m_matrix() ? "yes" : "no"),
          known(s.has_signs, std::to_string(s.signs.n_parts)),
          known(s.inverse_norm > 0, (s.is_norm_exact ? "" : ">= ") + number(s.inverse_norm)),
          known(c.barrier > 0 && s.signs.is_m_matrix(), number(c.barrier)),
          known(d.n_neighbours > 0, number(d.smallest_weight_ratio)),
          known(d.n_conditions > 0, std::to_string(d.rank) + "/" + std::to_string(d.n_conditions)),
          known(d.n_conditions > 0, number(d.smallest_pivot)),
          known(c.n_inner > 0, std::to_string(c.degree))};
    }

    const std::vector<std::string> head = {"method",     "m",       "h",          "unknowns",
                                           "smallest",   "largest", "zero modes", "asymmetry",
                                           "M-matrix",   "parts",   "|A^-1|",     "barrier",
                                           "min weight", "rank",    "pivot",      "degree"};

    /// In columns, '|' between them for Markdown.
    std::string print(const Table &table, bool is_markdown)
    {
      std::vector<std::size_t> width;
      for (const auto &row : table)
        for (std::size_t c = 0; c < row.size(); ++c)
        {
          width.resize(std::max(width.size(), c + 1));
          if (row.size() == table.front().size())
            width[c] = std::max(width[c], row[c].size());
        }
      std::ostringstream text;
      for (std::size_t r = 0; r < table.size(); ++r)
      {
        for (std::size_t c = 0; c < (is_markdown ? width.size() : table[r].size()); ++c)
          text << (is_markdown ? "| " : "") << std::left << std::setw(static_cast<int>(width[c]))
               << (c < table[r].size() ? table[r][c] : "") << (is_markdown ? " " : "  ");
        text << (is_markdown ? "|\n" : "\n");
        for (std::size_t c = 0; c < width.size() && is_markdown && r == 0; ++c)
          text << "|---" << (c + 1 == width.size() ? "|\n" : "");
      }
      return text.str();
    }

    const char *const meaning = "smallest, largest: eigenvalues of the symmetric part in the "
                                "discrete L2 inner product; the\n"
                                "smallest is the coercivity constant. |A^-1|: how far u moves at "
                                "most by a load of size 1;\n"
                                "barrier: what the maximum principle bounds it by, of M-matrices. "
                                "min weight: relative to its\n"
                                "area. rank, pivot: of the moments asked of a family. degree: of "
                                "polynomials that are mapped\n"
                                "exactly, at inner nodes.\n";

    std::string report(const scene::Scene &scene, const std::vector<StabilityRow> &rows,
                       const std::vector<study::StabilityVerdict> &verdicts, bool is_markdown)
    {
      Table table{head}, summary{{"method", "verdict", "condition", "explanation"}};
      for (const StabilityRow &row : rows)
        table.push_back(line(row));
      for (const auto &v : verdicts)
        summary.push_back({v.method, v.verdict, v.condition, v.explanation});
      return (is_markdown ? "# Stability: " : "") + scene.name + "\n\n" +
             print(table, is_markdown) + "\n" + meaning + "\n" + print(summary, is_markdown);
    }

    nlohmann::ordered_json to_json(const scene::Scene &scene, const std::vector<StabilityRow> &rows,
                                   const std::vector<study::StabilityVerdict> &verdicts)
    {
      using Json = nlohmann::ordered_json;
      Json json{{"scene", scene.name}, {"levels", Json::array()}, {"verdicts", Json::array()}};
      for (const StabilityRow &row : rows)
      {
        const study::Stability &s = row.stability;
        json["levels"].push_back({{"method", row.method},
                                  {"series", row.series},
                                  {"h", row.h},
                                  {"horizon", row.horizon},
                                  {"failure", row.failure},
                                  {"unknowns", s.n_unknowns},
                                  {"smallest_eigenvalue", s.smallest},
                                  {"largest_eigenvalue", s.largest},
                                  {"zero_modes", s.n_zero},
                                  {"has_signs", s.has_signs},
                                  {"asymmetry", s.signs.asymmetry},
                                  {"rows_with_positive_entries", s.signs.n_positive},
                                  {"rows_not_dominant", s.signs.n_weak},
                                  {"rows_not_tied", s.signs.n_loose},
                                  {"parts", s.signs.n_parts},
                                  {"is_m_matrix", s.has_signs && s.signs.is_m_matrix()},
                                  {"inverse_norm", s.inverse_norm},
                                  {"is_inverse_norm_exact", s.is_norm_exact},
                                  {"barrier", row.consistency.barrier},
                                  {"negative_weights", s.diagnostics.n_negative_weights},
                                  {"smallest_weight", s.diagnostics.smallest_weight_ratio},
                                  {"moment_conditions", s.diagnostics.n_conditions},
                                  {"moment_rank", s.diagnostics.rank},
                                  {"moment_pivot", s.diagnostics.smallest_pivot},
                                  {"inner_nodes", row.consistency.n_inner},
                                  {"exact_degree", row.consistency.degree},
                                  {"notes", s.diagnostics.notes}});
      }
      for (const auto &v : verdicts)
        json["verdicts"].push_back({{"method", v.method},
                                    {"verdict", v.verdict},
                                    {"condition", v.condition},
                                    {"explanation", v.explanation}});
      return json;
    }

    void write_mode(const study::DiscreteOperator &matrix, const std::vector<double> &mode,
                    const fs::path &file)
    {
      std::vector<dealii::DataOutBase::Patch<0, 2>> points(matrix.nodes.size());
      for (unsigned int i = 0; i < points.size(); ++i)
      {
        points[i].vertices[0] = matrix.nodes[i];
        points[i].patch_index = i;
        points[i].data.reinit(matrix.n_components, 1);
        for (unsigned int c = 0; c < matrix.n_components; ++c)
          points[i].data(c, 0) = static_cast<float>(mode[i * matrix.n_components + c]);
      }
      fs::create_directories(file.parent_path());
      meshfree::write_vtu(points, matrix.n_components, file.string());
    }

    std::string file_name(const StabilityRow &row)
    {
      std::string name = row.method + "_" + row.series;
      std::replace_if(
          name.begin(), name.end(),
          [](unsigned char c) { return std::isalnum(c) == 0 && c != '.'; }, '_');
      return name + ".vtu";
    }

    void write(const fs::path &file, const std::string &text)
    {
      if (!(std::ofstream(file) << text).flush())
        throw InputError("cannot write '" + file.string() + "'; give a writable folder with -o");
    }

    StabilityRow measure_level(const study::Method &method, const scene::Scene &scene,
                               const scene::Problem &problem, const std::string &series,
                               const scene::Level &level, const fs::path &modes)
    {
      StabilityRow row{method.name(), series, level.h, level.horizon, {}, {}, {}};
      try
      {
        const auto matrix = method.discrete_operator(scene, problem);
        if (!matrix)
          throw InputError("Methods/names: '" + method.name() +
                           "' shows no operator, so nothing can be measured; leave it out "
                           "(--methods)");
        row.stability = study::measure(*matrix);
        row.consistency = study::check_consistency(*matrix, problem);
        if (!modes.empty())
          write_mode(*matrix, row.stability.mode, modes / file_name(row));
      }
      catch (const NumericalError &error)
      {
        row.failure = error.what();
      }
      return row;
    }

    /// Whether verdicts are as the scene expects; says which are not.
    bool hold(const scene::Scene &scene, const std::vector<study::StabilityVerdict> &verdicts)
    {
      bool all_hold = true;
      for (const scene::Expected &expected : scene.expected_stability)
      {
        const auto found =
            std::find_if(verdicts.begin(), verdicts.end(),
                         [&](const auto &verdict) { return verdict.method == expected.method; });
        if (found != verdicts.end() && found->verdict == expected.verdict)
          continue;
        all_hold = false;
        std::cerr << "not as expected: " << expected.text << ": found "
                  << (found == verdicts.end() ? "no such method" : found->verdict) << '\n';
      }
      return all_hold;
    }
  } // namespace

  int stability(const StabilityOptions &options)
  {
    auto overrides = options.overrides;
    if (!options.methods.empty())
      overrides.push_back({"Methods/names", options.methods});
    const scene::Scene scene = scene::read_scene(options.scene_file, overrides);
    const study::Methods methods = study::choose_methods(scene, all_methods());

    const fs::path folder =
        options.output.empty() ? fs::path("results") / scene.name : fs::path(options.output);
    std::error_code error;
    fs::create_directories(folder, error);
    write(folder / "stability.md", "");

    std::vector<StabilityRow> rows;
    for (const auto &series : scene.series)
    {
      const auto n_levels = options.n_levels == 0
                                ? series.levels.size()
                                : std::min<std::size_t>(options.n_levels, series.levels.size());
      for (std::size_t level = 0; level < n_levels; ++level)
      {
        const scene::Problem problem = scene::make_problem(scene, 0, series.levels[level]);
        for (const auto &method : methods)
          rows.push_back(measure_level(*method, scene, problem, series.name, series.levels[level],
                                       level + 1 == n_levels ? folder / "modes" : fs::path()));
      }
    }
    std::vector<study::StabilityVerdict> verdicts;
    for (const auto &method : methods)
    {
      std::vector<StabilityRow> own;
      std::copy_if(rows.begin(), rows.end(), std::back_inserter(own),
                   [&](const StabilityRow &row) { return row.method == method->name(); });
      verdicts.push_back(study::judge(own));
    }
    std::stable_sort(rows.begin(), rows.end(), // method by method, as they were named
                     [&](const StabilityRow &a, const StabilityRow &b)
                     {
                       const auto rank = [&](const StabilityRow &row)
                       {
                         return std::find_if(methods.begin(), methods.end(),
                                             [&](const auto &method)
                                             { return method->name() == row.method; });
                       };
                       return rank(a) < rank(b);
                     });

    const std::string json = to_json(scene, rows, verdicts).dump(2) + "\n";
    write(folder / "stability.json", json);
    write(folder / "stability.md", report(scene, rows, verdicts, true));
    if (options.json)
      std::cout << json;
    else if (!options.quiet)
      std::cout << report(scene, rows, verdicts, false)
                << "\nwritten: " << (folder / "stability.md").string() << '\n';
    return options.check && !hold(scene, verdicts) ? 1 : 0;
  }
} // namespace plumbline::app
