#pragma once

#include "algebra/updated_cholesky.h"
#include "meshfree/fracture/connections.h"

namespace plumbline::meshfree
{
  /// Equilibrium of a network at load 1: factored when made, and changed by Woodbury's formula for
  /// bonds that break later, a row for each; with dilatations also one for each node that lost one.
  class NetworkEquations
  {
  public:
    /// @param connections  mechanisms that are found are held
    /// @throws NumericalError  most of the body is a mechanism
    NetworkEquations(const BondNetwork &network, Connections &connections);

    /// Take bonds out.
    /// @param connections  without them
    void take_out(const std::vector<std::size_t> &bonds, const Connections &connections);

    /// u of all nodes; empty: the equations have become singular.
    std::optional<std::vector<Tensor<1, 2>>> solve() const;

    /// What forces on free nodes do where grips stay; 0 at grips, shape (n_nodes).
    /// @pre solve() found them regular
    std::vector<Tensor<1, 2>> displacements(const std::vector<Tensor<1, 2>> &forces) const;

    /// Forces of what holds mechanisms, which the equations have beside those of the network.
    void add_holds(const std::vector<Tensor<1, 2>> &u, std::vector<Tensor<1, 2>> &forces) const;

    std::size_t rank() const { return cholesky_->rank(); } ///< rows since it was factored
    std::size_t n_unknowns() const { return n_unknowns_; }
    double factor_seconds() const { return cholesky_->factor_seconds(); }
    double update_seconds(std::size_t n_rows) const; ///< of so many rows more, and a solution

  private:
    using Bond = BondNetwork::Bond;

    /// A linear form of the unknowns, and its value of what grips do.
    struct Form
    {
      std::vector<std::pair<unsigned int, double>> entries;
      double offset = 0;
    };
    struct Terms
    {
      algebra::Rows rows;
      std::vector<double> factors, offsets;
    };
    void factor(Connections &connections);
    void add(Form &form, const Bond &bond, const Tensor<1, 2> &direction) const;
    Form dilatation(std::size_t node, const Connections &connections) const;
    Form position(const Connections::Hold &hold) const;
    Terms terms(const Connections &connections) const;
    static void append(algebra::Rows &rows, Form form);

    /// What bonds that were taken out change, as S of UpdatedCholesky.
    struct Taken
    {
      std::size_t bond = 0, row = 0; ///< row of way·Δu
      std::size_t dilating = 0;      ///< row of scale ξ·Δu
      double scale = 1;
    };
    std::vector<double> change() const;
    std::vector<Tensor<1, 2>> expand(const std::vector<double> &x) const; ///< 0 at grips

    const BondNetwork *network_;
    std::vector<int> unknown_; ///< first of each node, -1 at grips
    std::size_t n_unknowns_ = 0;
    double hold_stiffness_ = 0; ///< [force/length^2]
    Connections then_;          ///< when it was factored
    std::optional<algebra::UpdatedCholesky> cholesky_;
    std::vector<double> x0_, offsets_;
    std::vector<Taken> taken_;
    std::vector<std::size_t> node_rows_; ///< row of each node's dilatation, or none
    std::vector<std::size_t> hold_rows_;
    std::vector<Connections::Hold> holds_; ///< of the connections, seen so far
  };
} // namespace plumbline::meshfree
