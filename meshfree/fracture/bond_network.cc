#include "meshfree/fracture/bond_network.h"

#include "base/error.h"
#include "geometry/of_dimension.h"
#include "meshfree/scattered/damage.h"
#include "physics/crossing_energy.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <sstream>

namespace plumbline::meshfree
{
  namespace
  {
    constexpr double endless = std::numeric_limits<double>::infinity();
    constexpr double on_side = 1e-9; // of h: what two boxes share, and how far a node may be out

    using Cell = std::array<int, 3>; // of a lattice; in the plane the last index is 0

    Cell n_cells(const geometry::Lattice &lattice)
    {
      return {lattice.n_cells()[0], lattice.n_cells()[1], 1};
    }
    Cell n_cells(const geometry::CubeLattice &lattice)
    {
      return lattice.n_cells();
    }
    bool is_inside(const geometry::Lattice &lattice, const Cell &cell)
    {
      return lattice.is_inside(cell[0], cell[1]);
    }
    bool is_inside(const geometry::CubeLattice &lattice, const Cell &cell)
    {
      return lattice.is_inside(cell);
    }
    Point<2> centre(const geometry::Lattice &lattice, const Cell &cell)
    {
      return lattice.point(cell[0] + .5, cell[1] + .5);
    }
    Point<3> centre(const geometry::CubeLattice &lattice, const Cell &cell)
    {
      return {lattice.coordinate(0, cell[0] + .5), lattice.coordinate(1, cell[1] + .5),
              lattice.coordinate(2, cell[2] + .5)};
    }

    template <int dim>
    double cell_volume(double h)
    {
      return dim == 2 ? h * h : h * h * h;
    }

    /// A bond of every node of the lattice; of two that are opposite, one.
    template <int dim>
    struct Half
    {
      Cell k{};
      Tensor<1, dim> xi, way;
      double weight = 0; ///< w K
    };

    template <int dim>
    std::vector<Half<dim>> half_family(const NeighbourhoodQuadrature<dim> &rule,
                                       const Kernel<dim> &influence, double h, Backend backend)
    {
      const Bonds<dim> all =
          lattice_bonds(rule, physics::deviatoric_kernel(influence, 1), h, backend);
      std::vector<Half<dim>> result;
      for (const Bond<dim> &bond : all.family)
      {
        Cell k{};
        for (unsigned int d = 0; d < dim; ++d)
          k[d] = static_cast<int>(std::lround(bond.xi[d] / h));
        const double weight = bond.weight * radial_value(influence, bond);
        if (Cell{k[2], k[1], k[0]} > Cell{} && weight != 0)
          result.push_back({k, bond.xi, bond.kernel_point / bond.kernel_point.norm(), weight});
      }
      return result;
    }

    template <int dim>
    int box_of(const std::vector<geometry::BoxOf<dim>> &boxes, const Point<dim> &x, double h)
    {
      for (std::size_t i = 0; i < boxes.size(); ++i)
      {
        bool is_in = true;
        for (unsigned int d = 0; d < dim; ++d)
          is_in = is_in && x[d] > boxes[i].lower[d] - on_side * h &&
                  x[d] < boxes[i].upper[d] + on_side * h;
        if (is_in)
          return static_cast<int>(i);
      }
      return -1;
    }

    /// The first grip that shares area (volume) with the cell of a node, as geometry::vertex_cells
    /// holds nodes of bodies at rest; -1: none.
    template <int dim>
    int grip_of(const std::vector<geometry::BoxOf<dim>> &grips, const Point<dim> &x, double h)
    {
      const auto common = [&](const geometry::BoxOf<dim> &box, unsigned int d)
      { return std::min(box.upper[d], x[d] + h / 2) - std::max(box.lower[d], x[d] - h / 2); };
      for (std::size_t i = 0; i < grips.size(); ++i)
      {
        bool is_common = true;
        for (unsigned int d = 0; d < dim; ++d)
          is_common = is_common && common(grips[i], d) > on_side * h;
        if (is_common)
          return static_cast<int>(i);
      }
      return -1;
    }

