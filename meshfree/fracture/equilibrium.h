#pragma once

#include "meshfree/fracture/equations.h"

#include <functional>

namespace plumbline::meshfree
{
  // Instantiated for dim = 2 and 3.

  /// θ of all nodes by what is whole; empty where there is no dilatation.
  template <int dim>
  std::vector<double> dilatations(const BondNetwork<dim> &network,
                                  const Connections<dim> &connections, const NodeField<dim> &u);

  /// What a whole bond pulls its first node with, k way (way·Δu) + share ξ (τ θ + τ' θ').
  /// @param theta  may be empty where there is no dilatation
  template <int dim>
  Tensor<1, dim> force(const BondNetwork<dim> &network, const typename BondNetwork<dim>::Bond &bond,
                       const NodeField<dim> &u, const std::vector<double> &theta);

  /// Of what is whole, on all nodes, without surface terms; with bonds to fictitious nodes.
  template <int dim>
  NodeField<dim> forces(const BondNetwork<dim> &network, const Connections<dim> &connections,
                        const NodeField<dim> &u, const std::vector<double> &theta);

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
  template <int dim>
  std::optional<unsigned int>
  equilibrate(const std::function<NodeField<dim>(const NodeField<dim> &)> &forces,
              Iteration iteration, const BondNetwork<dim> &network,
              const NetworkEquations<dim> &equations, NodeField<dim> &u);
} // namespace plumbline::meshfree
