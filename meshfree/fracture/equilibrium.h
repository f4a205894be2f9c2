#pragma once

#include "meshfree/fracture/equations.h"

#include <functional>

namespace plumbline::meshfree
{
  /// θ of all nodes by what is whole; empty where there is no dilatation.
  std::vector<double> dilatations(const BondNetwork &network, const Connections &connections,
                                  const NodeField &u);

  /// What a whole bond pulls its first node with, k way (way·Δu) + share ξ (τ θ + τ' θ').
  /// @param theta  may be empty where there is no dilatation
  Tensor<1, 2> force(const BondNetwork &network, const BondNetwork::Bond &bond, const NodeField &u,
                     const std::vector<double> &theta);

  /// Of what is whole, on all nodes, without surface terms.
  NodeField forces(const BondNetwork &network, const Connections &connections, const NodeField &u,
                   const std::vector<double> &theta);

  /// Conjugate gradients are for forces that have an energy.
  enum class Iteration
  {
    conjugate_gradients,
    gmres
  };

  /// Equilibrium on free nodes by iterations from u, preconditioned with equations, to 1e-13 of the
  /// forces of what the grips do where nothing else moves.
  /// @param forces     a linear map of displacements, of all nodes
  /// @param equations  up to date
  /// @return           iterations; empty: too many, or the equations have become singular
  std::optional<unsigned int> equilibrate(const std::function<NodeField(const NodeField &)> &forces,
                                          Iteration iteration, const BondNetwork &network,
                                          const NetworkEquations &equations, NodeField &u);
} // namespace plumbline::meshfree
