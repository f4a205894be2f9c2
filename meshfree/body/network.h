#pragma once

#include "meshfree/body/operator.h"
#include "meshfree/fracture/equations.h"
#include "meshfree/surface/corrections.h"

namespace plumbline::meshfree
{
  /// A bond-based body (l = 4k): stiffnesses are those of the bulk times a surface correction,
  ///   uᵀBu/2 = Σ_bonds k/2 (d·Δu/r)²,  k = 2 (l/m) V_i V_j w ρ λ_ij,  m = h² Σ w ρ r²
  /// over a whole family, where VariationalOperator has the m of each node's own family. l is that
  /// of the first node. With fictitious nodes see SurfaceCorrection fictitious_nodes().
  /// @param influence, bonds  as of VariationalOperator
  /// @throws InputError  with fictitious nodes: not all nodes of one box, or a horizon that reaches
  /// beyond its other side
  /// @throws NumericalError  a node without neighbours
  BondNetwork<2> make_body_network(const VariationalBody &body, const Kernel<2> &influence,
                                   const Bonds<2> &bonds, const SurfaceCorrection &correction);

  /// Its operator. Sparse; solved by a factor (CHOLMOD).
  class NetworkOperator : public BodyOperator
  {
  public:
    /// @throws InputError, NumericalError  as make_body_network
    NetworkOperator(VariationalBody body, const Kernel<2> &influence, const Bonds<2> &bonds,
                    const SurfaceCorrection &correction);

    void vmult(algebra::Vector &result, const algebra::Vector &input) const override;
    std::string backend() const override { return "sparse, factor"; }
    std::uint64_t n_bonds() const override;
    const VariationalBody &body() const override { return body_; }
    algebra::SolveResult solve(algebra::Vector &u, const algebra::Vector &f, double tolerance,
                               unsigned int max_iterations) const override;

    const BondNetwork<2> &network() const { return network_; }

  private:
    NodeField<2> at_free(const algebra::Vector &field) const;
    void put(const NodeField<2> &field, double sign, algebra::Vector &result) const;

    VariationalBody body_;
    std::vector<std::size_t> positions_; ///< of the network's nodes in the body
    BondNetwork<2> network_;
    Connections<2> connections_;
    std::unique_ptr<NetworkEquations<2>> equations_;
  };
} // namespace plumbline::meshfree
