// What moves on boxes of cubes in space.
#include "algebra/spectrum.h"
#include "base/error.h"
#include "method/box_discretisation.h"
#include "method/linear_motion.h"

#include <deal.II/lac/vector.h>

#include <cmath>
#include <utility>

namespace plumbline::method
{
  namespace
  {
    bool is_diagonal(const algebra::Stencil &stencil)
    {
      return stencil.n_entries() == stencil.n_blocks();
    }

    /// Numbers of the free positions in vectors over all, component by component.
    std::vector<std::size_t> free_positions(const geometry::BoxNodes &nodes,
                                            unsigned int n_components)
    {
      const std::size_t n = nodes.n_positions();
      std::vector<std::size_t> positions;
      for (unsigned int c = 0; c < n_components; ++c)
        for (std::size_t i = 0; i < n; ++i)
          if (nodes.is_free.empty() || nodes.is_free[i] != 0)
            positions.push_back(c * n + i);
      return positions;
    }

    /// Couplings by one scalar stencil of each component between free positions.
    algebra::CsrMatrix assemble(const algebra::Stencil &stencil, const geometry::BoxNodes &nodes,
                                unsigned int n_components)
    {
      constexpr unsigned int none = static_cast<unsigned int>(-1);
      const auto positions = free_positions(nodes, n_components);
      std::vector<unsigned int> number(n_components * nodes.n_positions(), none);
      for (unsigned int i = 0; i < positions.size(); ++i)
        number[positions[i]] = i;
      const auto &n = nodes.n;
      const auto &reach = stencil.reaches();
      const auto place = [&](unsigned int c, int i, int j, int k)
      {
        return i +
               static_cast<std::size_t>(n[0]) *
                   (j + static_cast<std::size_t>(n[1]) * (k + static_cast<std::size_t>(n[2]) * c));
      };
      algebra::CsrMatrix rows;
      rows.start.assign(1, 0);
      for (unsigned int c = 0; c < n_components; ++c)
        for (int k = 0; k < n[2]; ++k)
          for (int j = 0; j < n[1]; ++j)
            for (int i = 0; i < n[0]; ++i)
            {
              if (number[place(c, i, j, k)] == none)
                continue;
              for (int d3 = -std::min(reach[2], k); d3 <= std::min(reach[2], n[2] - 1 - k); ++d3)
                for (int d2 = -std::min(reach[1], j); d2 <= std::min(reach[1], n[1] - 1 - j); ++d2)
                  for (int d1 = -std::min(reach[0], i); d1 <= std::min(reach[0], n[0] - 1 - i);
                       ++d1)
                    if (const auto column = number[place(c, i + d1, j + d2, k + d3)];
                        column != none)
                    {
                      rows.column.push_back(column);
                      rows.value.push_back(stencil(c, c, d1, d2, d3));
                    }
              rows.start.push_back(rows.column.size());
            }
      return rows;
    }

    MassRoot mass_root(const algebra::Stencil &mass, const geometry::BoxNodes &nodes,
                       std::size_t n_unknowns)
    {
      const double own = mass(0, 0, 0, 0, 0);
      if (is_diagonal(mass))
        return MassRoot(std::vector<double>(n_unknowns, own));
      if (nodes.is_free.empty())
        return MassRoot(ProductMass{nodes.n, mass.n_blocks(), own, mass(0, 0, 1, 0, 0) / own});
      return MassRoot(assemble(mass, nodes, mass.n_blocks()));
    }
  } // namespace

  std::unique_ptr<MotionOf<3>> BoxDiscretisation::motion(bool is_lumped) const
  {
    using Instant = problem::Problem<3>;
    using State = SemiDiscreteMotion::State;
    const auto mass = std::make_shared<const algebra::Stencil>(
        is_lumped ? algebra::lump(mass_stencil(), 1) : mass_stencil());
    const bool is_collocated = is_diagonal(*mass) && (*mass)(0, 0, 0, 0, 0) == 1;
    const auto positions = free_positions(nodes_, n_components_);
    const std::size_t n_nodes = positions.size() / n_components_;
    const auto unknowns = [positions](const Vector &over_nodes)
    {
      State u;
      u.reserve(positions.size());
      for (const std::size_t position : positions)
        u.push_back(over_nodes[position]);
      return u;
    };
    const auto driven = [this, unknowns](const algebra::Stencil &by, const problem::Field<3> &field,
                                         const Instant &instant)
    {
      Vector result = tested(field);
      if (by.reach() > 0)
        result -= collar_action(by, nodes_, constraint_values(instant, by.reach()));
      return unknowns(result);
    };
    LinearParts<3> parts{
        free_points(),
        n_components_,
        {},
        mass_root(*mass, nodes_, positions.size()),
        algebra::restrict(algebra::make_operator(stencil_, nodes_, backend_),
                          n_components_ * nodes_.n_positions(), positions),
        {},
        [=](const Instant &instant) { return driven(stencil_, instant.load, instant); },
        [=](const Instant &instant) { return driven(*mass, *instant.solution, instant); },
        is_collocated ? std::pow(lattice_.h(), 3) : 1};
    for (std::size_t k = 0; k < positions.size(); ++k)
      parts.place.push_back(k % n_components_ * n_nodes + k / n_components_);
    return move_linear<3>(std::move(parts));
  }
} // namespace plumbline::method
