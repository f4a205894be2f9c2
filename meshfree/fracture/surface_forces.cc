#include "meshfree/fracture/surface_forces.h"

#include "meshfree/fracture/equilibrium.h"
#include "meshfree/fracture/network_faces.h"
#include "meshfree/scattered/surface_terms.h"

#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

namespace plumbline::meshfree
{
  namespace
  {
    using NetworkBond = BondNetwork<2>::Bond;

    /// Each from a node that lacks it; of what hangs loose none.
    std::vector<NetworkBond> missing_bonds(const BondNetwork<2> &network,
                                           const Connections<2> &connections)
    {
      std::vector<NetworkBond> missing = network.surfaces->gaps;
      for (std::size_t b = 0; b < network.bonds.size(); ++b)
        if (!connections.is_whole(b))
        {
          missing.push_back(network.bonds[b]);
          missing.push_back(network.bonds[b].reversed());
        }
      missing.erase(std::remove_if(missing.begin(), missing.end(),
                                   [&](const NetworkBond &bond)
                                   { return connections.is_loose(bond.from); }),
                    missing.end());
      return missing;
    }
  } // namespace

  SurfaceForces::SurfaceForces(const BondNetwork<2> &network, const Connections<2> &connections)
      : network_(&network), connections_(&connections),
        correction_(network.nodes.size(), Tensor<2, 2>(dealii::unit_symmetric_tensor<2>())),
        pull_(network.nodes.size()), dilating_(network.nodes.size())
  {
    std::iota(dilating_.begin(), dilating_.end(), 0U);
    const std::vector<NetworkBond> missing = missing_bonds(network, connections);
    const NodeField<2> normal = correct(missing);
    if (network.surfaces->terms == problem::SurfaceTerms::published)
      add_published(missing, normal);
    if (network.surfaces->terms == problem::SurfaceTerms::consistent)
      add_consistent(missing);
  }

  void SurfaceForces::add_published(const std::vector<NetworkBond> &missing,
                                    const NodeField<2> &normal)
  {
    const double V = network_->h * network_->h;
    for (const NetworkBond &bond : missing)
    {
      const double excess = // λ - μ
          network_->dilatation.empty() ? 0 : network_->dilatation[bond.from] / V;
      const double mu = bond.stiffness / (8 * V * bond.share);
      const Tensor<1, 2> &n = normal[bond.from];
      pull_[bond.from] += V * bond.share *
                          (2 * excess * bond.xi +
                           4 * (bond.xi * n) * uniaxial_strain({mu + excess, mu}, bond.way, n) * n);
    }
  }

  void SurfaceForces::add_consistent(const std::vector<NetworkBond> &missing)
  {
    const double V = network_->h * network_->h;
    const Faces faces = find_faces(*network_, *connections_);
    std::vector<std::optional<Faces::Foot>> feet(network_->nodes.size());
    std::vector<char> is_known(network_->nodes.size(), 0);
    for (const NetworkBond &bond : missing)
    {
      std::optional<Faces::Foot> &foot = feet[bond.from];
      if (is_known[bond.from] == 0)
      {
        foot = faces.foot(network_->nodes[bond.from], network_->horizon + network_->h);
        is_known[bond.from] = 1;
        if (foot && !foot->is_near_end)
          dilating_[bond.from] = node_of_face(bond.from, foot->place);
      }
      if (!foot || foot->is_near_end)
        continue;
      const physics::Lame &own = network_->surfaces->lame[bond.from];
      pull_[bond.from] +=
          V * bond.share *
          (2 * (own.lambda - own.mu) + 4 * uniaxial_strain(own, bond.way, foot->normal)) * bond.xi;
    }
  }

  /// Of a node and its neighbours by whole bonds the one that is nearest to its foot.
  unsigned int SurfaceForces::node_of_face(unsigned int node, const Point<2> &foot) const
  {
    const double rounding = geometry::on_crack * network_->horizon;
    unsigned int nearest = node;
    double distance = network_->nodes[node].distance(foot);
    const auto [begin, end] = connections_->bonds_of(node);
    for (const unsigned int *b = begin; b != end; ++b)
    {
      const NetworkBond &bond = network_->bonds[*b];
      const unsigned int other = bond.from == node ? bond.to : bond.from;
      const double from_other = network_->nodes[other].distance(foot);
      if (connections_->is_whole(*b) && !connections_->is_loose(other) &&
          from_other < distance - rounding)
      {
        nearest = other;
        distance = from_other;
      }
    }
    return nearest;
  }

  /// M of nodes that lack bonds; their normals, 0 where bonds are missing on all sides alike.
  NodeField<2> SurfaceForces::correct(const std::vector<NetworkBond> &missing)
  {
    constexpr double collinear = 1e-10, no_direction = 1e-8;
    const std::size_t n = network_->nodes.size();
    std::vector<Tensor<2, 2>> shape(n);
    NodeField<2> outward(n);
    for (std::size_t b = 0; b < network_->bonds.size(); ++b)
      if (connections_->is_whole(b))
      {
        const NetworkBond &bond = network_->bonds[b];
        for (const unsigned int i : {bond.from, bond.to})
          shape[i] += bond.share * outer_product(bond.xi, bond.xi);
        const Tensor<1, 2> arm = bond.share * bond.xi.norm() * bond.xi; // w ξ, for K = c/r
        outward[bond.from] -= arm;
        outward[bond.to] += arm;
      }
    for (const NetworkBond &bond : missing)
    {
      const Tensor<2, 2> &one = shape[bond.from];
      const double square = one.norm_square();
      correction_[bond.from] = std::abs(determinant(one)) > collinear * square ? invert(one)
                               : square > 0                                    ? one / square
                                                                               : Tensor<2, 2>();
    }
    for (Tensor<1, 2> &one : outward)
    {
      const double length = one.norm();
      one = length > no_direction * network_->horizon ? one / length : Tensor<1, 2>();
    }
    return outward;
  }

  std::vector<double> SurfaceForces::dilatations(const NodeField<2> &u) const
  {
    std::vector<double> theta(u.size());
    for (std::size_t b = 0; b < network_->bonds.size(); ++b)
      if (connections_->is_whole(b))
      {
        const NetworkBond &bond = network_->bonds[b];
        const Tensor<1, 2> du = u[bond.to] - u[bond.from];
        for (const unsigned int i : {bond.from, bond.to}) // both see the same ξ Δu
          theta[i] += bond.share * (bond.xi * (correction_[i] * du));
      }
    return theta;
  }

  NodeField<2> SurfaceForces::forces(const NodeField<2> &u) const
  {
    const std::vector<double> theta = dilatations(u);
    NodeField<2> force = meshfree::forces(*network_, *connections_, u, theta);
    for (std::size_t i = 0; i < u.size(); ++i)
      force[i] += theta[dilating_[i]] * pull_[i];
    return force;
  }

  NodeField<2> SurfaceForces::terms(const NodeField<2> &u) const
  {
    const std::vector<double> theta = dilatations(u);
    NodeField<2> result(u.size());
    for (std::size_t i = 0; i < u.size(); ++i)
      result[i] = theta[dilating_[i]] * pull_[i];
    return result;
  }
} // namespace plumbline::meshfree
