#pragma once

#include "method/equation_of_motion.h"

namespace plumbline::method
{
  /// A motion whose states are the values of a vector field at its nodes, shape (dim, n_nodes).
  /// @tparam Base  EquationOfMotion or ContinuousMotion
  template <class Base = EquationOfMotion, unsigned int dim = 2>
  class NodalMotion : public Base
  {
  public:
    using State = EquationOfMotion::State;

    std::size_t size() const override { return dim * nodes_.size(); }
    unsigned int n_components() const override { return dim; }
    const std::vector<dealii::Point<2>> &nodes() const override { return nodes_; }

    State state(const problem::Field<2> &field) const override
    {
      State u;
      for (unsigned int c = 0; c < dim; ++c)
        for (const auto &node : nodes_)
          u.push_back(field(node, c));
      return u;
    }

    std::vector<double> nodal(const State &u) const override
    {
      std::vector<double> values;
      for (std::size_t k = 0; k < nodes_.size(); ++k)
        for (unsigned int c = 0; c < dim; ++c)
          values.push_back(u[c * nodes_.size() + k]);
      return values;
    }

  protected:
    std::vector<dealii::Point<2>> nodes_; ///< that are free
  };
} // namespace plumbline::method
