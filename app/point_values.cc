#include "point_values.h"

#include "base/error.h"
#include "problem/inside.h"
#include "scene/mesh.h"
#include "scene/problem.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <limits>

namespace plumbline::app
{
  namespace fs = std::filesystem;
  using dealii::Point;

  namespace
  {
    std::string name_of(const analysis::Record &run)
    {
      std::string name = run.key.problem + "_" + run.key.series + "_" + run.key.method;
      std::replace_if(
          name.begin(), name.end(),
          [](unsigned char c) { return std::isalnum(c) == 0 && c != '.'; }, '_');
      return name;
    }

    /// "u", or "u1" and "u2".
    std::string column(const std::string &name, unsigned int component, unsigned int n_components)
    {
      return name + (n_components == 1 ? "" : std::to_string(component + 1));
    }

    void write_header(std::ostream &out, unsigned int n_components, bool has_exact, bool has_change,
                      bool has_estimate)
    {
      out << "x,y";
      const auto name = [&](const std::string &one)
      {
        for (unsigned int c = 0; c < n_components; ++c)
          out << ',' << column(one, c, n_components);
      };
      name("u");
      if (has_exact)
      {
        name("exact");
        name("error");
      }
      if (has_change)
        name("change");
      out << (has_estimate ? ",estimate\n" : "\n");
    }
  } // namespace

  PointValues::PointValues(const scene::Scene &scene)
  {
    if (scene.output.points.empty())
      return;
    file_ = (fs::path(scene.folder) / scene.output.points).string();
    try
    {
      points_ = scene::read_nodes(file_, &lines_);
      if (points_.empty())
        throw InputError("'" + file_ + "' has no points; give one x,y on each line");
      require_inside(scene::make_problem(scene, 0, scene.study.series.front().levels.front()));
    }
    catch (const InputError &error)
    {
      throw InputError("Output/points = " + scene.output.points + ": " + error.what());
    }
  }

  std::vector<Point<2>> PointValues::of(const problem::Problem<2> &problem) const
  {
    std::vector<Point<2>> points;
    for (const Point<2> &x : points_)
      points.push_back(Point<2>() + (x - problem.origin));
    return points;
  }

  void PointValues::require_inside(const problem::Problem<2> &problem) const
  {
    const auto is_inside = problem::inside(problem);
    const std::vector<Point<2>> points = of(problem);
    for (std::size_t k = 0; k < points.size(); ++k)
      if (!is_inside(points[k]))
        throw InputError("'" + file_ + "', line " + std::to_string(lines_[k]) + ": (" +
                         std::to_string(points_[k][0]) + ", " + std::to_string(points_[k][1]) +
                         ") lies outside of the domain; take it out");
  }

  void PointValues::write(const problem::Problem<2> &problem, const analysis::Solution &solution,
                          const analysis::Record &run, const std::vector<double> &estimate,
                          const fs::path &folder)
  {
    require_inside(problem);
    const unsigned int n = problem.n_components;
    const std::string name = name_of(run);
    std::vector<double> &before = before_[name];
    fs::create_directories(folder);
    const fs::path file = folder / (name + "_level" + std::to_string(run.key.level + 1) + ".csv");
    std::ofstream out(file);
    out.precision(std::numeric_limits<double>::max_digits10);
    write_header(out, n, problem.solution.has_value(), !before.empty(), !estimate.empty());
    const std::vector<Point<2>> points = of(problem);
    std::vector<double> values;
    for (std::size_t k = 0; k < points_.size(); ++k)
    {
      const Point<2> &x = points[k];
      out << points_[k][0] << ',' << points_[k][1];
      for (unsigned int c = 0; c < n; ++c)
      {
        values.push_back(solution.value(x, c));
        out << ',' << values.back();
      }
      const double *u = &values[k * n];
      if (problem.solution)
      {
        std::vector<double> exact;
        for (unsigned int c = 0; c < n; ++c)
        {
          exact.push_back(problem.solution->value(x, c));
          out << ',' << exact.back();
        }
        for (unsigned int c = 0; c < n; ++c)
          out << ',' << u[c] - exact[c];
      }
      for (unsigned int c = 0; c < n && !before.empty(); ++c)
        out << ',' << u[c] - before[k * n + c];
      if (!estimate.empty())
        out << ',' << estimate[k];
      out << '\n';
    }
    if (!out.flush())
      throw InputError("cannot write all of '" + file.string() +
                       "'; free some space, or give another output folder (-o)");
    before = std::move(values);
  }
} // namespace plumbline::app
