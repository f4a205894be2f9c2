#pragma once

#include "report/view.h"

#include <array>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace plumbline::report
{
  /// The damage of the nodes of a lattice at one time, or another number of each, and what it is
  /// called.
  struct DamageMap
  {
    std::string title;
    std::vector<double> values; ///< shape (n[1], n[0]); NaN: no node
  };

  /// The cells of such a map.
  struct MapCells
  {
    std::array<double, 2> lower{}; ///< half an h before the first node
    double h = 0;
    std::array<int, 2> n{};
  };

  /// The rectangle that some nodes of a lattice lie in.
  MapCells cells_of(const std::vector<dealii::Point<2>> &nodes, double h);

  /// @param values  of the nodes; a cell without one has none
  DamageMap map_of(const std::string &title, const std::vector<dealii::Point<2>> &nodes,
                   const std::vector<double> &values, const MapCells &cells);

  /// So many nodes along each axis are a block of a picture, which has no more columns of them.
  int block_size(const MapCells &cells, int most_columns);

  /// Rows of blocks as gnuplot reads a matrix, the lowest first; NaN where a block has no
  /// node.
  /// @param show  what is seen of a block, of its nodes' values, one at least
  std::string rows_of(const DamageMap &map, const MapCells &cells, int size,
                      const std::function<double(const std::vector<double> &values)> &show);

  /// What draws such rows, as the first part of a plot command.
  /// @param rows  their name
  std::string image_of(const std::string &rows, const MapCells &cells, int size);

  /// Maps side by side as one picture, as commands of gnuplot. Where there are too many nodes to be
  /// seen, blocks of them with the largest damage of each: a thin crack is seen at any size.
  /// @pre  at least one map
  std::string damage_script(const std::vector<DamageMap> &maps, const std::string &file,
                            const std::string &title, const MapCells &cells);

  /// The components of a field of the nodes of a lattice, each a map.
  std::string damage_script(const analysis::PointField &field, double h,
                            const std::vector<std::string> &titles, const std::string &file,
                            const std::string &title);

  /// The damage of a record at its moments, see CrackPlan::moment.
  Picture damage_moments(const study::Record &record, const std::string &title,
                         const std::string &caption);

  /// Blocks of a picture with sharp edges, see with_sharp_blocks.
  void sharpen(const std::filesystem::path &picture);
} // namespace plumbline::report
