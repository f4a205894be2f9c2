// The piecewise constant field of nodal values on a lattice.
#include "meshfree/lattice/nodal_field.h"

#include <gtest/gtest.h>

using namespace plumbline;
using namespace plumbline::meshfree;

TEST(NodalField, has_the_value_of_a_node_all_over_the_square_around_it)
{
  constexpr double h = .25, nearly_half = .49;
  const geometry::Lattice lattice({{{{0, 0}, {1, .75}}}, {}}, h);
  for (const geometry::AxisSpecies &where : {geometry::AxisSpecies{.5, false, 0}, {0, true, 0}})
  {
    const auto expected = [](unsigned int component, int i, int j)
    { return 100. * component + 10 * j + i; };
    NodalField field{lattice, free_nodes(lattice, {where}, 2), {}};
    const auto &n = field.nodes.n;
    for (unsigned int c = 0; c < 2; ++c)
      for (int j = -1; j <= n[1]; ++j)
        for (int i = -1; i <= n[0]; ++i)
          field.values.push_back(expected(c, i, j));
    for (unsigned int c = 0; c < 2; ++c)
      for (int j = -1; j <= n[1]; ++j)
        for (int i = -1; i <= n[0]; ++i)
          for (const double s : {-nearly_half, 0., nearly_half})
            for (const double t : {-nearly_half, 0., nearly_half})
              EXPECT_EQ(field.value(lattice.point(i + where.offset + s, j + where.offset + t), c),
                        expected(c, i, j))
                  << i << ' ' << j << ' ' << s << ' ' << t;
  }
}
