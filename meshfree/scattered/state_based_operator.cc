#include "meshfree/scattered/state_based_operator.h"

#include "meshfree/scattered/surface_terms.h"

#include <algorithm>

namespace plumbline::meshfree
{
  namespace
  {
    using physics::Lame;

    /// The couplings of (u_1, u_2, θ) of one node to those of others.
    class BlockRow
    {
    public:
      explicit BlockRow(std::size_t n_nodes) : place_(n_nodes, none) {}

      void clear()
      {
        for (const unsigned int node : nodes_)
          place_[node] = none;
        nodes_.clear();
        blocks_.clear();
      }

      /// Zero at first.
      Tensor<2, 3> &operator[](unsigned int node)
      {
        if (place_[node] == none)
        {
          place_[node] = static_cast<unsigned int>(blocks_.size());
          nodes_.push_back(node);
          blocks_.emplace_back();
        }
        return blocks_[place_[node]];
      }

      const std::vector<unsigned int> &sorted_nodes()
      {
        std::sort(nodes_.begin(), nodes_.end());
        return nodes_;
      }

    private:
      static constexpr unsigned int none = -1;

      std::vector<unsigned int> place_; ///< of each node in blocks_
      std::vector<unsigned int> nodes_;
      std::vector<Tensor<2, 3>> blocks_;
    };

    /// Makes the rows of a share, node by node.
    class Assembly
    {
    public:
      Assembly(const FamilySource<2> &families, const StateBasedBody &body,
               std::pair<std::size_t, std::size_t> share, bool keeps_dilatation)
          : cells_(*body.cells), dilatation_(body.dilatation),
            has_collar_dilatation_(body.has_collar_dilatation), keeps_dilatation_(keeps_dilatation),
            has_energy_(body.damage.surface_terms == problem::SurfaceTerms::energy), share_(share),
            links_(families, body, share), row_(cells_.size()), n_unknowns_(2 * cells_.n_free),
            surface_terms_(body, links_, material_)
      {
        for (const Point<2> &x : cells_.nodes)
          material_.push_back(dilatation_.is_homogeneous && !material_.empty()
                                  ? material_.front()
                                  : dilatation_.material(x));
        for (std::size_t i = 0; i < cells_.size(); ++i)
          number_of_dilatation_.push_back(
              static_cast<unsigned int>(has_row(i) ? n_unknowns_++ : 0));
      }

      ScatteredOperator make()
      {
        result_.statistics = links_.statistics();
        result_.rows.free.start.assign(2 * share_.first + 1, 0);
        result_.rows.constrained.start = result_.rows.free.start;
        for (auto i = static_cast<unsigned int>(share_.first); i < share_.second; ++i)
          add_node(i);
        for (unsigned int i = 0; i < cells_.size(); ++i)
          if (has_row(i))
          {
            row_.clear();
            define_dilatation(i);
            put_row(2);
          }
        for (algebra::CsrMatrix *rows : {&result_.rows.free, &result_.rows.constrained})
          rows->start.resize(n_unknowns_ + 1, rows->column.size());
        result_.tips = surface_terms_.take_tips();
        return std::move(result_);
      }

    private:
      /// A node whose θ is unknown.
      bool has_row(std::size_t node) const
      {
        return keeps_dilatation_ && links_.has(node) &&
               (node < cells_.n_free || has_collar_dilatation_);
      }

      /// The force on a node of Ω.
      void add_node(unsigned int i)
      {
        row_.clear();
        const Lame &own = material_[i];
        Tensor<1, 2> own_factor;
        for (const Link &link : links_.of(i))
        {
          const unsigned int j = link.node;
          const Lame &other = material_[j], pair = pair_constants(dilatation_, own, other);
          if (link.is_intact)
          {
            own_factor -= dilatation_.factor(own, other) * force_direction(i, link);
            add_dilatation(j, -dilatation_.factor(other, own) * force_direction(j, link));
            const Tensor<2, 2> bond =
                8 * pair.mu * link.strength * outer_product(link.direction, link.direction);
            add(j, -bond);
            add(i, bond);
          }
        }
        if (const auto surface = surface_terms_.force(i))
        {
          if (surface->node == i)
            own_factor -= surface->factor;
          else
            add_dilatation(surface->node, -surface->factor);
        }
        add_dilatation(i, own_factor);
        put_row(0);
        put_row(1);
      }

