#include "meshfree/fracture/network_terms.h"

#include <algorithm>

namespace plumbline::meshfree
{
  template <int dim>
  NetworkTerms<dim>::NetworkTerms(const BondNetwork<dim> &network) : network_(&network)
  {
    for (const int grip : network.grip)
    {
      unknown_.push_back(grip < 0 ? static_cast<int>(n_unknowns_) : -1);
      n_unknowns_ += grip < 0 ? dim : 0;
    }
    for (const typename BondNetwork<dim>::Bond &bond : network.bonds)
      hold_stiffness_ = std::max(hold_stiffness_, bond.stiffness);
  }

  template <int dim>
  void NetworkTerms<dim>::add(Form &form, unsigned int node, const Tensor<1, dim> &factor) const
  {
    if (unknown_[node] >= 0)
      for (unsigned int d = 0; d < dim; ++d)
        form.entries.emplace_back(unknown_[node] + d, factor[d]);
    else
      form.offset += factor * network_->constrained[node];
  }

  template <int dim>
  void NetworkTerms<dim>::add(Form &form, const typename BondNetwork<dim>::Bond &bond,
                              const Tensor<1, dim> &direction) const
  {
    add(form, bond.to, direction);
    add(form, bond.from, -direction);
  }

  template <int dim>
  Form NetworkTerms<dim>::dilatation(std::size_t node, const Connections<dim> &connections) const
  {
    Form form;
    const auto [begin, end] = connections.bonds_of(node);
    for (const unsigned int *b = begin; b != end; ++b)
      if (connections.is_whole(*b))
        add(form, network_->bonds[*b], network_->bonds[*b].share * network_->bonds[*b].xi);
    return form;
  }

  template <int dim>
  Form NetworkTerms<dim>::position(const typename Connections<dim>::Hold &hold) const
  {
    const auto first = static_cast<unsigned int>(unknown_[hold.node]);
    Form form;
    for (unsigned int d = 0; d < dim; ++d)
      form.entries.emplace_back(first + d, hold.direction[d]);
    return form;
  }

  template <int dim>
  typename NetworkTerms<dim>::Terms
  NetworkTerms<dim>::all(const Connections<dim> &connections) const
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
    for (const typename BondNetwork<dim>::Extrapolated &bond : network_->extrapolated)
    {
      Form form;
      for (const auto &[node, factor] : bond.to)
        add(form, node, factor * bond.way);
      add(form, bond.from, -bond.way);
      add_term(bond.stiffness, std::move(form));
    }
    for (std::size_t i = 0; i < network_->dilatation.size(); ++i)
      add_term(network_->dilatation[i], dilatation(i, connections));
    for (const typename Connections<dim>::Hold &hold : connections.holds())
      add_term(hold_stiffness_, position(hold));
    return result;
  }

  template <int dim>
  void NetworkTerms<dim>::add_hold(const typename Connections<dim>::Hold &hold,
                                   const NodeField<dim> &u, NodeField<dim> &forces) const
  {
    forces[hold.node] += hold_stiffness_ * (hold.direction * u[hold.node]) * hold.direction;
  }

  template <int dim>
  std::vector<double> NetworkTerms<dim>::free(const NodeField<dim> &field) const
  {
    std::vector<double> x(n_unknowns_);
    for (std::size_t i = 0; i < unknown_.size(); ++i)
      if (unknown_[i] >= 0)
        for (unsigned int d = 0; d < dim; ++d)
          x[static_cast<std::size_t>(unknown_[i]) + d] = field[i][d];
    return x;
  }

  template <int dim>
  NodeField<dim> NetworkTerms<dim>::expand(const std::vector<double> &x) const
  {
    NodeField<dim> u(unknown_.size());
    for (std::size_t i = 0; i < u.size(); ++i)
      if (unknown_[i] >= 0)
        for (unsigned int d = 0; d < dim; ++d)
          u[i][d] = x[static_cast<std::size_t>(unknown_[i]) + d];
    return u;
  }

  template <int dim>
  NodeField<dim> NetworkTerms<dim>::displacements(const std::vector<double> &x) const
  {
    NodeField<dim> u = expand(x);
    for (std::size_t i = 0; i < u.size(); ++i)
      u[i] += network_->constrained[i];
    return u;
  }

  template <int dim>
  std::vector<Point<dim>> NetworkTerms<dim>::free_nodes() const
  {
    std::vector<Point<dim>> nodes;
    for (std::size_t i = 0; i < unknown_.size(); ++i)
      if (unknown_[i] >= 0)
        nodes.push_back(network_->nodes[i]);
    return nodes;
  }

  template class NetworkTerms<2>;
  template class NetworkTerms<3>;

  void append(algebra::CsrMatrix &rows, Form form)
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
