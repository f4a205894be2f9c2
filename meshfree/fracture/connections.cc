#include "meshfree/fracture/connections.h"

#include <algorithm>
#include <numeric>

namespace plumbline::meshfree
{
  namespace
  {
    /// A bond is in the line or plane of others where the square of the sine between them is below
    /// this: within an angle of 1e-5.
    constexpr double within = 1e-10;

    template <int dim>
    using Directions = std::vector<Tensor<1, dim>>; // orthonormal

    /// The part of a vector orthogonal to all directions.
    template <int dim>
    Tensor<1, dim> across(const Directions<dim> &directions, Tensor<1, dim> vector)
    {
      for (const Tensor<1, dim> &one : directions)
        vector -= (one * vector) * one;
      return vector;
    }

    /// Append a unit vector orthogonal to the given ones.
    void add_another(Directions<2> &directions)
    {
      Tensor<1, 2> next;
      next[0] = directions.empty() ? 1 : -directions[0][1];
      next[1] = directions.empty() ? 0 : directions[0][0];
      directions.push_back(next);
    }
    void add_another(Directions<3> &directions)
    {
      Tensor<1, 3> next;
      if (directions.size() == 2)
        next = dealii::cross_product_3d(directions[0], directions[1]);
      else
        for (unsigned int d = 0; d < 3; ++d) // the axis that is most across
        {
          Tensor<1, 3> axis;
          axis[d] = 1;
          const Tensor<1, 3> part = across(directions, axis);
          if (part.norm_square() > (1 + within) * next.norm_square())
            next = part;
        }
      directions.push_back(next / next.norm());
    }

    /// An orthonormal basis of the span of unit vectors; it begins with the last of them.
    template <int dim>
    Directions<dim> span(const std::vector<Tensor<1, dim>> &vectors)
    {
      Directions<dim> directions;
      if (!vectors.empty())
        directions.push_back(vectors.back());
      while (!directions.empty() && directions.size() < dim)
      {
        Tensor<1, dim> next;
        for (const Tensor<1, dim> &one : vectors)
          if (const Tensor<1, dim> part = across(directions, one);
              part.norm_square() > next.norm_square())
            next = part;
        if (next.norm_square() <= within)
          break;
        directions.push_back(next / next.norm());
      }
      return directions;
    }

    /// Things joined in sets, by the smallest of each.
    class Sets
    {
    public:
      explicit Sets(std::size_t n) : parent_(n)
      {
        std::iota(parent_.begin(), parent_.end(), std::size_t{0});
      }
      std::size_t find(std::size_t i)
      {
        while (parent_[i] != i)
          i = parent_[i] = parent_[parent_[i]];
        return i;
      }
      void join(std::size_t i, std::size_t j)
      {
        i = find(i);
        j = find(j);
        parent_[std::max(i, j)] = std::min(i, j);
      }

    private:
      std::vector<std::size_t> parent_;
    };
  } // namespace