      /// Of the force by the dilatation of a bond's end: K ξ, by the energy K M ξ.
      Tensor<1, 2> force_direction(unsigned int node, const Link &link) const
      {
        return has_energy_ ? links_.gradient(node, link) : link.strength * link.xi;
      }

      void add(unsigned int node, const Tensor<2, 2> &block)
      {
        Tensor<2, 3> &whole = row_[node];
        for (unsigned int c = 0; c < 2; ++c)
          for (unsigned int d = 0; d < 2; ++d)
            whole[c][d] += block[c][d];
      }

      /// The force factor θ_j.
      void add_dilatation(unsigned int j, const Tensor<1, 2> &factor)
      {
        if (j >= cells_.n_free && !has_collar_dilatation_)
          return;
        if (keeps_dilatation_)
        {
          Tensor<2, 3> &whole = row_[j];
          for (unsigned int c = 0; c < 2; ++c)
            whole[c][2] += factor[c];
          return;
        }
        Tensor<1, 2> sum;
        for (const Link &link : links_.of(j))
          if (link.is_intact)
          {
            const Tensor<1, 2> gradient = links_.gradient(j, link);
            sum += gradient;
            add(link.node, outer_product(factor, gradient));
          }
        add(j, -outer_product(factor, sum));
      }

      /// θ_i - Σ g·(u_j - u_i) = 0.
      void define_dilatation(unsigned int i)
      {
        row_[i][2][2] = 1;
        for (const Link &link : links_.of(i))
          if (link.is_intact)
          {
            const Tensor<1, 2> gradient = links_.gradient(i, link);
            for (unsigned int d = 0; d < 2; ++d)
            {
              row_[link.node][2][d] -= gradient[d];
              row_[i][2][d] += gradient[d];
            }
          }
      }

      /// Row c of a node, u before θ.
      void put_row(unsigned int c)
      {
        auto &[free, constrained] = result_.rows;
        const auto put = [](algebra::CsrMatrix &rows, std::size_t column, double entry)
        {
          rows.column.push_back(static_cast<unsigned int>(column));
          rows.value.push_back(entry);
        };
        const std::vector<unsigned int> &nodes = row_.sorted_nodes();
        for (const unsigned int j : nodes)
          for (unsigned int d = 0; d < 2; ++d)
            if (const double entry = row_[j][c][d]; entry != 0)
            {
              if (j < cells_.n_free)
                put(free, 2 * j + d, entry);
              else
                put(constrained, 2 * (j - cells_.n_free) + d, entry);
            }
        for (const unsigned int j : nodes)
          if (const double entry = row_[j][c][2]; entry != 0)
            put(free, number_of_dilatation_[j], entry);
        for (algebra::CsrMatrix *rows : {&free, &constrained})
          rows->start.push_back(rows->column.size());
      }

      const geometry::NodeCells<2> &cells_;
      const physics::Dilatation<2> &dilatation_;
      bool has_collar_dilatation_, keeps_dilatation_, has_energy_;
      std::pair<std::size_t, std::size_t> share_;
      Links links_;
      BlockRow row_;
      std::vector<Lame> material_;
      std::size_t n_unknowns_;
      SurfaceTerms surface_terms_;
      std::vector<unsigned int> number_of_dilatation_; ///< θ of each node is this unknown, if any
      ScatteredOperator result_;
    };
  } // namespace

  ScatteredOperator state_based_operator(const FamilySource<2> &families,
                                         const StateBasedBody &body,
                                         std::pair<std::size_t, std::size_t> share)
  {
    return Assembly(families, body, share, false).make();
  }

  ScatteredOperator state_based_system(const FamilySource<2> &families, const StateBasedBody &body)
  {
    return Assembly(families, body, {0, body.cells->n_free}, true).make();
  }
} // namespace plumbline::meshfree
