#pragma once

#include "meshfree/check/bond_file.h"

namespace plumbline::meshfree
{
  /// A bond as it stands in the file.
  template <int dim>
  struct GivenRow
  {
    std::int64_t i = 0, j = 0; ///< ids
    double weight = 0;         ///< [length^2]
    std::optional<Point<dim>> kernel_point;
    std::size_t line = 0;
  };

  /// Where the nodes of a file are among the cells, by their ids.
  class NodeIndex
  {
  public:
    template <int dim>
    NodeIndex(const GivenNodes<dim> &nodes, const geometry::NodeCells<dim> &cells);
    std::optional<unsigned int> find(std::int64_t id) const;

  private:
    std::unordered_map<std::int64_t, unsigned int> node_of_id_;
  };

  /// That the ids of bonds are off those of the nodes by one, as where one file counts from 0 and
  /// the other from 1: with the ids moved every bond is one between two nodes, all free nodes have
  /// bonds, and the bonds are shorter, all of which fails as they stand.
  /// @return  a sentence; empty: they are not
  template <int dim>
  std::string shifted_ids(const std::vector<GivenRow<dim>> &rows, const NodeIndex &index,
                          const geometry::NodeCells<dim> &cells);

  /// Whether nearly no pair of free nodes has bonds both ways.
  template <int dim>
  bool is_half_list(const std::vector<GivenRow<dim>> &rows, const NodeIndex &index,
                    std::size_t n_free);
} // namespace plumbline::meshfree
