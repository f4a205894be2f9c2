#pragma once

#include <deal.II/base/point.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace plumbline::report
{
  /// Numbers at points, one each or as many as there are coordinates.
  struct PointField
  {
    std::string name;
    bool is_vector = false;
    std::function<double(std::size_t point, unsigned int component)> value;
  };

  /// One of the states of a motion at points, for ParaView: DIR/NAME_00000.vtu, and DIR/NAME.pvd
  /// with all so far. In single precision: pictures, no results.
  /// @param times  of the states 0, 1, ..., this one
  /// Instantiated for dim = 2 and 3.
  /// @throws InputError  a file cannot be written
  template <int dim>
  void write_frame(const std::filesystem::path &dir, const std::string &name,
                   const std::vector<double> &times, const std::vector<dealii::Point<dim>> &points,
                   const std::vector<PointField> &fields);
} // namespace plumbline::report
