#pragma once

#include "analysis/record.h"
#include "problem/in_space.h"
#include "problem/on_line.h"
#include "problem/problem.h"
#include "scene/scene.h"
#include "study/study_results.h"
#include "study/values_at_points.h"

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace plumbline::io
{
  /// Stem of the names of files about a case, series and method.
  std::string file_stem(const analysis::Record &run);

  /// Values of solutions at the points of Output/points, one CSV file for each solve.
  class PointValues
  {
  public:
    /// @throws InputError  a file that cannot be read; a point outside of the domain of the first
    /// level, by its line
    explicit PointValues(const scene::Scene &scene);

    /// @throws InputError  a point is given twice
    void require_distinct() const;

    bool is_wanted() const { return !points_.empty(); }

    /// In the problem's coordinates.
    /// @throws InputError  a point outside of its domain, by its line
    std::vector<dealii::Point<1>> of(const problem::Problem<1> &problem) const;
    std::vector<dealii::Point<2>> of(const problem::Problem<2> &problem) const;
    std::vector<dealii::Point<3>> of(const problem::Problem<3> &problem) const;

    /// Reads what an interrupted run has written of the levels that it had finished. A file that is
    /// missing, or has other points, is ignored.
    /// @param folder  as of write()
    void take_over(const study::StudyResults &earlier, const std::filesystem::path &folder);

    /// Writes coordinates and u; the exact solution and the error, if the solution is known; the
    /// change of u from the level before, if this object has written or taken over one; the
    /// estimated error, if there is one. Numbers read back to the same bits.
    /// @param folder  of the files, made if it is not there
    /// @throws InputError  a file that cannot be written
    void write(const study::ValuesAtPoints &found, const analysis::Record &run,
               const std::filesystem::path &folder);

  private:
    std::vector<dealii::Point<3>>
    in_solid(const std::function<bool(const dealii::Point<3> &)> &is_inside) const;
    [[noreturn]] void refuse(std::size_t point) const;
    void read(std::size_t dimension);
    void read_text(const std::string &text, std::size_t dimension);
    std::string place(std::size_t point) const; ///< "'points.csv', line 3", or "point 2"
    std::string coordinates(std::size_t point) const;
    /// u in such a file, shape (n_points, n_components); empty if it has other points.
    std::vector<double> values_in(const std::filesystem::path &file) const;

    std::string file_,
        key_; ///< file_ empty: points are in the scene; key_: "Output/points = FILE: "
    std::vector<std::vector<double>> points_; ///< in the scene's coordinates, one to three of each
    std::vector<std::size_t> lines_;
    /// By case, series and method, and by level: u, shape (n_points, n_components).
    std::map<std::string, std::map<unsigned int, std::vector<double>>> levels_;
  };
} // namespace plumbline::io
