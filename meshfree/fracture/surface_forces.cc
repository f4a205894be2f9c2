#include "meshfree/fracture/surface_forces.h"

#include "meshfree/fracture/equilibrium.h"

#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>
#include <cmath>

namespace plumbline::meshfree
{
  namespace
  {
    using NetworkBond = BondNetwork::Bond;

    /// Each from a node that lacks it; of what hangs loose none.
    std::vector<NetworkBond> missing_bonds(const BondNetwork &network,
                                           const Connections &connections)
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

  SurfaceForces::SurfaceForces(const BondNetwork &network, const Connections &connections)
      : network_(&network), connections_(&connections),
        correction_(network.nodes.size(), Tensor<2, 2>(dealii::unit_symmetric_tensor<2>())),
        pull_(network.nodes.size())
  {
    const std::vector<NetworkBond> missing = missing_bonds(network, connections);
    const NodeField normal = correct(missing);
    const double V = network.h * network.h;
    for (const NetworkBond &bond : missing)
    {
      const double excess = // λ - μ
          network.dilatation.empty() ? 0 : network.dilatation[bond.from] / V;
      const double mu = bond.stiffness / (8 * V * bond.share), lambda = mu + excess;
      const Tensor<1, 2> &n = normal[bond.from], &way = bond.way;
      const double along = way * n, across = way[0] * n[1] - way[1] * n[0];
      pull_[bond.from] +=
          V * bond.share *
          (2 * excess * bond.xi +
           4 * (bond.xi * n) * ((lambda + 2 * mu) * across * across - lambda * along * along) * n);
    }
  }

  /// M of nodes that lack bonds; their normals, 0 where bonds are missing on all sides alike.
  NodeField SurfaceForces::correct(const std::vector<NetworkBond> &missing)
  {
    constexpr double collinear = 1e-10, no_direction = 1e-8;
    const std::size_t n = network_->nodes.size();
    std::vector<Tensor<2, 2>> shape(n);
    NodeField outward(n);
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

  std::vector<double> SurfaceForces::dilatations(const NodeField &u) const
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

  NodeField SurfaceForces::forces(const NodeField &u) const
  {
    const std::vector<double> theta = dilatations(u);
    NodeField force = meshfree::forces(*network_, *connections_, u, theta);
    for (std::size_t i = 0; i < u.size(); ++i)
      force[i] += theta[i] * pull_[i];
    return force;
  }
} // namespace plumbline::meshfree
