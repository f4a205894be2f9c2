#pragma once

#include "meshfree/fracture/bond_network.h"

#include <map>
#include <vector>

namespace plumbline::meshfree
{
  /// Which bonds of a network are whole, and what hangs loose in it: free nodes without bonds or
  /// with bonds on one line, in space in one plane, and pieces that no grip holds. Equilibrium says
  /// nothing of where they are; held in these directions they stay somewhere, which costs no force.
  /// Other mechanisms, such as pieces on a hinge, are not seen here: they leave the equations
  /// singular, and are constrained when that is found.
  /// Instantiated for dim = 2 and 3.
  template <int dim>
  class Connections
  {
  public:
    explicit Connections(const BondNetwork<dim> &network);

    void break_bonds(const std::vector<std::size_t> &bonds);

    bool is_whole(std::size_t bond) const { return is_whole_[bond] != 0; }
    /// Bonds at a node, broken ones too.
    std::pair<const unsigned int *, const unsigned int *> bonds_of(std::size_t node) const
    {
      return {incident_.data() + first_[node], incident_.data() + first_[node + 1]};
    }

    /// A direction, of length 1, in which nothing holds a free node.
    struct Hold
    {
      std::size_t node = 0;
      Tensor<1, dim> direction;
    };
    const std::vector<Hold> &holds() const { return holds_; } ///< as they came about
    bool is_loose(std::size_t node) const { return is_loose_[node] != 0; }

    /// Dead loads of the nodes that are not loose: those of loose ones are taken off.
    std::vector<Tensor<1, dim>> loads() const;

    /// Hold a mechanism where it moves most.
    /// @param mode  displacements that strain no bond, shape (n_nodes)
    void hold(const std::vector<Tensor<1, dim>> &mode);

    /// No path of whole bonds joins all grips.
    bool is_separated() const { return is_separated_; }

  private:
    bool carries(std::size_t bond) const { return is_whole_[bond] != 0 && is_idle_[bond] == 0; }
    void look_at(std::vector<std::size_t> nodes);
    void find_pieces();
    void hold(std::size_t node, std::vector<Tensor<1, dim>> directions);

    const BondNetwork<dim> *network_;
    std::vector<std::size_t> first_; ///< of each node in incident_, shape (n_nodes + 1)
    std::vector<unsigned int> incident_;
    std::vector<char> is_whole_;
    std::vector<char> is_idle_; ///< the bond carries no force: it is one of the last of a node, too
                                ///< few to hold it, or in a piece that hangs loose
    std::map<unsigned int, std::size_t>
        placed_; ///< the node that an idle bond is one of the last of
    std::vector<Hold> holds_;
    std::map<std::size_t, std::vector<Tensor<1, dim>>> held_; ///< directions of nodes, but of modes
    std::vector<char> is_loose_;
    bool is_separated_ = false;
  };
} // namespace plumbline::meshfree
