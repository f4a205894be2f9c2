#include "meshfree/fracture/network_terms.h"

#include <algorithm>

namespace plumbline::meshfree
{
  NetworkTerms::NetworkTerms(const BondNetwork &network) : network_(&network)
  {
    for (const int grip : network.grip)
    {
      unknown_.push_back(grip < 0 ? static_cast<int>(n_unknowns_) : -1);
      n_unknowns_ += grip < 0 ? 2 : 0;
    }
    for (const BondNetwork::Bond &bond : network.bonds)
      hold_stiffness_ = std::max(hold_stiffness_, bond.stiffness);
  }

  void NetworkTerms::add(Form &form, const BondNetwork::Bond &bond,
                         const Tensor<1, 2> &direction) const
  {
    for (const auto &[node, sign] : {std::pair(bond.to, 1.), std::pair(bond.from, -1.)})
      if (unknown_[node] >= 0)
        for (unsigned int d = 0; d < 2; ++d)
          form.entries.emplace_back(unknown_[node] + d, sign * direction[d]);
      else
        form.offset += sign * (direction * network_->constrained[node]);
  }

  NetworkTerms::Form NetworkTerms::dilatation(std::size_t node,
                                              const Connections &connections) const
  {
    Form form;
    const auto [begin, end] = connections.bonds_of(node);
    for (const unsigned int *b = begin; b != end; ++b)
      if (connections.is_whole(*b))
        add(form, network_->bonds[*b], network_->bonds[*b].share * network_->bonds[*b].xi);
    return form;
  }

  NetworkTerms::Form NetworkTerms::position(const Connections::Hold &hold) const
  {
    const auto first = static_cast<unsigned int>(unknown_[hold.node]);
    return {{{first, hold.direction[0]}, {first + 1, hold.direction[1]}}, 0};
  }

  NetworkTerms::Terms NetworkTerms::all(const Connections &connections) const
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

  void NetworkTerms::add_hold(const Connections::Hold &hold, const NodeField &u,
                              NodeField &forces) const
  {
    forces[hold.node] += hold_stiffness_ * (hold.direction * u[hold.node]) * hold.direction;
  }

  std::vector<double> NetworkTerms::free(const NodeField &field) const
  {
    std::vector<double> x(n_unknowns_);
    for (std::size_t i = 0; i < unknown_.size(); ++i)
      if (unknown_[i] >= 0)
        for (unsigned int d = 0; d < 2; ++d)
          x[static_cast<std::size_t>(unknown_[i]) + d] = field[i][d];
    return x;
  }

  NodeField NetworkTerms::expand(const std::vector<double> &x) const
  {
    NodeField u(unknown_.size());
    for (std::size_t i = 0; i < u.size(); ++i)
      if (unknown_[i] >= 0)
        for (unsigned int d = 0; d < 2; ++d)
          u[i][d] = x[static_cast<std::size_t>(unknown_[i]) + d];
    return u;
  }

  NodeField NetworkTerms::displacements(const std::vector<double> &x) const
  {
    NodeField u = expand(x);
    for (std::size_t i = 0; i < u.size(); ++i)
      u[i] += network_->constrained[i];
    return u;
  }

  std::vector<Point<2>> NetworkTerms::free_nodes() const
  {
    std::vector<Point<2>> nodes;
    for (std::size_t i = 0; i < unknown_.size(); ++i)
      if (unknown_[i] >= 0)
        nodes.push_back(network_->nodes[i]);
    return nodes;
  }

  void append(algebra::CsrMatrix &rows, NetworkTerms::Form form)
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
} // namespace plumbline::meshfree
