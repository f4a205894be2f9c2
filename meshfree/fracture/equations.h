#pragma once

#include "meshfree/fracture/connections.h"

#include <memory>
#include <optional>

namespace plumbline::meshfree
{
  /// Displacements of, or forces on, all nodes; shape (n_nodes).
  template <int dim>
  using NodeField = std::vector<Tensor<1, dim>>;

  /// Equilibrium of a network at load 1, without surface terms: made once, and kept up to date
  /// while bonds break.
  template <int dim>
  class NetworkEquations
  {
  public:
    virtual ~NetworkEquations() = default;

    /// Take bonds out.
    /// @param connections  without them, the same each time
    virtual void take_out(const std::vector<std::size_t> &bonds,
                          const Connections<dim> &connections) = 0;

    struct Solution
    {
      NodeField<dim> u;
      unsigned int n_iterations = 0;
    };
    /// @param start  as near to it as is known
    /// @return       empty: they have become singular, or it takes too many iterations
    virtual std::optional<Solution> solve(const NodeField<dim> &start) const = 0;

    /// Their inverse, or what is near to it: the same linear, symmetric map while nothing is taken
    /// out.
    /// @param forces  on free nodes
    /// @return        displacements where grips stay; empty: the equations have become singular
    virtual std::optional<NodeField<dim>> displacements(const NodeField<dim> &forces) const = 0;

    /// Forces of what holds mechanisms, which the equations have beside those of the network.
    virtual void add_holds(const NodeField<dim> &u, NodeField<dim> &forces) const = 0;

    virtual std::size_t rank() const = 0; ///< of what was changed since they were made
    virtual std::size_t n_unknowns() const = 0;

    // CPU seconds, estimated: the same wherever it runs, so that what is decided by them is.
    virtual double making_seconds() const = 0;
    /// @param n_bonds       that would be taken out
    /// @param n_iterations  of the solution before
    virtual double update_seconds(std::size_t n_bonds, unsigned int n_iterations) const = 0;
  };

  /// By a factorisation (CHOLMOD), and Woodbury's formula for what breaks later.
  /// @param connections  mechanisms that are found are constrained
  /// @throws NumericalError  most of the body is a mechanism
  /// Instantiated for dim = 2 and 3.
  template <int dim>
  std::unique_ptr<NetworkEquations<dim>> factored_equations(const BondNetwork<dim> &network,
                                                            Connections<dim> &connections);

  /// By conjugate gradients, preconditioned with ML's smoothed aggregation of what was whole when
  /// they were made: several times slower, but of the memory of the matrix alone, for bodies whose
  /// factor does not fit. Mechanisms that Connections<dim> does not see are neither found nor held:
  /// where they are is arbitrary, which linear stretches without surface terms do not notice.
  /// Source: Vaněk, Mandel & Brezina 1996, doi:10.1007/BF02238511. Instantiated for
  /// dim = 2 and 3.
  template <int dim>
  std::unique_ptr<NetworkEquations<dim>> multigrid_equations(const BondNetwork<dim> &network,
                                                             const Connections<dim> &connections);
} // namespace plumbline::meshfree
