#include "algebra/updated_cholesky.h"
#include "base/error.h"
#include "meshfree/fracture/network_terms.h"

#include <cmath>
#include <limits>

namespace plumbline::meshfree
{
  namespace
  {
    constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
    constexpr double parallel = 1e-12; ///< sine of an angle below which directions are the same

    /// Factored when made, and changed by Woodbury's formula for bonds that break later, a row for
    /// each; with dilatations also one for each node that lost one.
    template <int dim>
    class FactoredEquations : public NetworkEquations<dim>
    {
    public:
      FactoredEquations(const BondNetwork<dim> &network, Connections<dim> &connections);

      void take_out(const std::vector<std::size_t> &bonds,
                    const Connections<dim> &connections) override;
      std::optional<typename NetworkEquations<dim>::Solution>
      solve(const NodeField<dim> &start) const override;
      std::optional<NodeField<dim>> displacements(const NodeField<dim> &forces) const override;
      void add_holds(const NodeField<dim> &u, NodeField<dim> &forces) const override;
      std::size_t rank() const override { return cholesky_->rank(); }
      std::size_t n_unknowns() const override { return terms_.n_unknowns(); }
      double making_seconds() const override { return cholesky_->factor_seconds(); }
      double update_seconds(std::size_t n_bonds, unsigned int n_iterations) const override;

    private:
      void factor(Connections<dim> &connections);

      /// What bonds that were taken out change, as S of UpdatedCholesky.
      struct Taken
      {
        std::size_t bond = 0, row = 0; ///< row of way·Δu
        std::size_t dilating = 0;      ///< row of scale ξ·Δu
        double scale = 1;
      };
      std::vector<double> change() const;

      const BondNetwork<dim> *network_;
      NetworkTerms<dim> terms_;
      Connections<dim> then_; ///< when it was factored
      std::optional<algebra::UpdatedCholesky> cholesky_;
      std::vector<double> x0_, offsets_;
      std::vector<Taken> taken_;
      std::vector<std::size_t> node_rows_; ///< row of each node's dilatation, or none
      std::vector<std::size_t> hold_rows_;
      std::vector<typename Connections<dim>::Hold> holds_; ///< of the connections, seen so far
    };

    template <int dim>
    FactoredEquations<dim>::FactoredEquations(const BondNetwork<dim> &network,
                                              Connections<dim> &connections)
        : network_(&network), terms_(network), then_(connections),
          node_rows_(network.dilatation.size(), none)
    {
      factor(connections);
      holds_ = connections.holds();
    }

    template <int dim>
    void FactoredEquations<dim>::factor(Connections<dim> &connections)
    {
      constexpr int most_mechanisms = 100; // more are no exception but the body's state
      for (int i = 0; i < most_mechanisms; ++i)
      {
        const typename NetworkTerms<dim>::Terms all = terms_.all(connections);
        cholesky_ = algebra::UpdatedCholesky::factor(all.rows, all.factors, n_unknowns());
        if (cholesky_)
        {
          std::vector<double> b = network_->loads.empty() ? std::vector<double>(n_unknowns())
                                                          : terms_.free(connections.loads());
          for (std::size_t t = 0; t < all.factors.size(); ++t)
            for (std::size_t k = all.rows.start[t]; k < all.rows.start[t + 1]; ++k)
              b[all.rows.column[k]] -= all.factors[t] * all.offsets[t] * all.rows.value[k];
          x0_ = cholesky_->solve(b);
          return;
        }
        const auto mode = algebra::zero_mode(all.rows, all.factors, n_unknowns());
        if (!mode)
          break;
        connections.hold(terms_.expand(*mode));
      }
      throw NumericalError("the body is a mechanism, its bonds are too few to hold it together; "
                           "choose a larger horizon (Study/m), or stop before (Fracture/max "
                           "load, min reaction)");
    }

