#include "io/point_values.h"

#include "base/csv.h"
#include "base/error.h"
#include "base/number_text.h"
#include "geometry/tetrahedral_domain.h"
#include "physics/expression.h"
#include "problem/inside.h"
#include "scene/mesh_in_space.h"
#include "scene/on_line.h"
#include "scene/problem.h"
#include "scene/values.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>

namespace plumbline::io
{
  namespace fs = std::filesystem;
  using dealii::Point;

  namespace
  {
    /// "u", or "u1" and "u2".
    std::string column(const std::string &name, unsigned int component, unsigned int n_components)
    {
      return name + (n_components == 1 ? "" : std::to_string(component + 1));
    }

    /// "x", "x,y" or "x,y,z".
    std::string axes_text(std::size_t dimension)
    {
      return std::string("x,y,z").substr(0, 2 * dimension - 1);
    }

    void write_header(std::ostream &out, std::size_t dimension, unsigned int n_components,
                      bool has_exact, bool has_change, bool has_estimate, bool has_gradient)
    {
      out << axes_text(dimension);
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
      out << (has_estimate ? ",estimate" : "");
      for (unsigned int c = 0; c < n_components && has_gradient; ++c)
        for (std::size_t d = 0; d < dimension; ++d)
          out << ',' << column("u", c, n_components) << '_' << "xyz"[d];
      out << '\n';
    }
  } // namespace

