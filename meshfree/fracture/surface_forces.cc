#include "meshfree/fracture/surface_forces.h"

#include "meshfree/fracture/equations.h"

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/lac/solver_gmres.h>
#include <deal.II/lac/vector.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace plumbline::meshfree
{
  namespace
  {
    using NetworkBond = BondNetwork::Bond;
    using Field = std::vector<Tensor<1, 2>>;

    Field to_field(const dealii::Vector<double> &x)
    {
      Field field(x.size() / 2);
      for (std::size_t i = 0; i < field.size(); ++i)
        for (unsigned int d = 0; d < 2; ++d)
          field[i][d] = x[2 * i + d];
      return field;
    }

    /// Of free nodes, 0 at grips.
    void put(const Field &field, const BondNetwork &network, dealii::Vector<double> &x)
    {
      for (std::size_t i = 0; i < field.size(); ++i)
        for (unsigned int d = 0; d < 2; ++d)
          x[2 * i + d] = network.grip[i] < 0 ? field[i][d] : 0;
    }

    /// A linear map of fields, as a solver of deal.II wants it.
    struct Map
    {
      const BondNetwork &network;
      std::function<Field(const Field &)> action;

      void vmult(dealii::Vector<double> &result, const dealii::Vector<double> &input) const
      {
        put(action(to_field(input)), network, result);
      }
    };

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
    const Field normal = correct(missing);
    const double V = network.h * network.h,
                 excess = network.dilatation.empty() ? 0 : network.dilatation.front() / V; // λ - μ
    for (const NetworkBond &bond : missing)
    {
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
  std::vector<Tensor<1, 2>> SurfaceForces::correct(const std::vector<NetworkBond> &missing)
  {
    constexpr double collinear = 1e-10, no_direction = 1e-8;
    const std::size_t n = network_->nodes.size();
    std::vector<Tensor<2, 2>> shape(n);
    Field outward(n);
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

  std::vector<double> SurfaceForces::dilatations(const Field &u) const
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

  std::vector<Tensor<1, 2>> SurfaceForces::forces(const Field &u) const
  {
    const std::vector<double> theta = dilatations(u);
    const bool dilates = !network_->dilatation.empty();
    Field force(u.size());
    for (std::size_t i = 0; i < u.size(); ++i)
      force[i] = theta[i] * pull_[i];
    for (std::size_t b = 0; b < network_->bonds.size(); ++b)
      if (connections_->is_whole(b))
      {
        const NetworkBond &bond = network_->bonds[b];
        Tensor<1, 2> f = bond.stiffness * (bond.way * (u[bond.to] - u[bond.from])) * bond.way;
        if (dilates)
          f += network_->dilatation[bond.from] * bond.share * (theta[bond.from] + theta[bond.to]) *
               bond.xi;
        force[bond.from] += f;
        force[bond.to] -= f;
      }
    return force;
  }

  std::optional<unsigned int> equilibrate(const SurfaceForces &forces, const BondNetwork &network,
                                          const NetworkEquations &equations, Field &u)
  {
    constexpr unsigned int most_iterations = 300, most_vectors = 100;
    constexpr double tolerance = 1e-13; // of what the grips do where nothing else moves
    dealii::Vector<double> of_grips(2 * u.size()), residual(2 * u.size()), change(2 * u.size());
    put(forces.forces(network.held), network, of_grips);
    put(forces.forces(u), network, residual);
    const Map stiffness{network,
                        [&](const Field &v)
                        {
                          Field f = forces.forces(v);
                          for (Tensor<1, 2> &one : f)
                            one = -one;
                          equations.add_holds(v, f);
                          return f;
                        }},
        flexibility{network, [&](const Field &f) { return equations.displacements(f); }};
    dealii::SolverControl control(most_iterations, tolerance * of_grips.l2_norm(), false, false);
    dealii::SolverGMRES<dealii::Vector<double>> solver(
        control, dealii::SolverGMRES<dealii::Vector<double>>::AdditionalData(most_vectors, true));
    try
    {
      solver.solve(stiffness, change, residual, flexibility);
    }
    catch (const dealii::SolverControl::NoConvergence &)
    {
      return {};
    }
    const Field step = to_field(change);
    for (std::size_t i = 0; i < u.size(); ++i)
      u[i] += step[i];
    return control.last_step();
  }
} // namespace plumbline::meshfree
