#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <deal.II/base/point.h>

namespace plumbline::report
{
  /// A state of the nodes of a lattice for ParaView: u and further fields as data of points.
  struct LatticeFrame
  {
    std::array<int, 2> n{};
    dealii::Point<2> lower; ///< the first node [length]
    double h = 0;
    const std::vector<double> *u = nullptr; ///< shape (2, n[1], n[0])
    std::vector<std::pair<std::string, const std::vector<double> *>> fields; ///< shape (n[1], n[0])
  };

  /// Write frame number `index` as DIR/frame_00000.vtu, and DIR/frames.pvd with all frames so far.
  /// @param times  of frames 0, 1, ..., index
  /// @throws InputError  a file cannot be written
  void write_frame(const std::filesystem::path &dir, unsigned int index,
                   const std::vector<double> &times, const LatticeFrame &frame);
} // namespace plumbline::report
