#pragma once

#include "geometry/cracks.h"

#include <string>
#include <vector>

namespace plumbline::geometry
{
  /// An end of a crack that lies on bonds, which count as intact: an end slightly farther cuts
  /// them.
  struct TipOnBonds
  {
    std::size_t crack = 0; ///< which one of them
    Point<2> tip;
    std::size_t n_bonds = 0;

    /// In one sentence, with what to do.
    /// @param origin  that the tip's coordinates count from, see local_origin
    std::string text(const Point<2> &origin) const;
  };

  /// Ends of open cracks through which bonds pass, within on_crack of the horizon.
  /// @param nodes  that are in a bond with all others within the horizon
  std::vector<TipOnBonds> tips_on_bonds(const std::vector<Polyline> &cracks,
                                        const std::vector<Point<2>> &nodes, double horizon);
} // namespace plumbline::geometry
