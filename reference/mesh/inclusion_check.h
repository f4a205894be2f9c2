#pragma once

#include "physics/kernel.h"
#include "reference/mesh/cells.h"
#include "reference/mesh/space.h"

#include <string>

namespace plumbline::reference
{
  /// What CGAL's exact predicates say of a sample of pairs of cells.
  struct InclusionCheck
  {
    unsigned int n_inside = 0, n_cut = 0, n_apart = 0; ///< pairs, by exact predicates
    /// Decisions of assembly about them: where the pair stands, where its sides do, and of pairs
    /// that are cut which parts of sides lie in circles about points of others.
    unsigned int n_decisions = 0;
    unsigned int n_open = 0; ///< taken as cut, which they need not be: costs time alone
    unsigned int n_ties = 0; ///< see geometry::tie_width
    unsigned int n_wrong = 0;

    unsigned int n_pairs() const { return n_inside + n_cut + n_apart; }
    std::string text() const; ///< for reports
  };

  /// Which code decides where pairs stand.
  enum class Decider
  {
    edges,         ///< assemble_by_edges: circles about supports and sides
    sides_of_pairs ///< MeshCells and, but for rectangles, PolygonPairs
  };

  /// Hold decisions about pairs of cells in reach of each other, and somewhat beyond, against exact
  /// predicates: the functions that assembly calls are called. Costs some 2 ms a pair.
  InclusionCheck check_inclusions(const MeshSpace &space, const MeshCells &cells,
                                  const physics::Kernel<2> &kernel, Decider decider,
                                  unsigned int n_pairs, unsigned int seed);
} // namespace plumbline::reference
