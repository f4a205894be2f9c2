#pragma once

#include "reference/mesh/edge_integrals.h"
#include "reference/mesh/space.h"

#include <array>

namespace plumbline::reference
{
  /// A side of one or two triangles, with the nodes whose shape functions' normal derivative jumps
  /// there: its ends, and the vertices opposite.
  struct Edge
  {
    Segment segment;
    std::array<unsigned int, 4> node; ///< dofs, the ends first; n_nodes of them count
    std::array<double, 4> jump;       ///< J = -Σ_T |e| ∂φ/∂n_T
    unsigned int n_nodes = 2;
    double length = 0, radius = 0; ///< radius: about its middle, of the nodes
  };

  /// Where the two sides stand to a horizon.
  inline geometry::PairPosition position(const Edge &e, const Edge &f, double horizon)
  {
    return position_of_circles(e.segment.middle().distance(f.segment.middle()),
                               .5 * (e.length + f.length), horizon);
  }

  /// What continuous piecewise linears on triangles are by their sides: Δφ = Σ_e J(e) along e.
  struct EdgeForm
  {
    explicit EdgeForm(const MeshSpace &space);

    std::vector<Edge> edges;         ///< those with a free node first, each group by its first end
    std::size_t n_active = 0;        ///< with a free node
    std::vector<double> radius;      ///< of each dof's support, about its node
    std::vector<double> integral;    ///< of each shape function
    std::vector<char> is_at_outside; ///< nodes of sides that have one triangle
    double longest = 0;              ///< side
    double most_slender = 0;         ///< longest side squared over twice the area, of cells
  };

  /// How ∬ C φ_i(x) φ_j(y) over pairs of points within the horizon is found.
  enum class PairWay : char
  {
    none,  ///< supports are farther apart
    whole, ///< by the potential that is smooth at 0
    in     ///< by the potential that ends at the circle: supports must be apart
  };

  /// The way of each pair of nodes, symmetric.
  class PairWays
  {
  public:
    PairWays(const MeshSpace &space, const EdgeForm &form, const physics::Kernel<2> &kernel);

    PairWay operator()(unsigned int i, unsigned int j) const
    {
      const double distance = space_.support(i).distance(space_.support(j));
      const double both = form_.radius[i] + form_.radius[j];
      const geometry::PairPosition position = position_of_circles(distance, both, horizon_);
      if (position == geometry::PairPosition::apart)
        return PairWay::none;
      const bool is_apart = distance - both > apart_;
      if (is_apart && !is_product_)
        return PairWay::in;
      if (position == geometry::PairPosition::inside)
        return PairWay::whole;
      if (form_.is_at_outside[i] || form_.is_at_outside[j]) // not continuous: only this is valid
        return PairWay::in;
      return is_apart && distance > horizon_ ? PairWay::in : PairWay::whole;
    }

    /// Where supports stand to the horizon.
    geometry::PairPosition position(unsigned int i, unsigned int j) const
    {
      return position_of_circles(space_.support(i).distance(space_.support(j)),
                                 form_.radius[i] + form_.radius[j], horizon_);
    }

    /// Nodes farther apart have no pair by the potential that is smooth at 0.
    double farthest_whole() const { return farthest_whole_; }

  private:
    const MeshSpace &space_;
    const EdgeForm &form_;
    double horizon_, apart_, farthest_whole_;
    bool is_product_; ///< of pairs within the horizon the whole is one, at no cost
  };
} // namespace plumbline::reference
