#pragma once

#include "geometry/cube_lattice.h"
#include "geometry/node_cells.h"

#include <memory>
#include <string>

namespace plumbline::meshfree
{
  using geometry::Point;

  /// Cell averages of the free nodes to second order: a cell's centroid is not its node, so the
  /// value there is taken from a plane through the node, fitted to the nodes of Ω around it. Where
  /// nodes are centroids these are the nodal values.
  /// @param values  shape (n_free, n_components)
  /// @return        the same shape
  std::vector<double> cell_averages(const geometry::NodeCells<2> &cells,
                                    const std::vector<double> &values, unsigned int n_components);

  /// Nodal values as the piecewise constant function K_κ u on the cells of Ω.
  class ScatteredField
  {
  public:
    /// @param values  shape (n_free, n_components)
    ScatteredField(std::shared_ptr<const geometry::NodeCells<2>> cells, std::vector<double> values,
                   unsigned int n_components);

    /// The value of the cell that holds x in Ω: of the nearest node of Ω. Thread safe.
    double value(const geometry::Point<2> &x, unsigned int component) const;

    /// The cells in triangles with u as data.
    void write_vtu(const std::string &file) const;

  private:
    std::shared_ptr<const geometry::NodeCells<2>> cells_;
    std::vector<double> values_;
    unsigned int n_components_;
    geometry::BoxSearch<2> search_; ///< over the bounding boxes of the cells of Ω
  };

  /// The same in space.
  class NodalFieldInSpace
  {
  public:
    /// @param values  shape (n_free, n_components)
    NodalFieldInSpace(std::shared_ptr<const geometry::NodeCells<3>> cells,
                      std::vector<double> values, unsigned int n_components);

    /// The value of the node of Ω nearest to x in Ω. Thread safe.
    double value(const Point<3> &x, unsigned int component) const;

    /// Averages over the cubes of a lattice in Ω to second order: the values at their centres by
    /// planes through the nearest nodes, fitted to those around. Where nodes are the centres these
    /// are the nodal values. Shape (n_cells, n_components).
    std::vector<double> averages(const geometry::CubeLattice &lattice) const;

  private:
    std::size_t nearest(const Point<3> &x) const;

    std::shared_ptr<const geometry::NodeCells<3>> cells_;
    std::vector<double> values_;
    unsigned int n_components_;
    geometry::BoxSearch<3> search_; ///< over the bounding boxes of the cells of Ω
  };
} // namespace plumbline::meshfree