  template <int dim>
  Connections<dim>::Connections(const BondNetwork<dim> &network)
      : network_(&network), first_(network.nodes.size() + 1), is_whole_(network.bonds.size(), 1),
        is_idle_(network.bonds.size(), 0), is_loose_(network.nodes.size(), 0)
  {
    for (const typename BondNetwork<dim>::Bond &bond : network.bonds)
    {
      ++first_[bond.from + 1];
      ++first_[bond.to + 1];
    }
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    incident_.resize(first_.back());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (std::size_t b = 0; b < network.bonds.size(); ++b)
      for (const unsigned int node : {network.bonds[b].from, network.bonds[b].to})
        incident_[next[node]++] = static_cast<unsigned int>(b);
    std::vector<std::size_t> all(network.nodes.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    look_at(std::move(all));
    find_pieces();
  }

  template <int dim>
  void Connections<dim>::break_bonds(const std::vector<std::size_t> &bonds)
  {
    std::vector<std::size_t> ends;
    for (const std::size_t b : bonds)
    {
      is_whole_[b] = 0;
      ends.push_back(network_->bonds[b].from);
      ends.push_back(network_->bonds[b].to);
    }
    look_at(std::move(ends));
    find_pieces();
  }

  /// Hold a node across these directions, as far as it is not held yet.
  template <int dim>
  void Connections<dim>::hold(std::size_t node, Directions<dim> directions)
  {
    is_loose_[node] = 1;
    Directions<dim> &held = held_[node];
    for (const Tensor<1, dim> &one : held)
      if (const Tensor<1, dim> part = directions.empty() ? one : across(directions, one);
          part.norm_square() > within)
        directions.push_back(directions.empty() ? part : part / part.norm());
    while (directions.size() < dim)
    {
      add_another(directions);
      held.push_back(directions.back());
      holds_.push_back({node, directions.back()});
    }
  }

  template <int dim>
  std::vector<Tensor<1, dim>> Connections<dim>::loads() const
  {
    std::vector<Tensor<1, dim>> loads = network_->loads;
    for (std::size_t i = 0; i < loads.size(); ++i)
      if (is_loose(i))
        loads[i] = {};
    return loads;
  }

  template <int dim>
  void Connections<dim>::hold(const std::vector<Tensor<1, dim>> &mode)
  {
    constexpr double moves = 1e-6; // of the largest displacement
    std::size_t most = 0;
    for (std::size_t i = 0; i < mode.size(); ++i)
      if (mode[i].norm() > mode[most].norm())
        most = i;
    holds_.push_back({most, mode[most] / mode[most].norm()});
    for (std::size_t i = 0; i < mode.size(); ++i)
      if (mode[i].norm() > moves * mode[most].norm())
        is_loose_[i] = 1;
  }

  // Bonds that are too few to hold a node carry no force. They do not hold the nodes at their other
  // ends, which are therefore checked again; they still determine the position of the node itself.
  template <int dim>
  void Connections<dim>::look_at(std::vector<std::size_t> nodes)
  {
    std::vector<Tensor<1, dim>> ways;
    std::vector<unsigned int> carrying;
    while (!nodes.empty())
    {
      const std::size_t node = nodes.back();
      nodes.pop_back();
      if (network_->grip[node] >= 0)
        continue;
      ways.clear();
      carrying.clear();
      const auto [begin, end] = bonds_of(node);
      for (const unsigned int *b = begin; b != end; ++b)
      {
        const auto placed = is_whole(*b) ? placed_.find(*b) : placed_.end();
        if (carries(*b))
          carrying.push_back(*b);
        if (carries(*b) || (placed != placed_.end() && placed->second == node))
          ways.push_back(network_->bonds[*b].way);
      }
      const Directions<dim> directions = span(ways);
      if (directions.size() == dim)
        continue;
      hold(node, directions);
      if (carrying.size() != directions.size())
        continue;
      for (const unsigned int b : carrying)
      {
        is_idle_[b] = 1;
        placed_[b] = node;
        const typename BondNetwork<dim>::Bond &bond = network_->bonds[b];
        nodes.push_back(bond.from == node ? bond.to : bond.from);
      }
    }
  }

  template <int dim>
  void Connections<dim>::find_pieces()
  {
    const std::size_t n_nodes = network_->nodes.size();
    const int n_grips = 1 + *std::max_element(network_->grip.begin(), network_->grip.end());
    const auto grips = static_cast<std::size_t>(n_grips);
    Sets sets(grips + n_nodes); // grips come first, and so stand for their sets
    for (std::size_t i = 0; i < n_nodes; ++i)
      if (network_->grip[i] >= 0)
        sets.join(static_cast<std::size_t>(network_->grip[i]), grips + i);
    for (std::size_t b = 0; b < network_->bonds.size(); ++b)
      if (carries(b))
        sets.join(grips + network_->bonds[b].from, grips + network_->bonds[b].to);
    for (std::size_t g = 1; g < grips; ++g)
      is_separated_ = is_separated_ || sets.find(g) != sets.find(0);
    std::vector<std::size_t> of_pieces;
    for (std::size_t b = 0; b < network_->bonds.size(); ++b)
      if (carries(b) && sets.find(grips + network_->bonds[b].from) >= grips)
      {
        of_pieces.push_back(b);
        hold(network_->bonds[b].from, {});
        hold(network_->bonds[b].to, {});
      }
    for (const std::size_t b : of_pieces)
      is_idle_[b] = 1;
  }

  template class Connections<2>;
  template class Connections<3>;
} // namespace plumbline::meshfree