    template <int dim>
    void FactoredEquations<dim>::take_out(const std::vector<std::size_t> &bonds,
                                          const Connections<dim> &connections)
    {
      algebra::CsrMatrix rows;
      const auto add_row = [&](Form form)
      {
        offsets_.push_back(form.offset);
        append(rows, std::move(form));
        return offsets_.size() - 1;
      };
      for (const std::size_t b : bonds)
      {
        const typename BondNetwork<dim>::Bond &bond = network_->bonds[b];
        Form form;
        terms_.add(form, bond, bond.way);
        const std::size_t row = add_row(std::move(form));
        taken_.push_back({b, row, row, bond.xi * bond.way});
        if (network_->dilatation.empty())
          continue;
        if ((bond.xi - (bond.xi * bond.way) * bond.way).norm() > parallel * bond.xi.norm())
        {
          Form dilating;
          terms_.add(dilating, bond, bond.xi);
          taken_.back().dilating = add_row(std::move(dilating));
          taken_.back().scale = 1;
        }
        for (const unsigned int node : {bond.from, bond.to})
          if (node_rows_[node] == none)
            node_rows_[node] = add_row(terms_.dilatation(node, then_));
      }
      while (holds_.size() < connections.holds().size())
      {
        holds_.push_back(connections.holds()[holds_.size()]);
        hold_rows_.push_back(add_row(terms_.position(holds_.back())));
      }
      cholesky_->update(rows, change());
    }

    // of a node θ₀ - Σ s d is squared instead of θ₀, the sum over bonds that were taken out
    template <int dim>
    std::vector<double> FactoredEquations<dim>::change() const
    {
      const std::size_t r = offsets_.size();
      std::vector<double> S(r * r);
      std::vector<std::vector<const Taken *>> of_node(network_->dilatation.size());
      for (const Taken &one : taken_)
      {
        const typename BondNetwork<dim>::Bond &bond = network_->bonds[one.bond];
        S[one.row * r + one.row] -= bond.stiffness;
        if (!of_node.empty())
          for (const unsigned int node : {bond.from, bond.to})
            of_node[node].push_back(&one);
      }
      for (std::size_t node = 0; node < of_node.size(); ++node)
        for (const Taken *one : of_node[node])
        {
          const double tau = network_->dilatation[node],
                       share = network_->bonds[one->bond].share * one->scale;
          const std::size_t at = node_rows_[node];
          S[at * r + one->dilating] -= tau * share;
          S[one->dilating * r + at] -= tau * share;
          for (const Taken *two : of_node[node])
            S[one->dilating * r + two->dilating] +=
                tau * share * network_->bonds[two->bond].share * two->scale;
        }
      for (const std::size_t row : hold_rows_)
        S[row * r + row] += terms_.hold_stiffness();
      return S;
    }

    template <int dim>
    std::optional<typename NetworkEquations<dim>::Solution>
    FactoredEquations<dim>::solve(const NodeField<dim> & /*start*/) const
    {
      const auto x = cholesky_->updated(x0_, offsets_);
      if (!x)
        return {};
      return typename NetworkEquations<dim>::Solution{terms_.displacements(*x), 0};
    }

    template <int dim>
    std::optional<NodeField<dim>>
    FactoredEquations<dim>::displacements(const NodeField<dim> &forces) const
    {
      const auto x = cholesky_->updated(cholesky_->solve(terms_.free(forces)),
                                        std::vector<double>(offsets_.size()));
      if (!x)
        return {};
      return terms_.expand(*x);
    }

    template <int dim>
    void FactoredEquations<dim>::add_holds(const NodeField<dim> &u, NodeField<dim> &forces) const
    {
      for (const typename Connections<dim>::Hold &hold : holds_)
        terms_.add_hold(hold, u, forces);
    }

    template <int dim>
    double FactoredEquations<dim>::update_seconds(std::size_t n_bonds,
                                                  unsigned int n_iterations) const
    {
      // an iteration's solve is needed after a factorisation as well, what rows add to it is not
      const std::size_t r = rank() + n_bonds;
      return static_cast<double>(n_bonds) * cholesky_->append_seconds() +
             cholesky_->update_seconds(r) + (1 + n_iterations) * cholesky_->solution_seconds(r);
    }
  } // namespace

  template <int dim>
  std::unique_ptr<NetworkEquations<dim>> factored_equations(const BondNetwork<dim> &network,
                                                            Connections<dim> &connections)
  {
    return std::make_unique<FactoredEquations<dim>>(network, connections);
  }

  template std::unique_ptr<NetworkEquations<2>> factored_equations(const BondNetwork<2> &,
                                                                   Connections<2> &);
  template std::unique_ptr<NetworkEquations<3>> factored_equations(const BondNetwork<3> &,
                                                                   Connections<3> &);
} // namespace plumbline::meshfree
