#pragma once

#include "base/communicator.h"
#include "method/equation_of_motion.h"

#include <vector>

namespace plumbline::method
{
  /// Of an equation of motion that ranks share: states, g, nodes and nodal values are this rank's
  /// part, and all functions of the equation are collective. Products, energies and power are those
  /// of all ranks.
  class DistributedMotion
  {
  public:
    virtual ~DistributedMotion() = default;
    virtual const base::Communicator &ranks() const = 0;

    /// The number of an entry of this rank's states among those of one rank alone.
    virtual std::size_t number(std::size_t i) const = 0;

    /// Values at the nodes of all ranks, in the order of one rank alone, on the first rank; nothing
    /// on others.
    /// @param of_nodes  at this rank's nodes, shape (n_nodes, n_per_node)
    virtual std::vector<double> gather(const std::vector<double> &of_nodes,
                                       unsigned int n_per_node) const = 0;
  };

  /// Null: each rank has all.
  inline const DistributedMotion *distributed(const SemiDiscreteMotion &equation)
  {
    return dynamic_cast<const DistributedMotion *>(&equation);
  }

  /// That have a part of the states each.
  inline base::Communicator ranks_of(const SemiDiscreteMotion &equation)
  {
    const DistributedMotion *const shared = distributed(equation);
    return shared != nullptr ? shared->ranks() : base::Communicator::alone();
  }
} // namespace plumbline::method
