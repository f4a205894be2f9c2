#include "geometry/cracks.h"

#include "base/error.h"
#include "geometry/search.h"

#include <algorithm>
#include <sstream>

namespace plumbline::geometry
{
  namespace
  {
    double distance(const Point<2> &x, const Point<2> &first, const Point<2> &last)
    {
      const dealii::Tensor<1, 2> d = last - first;
      return x.distance(first + std::clamp((x - first) * d / d.norm_square(), 0., 1.) * d);
    }

    std::string name(const NodeCells<2> &cells, std::size_t node)
    {
      std::ostringstream text;
      text << "node " << cells.source[node] << " at (" << cells.nodes[node] << ')';
      return text.str();
    }
  } // namespace

  void check_cracks(const std::vector<Polyline> &cracks, const NodeCells<2> &cells,
                    const std::vector<char> &is_ghost, double horizon)
  {
    const double tolerance = on_crack * horizon;
    std::vector<Point<2>> nodes;
    std::vector<std::size_t> number;
    for (std::size_t i = 0; i < cells.size(); ++i)
      if (is_ghost.empty() || is_ghost[i] == 0)
      {
        nodes.push_back(cells.nodes[i]);
        number.push_back(i);
      }
    std::vector<Box> boxes;
    for (const Point<2> &x : nodes)
      boxes.push_back({x, x});
    const BoxSearch<2> search(boxes);
    std::vector<unsigned int> near;
    for (std::size_t c = 0; c < cracks.size(); ++c)
    {
      const Polyline &crack = cracks[c];
      const std::string subject = "crack " + std::to_string(c);
      if (crack.size() < 2)
        throw InputError(subject + " has fewer than two points; give a polyline");
      for (std::size_t i = 1; i < crack.size(); ++i)
      {
        if (!(crack[i - 1].distance(crack[i]) > tolerance))
          throw InputError(subject + " has its points " + std::to_string(i - 1) + " and " +
                           std::to_string(i) + " in one place; take one of them out");
        Box around = bounding_box({&crack[i - 1], 2});
        for (unsigned int d = 0; d < 2; ++d)
        {
          around.lower[d] -= tolerance;
          around.upper[d] += tolerance;
        }
        search.find(around, near);
        for (const unsigned int k : near)
          if (distance(nodes[k], crack[i - 1], crack[i]) <= tolerance)
          {
            std::ostringstream message;
            message << subject << " goes through " << name(cells, number[k]) << " on its way from ("
                    << crack[i - 1] << ") to (" << crack[i]
                    << "), so that it is not known on which side that is; move the crack by a part "
                       "of the cell, or the node";
            throw InputError(message.str());
          }
      }
    }
  }

  void check_ghosts(const std::vector<char> &is_ghost, const NodeCells<2> &cells)
  {
    for (std::size_t i = 0; i < std::min(is_ghost.size(), cells.n_free); ++i)
      if (is_ghost[i] != 0)
        throw InputError(name(cells, i) +
                         " lies in the domain and is a ghost; ghosts belong to the collar");
  }
} // namespace plumbline::geometry
