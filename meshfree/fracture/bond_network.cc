#include "meshfree/fracture/bond_network.h"

#include "base/error.h"
#include "meshfree/scattered/damage.h"

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
    using NetworkBond = BondNetwork::Bond;

    constexpr double endless = std::numeric_limits<double>::infinity();
    constexpr double on_side = 1e-9; // of h: what two boxes share, and how far a node may be out

    /// A bond of every node of the lattice; of two that are opposite, one.
    struct Half
    {
      std::array<int, 2> k{};
      Tensor<1, 2> xi, way;
      double weight = 0; ///< w K
    };

    std::vector<Half> half_family(const NeighbourhoodQuadrature<2> &rule,
                                  const Kernel<2> &influence, double h, Backend backend)
    {
      const Bonds<2> all =
          lattice_bonds(rule, physics::deviatoric_kernel(influence, 1), h, backend);
      std::vector<Half> result;
      for (const Bond<2> &bond : all.family)
      {
        const int k1 = static_cast<int>(std::lround(bond.xi[0] / h)),
                  k2 = static_cast<int>(std::lround(bond.xi[1] / h));
        const double weight = bond.weight * radial_value(influence, bond);
        if ((k2 > 0 || (k2 == 0 && k1 > 0)) && weight != 0)
          result.push_back(
              {{k1, k2}, bond.xi, bond.kernel_point / bond.kernel_point.norm(), weight});
      }
      return result;
    }

    /// β = ∫K r⁴ dr of K = 3/(πδ³r).
    double beta(const Kernel<2> &influence)
    {
      return .75 / M_PI * influence.horizon();
    }

    int box_of(const std::vector<geometry::Box> &boxes, const Point<2> &x, double h)
    {
      for (std::size_t i = 0; i < boxes.size(); ++i)
        if (x[0] > boxes[i].lower[0] - on_side * h && x[0] < boxes[i].upper[0] + on_side * h &&
            x[1] > boxes[i].lower[1] - on_side * h && x[1] < boxes[i].upper[1] + on_side * h)
          return static_cast<int>(i);
      return -1;
    }

    /// The first grip that shares area with the cell of a node, as geometry::vertex_cells holds
    /// nodes of bodies at rest; -1: none.
    int grip_of(const std::vector<geometry::Box> &grips, const Point<2> &x, double h)
    {
      const auto common = [&](const geometry::Box &box, unsigned int d)
      { return std::min(box.upper[d], x[d] + h / 2) - std::max(box.lower[d], x[d] - h / 2); };
      for (std::size_t i = 0; i < grips.size(); ++i)
        if (common(grips[i], 0) > on_side * h && common(grips[i], 1) > on_side * h)
          return static_cast<int>(i);
      return -1;
    }

    /// Nodes, by cells of the lattice: shape (n[1], n[0]), -1 where there is none.
    std::vector<int> place_nodes(const BreakingSolid &solid, const geometry::Lattice &lattice,
                                 BondNetwork &network)
    {
      const auto [n1, n2] = lattice.n_cells();
      std::vector<int> number(static_cast<std::size_t>(n1) * n2, -1);
      for (int j = 0; j < n2; ++j)
        for (int i = 0; i < n1; ++i)
          if (lattice.is_inside(i, j))
          {
            const Point<2> x = lattice.point(i + .5, j + .5);
            number[static_cast<std::size_t>(j) * n1 + i] = static_cast<int>(network.nodes.size());
            network.nodes.push_back(x);
            network.grip.push_back(grip_of(solid.grips, x, network.h));
            network.constrained.push_back(network.grip.back() < 0 ? Tensor<1, 2>()
                                                                  : solid.constrained(x));
          }
      for (std::size_t g = 0; g < solid.grips.size(); ++g)
        if (std::find(network.grip.begin(), network.grip.end(), static_cast<int>(g)) ==
            network.grip.end())
          throw InputError("Domain/fixed: grip " + std::to_string(g) +
                           " holds no node: it shares no area with a cell; give a box in the body "
                           "(Domain/boxes)");
      if (std::find(network.grip.begin(), network.grip.end(), -1) == network.grip.end())
        throw InputError("Domain/fixed holds all nodes; leave some of them free");
      return number;
    }

    /// Tells which bonds go across lines.
    class Crossing
    {
    public:
      Crossing(const std::vector<geometry::Polyline> &lines, const BondNetwork &network)
          : broken_({lines, {}, problem::SurfaceTerms::none}, cells(network), network.horizon)
      {
      }

      bool has(std::size_t from, const Tensor<1, 2> &xi, unsigned int to)
      {
        one_.neighbours = {to};
        one_.bonds.resize(1);
        one_.bonds[0].xi = Point<2>(xi);
        return !broken_.find(from, one_, is_intact_);
      }

    private:
      const geometry::NodeCells<2> &cells(const BondNetwork &network)
      {
        cells_.nodes = network.nodes;
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
    class BondToughness
    {
    public:
      BondToughness(const BreakingSolid &solid, const BondNetwork &network) : solid_(solid)
      {
        for (const Point<2> &x : network.nodes)
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

      double operator()(const BondNetwork &network, unsigned int a, const Tensor<1, 2> &xi,
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
      double at(const Point<2> &x) const
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

      const BreakingSolid &solid_;
      std::vector<double> of_nodes_;
      std::vector<std::unique_ptr<Crossing>> interfaces_;
      std::vector<bool> is_crossed_;
    };

    /// What two nodes have in common.
    struct Materials
    {
      std::vector<physics::Lame> lame;

      Materials(const BreakingSolid &solid, const std::vector<Point<2>> &nodes)
      {
        for (const Point<2> &x : nodes)
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

    /// Infinite where a bond cannot break.
    double critical_stretch(const BreakingSolid &solid, const BondNetwork &network,
                            const Materials &materials, double toughness,
                            const Kernel<2> &influence, unsigned int a, unsigned int b)
    {
      if ((network.grip[a] >= 0 && network.grip[b] >= 0) ||
          box_of(solid.unbreaking, network.nodes[a], network.h) >= 0 ||
          box_of(solid.unbreaking, network.nodes[b], network.h) >= 0)
        return endless;
      const physics::Lame lame = materials.mean(a, b);
      return std::sqrt(toughness / solid.trapping /
                       (4 * beta(influence) * (lame.lambda + lame.mu)));
    }
  } // namespace

  BondNetwork make_bond_network(const BreakingSolid &solid, const NeighbourhoodQuadrature<2> &rule,
                                const Kernel<2> &influence, double h, Backend backend)
  {
    BondNetwork network;
    network.h = h;
    network.horizon = influence.horizon();
    const geometry::Lattice lattice(solid.domain, h);
    const std::vector<int> number = place_nodes(solid, lattice, network);
    const Materials materials(solid, network.nodes);
    network.dilatation = dilatations(materials.lame, h * h);
    BondToughness toughness_of(solid, network);
    Crossing notch(solid.notch, network);
    const std::vector<Half> family = half_family(rule, influence, h, backend);
    const auto [n1, n2] = lattice.n_cells();
    const auto node_at = [&](int i, int j)
    {
      return i < 0 || i >= n1 || j < 0 || j >= n2 ? -1
                                                  : number[static_cast<std::size_t>(j) * n1 + i];
    };
    const auto bond_of = [&](const Half &half, unsigned int a, unsigned int b)
    {
      return NetworkBond{
          a,           b,      half.xi, half.way, h * h * 8 * materials.mean(a, b).mu * half.weight,
          half.weight, endless};
    };
    if (solid.surface_terms != problem::SurfaceTerms::uncorrected)
      network.surfaces = {solid.surface_terms, {}, solid.notch, materials.lame};
    const auto lack = [&](const NetworkBond &bond)
    {
      if (network.surfaces)
        network.surfaces->gaps.push_back(bond);
    };
    for (int j = 0; j < n2; ++j)
      for (int i = 0; i < n1; ++i)
        for (const Half &half : family)
        {
          const int from = node_at(i, j), to = node_at(i + half.k[0], j + half.k[1]),
                    behind = node_at(i - half.k[0], j - half.k[1]);
          if (from < 0)
            continue;
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
    toughness_of.check();
    if (!solid.notch.empty() && network.cut.empty())
      throw InputError("Domain/cracks cuts no bond: the notch lies outside of the body "
                       "(Domain/boxes); give a line in it, from its mouth to its tip");
    return network;
  }

  std::vector<double> BondNetwork::damage(const std::vector<std::size_t> &broken) const
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

  double lattice_toughness(const NeighbourhoodQuadrature<2> &rule, const Kernel<2> &influence,
                           double h, Backend backend, std::array<int, 2> along)
  {
    const double steps = std::hypot(along[0], along[1]);
    Assert(steps > 0, dealii::ExcMessage("a line without a direction"));
    // for λ = μ = 1 and s0² = 1/(8β); of each kind of bond |k x along| cross the line in h |along|
    double sum = 0;
    for (const Half &half : half_family(rule, influence, h, backend))
    {
      const double stretch = (half.way * half.xi) * (half.way * half.xi) / (8 * beta(influence)),
                   n_across = std::abs(half.k[0] * along[1] - half.k[1] * along[0]) / (h * steps);
      sum += .5 * h * h * 8 * half.weight * stretch * n_across;
    }
    return sum;
  }
} // namespace plumbline::meshfree
