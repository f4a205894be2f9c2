#include "meshfree/rules/families.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace plumbline::meshfree
{
  std::vector<geometry::Box> bounding_boxes(const geometry::NodeCells &cells, std::size_t n)
  {
    std::vector<geometry::Box> boxes;
    for (std::size_t i = 0; i < n; ++i)
      boxes.push_back(cells.bounding_box(i));
    return boxes;
  }

  Families::Families(NeighbourhoodQuadrature<2> rule, const Kernel<2> &kernel,
                     const geometry::NodeCells &cells, Backend backend)
      : rule_(std::move(rule)), kernel_(kernel), cells_(&cells), backend_(backend),
        pieces_(cells.pieces.begin(), cells.pieces.end()),
        search_(bounding_boxes(cells, cells.size())),
        // ramps reach half a cell beyond the horizon
        reach_(kernel.horizon() * (1 + tie_tolerance) +
               .5 * std::sqrt(*std::max_element(cells.area.begin(), cells.area.end())))
  {
  }

  void Families::make(std::size_t node, Family<2> &family) const
  {
    const Point<2> &x = cells_->nodes[node];
    family.bonds.clear();
    family.fit = {};
    family.is_clipped = false;
    search_.find(box_around(x, reach_), family.neighbours);
    std::size_t n = 0;
    for (const unsigned int j : family.neighbours)
    {
      const std::size_t first = cells_->first_piece[j];
      const Candidate<2> candidate{{x, kernel_.horizon()},
                                   backend_,
                                   Point<2>(cells_->nodes[j] - x),
                                   cells_->area[j],
                                   {pieces_.data() + first, cells_->first_piece[j + 1] - first}};
      if (j != node && add_bond(rule_, kernel_, candidate, family))
        family.neighbours[n++] = j;
    }
    family.neighbours.resize(n);
    finish(rule_, family,
           [&]
           {
             std::ostringstream place;
             place << "at node " << cells_->source[node] << ", (" << x[0] << ", " << x[1] << ")";
             return place.str();
           });
  }
} // namespace plumbline::meshfree
