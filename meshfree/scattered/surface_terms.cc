#include "meshfree/scattered/surface_terms.h"

#include <algorithm>

namespace plumbline::meshfree
{
  namespace
  {
    /// Columns are two for each node.
    void put(algebra::CsrMatrix &rows, unsigned int c, unsigned int node, const Tensor<2, 2> &block)
    {
      for (unsigned int d = 0; d < 2; ++d)
      {
        rows.column.push_back(2 * node + d);
        rows.value.push_back(block[c][d]);
      }
    }
  } // namespace

  physics::Lame pair_constants(const physics::Dilatation<2> &dilatation, const physics::Lame &a,
                               const physics::Lame &b)
  {
    const auto kind = dilatation.is_two_point ? physics::Mean::harmonic : physics::Mean::arithmetic;
    return {physics::mean(kind, a.lambda, b.lambda), physics::mean(kind, a.mu, b.mu)};
  }

  double uniaxial_strain(const physics::Lame &lame, const Tensor<1, 2> &d, const Tensor<1, 2> &n)
  {
    const double across = d * n, along = d[0] * n[1] - d[1] * n[0];
    return (lame.lambda + 2 * lame.mu) * along * along - lame.lambda * across * across;
  }

  std::vector<Tensor<1, 2>> TipRows::forces(const std::vector<double> &u) const
  {
    std::vector<Tensor<1, 2>> result(volume.size());
    for (std::size_t i = 0; i < volume.size(); ++i)
      for (unsigned int c = 0; c < 2; ++c)
        for (std::size_t k = rows.start[2 * i + c]; k < rows.start[2 * i + c + 1]; ++k)
          result[i][c] += volume[i] * rows.value[k] * u[rows.column[k]];
    return result;
  }

  SurfaceTerms::SurfaceTerms(const StateBasedBody &body, const Links &links,
                             const std::vector<physics::Lame> &material)
      : body_(&body), links_(&links), material_(&material),
        horizon_(body.dilatation.influence.horizon()),
        faces_(find_faces(body.damage, *body.cells, horizon_))
  {
    for (const Point<2> &tip : faces_.ends())
      tips_.push_back({tip, {}, {}});
  }

  std::optional<SurfaceTerms::Force> SurfaceTerms::force(unsigned int i)
  {
    const problem::SurfaceTerms terms = body_->damage.surface_terms;
    if (links_->is_whole(i) || terms == problem::SurfaceTerms::none ||
        terms == problem::SurfaceTerms::energy)
      return {};
    double reach = 0;
    for (const Link &link : links_->of(i))
      reach = std::max(reach, link.xi.norm());
    const auto foot = faces_.foot(body_->cells->nodes[i], reach);
    const bool is_consistent = terms == problem::SurfaceTerms::consistent;
    if (is_consistent && (!foot || foot->is_near_end))
      return {};
    const Force result = is_consistent ? consistent(i, *foot) : published(i);
    if (foot)
      remember_about_tips(i, foot->place, result);
    return result;
  }

  /// Eqs. (3.19), (3.22): along the normal, by the node's own dilatation.
  SurfaceTerms::Force SurfaceTerms::published(unsigned int i) const
  {
    Force force{i, {}};
    const Tensor<1, 2> n = links_->remainder(i).normal;
    for (const Link &link : links_->of(i))
    {
      if (link.is_intact)
        continue;
      const physics::Lame pair =
          pair_constants(body_->dilatation, (*material_)[i], (*material_)[link.node]);
      force.factor += 2 * (pair.lambda - pair.mu) * link.strength * link.xi;
      force.factor +=
          4 * link.strength * (link.xi * n) * uniaxial_strain(pair, link.direction, n) * n;
    }
    return force;
  }

  /// What whole bonds would exert in uniaxial stress along the face. By the constants of the node,
  /// for beyond an interface is another stress, and by θ at the face: over the layer of nodes at a
  /// straight face the forces cancel then.
  SurfaceTerms::Force SurfaceTerms::consistent(unsigned int i, const Faces::Foot &foot) const
  {
    Force force{node_of_face(i, foot.place), {}};
    const physics::Lame &own = (*material_)[i];
    for (const Link &link : links_->of(i))
      if (!link.is_intact)
        force.factor +=
            link.strength *
            (2 * (own.lambda - own.mu) + 4 * uniaxial_strain(own, link.direction, foot.normal)) *
            link.xi;
    return force;
  }

  /// Of a node and its intact neighbours the one that is nearest to its foot.
  unsigned int SurfaceTerms::node_of_face(unsigned int i, const Point<2> &foot) const
  {
    const std::vector<Point<2>> &nodes = body_->cells->nodes;
    unsigned int nearest = i;
    for (const Link &link : links_->of(i))
      if (link.is_intact && nodes[link.node].distance(foot) <
                                nodes[nearest].distance(foot) - geometry::on_crack * horizon_)
        nearest = link.node;
    return nearest;
  }

  /// Nodes are about a tip by their feet, so that whole columns of a straight face are.
  void SurfaceTerms::remember_about_tips(unsigned int i, const Point<2> &foot, const Force &force)
  {
    if (force.node >= body_->cells->n_free && !body_->has_collar_dilatation)
      return;
    for (TipRows &tip : tips_)
    {
      if (!(tip.place.distance(foot) < TipRows::reach * horizon_))
        continue;
      tip.volume.push_back(body_->cells->area[i]);
      if (tip.rows.start.empty())
        tip.rows.start.push_back(0);
      for (unsigned int c = 0; c < 2; ++c)
      {
        for (const Link &link : links_->of(force.node))
          if (link.is_intact)
          {
            const Tensor<2, 2> block =
                outer_product(force.factor, links_->gradient(force.node, link));
            put(tip.rows, c, link.node, block);
            put(tip.rows, c, force.node, -block);
          }
        tip.rows.start.push_back(tip.rows.column.size());
      }
    }
  }
} // namespace plumbline::meshfree
