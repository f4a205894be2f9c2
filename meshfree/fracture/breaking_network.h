#pragma once

#include "meshfree/fracture/surface_forces.h"
#include "method/breakable_body.h"
#include "problem/fracture.h"

#include <memory>

namespace plumbline::meshfree
{
  /// When the equations of a network are made anew.
  enum class Refactor
  {
    when_cheaper, ///< once an event would cost more than the mean of those since they were made,
                  ///< that included, by the estimates of NetworkEquations<dim>
    always        ///< at every event, to compare with
  };

  /// A bond network in equilibrium while its bonds break. What hangs loose (see Connections<dim>)
  /// carries no force and no dead load. With surface terms (see SurfaceForces) its energies are
  /// those of the bonds and dilatations that it has, but its forces have no energy. Instantiated
  /// for dim = 2 and 3.
  template <int dim>
  class BreakingNetwork : public method::QuasistaticFractureModel
  {
  public:
    /// @param solver  automatic is factor: what fits is not known here
    /// @throws InputError  no path of bonds joins the grips from the beginning
    /// @throws NumericalError  the body is a mechanism
    BreakingNetwork(BondNetwork<dim> network, problem::Stretch stretch,
                    problem::GrowthSolver solver = problem::GrowthSolver::factor,
                    Refactor refactor = Refactor::when_cheaper);

    BreakingNetwork(const BreakingNetwork &) = delete; // its equations point to its network
    BreakingNetwork &operator=(const BreakingNetwork &) = delete;

    std::size_t n_bonds() const override { return network_.bonds.size(); }
    const Response &response() const override { return response_; }
    Release break_bonds(const std::vector<std::size_t> &bonds) override;
    void restart(const std::vector<std::size_t> &broken) override;
    bool is_separated() const override;
    /// A ratio of sums of the loads' magnitudes.
    std::optional<double> load_left() const override;
    bool has_energy() const override { return !network_.surfaces; }
    const Work &work() const override { return work_; }

    const BondNetwork<dim> &network() const { return network_; }
    std::size_t n_unknowns() const override { return equations_->n_unknowns(); }
    /// u of all nodes at load 1.
    const NodeField<dim> &displacements() const { return u_; }

  private:
    void factor();
    bool update(const std::vector<std::size_t> &bonds);
    bool equilibrate();
    void evaluate();
    double residual() const;
    std::size_t n_loaded() const; ///< nodes with a dead load that are not loose
    double critical_load(const typename BondNetwork<dim>::Bond &bond) const;
    Release release(const std::vector<std::size_t> &bonds) const;

    BondNetwork<dim> network_;
    bool is_pulled_by_loads_ = false; ///< alone, no grip moves
    problem::Stretch stretch_;
    problem::GrowthSolver solver_;
    Refactor refactor_;
    std::vector<std::size_t> broken_;
    std::unique_ptr<Connections<dim>> connections_;
    std::unique_ptr<NetworkEquations<dim>> equations_;
    std::optional<SurfaceForces> surfaces_; ///< of dim = 2 alone
    double seconds_ = 0;                    ///< estimated, since they were made
    std::size_t n_events_ = 0;
    unsigned int n_iterations_ = 0; ///< of the last solution

    NodeField<dim> u_;
    std::vector<double> pull_;  ///< way·Δu of each bond
    std::vector<double> theta_; ///< of each node, or empty
    double force_scale_ = 0;    ///< largest force of a bond when all were whole
    Response response_;
    Work work_;
  };

  /// Data of a network's nodes and bonds, without a quasi-static body.
  template <int dim>
  method::BreakableBody<dim> nodes_and_bonds(std::shared_ptr<const BondNetwork<dim>> network,
                                             const dealii::Point<2> &notch_tip);

  /// The same with what is known of its nodes and bonds.
  template <int dim>
  method::BreakableBody<dim> breakable_body(std::shared_ptr<BreakingNetwork<dim>> body,
                                            const dealii::Point<2> &notch_tip);
} // namespace plumbline::meshfree
