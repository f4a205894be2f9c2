#include "meshfree/check/images.h"

#include "geometry/cell_locator.h"

#include <algorithm>
#include <numeric>

namespace plumbline::meshfree
{
  void add_images(const geometry::Mesh &mesh, GivenNodes &nodes)
  {
    const geometry::CellLocator locator(mesh);
    const std::size_t n = nodes.size();
    nodes.original.resize(n);
    std::iota(nodes.original.begin(), nodes.original.end(), 0);
    for (const int a : {-1, 0, 1})
      for (const int b : {-1, 0, 1})
        for (std::size_t k = 0; k < n && (a != 0 || b != 0); ++k)
        {
          const Point<2> image(nodes.places[k][0] + a * nodes.box->side(0),
                               nodes.places[k][1] + b * nodes.box->side(1));
          if (!locator.find(image))
            continue;
          ++nodes.n_images;
          nodes.original.push_back(k);
          nodes.places.push_back(image);
          nodes.id.push_back(nodes.id[k]);
          nodes.volume.push_back(nodes.volume[k]);
          nodes.line.push_back(nodes.line[k]);
        }
  }

  NearestImages::NearestImages(const GivenNodes &nodes, const geometry::NodeCells<2> &cells)
      : cells_(cells), images_(cells.n_free)
  {
    for (unsigned int cell = 0; cell < cells.size(); ++cell)
      images_[nodes.original[cells.source[cell]]].push_back(cell);
  }

  unsigned int NearestImages::nearest(unsigned int j, unsigned int i) const
  {
    const auto distance = [&](unsigned int cell)
    { return (cells_.nodes[cell] - cells_.nodes[i]).norm_square(); };
    return *std::min_element(images_[j].begin(), images_[j].end(),
                             [&](unsigned int a, unsigned int b)
                             { return distance(a) < distance(b); });
  }

  std::vector<Family<2>> without_images(const std::vector<Family<2>> &families,
                                        const GivenNodes &nodes,
                                        const geometry::NodeCells<2> &cells)
  {
    std::vector<Family<2>> result(families.size());
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < families.size(); ++i)
    {
      const Family<2> &family = families[i];
      const auto node = [&](std::size_t k)
      { return static_cast<unsigned int>(nodes.original[cells.source[family.neighbours[k]]]); };
      order.resize(family.bonds.size());
      std::iota(order.begin(), order.end(), 0);
      std::sort(order.begin(), order.end(),
                [&](std::size_t a, std::size_t b) { return node(a) < node(b); });
      for (const std::size_t k : order)
      {
        result[i].neighbours.push_back(node(k));
        result[i].bonds.push_back(family.bonds[k]);
      }
    }
    return result;
  }

  std::vector<std::size_t> crossing_bonds(const std::vector<Family<2>> &families,
                                          const GivenNodes &nodes,
                                          const geometry::NodeCells<2> &cells)
  {
    std::vector<std::size_t> result(2);
    for (const Family<2> &family : families)
      for (const unsigned int cell : family.neighbours)
      {
        const std::size_t k = cells.source[cell];
        const Point<2> moved(nodes.places[k] - nodes.places[nodes.original[k]]);
        for (unsigned int d = 0; d < 2; ++d)
          result[d] += nodes.box->crosses(moved, d) ? 1 : 0;
      }
    return result;
  }

  std::string missing_crossings(const std::vector<std::size_t> &n_crossing)
  {
    std::string axes;
    for (std::size_t d = 0; d < n_crossing.size(); ++d)
      if (n_crossing[d] == 0)
        axes += (axes.empty() ? "" : " and ") + std::string(1, "xyz"[d]);
    return axes.empty() ? ""
                        : "no bond crosses the sides of the periodic box in " + axes +
                              ": the code finds neighbours without nearest images of nodes; add "
                              "the bonds across these sides, or, where they are free surfaces, "
                              "do not check with a periodic boundary";
  }
} // namespace plumbline::meshfree
