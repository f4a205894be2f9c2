#include "meshfree/fracture/bond_network.h"

#include "base/error.h"
#include "geometry/of_dimension.h"
#include "meshfree/rules/families.h"
#include "meshfree/scattered/damage.h"
#include "physics/crossing_energy.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
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

    /// @param grip    -1: it is free
    /// @param volume  of its cell
    template <int dim>
    void add_node(const BreakingSolid<dim> &solid, const Point<dim> &x, int grip, double volume,
                  BondNetwork<dim> &network)
    {
      network.nodes.push_back(x);
      network.grip.push_back(grip);
      const bool is_free = grip < 0;
      network.constrained.push_back(is_free ? Tensor<1, dim>() : solid.constrained(x));
      if (solid.load)
        network.loads.push_back(is_free ? volume * solid.load(x) : Tensor<1, dim>());
    }

    /// @throws InputError  a grip without a node, or no node that is free
    template <int dim>
    void check_grips(const BreakingSolid<dim> &solid, const BondNetwork<dim> &network)
    {
      for (std::size_t g = 0; g < solid.grips.size(); ++g)
        if (std::find(network.grip.begin(), network.grip.end(), static_cast<int>(g)) ==
            network.grip.end())
          throw InputError("Domain/fixed: grip " + std::to_string(g) +
                           (network.cells
                                ? " holds no node: none lies in its box"
                                : " holds no node: it shares no " +
                                      std::string(dim == 2 ? "area" : "volume") + " with a cell") +
                           "; give a box in the body (Domain/boxes)");
      if (std::find(network.grip.begin(), network.grip.end(), -1) == network.grip.end())
        throw InputError("Domain/fixed holds all nodes; leave some of them free");
    }

    /// Nodes, by cells of the lattice: shape (n[2], n[1], n[0]), -1 where there is none.
    template <int dim>
    std::vector<int> place_nodes(const BreakingSolid<dim> &solid,
                                 const geometry::LatticeOf<dim> &lattice, BondNetwork<dim> &network)
    {
      const Cell n = n_cells(lattice);
      std::vector<int> number(static_cast<std::size_t>(n[0]) * n[1] * n[2], -1);
      geometry::for_each_index({0, 0, 0}, n,
                               [&](const Cell &cell)
                               {
                                 if (!is_inside(lattice, cell))
                                   return;
                                 const Point<dim> x = centre(lattice, cell);
                                 number[geometry::number_within(cell, n)] =
                                     static_cast<int>(network.nodes.size());
                                 add_node(solid, x, grip_of(solid.grips, x, network.h),
                                          cell_volume<dim>(network.h), network);
                               });
      check_grips(solid, network);
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
    /// @param factor  of a node: τ over λ - μ
    template <class Factor>
    std::vector<double> dilatations(const std::vector<physics::Lame> &lame, const Factor &factor)
    {
      constexpr double rounding = 1e-12;
      const auto is_bonds = [](const physics::Lame &one)
      { return std::abs(one.lambda - one.mu) <= rounding * one.mu; };
      if (std::all_of(lame.begin(), lame.end(), is_bonds))
        return {};
      std::vector<double> result;
      for (std::size_t i = 0; i < lame.size(); ++i)
        result.push_back(factor(i) * (lame[i].lambda - lame[i].mu));
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
      return std::sqrt(toughness / solid.trapping / physics::crossing_energy(influence, lame));
    }

    /// Puts bonds into a network, each whole or cut by the notch.
    template <int dim>
    class BondMaker
    {
    public:
      using NetworkBond = typename BondNetwork<dim>::Bond;

      /// @param network  with its nodes
      BondMaker(const BreakingSolid<dim> &solid, const Kernel<dim> &influence,
                BondNetwork<dim> &network)
          : solid_(solid), influence_(influence), network_(network),
            materials_(solid, network.nodes), toughness_of_(solid, network),
            notch_(solid.notch, network)
      {
        network.surfaces = surfaces_of(solid, materials_);
      }

      /// @param strength  V w K
      NetworkBond bond(unsigned int a, unsigned int b, const Tensor<1, dim> &xi,
                       const Tensor<1, dim> &way, double strength, double share) const
      {
        return {a,     b,      xi, way, strength * (2 * (dim + 2)) * materials_.mean(a, b).mu,
                share, endless};
      }

      void add(NetworkBond bond)
      {
        if (notch_.has(bond.from, bond.xi, bond.to))
        {
          network_.cut.push_back({bond.from, bond.to});
          lack(bond);
          lack(bond.reversed());
          return;
        }
        const double toughness = toughness_of_(network_, bond.from, bond.xi, bond.to);
        bond.critical = critical_stretch(solid_, network_, materials_, toughness, influence_,
                                         bond.from, bond.to);
        network_.bonds.push_back(bond);
        network_.toughness.push_back(toughness);
      }

      /// There is no such bond, because there is no node, or a notch is between.
      void lack(const NetworkBond &bond)
      {
        if (network_.surfaces)
          network_.surfaces->gaps.push_back(bond);
      }

      const std::vector<physics::Lame> &lame() const { return materials_.lame; }

      /// @throws InputError  an interface or a notch that no bond crosses
      void check() const
      {
        toughness_of_.check();
        if (!solid_.notch.empty() && network_.cut.empty())
          throw InputError("Domain/cracks cuts no bond: the notch lies outside of the body "
                           "(Domain/boxes); give a line in it, from its mouth to its tip");
      }

    private:
      const BreakingSolid<dim> &solid_;
      const Kernel<dim> &influence_;
      BondNetwork<dim> &network_;
      Materials<dim> materials_;
      BondToughness<dim> toughness_of_;
      Crossing notch_;
    };
  } // namespace

  namespace
  {
    /// Of a solid on a lattice.
    template <int dim>
    BondNetwork<dim> lattice_network(const BreakingSolid<dim> &solid,
                                     const NeighbourhoodQuadrature<dim> &rule,
                                     const Kernel<dim> &influence, double h, Backend backend)
    {
      BondNetwork<dim> network;
      network.h = h;
      network.horizon = influence.horizon();
      const geometry::LatticeOf<dim> lattice(solid.domain, h);
      const std::vector<int> number = place_nodes(solid, lattice, network);
      BondMaker<dim> maker(solid, influence, network);
      const double V = cell_volume<dim>(h);
      network.dilatation = dilatations(maker.lame(), [V](std::size_t) { return V; });
      const std::vector<Half<dim>> family = half_family(rule, influence, h, backend);
      const Cell n = n_cells(lattice);
      const auto node_at = [&](const Cell &cell, const Cell &k, int sign)
      {
        const Cell at = {cell[0] + sign * k[0], cell[1] + sign * k[1], cell[2] + sign * k[2]};
        return geometry::is_within(at, n) ? number[geometry::number_within(at, n)] : -1;
      };
      const auto add_bonds = [&](const Cell &cell)
      {
        const int from = number[geometry::number_within(cell, n)];
        if (from < 0)
          return;
        for (const Half<dim> &half : family)
        {
          const int to = node_at(cell, half.k, 1), behind = node_at(cell, half.k, -1);
          const auto a = static_cast<unsigned int>(from);
          const auto bond_to = [&](unsigned int b)
          { return maker.bond(a, b, half.xi, half.way, V * half.weight, half.weight); };
          if (behind < 0)
            maker.lack(bond_to(a).reversed());
          if (to < 0)
            maker.lack(bond_to(a));
          else
            maker.add(bond_to(static_cast<unsigned int>(to)));
        }
      };
      geometry::for_each_index({0, 0, 0}, n, add_bonds);
      maker.check();
      return network;
    }

    /// ½ (V_i w_ij + V_j w_ji) K of all pairs of scattered nodes, i < j, in their order.
    std::map<std::array<unsigned int, 2>, double> strengths(const Families<2> &families,
                                                            const Kernel<2> &influence)
    {
      std::map<std::array<unsigned int, 2>, double> all;
      Family<2> family;
      for (std::size_t i = 0; i < families.cells().size(); ++i)
      {
        families.make(i, family);
        const auto from = static_cast<unsigned int>(i);
        for (std::size_t k = 0; k < family.bonds.size(); ++k)
          all[{std::min(from, family.neighbours[k]), std::max(from, family.neighbours[k])}] +=
              .5 * families.cells().area[i] * family.bonds[k].weight *
              radial_value(influence, family.bonds[k]);
      }
      return all;
    }

    /// See BondNetwork.
    double cut_energy(const BondNetwork<2> &network, const Kernel<2> &influence)
    {
      // a bond of stretch 1 has the energy 4 share r² where μ = 1, at both its ends half of it; the
      // mean of |ξ·n| over directions n is 2 r/π
      const double first = physics::crossing_energy(influence, {1, 1});
      std::vector<double> of_nodes(network.nodes.size());
      for (const typename BondNetwork<2>::Bond &bond : network.bonds)
        for (const unsigned int node : {bond.from, bond.to})
          of_nodes[node] += 2 * bond.share * std::pow(bond.xi.norm(), 3) * 2 / M_PI / first /
                            network.cells->area[node];
      const auto middle = of_nodes.begin() + static_cast<std::ptrdiff_t>(of_nodes.size() / 2);
      std::nth_element(of_nodes.begin(), middle, of_nodes.end());
      return *middle;
    }

    /// Of a solid on scattered nodes.
    BondNetwork<2> scattered_network(const BreakingSolid<2> &solid,
                                     const NeighbourhoodQuadrature<2> &rule,
                                     const Kernel<2> &influence, Backend backend)
    {
      const geometry::NodeCells<2> &cells = *solid.cells;
      if (solid.surface_terms != problem::SurfaceTerms::uncorrected)
        throw InputError("Fracture/surface terms = " + base::word(solid.surface_terms) +
                         " is not available on scattered nodes; write uncorrected");
      if (rule.adjust)
        throw InputError("this rule adjusts the weights of whole balls, and families end at free "
                         "surfaces; write Methods/names = FA or PA-AC, or Domain/mesh = lattice");
      BondNetwork<2> network;
      network.horizon = influence.horizon();
      network.cells = solid.cells;
      network.h = std::sqrt(std::accumulate(cells.area.begin(), cells.area.end(), 0.) /
                            static_cast<double>(cells.size()));
      for (std::size_t i = 0; i < cells.size(); ++i)
        add_node(solid, cells.nodes[i], box_of(solid.grips, cells.nodes[i], network.h),
                 cells.area[i], network);
      check_grips(solid, network);
      BondMaker<2> maker(solid, influence, network);
      network.dilatation =
          dilatations(maker.lame(), [&](std::size_t i) { return 1 / cells.area[i]; });
      const Families<2> families(rule, physics::deviatoric_kernel(influence, 1), cells, backend);
      for (const auto &[ends, strength] : strengths(families, influence))
        if (strength != 0)
        {
          const Tensor<1, 2> xi = cells.nodes[ends[1]] - cells.nodes[ends[0]];
          maker.add(maker.bond(ends[0], ends[1], xi, xi / xi.norm(), strength, strength));
        }
      maker.check();
      network.cut_energy = cut_energy(network, influence);
      return network;
    }
  } // namespace

  template <int dim>
  BondNetwork<dim> make_bond_network(const BreakingSolid<dim> &solid,
                                     const NeighbourhoodQuadrature<dim> &rule,
                                     const Kernel<dim> &influence, double h, Backend backend)
  {
    if constexpr (dim == 2)
      if (solid.cells)
        return scattered_network(solid, rule, influence, backend);
    return lattice_network(solid, rule, influence, h, backend);
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
    const double V = cell_volume<dim>(h), first = physics::crossing_energy(influence, {1, 1});
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
