#include "meshfree/fracture/equations.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumbline::meshfree
{
  namespace
  {
    constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
    constexpr double parallel = 1e-12; ///< sine of an angle below which directions are the same

    double largest_stiffness(const BondNetwork &network)
    {
      double largest = 0;
      for (const BondNetwork::Bond &bond : network.bonds)
        largest = std::max(largest, bond.stiffness);
      return largest;
    }
  } // namespace

  NetworkEquations::NetworkEquations(const BondNetwork &network, Connections &connections)
      : network_(&network), hold_stiffness_(largest_stiffness(network)), then_(connections),
        node_rows_(network.dilatation.size(), none)
  {
    for (const int grip : network.grip)
    {
      unknown_.push_back(grip < 0 ? static_cast<int>(n_unknowns_) : -1);
      n_unknowns_ += grip < 0 ? 2 : 0;
    }
    factor(connections);
    holds_ = connections.holds();
  }

  void NetworkEquations::factor(Connections &connections)
  {
    constexpr int most_mechanisms = 100; // more are no exception but the body's state
    for (int i = 0; i < most_mechanisms; ++i)
    {
      const Terms all = terms(connections);
      cholesky_ = algebra::UpdatedCholesky::factor(all.rows, all.factors, n_unknowns_);
      if (cholesky_)
      {
        std::vector<double> b(n_unknowns_);
        for (std::size_t t = 0; t < all.factors.size(); ++t)
          for (std::size_t k = all.rows.start[t]; k < all.rows.start[t + 1]; ++k)
            b[all.rows.column[k]] -= all.factors[t] * all.offsets[t] * all.rows.value[k];
        x0_ = cholesky_->solve(b);
        return;
      }
      const auto mode = algebra::zero_mode(all.rows, all.factors, n_unknowns_);
      if (!mode)
        break;
      connections.hold(expand(*mode));
    }
    throw NumericalError("the body is a mechanism, its bonds are too few to hold it together; "
                         "choose a larger horizon (Study/m), or stop before (Fracture/largest "
                         "load, least reaction)");
  }

  void NetworkEquations::add(Form &form, const Bond &bond, const Tensor<1, 2> &direction) const
  {
    for (const auto &[node, sign] : {std::pair(bond.to, 1.), std::pair(bond.from, -1.)})
      if (unknown_[node] >= 0)
        for (unsigned int d = 0; d < 2; ++d)
          form.entries.emplace_back(unknown_[node] + d, sign * direction[d]);
      else
        form.offset += sign * (direction * network_->held[node]);
  }

  NetworkEquations::Form NetworkEquations::dilatation(std::size_t node,
                                                      const Connections &connections) const
  {
    Form form;
    const auto [begin, end] = connections.bonds_of(node);
    for (const unsigned int *b = begin; b != end; ++b)
      if (connections.is_whole(*b))
        add(form, network_->bonds[*b], network_->bonds[*b].share * network_->bonds[*b].xi);
    return form;
  }

  NetworkEquations::Form NetworkEquations::position(const Connections::Hold &hold) const
  {
    const auto first = static_cast<unsigned int>(unknown_[hold.node]);
    return {{{first, hold.direction[0]}, {first + 1, hold.direction[1]}}, 0};
  }

  void NetworkEquations::append(algebra::Rows &rows, Form form)
  {
    std::sort(form.entries.begin(), form.entries.end());
    if (rows.start.empty())
      rows.start.push_back(0);
    for (const auto &[column, value] : form.entries)
      if (rows.column.size() > rows.start.back() && rows.column.back() == column)
        rows.value.back() += value;
      else
      {
        rows.column.push_back(column);
        rows.value.push_back(value);
      }
    rows.start.push_back(rows.column.size());
  }

  NetworkEquations::Terms NetworkEquations::terms(const Connections &connections) const
  {
    Terms result;
    const auto add_term = [&](double factor, Form form)
    {
      result.factors.push_back(factor);
      result.offsets.push_back(form.offset);
      append(result.rows, std::move(form));
    };
    for (std::size_t b = 0; b < network_->bonds.size(); ++b)
      if (connections.is_whole(b))
      {
        Form form;
        add(form, network_->bonds[b], network_->bonds[b].way);
        add_term(network_->bonds[b].stiffness, std::move(form));
      }
    for (std::size_t i = 0; i < network_->dilatation.size(); ++i)
      add_term(network_->dilatation[i], dilatation(i, connections));
    for (const Connections::Hold &hold : connections.holds())
      add_term(hold_stiffness_, position(hold));
    return result;
  }

  void NetworkEquations::take_out(const std::vector<std::size_t> &bonds,
                                  const Connections &connections)
  {
    algebra::Rows rows;
    const auto add_row = [&](Form form)
    {
      offsets_.push_back(form.offset);
      append(rows, std::move(form));
      return offsets_.size() - 1;
    };
    for (const std::size_t b : bonds)
    {
      const Bond &bond = network_->bonds[b];
      Form form;
      add(form, bond, bond.way);
      const std::size_t row = add_row(std::move(form));
      taken_.push_back({b, row, row, bond.xi * bond.way});
      if (network_->dilatation.empty())
        continue;
      if ((bond.xi - (bond.xi * bond.way) * bond.way).norm() > parallel * bond.xi.norm())
      {
        Form dilating;
        add(dilating, bond, bond.xi);
        taken_.back().dilating = add_row(std::move(dilating));
        taken_.back().scale = 1;
      }
      for (const unsigned int node : {bond.from, bond.to})
        if (node_rows_[node] == none)
          node_rows_[node] = add_row(dilatation(node, then_));
    }
    while (holds_.size() < connections.holds().size())
    {
      holds_.push_back(connections.holds()[holds_.size()]);
      hold_rows_.push_back(add_row(position(holds_.back())));
    }
    cholesky_->append(rows);
  }

  // of a node θ₀ - Σ s d is squared instead of θ₀, the sum over bonds that were taken out
  std::vector<double> NetworkEquations::change() const
  {
    const std::size_t r = rank();
    std::vector<double> S(r * r);
    std::vector<std::vector<const Taken *>> of_node(network_->dilatation.size());
    for (const Taken &one : taken_)
    {
      const Bond &bond = network_->bonds[one.bond];
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
      S[row * r + row] += hold_stiffness_;
    return S;
  }

  std::vector<Tensor<1, 2>> NetworkEquations::expand(const std::vector<double> &x) const
  {
    std::vector<Tensor<1, 2>> u(unknown_.size());
    for (std::size_t i = 0; i < u.size(); ++i)
      if (unknown_[i] >= 0)
        for (unsigned int d = 0; d < 2; ++d)
          u[i][d] = x[static_cast<std::size_t>(unknown_[i]) + d];
    return u;
  }

  std::optional<std::vector<Tensor<1, 2>>> NetworkEquations::solve() const
  {
    const auto x = cholesky_->updated(x0_, change(), offsets_);
    if (!x)
      return {};
    std::vector<Tensor<1, 2>> u = expand(*x);
    for (std::size_t i = 0; i < u.size(); ++i)
      u[i] += network_->held[i];
    return u;
  }

  std::vector<Tensor<1, 2>>
  NetworkEquations::displacements(const std::vector<Tensor<1, 2>> &forces) const
  {
    std::vector<double> b(n_unknowns_);
    for (std::size_t i = 0; i < unknown_.size(); ++i)
      if (unknown_[i] >= 0)
        for (unsigned int d = 0; d < 2; ++d)
          b[static_cast<std::size_t>(unknown_[i]) + d] = forces[i][d];
    return expand(
        *cholesky_->updated(cholesky_->solve(b), change(), std::vector<double>(offsets_.size())));
  }

  void NetworkEquations::add_holds(const std::vector<Tensor<1, 2>> &u,
                                   std::vector<Tensor<1, 2>> &forces) const
  {
    for (const Connections::Hold &hold : holds_)
      forces[hold.node] += hold_stiffness_ * (hold.direction * u[hold.node]) * hold.direction;
  }

  double NetworkEquations::update_seconds(std::size_t n_rows) const
  {
    return static_cast<double>(n_rows) * cholesky_->append_seconds() +
           cholesky_->update_seconds(rank() + n_rows);
  }
} // namespace plumbline::meshfree
