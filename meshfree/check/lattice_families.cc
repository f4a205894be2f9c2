#include "meshfree/check/lattice_families.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace plumbline::meshfree
{
  template <int dim>
  LatticeFamilies<dim>::LatticeFamilies(const NeighbourhoodQuadrature<dim> &rule,
                                        const Kernel<dim> &kernel,
                                        const geometry::NodeCells<dim> &cells, double h)
      : cells_(cells), h_(h), lower_(cells.nodes.front()),
        bonds_(lattice_bonds(rule, kernel, h, Backend::fast).family)
  {
    for (const Point<dim> &x : cells.nodes)
      for (unsigned int d = 0; d < dim; ++d)
        lower_[d] = std::min(lower_[d], x[d]);
    std::size_t n = 1;
    for (const Point<dim> &x : cells.nodes)
      for (unsigned int d = 0; d < dim; ++d)
        n_[d] = std::max(n_[d], place(x)[d] + 1);
    for (const int along : n_)
      n *= static_cast<std::size_t>(along);
    node_.assign(n, static_cast<unsigned int>(cells.size()));
    for (std::size_t k = 0; k < cells.size(); ++k)
    {
      const Place at = place(cells.nodes[k]);
      std::size_t index = 0;
      for (unsigned int d = dim; d-- > 0;)
        index = index * static_cast<std::size_t>(n_[d]) + static_cast<std::size_t>(at[d]);
      node_[index] = static_cast<unsigned int>(k);
    }
  }

  template <int dim>
  typename LatticeFamilies<dim>::Place LatticeFamilies<dim>::place(const Point<dim> &x) const
  {
    Place at{};
    for (unsigned int d = 0; d < dim; ++d)
      at[d] = static_cast<int>(std::lround((x[d] - lower_[d]) / h_));
    return at;
  }

  template <int dim>
  std::size_t LatticeFamilies<dim>::node_at(const Place &at) const
  {
    std::size_t index = 0;
    for (unsigned int d = dim; d-- > 0;)
    {
      if (at[d] < 0 || at[d] >= n_[d])
        return cells_.size();
      index = index * static_cast<std::size_t>(n_[d]) + static_cast<std::size_t>(at[d]);
    }
    return node_[index];
  }

  template <int dim>
  Family<dim> LatticeFamilies<dim>::family(std::size_t node) const
  {
    const Place at = place(cells_.nodes[node]);
    std::vector<std::pair<std::size_t, std::size_t>> found; // nodes and their bonds
    for (std::size_t k = 0; k < bonds_.size(); ++k)
    {
      Place to = at;
      for (unsigned int d = 0; d < dim; ++d)
        to[d] += static_cast<int>(std::lround(bonds_[k].xi[d] / h_));
      if (const std::size_t j = node_at(to); j < cells_.size())
        found.emplace_back(j, k);
    }
    std::sort(found.begin(), found.end());
    Family<dim> family;
    for (const auto &[j, k] : found)
    {
      family.neighbours.push_back(static_cast<unsigned int>(j));
      family.bonds.push_back(bonds_[k]);
    }
    return family;
  }

  template class LatticeFamilies<2>;
  template class LatticeFamilies<3>;
} // namespace plumbline::meshfree
