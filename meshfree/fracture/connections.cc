#include "meshfree/fracture/connections.h"

#include <algorithm>
#include <numeric>

namespace plumbline::meshfree
{
  namespace
  {
    /// Bonds lie on a line where the determinant of Σ way⊗way is below this part of its square:
    /// within an angle of 1e-5.
    constexpr double collinear = 1e-10;

    Tensor<1, 2> across(const Tensor<1, 2> &way)
    {
      Tensor<1, 2> result;
      result[0] = -way[1];
      result[1] = way[0];
      return result;
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

  Connections::Connections(const BondNetwork &network)
      : network_(&network), first_(network.nodes.size() + 1), is_whole_(network.bonds.size(), 1),
        is_idle_(network.bonds.size(), 0), n_holds_(network.nodes.size(), 0),
        is_loose_(network.nodes.size(), 0)
  {
    for (const BondNetwork::Bond &bond : network.bonds)
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

  void Connections::break_bonds(const std::vector<std::size_t> &bonds)
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

  void Connections::hold_across(std::size_t node, const Tensor<1, 2> &way)
  {
    if (n_holds_[node] > 0)
      return;
    n_holds_[node] = is_loose_[node] = 1;
    holds_.push_back({node, across(way)});
  }

  void Connections::hold_both(std::size_t node)
  {
    is_loose_[node] = 1;
    Tensor<1, 2> direction;
    direction[0] = 1;
    if (n_holds_[node] == 1)
      for (const Hold &one : holds_)
        if (one.node == node)
          direction = one.direction;
    if (n_holds_[node] == 0)
      holds_.push_back({node, direction});
    if (n_holds_[node] < 2)
      holds_.push_back({node, across(direction)});
    n_holds_[node] = 2;
  }

  void Connections::hold(const std::vector<Tensor<1, 2>> &mode)
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

  // the last bond of a node does not hold the node at its other end, which is looked at again
  void Connections::look_at(std::vector<std::size_t> nodes)
  {
    while (!nodes.empty())
    {
      const std::size_t node = nodes.back();
      nodes.pop_back();
      if (network_->grip[node] >= 0)
        continue;
      Tensor<2, 2> sum;
      std::size_t n = 0, n_whole = 0, last = 0;
      const auto [begin, end] = bonds_of(node);
      for (const unsigned int *b = begin; b != end; ++b)
      {
        n_whole += is_whole(*b) ? 1 : 0;
        if (!carries(*b))
          continue;
        ++n;
        last = *b;
        sum += outer_product(network_->bonds[*b].way, network_->bonds[*b].way);
      }
      if (n > 0 && determinant(sum) > collinear * trace(sum) * trace(sum))
        continue;
      if (n > 0)
        hold_across(node, network_->bonds[last].way);
      else if (n_whole == 0 || n_holds_[node] == 0)
        hold_both(node); // else its own last bond goes on to say where it is
      if (n != 1)
        continue;
      is_idle_[last] = 1;
      const BondNetwork::Bond &bond = network_->bonds[last];
      nodes.push_back(bond.from == node ? bond.to : bond.from);
    }
  }

  void Connections::find_pieces()
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
        hold_both(network_->bonds[b].from);
        hold_both(network_->bonds[b].to);
      }
    for (const std::size_t b : of_pieces)
      is_idle_[b] = 1;
  }
} // namespace plumbline::meshfree
