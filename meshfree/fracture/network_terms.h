#pragma once

#include "algebra/csr_matrix.h"
#include "meshfree/fracture/equations.h"

namespace plumbline::meshfree
{
  /// A linear form of the unknowns, and its value for the displacements of the grips.
  struct Form
  {
    std::vector<std::pair<unsigned int, double>> entries;
    double offset = 0;
  };
  void append(algebra::CsrMatrix &rows, Form form);

  /// The energy of a network at load 1 as squares of linear forms of its unknowns, dim for
  /// each free node: E = Σ factor/2 (row·x + offset)², a term for each bond, each dilatation and
  /// each direction that is constrained. Instantiated for dim = 2 and 3.
  template <int dim>
  class NetworkTerms
  {
  public:
    explicit NetworkTerms(const BondNetwork<dim> &network);

    void add(Form &form, const typename BondNetwork<dim>::Bond &bond,
             const Tensor<1, dim> &direction) const;
    void add(Form &form, unsigned int node, const Tensor<1, dim> &factor) const; ///< factor·u
    Form dilatation(std::size_t node, const Connections<dim> &connections) const;
    Form position(const typename Connections<dim>::Hold &hold) const;

    struct Terms
    {
      algebra::CsrMatrix rows;
      std::vector<double> factors, offsets;
    };
    Terms all(const Connections<dim> &connections) const; ///< of what is whole

    std::size_t n_unknowns() const { return n_unknowns_; }
    double hold_stiffness() const { return hold_stiffness_; } ///< [force/length^(4 - dim)]
    void add_hold(const typename Connections<dim>::Hold &hold, const NodeField<dim> &u,
                  NodeField<dim> &forces) const;

    std::vector<double> free(const NodeField<dim> &field) const;      ///< the unknowns' part
    NodeField<dim> expand(const std::vector<double> &x) const;        ///< 0 at grips
    NodeField<dim> displacements(const std::vector<double> &x) const; ///< those of the grips there
    std::vector<Point<dim>> free_nodes() const;

  private:
    const BondNetwork<dim> *network_;
    std::vector<int> unknown_; ///< first of each node, -1 at grips
    std::size_t n_unknowns_ = 0;
    double hold_stiffness_ = 0;
  };
} // namespace plumbline::meshfree
