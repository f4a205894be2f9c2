// Pairs of cells by quadrature against brute force.
#include "reference/mesh/pair_quadrature.h"

#include <deal.II/base/quadrature_lib.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace plumbline;
using namespace plumbline::reference;

namespace
{
  void add_rectangle(geometry::Mesh &mesh, const Point<2> &lower, const Point<2> &upper)
  {
    const auto first = static_cast<unsigned int>(mesh.vertices.size());
    for (const Point<2> &vertex :
         {lower, Point<2>(upper[0], lower[1]), upper, Point<2>(lower[0], upper[1])})
      mesh.vertices.push_back(vertex);
    mesh.cells.push_back({{first, first + 1, first + 2, first + 3}, 4, true});
  }
} // namespace

TEST(PairQuadrature, inner_rules_have_five_digits_and_one_more_with_each_refinement)
{
  // a long cell next to where kernels like 1/r count as smooth, as rules are chosen for; so small a
  // cell to see it from that the outer rule has no error
  constexpr double half = .1, thin = .01, small = 1e-3, distance = 2.05 * half;
  const auto mesh = std::make_shared<geometry::Mesh>();
  add_rectangle(*mesh, {-small / 2, -small / 2}, {small / 2, small / 2});
  add_rectangle(*mesh, {distance - half, -thin / 2}, {distance + half, thin / 2});
  const MeshSpace space(mesh, false, 0);
  const MeshCells cells(*mesh);
  const physics::Kernel<2> kernel(physics::Structure::scalar, {{1, -1}}, 1, 1);
  const KernelEntries profile(kernel);

  double exact = 0;
  const dealii::QGauss<2> outer(3), inner(20);
  for (unsigned int p = 0; p < outer.size(); ++p)
    for (unsigned int q = 0; q < inner.size(); ++q)
    {
      const Point<2> x(small * (outer.point(p)[0] - .5), small * (outer.point(p)[1] - .5)),
          y(distance + 2 * half * (inner.point(q)[0] - .5), thin * (inner.point(q)[1] - .5));
      exact += small * small * outer.weight(p) * 2 * half * thin * inner.weight(q) / x.distance(y);
    }

  for (const unsigned int refinement : {0u, 1u, 2u, 3u, 4u})
  {
    PairQuadrature pairs(space, cells, profile, kernel.horizon(), {}, refinement,
                         geometry::Backend::fast);
    PairBlocks blocks;
    pairs.integrate(0, 1, blocks);
    for (const auto *block : {&blocks.outer, &blocks.cross, &blocks.inner})
      EXPECT_NEAR(block->at(0) / exact, 1, std::pow(.1, 5 + refinement)) << refinement;
  }
}
