#pragma once

#include "algebra/csr_matrix.h"
#include "meshfree/fracture/equations.h"

namespace plumbline::meshfree
{
  /// The energy of a network at load 1 as squares of linear forms of its unknowns, two for each
  /// free node: E = Σ factor/2 (row·x + offset)², a term for each bond, each dilatation and each
  /// direction that is constrained.
  class NetworkTerms
  {
  public:
    explicit NetworkTerms(const BondNetwork &network);

    /// A linear form of the unknowns, and its value of what grips do.
    struct Form
    {
      std::vector<std::pair<unsigned int, double>> entries;
      double offset = 0;
    };
    void add(Form &form, const BondNetwork::Bond &bond, const Tensor<1, 2> &direction) const;
    Form dilatation(std::size_t node, const Connections &connections) const;
    Form position(const Connections::Hold &hold) const;

    struct Terms
    {
      algebra::CsrMatrix rows;
      std::vector<double> factors, offsets;
    };
    Terms all(const Connections &connections) const; ///< of what is whole

    std::size_t n_unknowns() const { return n_unknowns_; }
    double hold_stiffness() const { return hold_stiffness_; } ///< [force/length²]
    void add_hold(const Connections::Hold &hold, const NodeField &u, NodeField &forces) const;

    std::vector<double> free(const NodeField &field) const;      ///< the unknowns' part
    NodeField expand(const std::vector<double> &x) const;        ///< 0 at grips
    NodeField displacements(const std::vector<double> &x) const; ///< what grips do there
    std::vector<Point<2>> free_nodes() const;

  private:
    const BondNetwork *network_;
    std::vector<int> unknown_; ///< first of each node, -1 at grips
    std::size_t n_unknowns_ = 0;
    double hold_stiffness_ = 0;
  };

  void append(algebra::CsrMatrix &rows, NetworkTerms::Form form);
} // namespace plumbline::meshfree
