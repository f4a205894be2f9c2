#include "geometry/cell_locator.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace plumbline::geometry
{
  namespace
  {
    std::vector<Polygon> polygons(const Mesh &mesh)
    {
      std::vector<Polygon> result;
      for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
        result.push_back(mesh.polygon(cell));
      return result;
    }

    /// Of the cells, larger by more than what `contains` takes for rounding.
    std::vector<Box> boxes(const std::vector<Polygon> &cells)
    {
      std::vector<Box> result;
      for (const Polygon &cell : cells)
      {
        Box box = bounding_box(view(cell));
        const double largest = std::max({std::abs(box.lower[0]), std::abs(box.lower[1]),
                                         std::abs(box.upper[0]), std::abs(box.upper[1])});
        const double slack = 8 * std::numeric_limits<double>::epsilon() * largest;
        for (unsigned int d = 0; d < 2; ++d)
        {
          box.lower[d] -= slack;
          box.upper[d] += slack;
        }
        result.push_back(box);
      }
      return result;
    }
  } // namespace

  CellLocator::CellLocator(const Mesh &mesh) : polygons_(polygons(mesh)), search_(boxes(polygons_))
  {
    for (const MeshCell &cell : mesh.cells)
      is_inside_.push_back(cell.is_inside);
  }

  std::optional<std::size_t> CellLocator::find(const Point<2> &x) const
  {
    std::vector<unsigned int> near;
    search_.find({x, x}, near);
    std::optional<std::size_t> found;
    for (const unsigned int cell : near)
      if ((!found || is_inside_[cell]) && contains(view(polygons_[cell]), x))
      {
        found = cell;
        if (is_inside_[cell])
          break;
      }
    return found;
  }

  std::size_t CellLocator::at(const Point<2> &x) const
  {
    if (const auto cell = find(x))
      return *cell;
    std::ostringstream message;
    message
        << "the point (" << x[0] << ", " << x[1]
        << ") lies outside of the domain and its collar, in no cell of the mesh; move it in, or "
           "widen the mesh";
    throw InputError(message.str());
  }
} // namespace plumbline::geometry
