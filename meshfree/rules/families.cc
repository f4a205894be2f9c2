#include "meshfree/rules/families.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

namespace plumbline::meshfree
{
  namespace
  {
    /// As `intersect` takes them.
    std::vector<geometry::ConvexCell> prepared(const geometry::NodeCells<2> &cells)
    {
      return {cells.pieces.begin(), cells.pieces.end()};
    }
    std::vector<geometry::ConvexCell> prepared(const geometry::NodeCells<3> &)
    {
      return {};
    }

    const auto *all_pieces(const geometry::NodeCells<2> &,
                           const std::vector<geometry::ConvexCell> &of_cells)
    {
      return of_cells.data();
    }
    const auto *all_pieces(const geometry::NodeCells<3> &cells,
                           const std::vector<geometry::ConvexCell> &)
    {
      return cells.pieces.data();
    }

    template <int dim>
    double largest_size(const geometry::NodeCells<dim> &cells)
    {
      return std::pow(*std::max_element(cells.area.begin(), cells.area.end()), 1. / dim);
    }

    template <int dim>
    double distance_square(const Point<dim> &x, const typename geometry::BoxSearch<dim>::Box &box)
    {
      double sum = 0;
      for (unsigned int d = 0; d < dim; ++d)
      {
        const double way = std::max({0., box.lower[d] - x[d], x[d] - box.upper[d]});
        sum += way * way;
      }
      return sum;
    }

    template <int dim>
    std::string words(std::size_t index, const Point<dim> &x)
    {
      std::ostringstream place;
      place << "at node " << index << ", (" << x[0];
      for (unsigned int d = 1; d < dim; ++d)
        place << ", " << x[d];
      place << ")";
      return place.str();
    }
  } // namespace

  template <int dim>
  std::vector<typename geometry::BoxSearch<dim>::Box>
  bounding_boxes(const geometry::NodeCells<dim> &cells, std::size_t n)
  {
    std::vector<typename geometry::BoxSearch<dim>::Box> boxes;
    for (std::size_t i = 0; i < n; ++i)
      boxes.push_back(cells.bounding_box(i));
    return boxes;
  }

  template std::vector<geometry::Box> bounding_boxes(const geometry::NodeCells<2> &, std::size_t);
  template std::vector<geometry::Cuboid> bounding_boxes(const geometry::NodeCells<3> &,
                                                        std::size_t);

  template <int dim>
  Families<dim>::Families(NeighbourhoodQuadrature<dim> rule, const Kernel<dim> &kernel,
                          const geometry::NodeCells<dim> &cells, Backend backend)
      : rule_(std::move(rule)), kernel_(kernel), cells_(&cells), backend_(backend),
        pieces_(prepared(cells)), search_(bounding_boxes(cells, cells.size())),
        // ramps reach half a cell beyond the horizon
        reach_(kernel.horizon() * (1 + tie_tolerance) + .5 * largest_size(cells))
  {
  }

  template <int dim>
  void Families<dim>::make(std::size_t node, Family<dim> &family) const
  {
    const Point<dim> &x = cells_->nodes[node];
    family.bonds.clear();
    family.fit = {};
    family.is_clipped = false;
    family.own_area = cells_->area[node];
    search_.find(box_around(x, reach_), family.neighbours);
    const auto *const pieces = all_pieces(*cells_, pieces_);
    std::size_t n = 0;
    for (const unsigned int j : family.neighbours)
    {
      if (j == node || distance_square<dim>(x, search_.box(j)) > reach_ * reach_)
        continue;
      const std::size_t first = cells_->first_piece[j];
      const Candidate<dim> candidate{{x, kernel_.horizon()},
                                     backend_,
                                     Point<dim>(cells_->nodes[j] - x),
                                     cells_->area[j],
                                     {pieces + first, cells_->first_piece[j + 1] - first}};
      if (add_bond(rule_, kernel_, candidate, family))
        family.neighbours[n++] = j;
    }
    family.neighbours.resize(n);
    finish(rule_, family, [&] { return words(cells_->source[node], x); });
  }

  template class Families<2>;
  template class Families<3>;
} // namespace plumbline::meshfree