    /// Nodes, by cells of the lattice: shape (n[2], n[1], n[0]), -1 where there is none.
    template <int dim>
    std::vector<int> place_nodes(const BreakingSolid<dim> &solid,
                                 const geometry::LatticeOf<dim> &lattice, BondNetwork<dim> &network)
    {
      const Cell n = n_cells(lattice);
      std::vector<int> number(static_cast<std::size_t>(n[0]) * n[1] * n[2], -1);
      geometry::for_each_index(
          {0, 0, 0}, n,
          [&](const Cell &cell)
          {
            if (!is_inside(lattice, cell))
              return;
            const Point<dim> x = centre(lattice, cell);
            number[geometry::number_within(cell, n)] = static_cast<int>(network.nodes.size());
            network.nodes.push_back(x);
            network.grip.push_back(grip_of(solid.grips, x, network.h));
            const bool is_free = network.grip.back() < 0;
            network.constrained.push_back(is_free ? Tensor<1, dim>() : solid.constrained(x));
            if (solid.load)
              network.loads.push_back(is_free ? cell_volume<dim>(network.h) * solid.load(x)
                                              : Tensor<1, dim>());
          });
      for (std::size_t g = 0; g < solid.grips.size(); ++g)
        if (std::find(network.grip.begin(), network.grip.end(), static_cast<int>(g)) ==
            network.grip.end())
          throw InputError("Domain/fixed: grip " + std::to_string(g) +
                           " holds no node: it shares no " + (dim == 2 ? "area" : "volume") +
                           " with a cell; give a box in the body (Domain/boxes)");
      if (std::find(network.grip.begin(), network.grip.end(), -1) == network.grip.end())
        throw InputError("Domain/fixed holds all nodes; leave some of them free");
      return number;
    }

    /// x and y: they determine the position relative to a line, and to the surface it sweeps along
    /// z.
    template <int dim>
    Point<2> in_plane(const Tensor<1, dim> &x)
    {
      return {x[0], x[1]};
    }

    /// Tells which bonds go across lines, in space across what lines sweep along z.
    class Crossing
    {
    public:
      template <int dim>
      Crossing(const std::vector<geometry::Polyline> &lines, const BondNetwork<dim> &network)
          : broken_({lines, {}, problem::SurfaceTerms::none}, cells(network), network.horizon)
      {
      }

      template <int dim>
      bool has(std::size_t from, const Tensor<1, dim> &xi, unsigned int to)
      {
        one_.neighbours = {to};
        one_.bonds.resize(1);
        one_.bonds[0].xi = in_plane(xi);
        return !broken_.find(from, one_, is_intact_);
      }

    private:
      template <int dim>
      const geometry::NodeCells<2> &cells(const BondNetwork<dim> &network)
      {
        for (const Point<dim> &x : network.nodes)
          cells_.nodes.push_back(in_plane(x));
        cells_.n_free = network.nodes.size();
        for (std::size_t i = 0; i < network.nodes.size(); ++i)
          cells_.source.push_back(i);
        return cells_;
      }

      geometry::NodeCells<2> cells_; // before what is made of them
      BrokenBonds broken_;
      Family<2> one_;
      std::vector<char> is_intact_;
    };

    /// G of bonds.
    template <int dim>
    class BondToughness
    {
    public:
      BondToughness(const BreakingSolid<dim> &solid, const BondNetwork<dim> &network)
          : solid_(solid)
      {
        for (const Point<dim> &x : network.nodes)
          of_nodes_.push_back(at(x));
        for (std::size_t k = 0; k < solid.interfaces.size(); ++k)
          try
          {
            interfaces_.push_back(std::make_unique<Crossing>(
                std::vector<geometry::Polyline>(1, solid.interfaces[k].line), network));
          }
          catch (const InputError &error)
          {
            throw InputError("Fracture/interfaces, line " + std::to_string(k + 1) + ": " +
                             error.what());
          }
        is_crossed_.resize(interfaces_.size());
      }

      double operator()(const BondNetwork<dim> &network, unsigned int a, const Tensor<1, dim> &xi,
                        unsigned int b)
      {
        double G = endless;
        for (std::size_t k = 0; k < interfaces_.size(); ++k)
          if (interfaces_[k]->has(a, xi, b))
          {
            is_crossed_[k] = true;
            G = std::min(G, solid_.interfaces[k].toughness);
          }
        if (G < endless)
          return G;
        if (!solid_.takes_least_toughness)
          return .5 * (of_nodes_[a] + of_nodes_[b]);
        constexpr double n_per_mesh_size = 8;
        const auto n = static_cast<int>(std::ceil(n_per_mesh_size * xi.norm() / network.h));
        G = std::min(of_nodes_[a], of_nodes_[b]);
        for (int k = 1; k < n; ++k)
          G = std::min(G, at(network.nodes[a] + k / static_cast<double>(n) * xi));
        return G;
      }

