#include "reference/mesh/edge_form.h"

#include "reference/mesh/whole_potential.h"

#include <algorithm>
#include <limits>
#include <map>

namespace plumbline::reference
{
  namespace
  {
    constexpr unsigned int n_corners = 3;
    constexpr unsigned int next[n_corners] = {1, 2, 0};

    /// A triangle's nodes and corners, counter-clockwise.
    struct Triangle
    {
      std::array<unsigned int, n_corners> node;
      std::array<Point<2>, n_corners> corner;

      Triangle(const MeshSpace &space, std::size_t cell)
      {
        for (unsigned int k = 0; k < n_corners; ++k)
        {
          node[k] = space.dofs(cell)[k];
          corner[k] = space.support(node[k]);
        }
      }

      Vector2 side(unsigned int k) const { return corner[next[k]] - corner[k]; }
      double twice_area() const { return cross(side(0), side(1)); }

      /// |e| ∂φ_i/∂n on side k: both are turned sides, the opposite one of i by 2 |T|.
      double flux(unsigned int k, unsigned int i) const
      {
        return -(side(k) * side(next[i])) / twice_area();
      }
    };

    /// The edge between two nodes, made when it is first asked for.
    class Edges
    {
    public:
      explicit Edges(const MeshSpace &space) : space_(space) { all.reserve(count(space)); }

      Edge &between(unsigned int a, unsigned int b)
      {
        const auto [place, is_new] = index_.try_emplace(std::minmax(a, b), all.size());
        if (is_new)
        {
          const auto [first, second] = place->first;
          all.push_back({{space_.support(first), space_.support(second)}, {first, second}, {}});
          all.back().length = all.back().segment.along.norm();
        }
        return all[place->second];
      }

      std::vector<Edge> all;

    private:
      /// A vector that grows would take three times the memory for a moment.
      static std::size_t count(const MeshSpace &space)
      {
        std::vector<std::pair<unsigned int, unsigned int>> ends;
        ends.reserve(n_corners * space.mesh().cells.size());
        for (std::size_t cell = 0; cell < space.mesh().cells.size(); ++cell)
          for (unsigned int k = 0; k < n_corners; ++k)
            ends.push_back(std::minmax(space.dofs(cell)[k], space.dofs(cell)[next[k]]));
        std::sort(ends.begin(), ends.end());
        return static_cast<std::size_t>(std::unique(ends.begin(), ends.end()) - ends.begin());
      }

      const MeshSpace &space_;
      std::map<std::pair<unsigned int, unsigned int>, std::size_t> index_;
    };
  } // namespace

  EdgeForm::EdgeForm(const MeshSpace &space)
      : radius(space.n_dofs()), integral(space.n_dofs()), is_at_outside(space.n_dofs())
  {
    Edges found(space);
    for (std::size_t cell = 0; cell < space.mesh().cells.size(); ++cell)
    {
      const Triangle triangle(space, cell);
      double longest_side = 0;
      for (unsigned int k = 0; k < n_corners; ++k)
      {
        const unsigned int opposite = next[next[k]];
        const double length = triangle.side(k).norm();
        longest_side = std::max(longest_side, length);
        integral[triangle.node[k]] += triangle.twice_area() / 6;
        for (const unsigned int end : {k, next[k]})
          radius[triangle.node[end]] = std::max(radius[triangle.node[end]], length);
        Edge &edge = found.between(triangle.node[k], triangle.node[next[k]]);
        edge.node[edge.n_nodes++] = triangle.node[opposite];
        for (unsigned int i = 0; i < n_corners; ++i)
          for (unsigned int n = 0; n < edge.n_nodes; ++n)
            if (edge.node[n] == triangle.node[i])
              edge.jump[n] -= triangle.flux(k, i);
      }
      longest = std::max(longest, longest_side);
      most_slender = std::max(most_slender, longest_side * longest_side / triangle.twice_area());
    }
    edges = std::move(found.all);
    for (Edge &edge : edges)
    {
      for (unsigned int n = 0; n < edge.n_nodes; ++n)
        edge.radius =
            std::max(edge.radius, edge.segment.middle().distance(space.support(edge.node[n])));
      if (edge.n_nodes == 3)
        is_at_outside[edge.node[0]] = is_at_outside[edge.node[1]] = 1;
    }
    const auto is_active = [&](const Edge &edge)
    {
      return std::any_of(edge.node.begin(), edge.node.begin() + edge.n_nodes,
                         [&](unsigned int node) { return node < space.n_free(); });
    };
    const auto constrained =
        std::partition(edges.begin(), edges.end(), [&](const Edge &e) { return is_active(e); });
    n_active = static_cast<std::size_t>(constrained - edges.begin());
    std::sort(edges.begin(), constrained,
              [](const Edge &a, const Edge &b) { return a.node < b.node; });
  }

  PairWays::PairWays(const MeshSpace &space, const EdgeForm &form, const physics::Kernel<2> &kernel)
      : space_(space), form_(form), horizon_(kernel.horizon()),
        is_product_(WholePotential::is_product(kernel))
  {
    // the farther apart supports must be for the potential that ends at the circle, the larger the
    // smooth one becomes; the nearer they may be, the former, and it is (δ/h)^4 times larger than
    // the sum of its terms. Of bond tensors it has a pole at 0. Measured by linear fields
    constexpr double wide = 3.5; // triangles, in horizons
    const bool is_tensor = kernel.structure() == physics::Structure::tensor;
    apart_ = (horizon_ < wide * form.longest ? .25 : is_tensor ? .4 : .35) * horizon_;
    const double both = 2 * *std::max_element(form.radius.begin(), form.radius.end());
    farthest_whole_ = is_product_ ? std::max(horizon_, apart_ + both) : apart_ + both;
  }
} // namespace plumbline::reference
