#pragma once

#include "geometry/node_cells.h"
#include "method/quasistatic_fracture_model.h"

#include <deal.II/base/point.h>

#include <array>
#include <functional>
#include <memory>
#include <vector>

namespace plumbline::method
{
  /// A body whose bonds can break, with what is known of its nodes and bonds.
  template <int dim>
  struct BreakableBody
  {
    std::shared_ptr<QuasistaticFractureModel> body;
    double horizon = 0; ///< [length]
    double h = 0;       ///< of the lattice, or the mean of scattered nodes [length]
    std::vector<dealii::Point<dim>> nodes;
    std::shared_ptr<const geometry::NodeCells<dim>> cells; ///< of scattered nodes; null: a lattice
    /// Of scattered nodes: the energy of all bonds across a straight cut at their critical stretch,
    /// over G.
    double cut_energy = 0;
    std::vector<double> toughness;                       ///< G of each node [force/length]
    std::vector<double> toughness_of_bonds;              ///< G of each bond [force/length]
    std::vector<std::array<unsigned int, 2>> bonds, cut; ///< their nodes; of those the notch cuts
    dealii::Point<2> notch_tip;                          ///< in space along z through the body
    bool has_dilatation = false;                         ///< else bonds are all
    /// The fraction of each node's bonds that is broken or cut.
    std::function<std::vector<double>(const std::vector<std::size_t> &broken)> damage;
  };
} // namespace plumbline::method
