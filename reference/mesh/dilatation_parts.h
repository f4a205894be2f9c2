#pragma once

#include "reference/mesh/dilatation_row.h"
#include "reference/mesh/outer_cells.h"

#include <unordered_map>

namespace plumbline::reference
{
  /// What `DilatationRow::integrate` gives for the outer points of a cell and a cell near to it,
  /// once for all pairs of cells that are translations of one another.
  class DilatationParts
  {
  public:
    /// Not there if most pairs are single, or materials have a part in them.
    /// @param units  the outer points in a unit cell
    DilatationParts(const MeshSpace &space, const std::vector<OuterCell> &outer,
                    const Translations &translations, const std::vector<Point<2>> &units,
                    const DilatationRow &row);

    bool is_there() const { return !values_.empty(); }

    /// Of each near cell that of the first outer point; those of the next ones follow.
    void find(const OuterCell &outer, std::vector<const double *> &known) const;

  private:
    const Translations &translations_;
    std::size_t n_values_; ///< of a point
    std::size_t n_points_;
    std::unordered_map<Translations::Pair, std::size_t, Translations::Pair::Hash> place_;
    std::vector<double> values_; ///< shape (n_pairs, n_points, n_shapes, 2)
  };
} // namespace plumbline::reference