      /// @throws InputError  an interface that no bond crossed
      void check() const
      {
        for (std::size_t k = 0; k < is_crossed_.size(); ++k)
          if (!is_crossed_[k])
            throw InputError("Fracture/interfaces: no bond crosses line " + std::to_string(k + 1) +
                             "; give a line in the body (Domain/boxes), or take it out");
      }

    private:
      double at(const Point<dim> &x) const
      {
        const double G = solid_.toughness(x);
        if (G > 0)
          return G;
        std::ostringstream message;
        message << "Fracture/toughness = " << G << " at (" << x
                << ") must be positive: it is the fracture energy per unit area; "
                << "give a positive value for each phase";
        throw InputError(message.str());
      }

      const BreakingSolid<dim> &solid_;
      std::vector<double> of_nodes_;
      std::vector<std::unique_ptr<Crossing>> interfaces_;
      std::vector<bool> is_crossed_;
    };

    /// What two nodes have in common.
    template <int dim>
    struct Materials
    {
      std::vector<physics::Lame> lame;

      Materials(const BreakingSolid<dim> &solid, const std::vector<Point<dim>> &nodes)
      {
        for (const Point<dim> &x : nodes)
          lame.push_back(solid.material(x));
      }

      physics::Lame mean(std::size_t i, std::size_t j) const
      {
        using physics::Mean;
        return {physics::mean(Mean::harmonic, lame[i].lambda, lame[j].lambda),
                physics::mean(Mean::harmonic, lame[i].mu, lame[j].mu)};
      }
    };

    /// τ; empty if λ = μ to rounding everywhere.
    std::vector<double> dilatations(const std::vector<physics::Lame> &lame, double V)
    {
      constexpr double rounding = 1e-12;
      const auto is_bonds = [](const physics::Lame &one)
      { return std::abs(one.lambda - one.mu) <= rounding * one.mu; };
      if (std::all_of(lame.begin(), lame.end(), is_bonds))
        return {};
      std::vector<double> result;
      for (const physics::Lame &one : lame)
        result.push_back(V * (one.lambda - one.mu));
      return result;
    }

    /// Without gaps; empty: the forces have an energy.
    /// @throws InputError  surface terms in space
    template <int dim>
    std::optional<typename BondNetwork<dim>::Surfaces> surfaces_of(const BreakingSolid<dim> &solid,
                                                                   const Materials<dim> &materials)
    {
      if (solid.surface_terms == problem::SurfaceTerms::uncorrected)
        return {};
      if (dim == 3)
        throw InputError("Fracture/surface terms = " + base::word(solid.surface_terms) +
                         " is not available in three dimensions; write uncorrected");
      return
          typename BondNetwork<dim>::Surfaces{solid.surface_terms, {}, solid.notch, materials.lame};
    }

    /// Infinite where a bond cannot break.
    template <int dim>
    double critical_stretch(const BreakingSolid<dim> &solid, const BondNetwork<dim> &network,
                            const Materials<dim> &materials, double toughness,
                            const Kernel<dim> &influence, unsigned int a, unsigned int b)
    {
      if ((network.grip[a] >= 0 && network.grip[b] >= 0) ||
          box_of(solid.unbreaking, network.nodes[a], network.h) >= 0 ||
          box_of(solid.unbreaking, network.nodes[b], network.h) >= 0)
        return endless;
      const physics::Lame lame = materials.mean(a, b);
      return std::sqrt(toughness / solid.trapping /
                       physics::crossing_energy<dim>(influence.horizon(), lame));
    }
  } // namespace

