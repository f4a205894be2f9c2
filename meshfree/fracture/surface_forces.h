#pragma once

#include "meshfree/fracture/equations.h"

namespace plumbline::meshfree
{
  /// Forces of a network whose surfaces, at its sides and at cracks, are free of traction in a
  /// field of uniaxial stress along them:
  ///   F_i = Σ_whole [k way (way·Δu) + V share (λ - μ) ξ (θ_i + θ_j)] + Σ_missing V share P,
  ///   θ_i = Σ_whole share ξ·M_i Δu,
  ///   P = [2 (λ - μ) ξ + 4 (ξ·n) ((λ + 2μ) (d·p)² - λ (d·n)²) n] θ_i  published
  ///   P = [2 (λ - μ) + 4 ((λ + 2μ) (d·p)² - λ (d·n)²)] ξ θ_k          consistent
  /// with d = way, p across the normal n, and M_i such that θ of a linear field is its divergence;
  /// a pseudo-inverse where whole bonds lie on a line. Consistent terms have the node's own
  /// constants, the normal of the nearest face, and as k of the node and its neighbours by whole
  /// bonds the one nearest to the foot; there are none where Faces::Foot::is_near_end holds. What
  /// hangs loose has the network's own forces. No energy has these forces: their matrix is not
  /// symmetric. Source: Fan et al. 2022, eqs. (3.19)-(3.22), doi:10.1016/j.cma.2022.115340
  /// (published).
  class SurfaceForces
  {
  public:
    /// Of what is whole. @pre network.surfaces
    SurfaceForces(const BondNetwork<2> &network, const Connections<2> &connections);

    /// On all nodes; shape (n_nodes) as u.
    NodeField<2> forces(const NodeField<2> &u) const;
    NodeField<2> terms(const NodeField<2> &u) const; ///< their part of what is missing
    std::vector<double> dilatations(const NodeField<2> &u) const;

  private:
    NodeField<2> correct(const std::vector<BondNetwork<2>::Bond> &missing);
    void add_published(const std::vector<BondNetwork<2>::Bond> &missing,
                       const NodeField<2> &normal);
    void add_consistent(const std::vector<BondNetwork<2>::Bond> &missing);
    unsigned int node_of_face(unsigned int node, const Point<2> &foot) const;

    const BondNetwork<2> *network_;
    const Connections<2> *connections_;
    std::vector<Tensor<2, 2>> correction_;
    std::vector<Tensor<1, 2>> pull_;     ///< on a node by a dilatation, of what is missing
    std::vector<unsigned int> dilating_; ///< the node whose dilatation that is
  };
} // namespace plumbline::meshfree
