#pragma once

#include "meshfree/scattered/links.h"

#include <optional>

namespace plumbline::meshfree
{
  /// Lamé constants of a bond between two nodes, by the means that the model takes.
  physics::Lame pair_constants(const physics::Dilatation<2> &dilatation, const physics::Lame &a,
                               const physics::Lame &b);

  /// 2μ d·ε d / θ for a direction d of length 1 where stress is uniaxial, along a face of normal n:
  /// the strain is (λ + 2μ) / 2μ θ along the face and -λ / 2μ θ across it.
  double uniaxial_strain(const physics::Lame &lame, const Tensor<1, 2> &d, const Tensor<1, 2> &n);

  /// Forces of surface terms on nodes with broken bonds, see state_based_operator.
  class SurfaceTerms
  {
  public:
    /// @param body, links, material  outlive it; material of each node, to be there when `force` is
    /// asked for
    SurfaceTerms(const StateBasedBody &body, const Links &links,
                 const std::vector<physics::Lame> &material);

    /// Force density factor θ_node.
    struct Force
    {
      unsigned int node = 0;
      Tensor<1, 2> factor;
    };

    /// Of node i of Ω, once for each; empty where there is none.
    std::optional<Force> force(unsigned int i);

    /// The forces so far about each tip of a crack.
    std::vector<TipRows> take_tips() { return std::move(tips_); }

  private:
    Force published(unsigned int i) const;
    Force consistent(unsigned int i, const Faces::Foot &foot) const;
    unsigned int node_of_face(unsigned int i, const Point<2> &foot) const;
    void remember_about_tips(unsigned int i, const Point<2> &foot, const Force &force);

    const StateBasedBody *body_;
    const Links *links_;
    const std::vector<physics::Lame> *material_;
    double horizon_;
    Faces faces_;
    std::vector<TipRows> tips_;
  };
} // namespace plumbline::meshfree