  template <int dim>
  BondNetwork<dim> make_bond_network(const BreakingSolid<dim> &solid,
                                     const NeighbourhoodQuadrature<dim> &rule,
                                     const Kernel<dim> &influence, double h, Backend backend)
  {
    using NetworkBond = typename BondNetwork<dim>::Bond;
    BondNetwork<dim> network;
    network.h = h;
    network.horizon = influence.horizon();
    const geometry::LatticeOf<dim> lattice(solid.domain, h);
    const std::vector<int> number = place_nodes(solid, lattice, network);
    const Materials<dim> materials(solid, network.nodes);
    const double V = cell_volume<dim>(h);
    network.dilatation = dilatations(materials.lame, V);
    BondToughness<dim> toughness_of(solid, network);
    Crossing notch(solid.notch, network);
    const std::vector<Half<dim>> family = half_family(rule, influence, h, backend);
    const Cell n = n_cells(lattice);
    const auto node_at = [&](const Cell &cell, const Cell &k, int sign)
    {
      const Cell at = {cell[0] + sign * k[0], cell[1] + sign * k[1], cell[2] + sign * k[2]};
      return geometry::is_within(at, n) ? number[geometry::number_within(at, n)] : -1;
    };
    const auto bond_of = [&](const Half<dim> &half, unsigned int a, unsigned int b)
    {
      return NetworkBond{a,
                         b,
                         half.xi,
                         half.way,
                         V * (2 * (dim + 2)) * materials.mean(a, b).mu * half.weight,
                         half.weight,
                         endless};
    };
    network.surfaces = surfaces_of(solid, materials);
    const auto lack = [&](const NetworkBond &bond)
    {
      if (network.surfaces)
        network.surfaces->gaps.push_back(bond);
    };
    const auto add_bonds = [&](const Cell &cell)
    {
      const int from = number[geometry::number_within(cell, n)];
      if (from < 0)
        return;
      for (const Half<dim> &half : family)
      {
        const int to = node_at(cell, half.k, 1), behind = node_at(cell, half.k, -1);
        const auto a = static_cast<unsigned int>(from), b = static_cast<unsigned int>(to);
        if (behind < 0)
          lack(bond_of(half, a, a).reversed());
        if (to < 0)
        {
          lack(bond_of(half, a, a));
          continue;
        }
        NetworkBond bond = bond_of(half, a, b);
        if (notch.has(a, half.xi, b))
        {
          network.cut.push_back({a, b});
          lack(bond);
          lack(bond.reversed());
          continue;
        }
        const double toughness = toughness_of(network, a, half.xi, b);
        bond.critical = critical_stretch(solid, network, materials, toughness, influence, a, b);
        network.bonds.push_back(bond);
        network.toughness.push_back(toughness);
      }
    };
    geometry::for_each_index({0, 0, 0}, n, add_bonds);
    toughness_of.check();
    if (!solid.notch.empty() && network.cut.empty())
      throw InputError("Domain/cracks cuts no bond: the notch lies outside of the body "
                       "(Domain/boxes); give a line in it, from its mouth to its tip");
    return network;
  }

  template <int dim>
  std::vector<double> BondNetwork<dim>::damage(const std::vector<std::size_t> &broken) const
  {
    std::vector<double> all(nodes.size()), lost(nodes.size());
    for (const auto &ends : cut)
      for (const unsigned int node : ends)
      {
        ++all[node];
        ++lost[node];
      }
    for (const Bond &bond : bonds)
    {
      ++all[bond.from];
      ++all[bond.to];
    }
    for (const std::size_t b : broken)
    {
      ++lost[bonds[b].from];
      ++lost[bonds[b].to];
    }
    for (std::size_t i = 0; i < nodes.size(); ++i)
      lost[i] = all[i] > 0 ? lost[i] / all[i] : 0;
    return lost;
  }

  template <int dim>
  double lattice_toughness(const NeighbourhoodQuadrature<dim> &rule, const Kernel<dim> &influence,
                           double h, Backend backend, std::array<int, dim> normal)
  {
    double steps = 0;
    for (const int step : normal)
      steps = std::hypot(steps, step);
    Assert(steps > 0, dealii::ExcMessage("a normal without a direction"));
    // λ = μ = 1; of each kind of bond |k·normal| go through the line or plane in h or h² times
    // |normal|
    const double V = cell_volume<dim>(h),
                 first = physics::crossing_energy<dim>(influence.horizon(), {1, 1});
    double sum = 0;
    for (const Half<dim> &half : half_family(rule, influence, h, backend))
    {
      int rise = 0;
      for (unsigned int d = 0; d < dim; ++d)
        rise += half.k[d] * normal[d];
      const double stretch = (half.way * half.xi) * (half.way * half.xi) / first,
                   n_across = std::abs(rise) / (V / h * steps);
      sum += .5 * V * (2 * (dim + 2)) * half.weight * stretch * n_across;
    }
    return sum;
  }

#define INSTANTIATE(dim)                                                                           \
  template struct BondNetwork<dim>;                                                                \
  template BondNetwork<dim> make_bond_network(const BreakingSolid<dim> &,                          \
                                              const NeighbourhoodQuadrature<dim> &,                \
                                              const Kernel<dim> &, double, Backend);               \
  template double lattice_toughness<dim>(const NeighbourhoodQuadrature<dim> &,                     \
                                         const Kernel<dim> &, double, Backend,                     \
                                         std::array<int, dim>);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace plumbline::meshfree
