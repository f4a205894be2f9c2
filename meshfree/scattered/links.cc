#include "meshfree/scattered/links.h"

namespace plumbline::meshfree
{
  Links::Links(const FamilySource<2> &families, const StateBasedBody &body,
               std::pair<std::size_t, std::size_t> share)
      : nodes_(body.cells->size()), statistics_(*body.cells, body.ball_order)
  {
    const Kernel<2> &influence = body.dilatation.influence;
    const BrokenBonds broken(body.damage, *body.cells, influence.horizon());
    const Kernel<2> deviatoric = physics::deviatoric_kernel(influence, 1);
    Family<2> family;
    std::vector<char> is_intact;
    const auto add = [&](std::size_t i)
    {
      families(i, family);
      Node &node = nodes_[i];
      node.first = links_.size();
      for (std::size_t d = 0; d < 2; ++d)
        node.remainder.correction[d][d] = 1;
      node.is_whole = broken.find(i, family, is_intact);
      if (!node.is_whole)
        node.remainder = meshfree::remainder(influence, family, is_intact);
      for (std::size_t k = 0; k < family.bonds.size(); ++k)
      {
        const Bond<2> &bond = family.bonds[k];
        links_.push_back({family.neighbours[k], is_intact[k] != 0,
                          bond.weight * radial_value(influence, bond), bond.xi,
                          bond.kernel_point / bond.kernel_point.norm()});
      }
      node.last = links_.size();
    };
    for (std::size_t i = share.first; i < share.second; ++i)
    {
      add(i);
      statistics_.add(deviatoric, body.cells->nodes[i], family);
      check_constrained(is_intact, *body.cells, i);
    }
    const std::size_t n_own = links_.size();
    for (std::size_t k = 0; k < n_own; ++k)
      if (const Link link = links_[k]; link.is_intact && !has(link.node))
        add(link.node);
  }
} // namespace plumbline::meshfree
