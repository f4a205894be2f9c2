#pragma once

#include "geometry/visibility.h"
#include "reference/mesh/cells.h"
#include "reference/mesh/space.h"
#include "reference/mesh/translations.h"

namespace plumbline::reference
{
  /// An outer cell, and what is within the horizon of it.
  struct OuterCell
  {
    /// Dofs with numbers dof, dof + 1, ..., dof + size - 1 that follow each other.
    struct Run
    {
      unsigned int dof = 0, place = 0, size = 0; ///< place: of the first in dofs
    };

    unsigned int cell = 0;
    bool is_cut = false;            ///< a crack or a gap is within the horizon
    std::vector<unsigned int> near; ///< cells, alike around cells that are translations
    std::vector<unsigned int> dofs; ///< of these in turn, each once
    std::vector<Run> runs;          ///< the same by number
  };

  /// The cells that have free dofs within the horizon, ascending.
  /// @param gaps  regions beyond free surfaces, without cells
  std::vector<OuterCell> find_outer(const MeshSpace &space, const MeshCells &cells,
                                    const Translations &translations, double horizon,
                                    const std::vector<geometry::Cut> &cracks,
                                    const std::vector<geometry::Box> &gaps);

  /// For each outer cell the first one whose surroundings are a translation of its own. A cut cell
  /// is alike to itself only.
  std::vector<std::size_t> find_alike(const std::vector<OuterCell> &outer,
                                      const Translations &translations);
} // namespace plumbline::reference
