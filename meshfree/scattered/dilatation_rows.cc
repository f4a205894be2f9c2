#include "meshfree/scattered/dilatation_rows.h"

#include <algorithm>
#include <utility>

namespace plumbline::meshfree
{
  namespace
  {
    using dealii::Tensor;

    /// θ of a node is Σ value·(u_node - u).
    struct Gradient
    {
      unsigned int node = 0;
      Tensor<1, 3> value;
    };
    using Gradients = std::vector<Gradient>;

    /// Of free nodes, and of those that they reach.
    std::vector<Gradients> find_gradients(const FamilySource<3> &families,
                                          const Kernel<3> &influence,
                                          const geometry::NodeCells<3> &cells)
    {
      std::vector<Gradients> gradients(cells.size());
      Family<3> family;
      const auto find = [&](std::size_t node)
      {
        families(node, family);
        for (std::size_t k = 0; k < family.bonds.size(); ++k)
        {
          const Bond<3> &bond = family.bonds[k];
          gradients[node].push_back(
              {family.neighbours[k], bond.weight * radial_value(influence, bond) * bond.xi});
        }
      };
      for (std::size_t i = 0; i < cells.n_free; ++i)
        find(i);
      for (std::size_t i = 0; i < cells.n_free; ++i)
        for (const Gradient &other : gradients[i])
          if (other.node >= cells.n_free && gradients[other.node].empty())
            find(other.node);
      return gradients;
    }

    /// The force on one node at a time, as blocks of u of others.
    class BlockSums
    {
    public:
      explicit BlockSums(const std::vector<Gradients> &gradients)
          : gradients_(gradients), blocks_(gradients.size()), is_there_(gradients.size())
      {
      }

      /// += factor θ_node.
      void add(unsigned int node, const Tensor<1, 3> &factor)
      {
        Tensor<1, 3> sum;
        for (const Gradient &other : gradients_[node])
        {
          block(other.node) += outer_product(factor, other.value);
          sum += other.value;
        }
        block(node) -= outer_product(factor, sum);
      }

      /// Three rows more, and none of the sums is left.
      void move_to(algebra::CsrMatrix &rows)
      {
        std::sort(nodes_.begin(), nodes_.end());
        for (unsigned int c = 0; c < 3; ++c)
        {
          for (const unsigned int node : nodes_)
            for (unsigned int d = 0; d < 3; ++d)
            {
              rows.column.push_back(3 * node + d);
              rows.value.push_back(blocks_[node][c][d]);
            }
          rows.start.push_back(rows.column.size());
        }
        for (const unsigned int node : nodes_)
        {
          blocks_[node] = Tensor<2, 3>();
          is_there_[node] = 0;
        }
        nodes_.clear();
      }

    private:
      Tensor<2, 3> &block(unsigned int node)
      {
        if (is_there_[node] == 0)
          nodes_.push_back(node);
        is_there_[node] = 1;
        return blocks_[node];
      }

      const std::vector<Gradients> &gradients_;
      std::vector<Tensor<2, 3>> blocks_; ///< of all nodes
      std::vector<char> is_there_;
      std::vector<unsigned int> nodes_; ///< of blocks that are there
    };
  } // namespace

  algebra::CsrMatrix dilatation_rows(const FamilySource<3> &families,
                                     const physics::Dilatation<3> &dilatation,
                                     const geometry::NodeCells<3> &cells)
  {
    const auto gradients = find_gradients(families, dilatation.influence, cells);
    const physics::Lame lame = dilatation.material({});
    const double f = dilatation.factor(lame, lame);
    BlockSums sums(gradients);
    algebra::CsrMatrix rows;
    rows.start.push_back(0);
    for (unsigned int i = 0; i < cells.n_free; ++i)
    {
      Tensor<1, 3> own;
      for (const Gradient &other : gradients[i])
      {
        sums.add(other.node, -f * other.value);
        own -= f * other.value;
      }
      sums.add(i, own);
      sums.move_to(rows);
    }
    return rows;
  }
} // namespace plumbline::meshfree
