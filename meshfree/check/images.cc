#include "meshfree/check/images.h"

#include "geometry/cell_locator.h"

#include <algorithm>
#include <numeric>

namespace plumbline::meshfree
{
  namespace
  {
    /// Adds the images in neighbouring boxes for which there is a place.
    template <int dim, class HasPlace>
    void add_all_images(const HasPlace &has_place, GivenNodes<dim> &nodes)
    {
      const std::size_t n = nodes.size();
      nodes.original.resize(n);
      std::iota(nodes.original.begin(), nodes.original.end(), 0);
      int n_boxes = 1;
      for (unsigned int d = 0; d < dim; ++d)
        n_boxes *= 3;
      for (int box = 0; box < n_boxes; ++box) // -1, 0, 1 along each axis, the last fastest
      {
        Point<dim> moved;
        for (int d = dim - 1, rest = box; d >= 0; --d, rest /= 3)
          moved[d] = (rest % 3 - 1) * nodes.box->side(d);
        for (std::size_t k = 0; k < n && moved.square() > 0; ++k)
        {
          const Point<dim> image = nodes.places[k] + dealii::Tensor<1, dim>(moved);
          if (!has_place(image))
            continue;
          ++nodes.n_images;
          nodes.original.push_back(k);
          nodes.places.push_back(image);
          nodes.id.push_back(nodes.id[k]);
          nodes.volume.push_back(nodes.volume[k]);
          nodes.line.push_back(nodes.line[k]);
        }
      }
    }
  } // namespace

  void add_images(const geometry::Mesh &mesh, GivenNodes<2> &nodes)
  {
    const geometry::CellLocator locator(mesh);
    add_all_images<2>([&](const Point<2> &x) { return locator.find(x).has_value(); }, nodes);
  }

  void add_images(double width, GivenNodes<3> &nodes)
  {
    add_all_images<3>(
        [&](const Point<3> &x)
        {
          for (unsigned int d = 0; d < 3; ++d)
            if (x[d] < nodes.box->lower[d] - width || x[d] > nodes.box->upper[d] + width)
              return false;
          return true;
        },
        nodes);
  }

  template <int dim>
  NearestImages<dim>::NearestImages(const GivenNodes<dim> &nodes,
                                    const geometry::NodeCells<dim> &cells)
      : cells_(cells), images_(cells.n_free)
  {
    for (unsigned int cell = 0; cell < cells.size(); ++cell)
      images_[nodes.original[cells.source[cell]]].push_back(cell);
  }

  template <int dim>
  unsigned int NearestImages<dim>::nearest(unsigned int j, unsigned int i) const
  {
    const auto distance = [&](unsigned int cell)
    { return (cells_.nodes[cell] - cells_.nodes[i]).norm_square(); };
    return *std::min_element(images_[j].begin(), images_[j].end(),
                             [&](unsigned int a, unsigned int b)
                             { return distance(a) < distance(b); });
  }

  template <int dim>
  std::vector<Family<dim>> without_images(const std::vector<Family<dim>> &families,
                                          const GivenNodes<dim> &nodes,
                                          const geometry::NodeCells<dim> &cells)
  {
    std::vector<Family<dim>> result(families.size());
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < families.size(); ++i)
    {
      const Family<dim> &family = families[i];
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

  template <int dim>
  std::vector<std::size_t> crossing_bonds(const std::vector<Family<dim>> &families,
                                          const GivenNodes<dim> &nodes,
                                          const geometry::NodeCells<dim> &cells)
  {
    std::vector<std::size_t> result(dim);
    for (const Family<dim> &family : families)
      for (const unsigned int cell : family.neighbours)
      {
        const std::size_t k = cells.source[cell];
        const Point<dim> moved(nodes.places[k] - nodes.places[nodes.original[k]]);
        for (unsigned int d = 0; d < dim; ++d)
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

  template class NearestImages<2>;
  template class NearestImages<3>;
  template std::vector<Family<2>> without_images(const std::vector<Family<2>> &,
                                                 const GivenNodes<2> &,
                                                 const geometry::NodeCells<2> &);
  template std::vector<Family<3>> without_images(const std::vector<Family<3>> &,
                                                 const GivenNodes<3> &,
                                                 const geometry::NodeCells<3> &);
  template std::vector<std::size_t> crossing_bonds(const std::vector<Family<2>> &,
                                                   const GivenNodes<2> &,
                                                   const geometry::NodeCells<2> &);
  template std::vector<std::size_t> crossing_bonds(const std::vector<Family<3>> &,
                                                   const GivenNodes<3> &,
                                                   const geometry::NodeCells<3> &);
} // namespace plumbline::meshfree
