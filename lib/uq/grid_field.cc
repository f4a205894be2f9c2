#include "uq/grid_field.h"

#include "base/error.h"
#include "base/number_text.h"

#include <deal.II/base/exceptions.h>

#include <cmath>
#include <numeric>
#include <string>

namespace plumbline::uq
{
  namespace
  {
    void check_box(const Box &box)
    {
      for (unsigned int d = 0; d < 2; ++d)
        if (!(box.upper[d] > box.lower[d]) || !std::isfinite(box.upper[d] - box.lower[d]))
          throw InputError("the box of a random field reaches from " +
                           base::to_text(box.lower[d], 6) + " to " +
                           base::to_text(box.upper[d], 6) + " along " + (d == 0 ? "x" : "y") +
                           "; give it a length > 0");
    }
  } // namespace

  Point<2> Grid::node(int i, int j) const
  {
    return {box.lower[0] + (i + .5) * h(0), box.lower[1] + (j + .5) * h(1)};
  }

  void check(const Grid &grid)
  {
    check_box(grid.box);
    for (const int n : grid.n)
      if (n < 1)
        throw InputError("the grid of a random field has " + std::to_string(grid.n[0]) + " x " +
                         std::to_string(grid.n[1]) + " nodes; give at least one along x and y");
  }

  Grid make_grid(const Box &box, double h)
  {
    constexpr double most_nodes = 1e8;
    check_box(box);
    const double w = (box.upper[0] - box.lower[0]) / h, v = (box.upper[1] - box.lower[1]) / h;
    if (!(h > 0) || !std::isfinite(h))
      throw InputError("the grid of a random field has cells of size h = " + base::to_text(h, 6) +
                       "; give a length > 0");
    if (!(std::max(1., w) * std::max(1., v) <= most_nodes))
      throw InputError("the grid of a random field has " + base::to_text(w * v, 3) +
                       " nodes at h = " + base::to_text(h, 6) +
                       "; choose a larger h, 1e8 nodes are the most");
    return {box,
            {static_cast<int>(std::max(1., std::round(w))),
             static_cast<int>(std::max(1., std::round(v)))}};
  }

  GridField::GridField(const Grid &grid, std::vector<double> values, Interpolation between)
      : grid_(grid), values_(std::move(values)),
        between_(between), per_length_{1 / grid.h(0), 1 / grid.h(1)}
  {
    check(grid);
    AssertThrow(values_.size() == grid.size(),
                dealii::ExcDimensionMismatch(values_.size(), grid.size()));
  }

  double GridField::mean() const
  {
    return std::accumulate(values_.begin(), values_.end(), 0.) /
           static_cast<double>(values_.size());
  }

  double GridField::smallest() const
  {
    return *std::min_element(values_.begin(), values_.end());
  }

  double GridField::largest() const
  {
    return *std::max_element(values_.begin(), values_.end());
  }
} // namespace plumbline::uq
