#pragma once

#include "meshfree/check/probe_plan.h"

#include <functional>

namespace plumbline::meshfree
{
  /// Displacements of all nodes [length], or forces on them, shape (n_nodes).
  template <int dim>
  using NodeVectors = std::vector<dealii::Tensor<1, dim>>;

  /// Another program: the forces on all nodes at given displacements.
  template <int dim>
  using Forces = std::function<NodeVectors<dim>(const NodeVectors<dim> &displacements)>;

  /// A bond's force constant: the force on node i along the bond per length that node j moves.
  struct ProbedBond
  {
    std::size_t i = 0, j = 0; ///< indices of nodes
    double force_constant = 0;
  };

  /// A defect relative to the largest force constant, and the bond where it is found.
  struct ProbeDefect
  {
    double value = 0;
    std::size_t i = 0, j = 0;
  };

  /// What differences of forces tell of the bonds.
  struct ProbeFindings
  {
    /// The whole families of the nodes that were displaced, by i and j, without those below
    /// `negligible`.
    std::vector<ProbedBond> bonds;
    double largest = 0;          ///< of the force constants
    std::size_t n_two_sided = 0; ///< pairs both nodes of which were displaced
    ProbeDefect asymmetry;       ///< |k_ij - k_ji| of these pairs
    ProbeDefect noncentral;      ///< |∂F_i/∂u_j - k_ij ξ⊗ξ/|ξ|²|: 0 for bonds
    double imbalance = 0;        ///< |Σ_i ∂F_i/∂u_j|, over all nodes: 0 where pairs balance
    double nonlinearity = 0;     ///< change of ∂F_i/∂u_j where the step is halved
    std::size_t n_loaded = 0;    ///< nodes with a force where none is displaced
    std::size_t loaded = 0;      ///< the one with the largest

    /// Parts of force constants that count as 0, relative to the largest: forces are often
    /// written with six digits.
    static constexpr double negligible = 1e-6;
  };

  /// Force constants k of the bonds of another program, by central differences of its forces:
  ///   ∂F_i/∂u_j = k_ij ξ⊗ξ/|ξ|², ξ = x_j - x_i.
  /// Where node j of a bond is not displaced, k_ij is that from the other end, k_ji, as of forces
  /// that balance.
  /// Accuracy: relative (step/|ξ|)² where the stretch of a bond is not linear in displacements.
  /// Not for: forces that depend on more than the two nodes of a bond, see `noncentral`.
  /// @throws InputError  no force answers, or one does beyond the horizon
  template <int dim>
  ProbeFindings probe(const ProbePlan<dim> &plan, const Forces<dim> &forces);
} // namespace plumbline::meshfree
