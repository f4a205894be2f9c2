// The semi-discrete equation of motion on unions of boxes, in three dimensions.
#include "algebra/slab_operator.h"
#include "algebra/spectrum.h"
#include "base/error.h"
#include "geometry/node_planes.h"
#include "method/box_discretisation.h"
#include "method/linear_motion.h"

#include <deal.II/lac/vector.h>

#include <cmath>
#include <optional>
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

    /// Couplings by a stencil of one component between free positions.
    algebra::CsrMatrix assemble(const algebra::Stencil &stencil, const geometry::BoxNodes &nodes)
    {
      constexpr auto none = static_cast<unsigned int>(-1);
      const std::array<int, 3> &n = nodes.n, &reach = stencil.reaches();
      const auto positions = free_positions(nodes, 1);
      std::vector<unsigned int> number(nodes.n_positions(), none);
      for (unsigned int i = 0; i < positions.size(); ++i)
        number[positions[i]] = i;
      algebra::CsrMatrix rows;
      rows.start.assign(1, 0);
      geometry::for_each_index(
          {0, 0, 0}, n,
          [&](const std::array<int, 3> &at)
          {
            if (!nodes.free(at))
              return;
            geometry::for_each_index(
                {-reach[0], -reach[1], -reach[2]}, {reach[0] + 1, reach[1] + 1, reach[2] + 1},
                [&](const std::array<int, 3> &k)
                {
                  const std::array<int, 3> there = {at[0] + k[0], at[1] + k[1], at[2] + k[2]};
                  if (!nodes.free(there))
                    return;
                  rows.column.push_back(number[geometry::number_within(there, n)]);
                  rows.value.push_back(stencil(0, 0, k[0], k[1], k[2]));
                });
            rows.start.push_back(rows.column.size());
          });
      return rows;
    }

    /// @param slabs       where ranks share the nodes
    /// @param n_unknowns  of this rank
    MassRoot mass_root(const algebra::Stencil &mass, const geometry::BoxNodes &nodes,
                       const std::optional<base::Slabs> &slabs, std::size_t n_unknowns)
    {
      const double own = mass(0, 0, 0, 0, 0);
      if (is_diagonal(mass))
        return MassRoot(std::vector<double>(n_unknowns, own));
      if (nodes.is_free.empty())
        return MassRoot(ProductMass{nodes.n, mass.n_blocks(), own, mass(0, 0, 1, 0, 0) / own},
                        slabs);
      return MassRoot(assemble(mass, nodes), mass.n_blocks());
    }
  } // namespace

  std::unique_ptr<MotionOf<3>> BoxDiscretisation::motion(bool is_lumped) const
  {
    using Instant = problem::Problem<3>;
    using State = SemiDiscreteMotion::State;
    const auto mass = std::make_shared<const algebra::Stencil>(
        is_lumped ? algebra::lump(mass_stencil(), 1) : mass_stencil());
    const bool is_collocated = is_diagonal(*mass) && (*mass)(0, 0, 0, 0, 0) == 1;
    std::optional<NodeSlabs> distribution;
    if (node_slabs_.ranks().n_ranks() > 1)
      distribution = {node_slabs_, static_cast<std::size_t>(nodes_.n[0]) * nodes_.n[1]};
    const geometry::BoxNodes own = geometry::planes_of(nodes_, node_slabs_.owned());
    const auto positions =
        std::make_shared<const std::vector<std::size_t>>(free_positions(own, n_components_));
    const std::size_t n_unknowns = positions->size(), n_nodes = n_unknowns / n_components_;
    const auto unknowns = [positions](const Vector &over_nodes)
    {
      State u;
      u.reserve(positions->size());
      for (const std::size_t position : *positions)
        u.push_back(over_nodes[position]);
      return u;
    };
    const auto driven = [this, own, unknowns](const algebra::Stencil &by,
                                              const problem::Field<3> &field,
                                              const Instant &instant)
    {
      Vector result = tested(field);
      if (by.reach() > 0)
        result -= collar_action(by, own, constraint_values(instant, by.reach()));
      return unknowns(result);
    };
    LinearParts<3> parts{
        free_points(),
        n_components_,
        {},
        mass_root(*mass, nodes_, distribution ? std::optional(distribution->slabs) : std::nullopt,
                  n_unknowns),
        {},
        {},
        [=](const Instant &instant) { return driven(stencil_, instant.load, instant); },
        [=](const Instant &instant) { return driven(*mass, *instant.solution, instant); },
        is_collocated ? std::pow(lattice_.h(), 3) : 1,
        distribution};
    if (distribution)
      parts.stiffness = [by = std::make_shared<const algebra::SlabOperator>(
                             stencil_, nodes_.n, node_slabs_, backend_)](const State &x, State &y)
      { by->apply(x.data(), y.data()); };
    else
      parts.stiffness = algebra::restrict(algebra::make_operator(stencil_, nodes_, backend_),
                                          n_components_ * nodes_.n_positions(), *positions);
    parts.place.reserve(n_unknowns);
    for (std::size_t k = 0; k < n_unknowns; ++k)
      parts.place.push_back(k % n_components_ * n_nodes + k / n_components_);
    return move_linear<3>(std::move(parts));
  }
} // namespace plumbline::method
