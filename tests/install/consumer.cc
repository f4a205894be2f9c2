// A project of somebody else: the weights of one rule, and the diagonal of a reference.

#include <meshfree/rules/rules.h>
#include <reference/lattice/stencil.h>

#include <iostream>

int main()
{
  using namespace plumbline;
  const auto kernel =
      physics::Kernel<2>::with_diffusion(physics::kernel_type("linear-decay").profile, .3, .5);
  const auto bonds = meshfree::lattice_bonds(meshfree::improved_partial_area(kernel), kernel, .1,
                                             geometry::Backend::fast);
  const auto stencil = reference::galerkin_stencil(kernel, .1, reference::AxisShapes(true, 1),
                                                   geometry::Backend::fast);
  std::cout << bonds.family.size() << ' ' << stencil(0, 0, 0, 0) << '\n';
  return bonds.family.size() == 44 && stencil(0, 0, 0, 0) > 0 ? 0 : 1;
}
