#pragma once

#include "meshfree/fracture/bond_network.h"
#include "method/breaking_motion.h"

#include <memory>

namespace plumbline::meshfree
{
  /// A bond network in the plane in motion, ρ V ü = -∂E/∂u + V b with the energy E of BondNetwork
  /// and the same volume V of all nodes. For λ = μ, without dilatations, a bond that breaks only
  /// lowers E, and with it the largest eigenvalue: the critical step of the intact body holds for
  /// all time.
  /// Source: prototype microelastic brittle bonds, Silling & Askari 2005,
  /// doi:10.1016/j.compstruc.2004.11.026, with linearised stretch ξ·Δu/|ξ|².
  class NetworkMotion : public method::BreakingMotion
  {
  public:
    /// @pre  the network has no surface terms, whose forces derive from no energy
    explicit NetworkMotion(std::shared_ptr<const BondNetwork<2>> network);

    std::size_t size() const override { return 2 * n_free_; }
    void acceleration(const State &u, const std::vector<double> &g, State &a) const override;
    void tangent(const State &u, const std::vector<double> &g, const State &v,
                 State &out) const override;
    double product(const State &u, const State &v) const override;
    double energy(const State &u, const std::vector<double> &g) const override;
    double power(const State &u, const State &v, const std::vector<double> &g,
                 const std::vector<double> &rate) const override;
    unsigned int n_components() const override { return 2; }
    std::vector<double> nodal(const State &u) const override { return u; }

    Breaks break_bonds(const State &u, const std::vector<double> &g) override;
    void restart(const std::vector<std::size_t> &broken) override;
    bool is_free(std::size_t node) const override { return network_->grip[node] < 0; }
    std::vector<double> displacements(const State &u, const std::vector<double> &g) const override;

  private:
    /// The data of a bond that sums over all bonds use.
    struct Link
    {
      unsigned int from = 0, to = 0;
      double xi[2], way[2];
      double stiffness = 0, share = 0;
      double limit = 0; ///< of ξ·Δu; infinite: it never breaks, or it is broken
      std::size_t bond = 0;
    };

    void remove(const std::vector<std::size_t> &bonds);
    std::vector<double> dilatations(const std::vector<double> &all) const;
    double energy(const std::vector<double> &all) const;
    /// -∂E/∂u of all nodes, shape (n_nodes, 2), as `all`.
    void forces(const std::vector<double> &all, std::vector<double> &f) const;
    /// The forces at a state, computed once for consecutive calls with the same state.
    const std::vector<double> &forces(const State &u, const std::vector<double> &g) const;
    std::vector<double> with_grips(const State &u, const std::vector<double> &g) const;

    std::shared_ptr<const BondNetwork<2>> network_;
    std::size_t n_free_ = 0;
    double volume_ = 0;       ///< of a node, per thickness [length^2]
    std::vector<Link> links_; ///< of whole bonds
    mutable State u_;
    mutable std::vector<double> g_, forces_; ///< the last forces, and their state
  };

  method::MovingBody moving_body(BondNetwork<2> network, const dealii::Point<2> &notch_tip);
} // namespace plumbline::meshfree
