#include "geometry/interval_lattice.h"

#include "base/error.h"

#include <cmath>
#include <sstream>
#include <utility>

namespace plumbline::geometry
{
  namespace
  {
    /// A length counts as a whole number of cells if it is one to this fraction of a cell.
    constexpr double whole = 1e-6;

    constexpr double most_cells = 1e6;

    int whole_cells(double length, double h, const Interval &piece)
    {
      const double cells = length / h;
      std::ostringstream message;
      if (std::abs(cells - std::round(cells)) > whole)
        message << "mesh size h = " << h << " does not divide the interval [" << piece.lower << ", "
                << piece.upper << "] of Domain/boxes into whole cells (" << cells
                << " cells); choose h so that the distances between all ends are multiples of it, "
                   "as a fraction such as 1/12 if it has no short decimal";
      else if (cells > most_cells)
        message << "mesh size h = " << h << " makes " << cells << " cells, more than " << most_cells
                << "; choose a larger h (Study/h)";
      else
        return static_cast<int>(std::lround(cells));
      throw InputError(message.str());
    }
  } // namespace

  IntervalLattice::IntervalLattice(std::vector<Interval> pieces, double h)
      : pieces_(std::move(pieces)), h_(h)
  {
    if (!(h > 0) || !std::isfinite(h))
      throw InputError("mesh size h = " + std::to_string(h) + " must be a positive length");
    if (pieces_.empty())
      throw InputError("Domain/boxes is empty; give at least one interval 'x0 : x1'");
    Interval hull = pieces_.front();
    for (const Interval &piece : pieces_)
      hull = {std::min(hull.lower, piece.lower), std::max(hull.upper, piece.upper)};
    origin_ = hull.lower;
    is_inside_.assign(static_cast<std::size_t>(whole_cells(hull.upper - hull.lower, h, hull)), 0);
    for (const Interval &piece : pieces_)
    {
      const int from = whole_cells(piece.lower - origin_, h, piece),
                to = whole_cells(piece.upper - origin_, h, piece);
      std::fill(is_inside_.begin() + from, is_inside_.begin() + to, 1);
    }
    size_ = static_cast<std::size_t>(std::count(is_inside_.begin(), is_inside_.end(), 1));
    if (size_ == 0)
      throw InputError("Domain/boxes: no cell is left; choose a smaller h (Study/h)");
  }

  std::optional<int> IntervalLattice::cell_at(double x) const
  {
    constexpr double at_end = 1e-9;
    const double s = (x - origin_) / h_;
    const int below = static_cast<int>(std::floor(s));
    if (is_inside(below))
      return below;
    if (is_inside(below - 1) && s - below <= at_end)
      return below - 1;
    if (is_inside(below + 1) && below + 1 - s <= at_end)
      return below + 1;
    return {};
  }
} // namespace plumbline::geometry
