#include "meshfree/fracture/breaking_network.h"

#include "base/cost.h"
#include "base/error.h"
#include "meshfree/fracture/equilibrium.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumbline::meshfree
{
  namespace
  {
    constexpr double endless = std::numeric_limits<double>::infinity();
    /// Of forces on free nodes: more than 1e5 sums of 1e2 forces make.
    constexpr double worst_residual = 1e-10;

    double square(double x)
    {
      return x * x;
    }
  } // namespace

  template <int dim>
  BreakingNetwork<dim>::BreakingNetwork(BondNetwork<dim> network, problem::Stretch stretch,
                                        problem::GrowthSolver solver, Refactor refactor)
      : network_(std::move(network)), stretch_(stretch), solver_(solver), refactor_(refactor)
  {
    const auto is_zero = [](const Tensor<1, dim> &value) { return value.norm_square() == 0; };
    const auto is_all_zero = [&](const std::vector<Tensor<1, dim>> &values)
    { return std::all_of(values.begin(), values.end(), is_zero); };
    is_pulled_by_loads_ = !network_.loads.empty() && is_all_zero(network_.constrained);
    if (!network_.loads.empty() && is_all_zero(network_.loads))
      throw InputError("Problem/load is 0 at all nodes that are free; let it act on a row of nodes "
                       "outside of Domain/fixed, or clear it");
    factor();
    if (is_separated())
      throw InputError(
          "Domain/fixed: no path of bonds joins the grips or the loaded nodes; let the notch "
          "(Domain/cracks) end in the body, or mend Domain/boxes");
  }

  template <int dim>
  void BreakingNetwork<dim>::factor()
  {
    const base::CpuTimer timer;
    connections_ = std::make_unique<Connections<dim>>(network_);
    connections_->break_bonds(broken_);
    equations_ = solver_ == problem::GrowthSolver::multigrid
                     ? multigrid_equations(network_, *connections_)
                     : factored_equations(network_, *connections_);
    seconds_ = equations_->making_seconds();
    n_events_ = 1;
    u_ = network_.constrained;
    if (!equilibrate())
      throw NumericalError("iterations do not find equilibrium; stop before (Fracture/max "
                           "load, min reaction), or write Fracture/solver = factor and "
                           "Fracture/surface terms = uncorrected");
    ++work_.n_factorisations;
    work_.factor_seconds += timer.seconds();
    evaluate();
  }

  template <int dim>
  std::size_t BreakingNetwork<dim>::n_loaded() const
  {
    std::size_t n = 0;
    for (std::size_t i = 0; i < network_.loads.size(); ++i)
      n += network_.loads[i].norm_square() > 0 && !connections_->is_loose(i) ? 1 : 0;
    return n;
  }

  template <int dim>
  bool BreakingNetwork<dim>::is_separated() const
  {
    return connections_->is_separated() || (is_pulled_by_loads_ && n_loaded() == 0);
  }

  template <int dim>
  std::optional<double> BreakingNetwork<dim>::load_left() const
  {
    if (network_.loads.empty())
      return {};
    double all = 0, left = 0;
    for (std::size_t i = 0; i < network_.loads.size(); ++i)
    {
      const double load = network_.loads[i].norm();
      all += load;
      left += connections_->is_loose(i) ? 0 : load;
    }
    return left / all;
  }

  template <int dim>
  void BreakingNetwork<dim>::restart(const std::vector<std::size_t> &broken)
  {
    broken_ = broken;
    std::sort(broken_.begin(), broken_.end());
    factor();
  }

  /// Without factoring; false if that would be cheaper, or is needed.
  template <int dim>
  bool BreakingNetwork<dim>::update(const std::vector<std::size_t> &bonds)
  {
    const double cost = equations_->update_seconds(bonds.size(), n_iterations_);
    if (refactor_ == Refactor::always || cost * static_cast<double>(n_events_) > seconds_)
      return false;
    const base::CpuTimer timer;
    const std::size_t n_before = n_loaded();
    connections_->break_bonds(bonds);
    if (n_loaded() != n_before) // the right-hand side is another
      return false;
    equations_->take_out(bonds, *connections_);
    if (!equilibrate())
      return false;
    seconds_ += cost;
    ++n_events_;
    ++work_.n_updates;
    work_.largest_rank = std::max<std::uint64_t>(work_.largest_rank, equations_->rank());
    evaluate();
    work_.update_seconds += timer.seconds();
    return response_.residual <= worst_residual;
  }

  /// From u; false: the equations have become singular, or it takes too many iterations.
  template <int dim>
  bool BreakingNetwork<dim>::equilibrate()
  {
    std::optional<unsigned int> n;
    if constexpr (dim == 2)
      if (network_.surfaces)
      {
        surfaces_.emplace(network_, *connections_);
        n = meshfree::equilibrate<dim>([this](const NodeField<dim> &u)
                                       { return surfaces_->forces(u); },
                                       Iteration::gmres, network_, *equations_, u_);
      }
    if (!network_.surfaces)
      if (auto solution = equations_->solve(u_))
      {
        u_ = std::move(solution->u);
        n = solution->n_iterations;
      }
    if (!n)
      return false;
    n_iterations_ = *n;
    work_.n_iterations += n_iterations_;
    work_.most_iterations = std::max<std::uint64_t>(work_.most_iterations, n_iterations_);
    return true;
  }

  template <int dim>
  typename BreakingNetwork<dim>::Release
  BreakingNetwork<dim>::break_bonds(const std::vector<std::size_t> &bonds)
  {
    Release result = release(bonds);
    const std::vector<double> pull = pull_;
    const NodeField<dim> u = network_.loads.empty() ? NodeField<dim>() : u_;
    std::vector<double> theta = theta_;
    for (const std::size_t b : bonds) // of what stays whole
      if (!theta.empty())
        for (const unsigned int node : {network_.bonds[b].from, network_.bonds[b].to})
          theta[node] -=
              network_.bonds[b].share *
              (network_.bonds[b].xi * (u_[network_.bonds[b].to] - u_[network_.bonds[b].from]));
    broken_.insert(broken_.end(), bonds.begin(), bonds.end());
    result.is_factored = !update(bonds);
    if (result.is_factored)
      restart(broken_);
    for (std::size_t b = 0; b < network_.bonds.size(); ++b)
      if (connections_->is_whole(b))
        result.relaxing += .5 * network_.bonds[b].stiffness * square(pull_[b] - pull[b]);
    const NodeField<dim> loads = connections_->loads();
    for (std::size_t i = 0; i < loads.size(); ++i)
      result.work += loads[i] * (u_[i] - u[i]);
    for (std::size_t i = 0; i < theta.size(); ++i)
      result.relaxing += .5 * network_.dilatation[i] * square(theta_[i] - theta[i]);
    return result;
  }

  template <int dim>
  typename BreakingNetwork<dim>::Release
  BreakingNetwork<dim>::release(const std::vector<std::size_t> &bonds) const
  {
    Release result;
    std::vector<double> theta = theta_;
    for (const std::size_t b : bonds)
    {
      const typename BondNetwork<dim>::Bond &bond = network_.bonds[b];
      const double own = .5 * bond.stiffness * square(pull_[b]),
                   dilation = bond.share * (bond.xi * (u_[bond.to] - u_[bond.from]));
      result.single.push_back(own);
      result.bonds += own;
      if (theta.empty())
        continue;
      for (const unsigned int node : {bond.from, bond.to})
      {
        const double half_tau = .5 * network_.dilatation[node];
        result.single.back() += half_tau * (square(theta_[node]) - square(theta_[node] - dilation));
        result.bonds += half_tau * (square(theta[node]) - square(theta[node] - dilation));
        theta[node] -= dilation;
      }
    }
    return result;
  }

  template <int dim>
  double BreakingNetwork<dim>::critical_load(const typename BondNetwork<dim>::Bond &bond) const
  {
    const Tensor<1, dim> du = u_[bond.to] - u_[bond.from];
    const double b = bond.xi * du, c = bond.critical * bond.xi.norm_square();
    if (stretch_ == problem::Stretch::linear)
      return b > 0 ? c / b : endless;
    if (connections_->is_loose(bond.from) || connections_->is_loose(bond.to))
      return endless; // where they are says nothing
    // the positive root of q λ² + 2 b λ = s0 (2 + s0) r²
    const double q = du.norm_square(), right = c * (2 + bond.critical),
                 sum = b + std::sqrt(b * b + q * right);
    return sum > 0 ? right / sum : endless;
  }

  template <int dim>
  void BreakingNetwork<dim>::evaluate()
  {
    const std::vector<typename BondNetwork<dim>::Bond> &bonds = network_.bonds;
    theta_ = dilatations(network_, *connections_, u_);
    if constexpr (dim == 2)
      if (surfaces_ && !theta_.empty())
        theta_ = surfaces_->dilatations(u_);
    pull_.assign(bonds.size(), 0);
    response_ = {0, 0, 0, std::vector<double>(bonds.size(), endless)};
    double largest_force = 0;
    for (std::size_t b = 0; b < bonds.size(); ++b)
    {
      if (!connections_->is_whole(b))
        continue;
      const typename BondNetwork<dim>::Bond &bond = bonds[b];
      const Tensor<1, dim> f = force(network_, bond, u_, theta_);
      pull_[b] = bond.way * (u_[bond.to] - u_[bond.from]);
      response_.energy += .5 * bond.stiffness * square(pull_[b]);
      response_.reaction += f * (network_.constrained[bond.to] - network_.constrained[bond.from]);
      largest_force = std::max(largest_force, f.norm_square());
      if (std::isfinite(bond.critical))
        response_.critical_loads[b] = critical_load(bond);
    }
    for (std::size_t i = 0; i < theta_.size(); ++i)
      response_.energy += .5 * network_.dilatation[i] * square(theta_[i]);
    const NodeField<dim> loads = connections_->loads();
    for (std::size_t i = 0; i < loads.size(); ++i)
      response_.reaction += loads[i] * u_[i];
    if constexpr (dim == 2)
      if (surfaces_) // they act on nodes in grips too
      {
        const NodeField<dim> terms = surfaces_->terms(u_);
        for (std::size_t i = 0; i < terms.size(); ++i)
          response_.reaction -= terms[i] * network_.constrained[i];
      }
    if (force_scale_ == 0)
      force_scale_ = std::sqrt(largest_force);
    response_.residual = residual();
  }

  template <int dim>
  double BreakingNetwork<dim>::residual() const
  {
    NodeField<dim> sums;
    if constexpr (dim == 2)
      if (surfaces_)
        sums = surfaces_->forces(u_);
    if (!surfaces_)
      sums = forces(network_, *connections_, u_, theta_);
    const NodeField<dim> loads = connections_->loads();
    for (std::size_t i = 0; i < loads.size(); ++i)
      sums[i] += loads[i];
    double largest = 0;
    for (std::size_t i = 0; i < sums.size(); ++i)
      if (network_.grip[i] < 0)
        largest = std::max(largest, sums[i].norm_square());
    return std::sqrt(largest) / force_scale_;
  }

  template <int dim>
  method::BreakableBody<dim> nodes_and_bonds(std::shared_ptr<const BondNetwork<dim>> network,
                                             const dealii::Point<2> &notch_tip)
  {
    method::BreakableBody<dim> model;
    model.horizon = network->horizon;
    model.h = network->h;
    model.nodes = network->nodes;
    model.cells = network->cells;
    model.cut_energy = network->cut_energy;
    for (const typename BondNetwork<dim>::Bond &bond : network->bonds)
      model.bonds.push_back({bond.from, bond.to});
    model.toughness_of_bonds = network->toughness;
    model.cut = network->cut;
    model.notch_tip = notch_tip;
    model.has_dilatation = !network->dilatation.empty();
    model.damage = [network = std::move(network)](const std::vector<std::size_t> &broken)
    { return network->damage(broken); };
    return model;
  }

  template <int dim>
  method::BreakableBody<dim> breakable_body(std::shared_ptr<BreakingNetwork<dim>> body,
                                            const dealii::Point<2> &notch_tip)
  {
    method::BreakableBody<dim> model =
        nodes_and_bonds<dim>({body, &body->network()}, notch_tip); // lives as long as the body
    model.body = std::move(body);
    return model;
  }

  template class BreakingNetwork<2>;
  template class BreakingNetwork<3>;
  template method::BreakableBody<2> nodes_and_bonds(std::shared_ptr<const BondNetwork<2>>,
                                                    const dealii::Point<2> &);
  template method::BreakableBody<3> nodes_and_bonds(std::shared_ptr<const BondNetwork<3>>,
                                                    const dealii::Point<2> &);
  template method::BreakableBody<2> breakable_body(std::shared_ptr<BreakingNetwork<2>>,
                                                   const dealii::Point<2> &);
  template method::BreakableBody<3> breakable_body(std::shared_ptr<BreakingNetwork<3>>,
                                                   const dealii::Point<2> &);
} // namespace plumbline::meshfree