  std::string file_stem(const analysis::Record &run)
  {
    std::string name = run.key.problem + "_" + run.key.series + "_" + run.key.method;
    std::replace_if(
        name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0 && c != '.'; },
        '_');
    return name;
  }

  namespace
  {
    fs::path file_of(const analysis::Record &run, const fs::path &folder)
    {
      return folder / (file_stem(run) + "_level" + std::to_string(run.key.level + 1) + ".csv");
    }
  } // namespace

  namespace
  {
    /// Numbers and what separates them: no name of a file.
    bool are_numbers(const std::string &text)
    {
      return text.find_first_not_of("0123456789.,:;eE+- ") == std::string::npos &&
             (text.find_first_of(":;, ") != std::string::npos ||
              text.find_first_of("123456789") == 0 || text.find_first_of("0.-") == 0);
    }
  } // namespace

  PointValues::PointValues(const scene::Scene &scene)
  {
    if (scene.output.points.empty())
      return;
    key_ = "Output/points = " + scene.output.points + ": ";
    try
    {
      const std::size_t dimension = scene.domain.is_in_space() ? 3 : is_on_intervals(scene) ? 1 : 2;
      if (are_numbers(scene.output.points))
        read_text(scene.output.points, dimension);
      else
      {
        file_ = (fs::path(scene.folder) / scene.output.points).string();
        read(dimension);
      }
    }
    catch (const InputError &error)
    {
      throw InputError(key_ + error.what());
    }
    // what is wrong with the domain is no fault of the points
    const problem::Level &first = scene.study.series.front().levels.front();
    if (scene.domain.is_in_space() && scene.domain.mesh.is_file())
    {
      const auto mesh = make_mesh_in_space(scene, first);
      const geometry::TetrahedronSearch cells(*mesh);
      (void)in_solid([&](const Point<3> &x) { return cells.find(x).has_value(); });
    }
    else if (scene.domain.is_in_space())
      (void)in_solid([cubes = scene.domain.cubes(first.h)](const Point<3> &x)
                     { return cubes.cell_at(x).has_value(); });
    else if (is_on_intervals(scene))
      (void)of(make_problem_on_line(scene, 0, first));
    else
      (void)of(scene::make_problem(scene, 0, first));
  }

  void PointValues::read(std::size_t dimension)
  {
    const std::vector<std::string> all = {"x", "y", "z"},
                                   axes(all.begin(),
                                        all.begin() + static_cast<std::ptrdiff_t>(dimension)),
                                   others(all.begin() + static_cast<std::ptrdiff_t>(dimension),
                                          all.end());
    base::Csv csv(file_, axes);
    while (csv.next())
    {
      points_.emplace_back();
      for (const std::string &axis : axes)
        points_.back().push_back(csv.number(axis));
      lines_.push_back(csv.line());
      for (const std::string &axis : others)
        if (csv.has(axis) && csv.number(axis) != 0)
          throw InputError(
              "'" + file_ + "', line " + std::to_string(csv.line()) + ": " + axis + " = " +
              base::to_text(csv.number(axis), 6) + ", but the scene has " +
              (dimension == 1 ? "one dimension" : "two dimensions") + "; take out the column " +
              axis + ", or write Domain/dimension = " + std::to_string(axis.front() - 'x' + 1));
    }
    if (points_.empty())
      throw InputError("'" + file_ + "' has no points; give one " + axes_text(dimension) +
                       " on each line");
  }

  void PointValues::read_text(const std::string &text, std::size_t dimension)
  {
    std::string points = text;
    std::replace(points.begin(), points.end(), ';', ':');
    for (const std::string &point : physics::split_outside_brackets(points, ':'))
    {
      std::vector<double> x;
      for (const std::string &number : physics::split_outside_brackets(point, ','))
        x.push_back(scene::to_number(number));
      if (x.size() != dimension)
        throw InputError("the point '" + point + "' has " + std::to_string(x.size()) +
                         " coordinates, but the scene has " + std::to_string(dimension) +
                         " dimensions; write points " + axes_text(dimension) +
                         " separated by ':', or the name of a CSV file");
      points_.push_back(std::move(x));
      lines_.push_back(points_.size());
    }
  }

  std::string PointValues::place(std::size_t point) const
  {
    return (file_.empty() ? "point " : "'" + file_ + "', line ") + std::to_string(lines_[point]);
  }

  std::string PointValues::coordinates(std::size_t point) const
  {
    std::string text;
    for (const double x : points_[point])
      text += (text.empty() ? "" : ", ") + base::to_text(x, 6);
    return "(" + text + ")";
  }

  void PointValues::require_distinct() const
  {
    std::map<std::vector<double>, std::size_t> known;
    for (std::size_t i = 0; i < points_.size(); ++i)
      if (const auto [first, is_new] = known.emplace(points_[i], i); !is_new)
        throw InputError(key_ + place(i) + ": " + coordinates(i) + " is listed twice, first as " +
                         place(first->second) + "; remove one");
  }

  std::vector<Point<1>> PointValues::of(const problem::Problem<1> &problem) const
  {
    std::vector<Point<1>> points;
    for (const auto &x : points_)
    {
      points.emplace_back(x[0]);
      if (!problem.lattice.cell_at(x[0]))
        refuse(points.size() - 1);
    }
    return points;
  }

  std::vector<Point<2>> PointValues::of(const problem::Problem<2> &problem) const
  {
    const auto is_inside = problem::inside(problem);
    std::vector<Point<2>> points;
    for (const auto &x : points_)
    {
      points.push_back(Point<2>() + (Point<2>(x[0], x[1]) - problem.origin));
      if (!is_inside(points.back()))
        refuse(points.size() - 1);
    }
    return points;
  }

  std::vector<Point<3>> PointValues::of(const problem::Problem<3> &problem) const
  {
    return in_solid(problem::inside(problem));
  }

  std::vector<Point<3>>
  PointValues::in_solid(const std::function<bool(const Point<3> &)> &is_inside) const
  {
    std::vector<Point<3>> points;
    for (const auto &x : points_)
    {
      points.emplace_back(x[0], x[1], x[2]);
      if (!is_inside(points.back()))
        refuse(points.size() - 1);
    }
    return points;
  }

  void PointValues::refuse(std::size_t point) const
  {
    throw InputError(key_ + place(point) + ": " + coordinates(point) +
                     " lies outside of the domain; take it out");
  }

  std::vector<double> PointValues::values_in(const fs::path &file) const
  {
    const char *const axes[] = {"x", "y", "z"};
    const std::size_t dimension = points_.front().size();
    base::Csv csv(file.string(), {axes, axes + dimension});
    std::vector<std::string> columns;
    for (const std::string name : {"u", "u1", "u2", "u3"})
      if (csv.has(name))
        columns.push_back(name);
    std::vector<double> values;
    std::size_t n = 0;
    for (; csv.next(); ++n)
    {
      for (std::size_t d = 0; d < dimension; ++d)
        if (n >= points_.size() || csv.number(axes[d]) != points_[n][d])
          return {};
      for (const std::string &name : columns)
        values.push_back(csv.number(name));
    }
    return n == points_.size() ? values : std::vector<double>{};
  }

  void PointValues::take_over(const study::StudyResults &earlier, const fs::path &folder)
  {
    const auto take = [&](const analysis::Record &run)
    {
      try
      {
        const std::vector<double> values = values_in(file_of(run, folder));
        if (!values.empty())
          levels_[file_stem(run)][run.key.level] = values;
      }
      catch (const InputError &) // without it the next level has no change
      {
      }
    };
    for (const analysis::Record &run : earlier.records)
    {
      if (run.failure.empty())
        take(run);
      analysis::Record reference;
      reference.key = run.key;
      reference.key.method = study::reference_name;
      take(reference);
    }
  }

  void PointValues::write(const study::ValuesAtPoints &found, const analysis::Record &run,
                          const fs::path &folder)
  {
    const unsigned int n = found.n_components;
    auto &levels = levels_[file_stem(run)];
    const auto finer = levels.lower_bound(run.key.level);
    const std::vector<double> before =
        finer == levels.begin() ? std::vector<double>{} : std::prev(finer)->second;
    fs::create_directories(folder);
    const fs::path file = file_of(run, folder);
    std::ofstream out(file);
    out.precision(std::numeric_limits<double>::max_digits10);
    write_header(out, points_.front().size(), n, !found.exact.empty(), !before.empty(),
                 !found.estimate.empty(), !found.gradient.empty());
    for (std::size_t k = 0; k < points_.size(); ++k)
    {
      const char *separator = "";
      const auto add = [&](double value)
      {
        out << separator << value;
        separator = ",";
      };
      for (const double x : points_[k])
        add(x);
      const double *const u = &found.values[k * n];
      for (unsigned int c = 0; c < n; ++c)
        add(u[c]);
      if (!found.exact.empty())
      {
        const double *const exact = &found.exact[k * n];
        for (unsigned int c = 0; c < n; ++c)
          add(exact[c]);
        for (unsigned int c = 0; c < n; ++c)
          add(u[c] - exact[c]);
      }
      for (unsigned int c = 0; c < n && !before.empty(); ++c)
        add(u[c] - before[k * n + c]);
      if (!found.estimate.empty())
        add(found.estimate[k]);
      const std::size_t n_slopes = found.gradient.size() / points_.size();
      for (std::size_t d = 0; d < n_slopes; ++d)
        add(found.gradient[k * n_slopes + d]);
      out << '\n';
    }
    if (!out.flush())
      throw InputError("cannot write all of '" + file.string() +
                       "'; free some space, or give another output folder (-o)");
    levels[run.key.level] = found.values;
  }
} // namespace plumbline::io
