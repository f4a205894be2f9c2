#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace plumbline::report
{
  /// The damage of the nodes of a lattice at one time, and what it is called.
  struct DamageMap
  {
    std::string title;
    std::vector<double> values; ///< shape (n[1], n[0]); NaN: no node
  };

  /// Maps side by side as one picture, as commands of gnuplot. Where there are too many nodes to be
  /// seen, blocks of them with the largest damage of each: a thin crack is seen at any size.
  /// @param lower  of the body, half an h before its first node
  /// @pre          at least one map
  std::string damage_script(const std::vector<DamageMap> &maps, const std::string &file,
                            const std::string &title, const std::array<double, 2> &lower, double h,
                            const std::array<int, 2> &n);

  /// Blocks of a picture with sharp edges, see with_sharp_blocks.
  void sharpen(const std::filesystem::path &picture);
} // namespace plumbline::report
