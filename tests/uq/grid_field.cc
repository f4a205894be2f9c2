// Fields by their values on a grid, and expansions in them.
#include "uq/grid_field.h"
#include "base/error.h"
#include "uq/expansion.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace plumbline;
using namespace plumbline::uq;

namespace
{
  const Grid grid{{{1, -2}, {4, 0}}, {6, 5}}; // h = .5, .4

  template <class Function>
  std::vector<double> at_nodes(const Function &function)
  {
    std::vector<double> values;
    for (int j = 0; j < grid.n[1]; ++j)
      for (int i = 0; i < grid.n[0]; ++i)
        values.push_back(function(grid.node(i, j)));
    return values;
  }

  double product(const Point<2> &x)
  {
    return (2 + x[0]) * (1 - 3 * x[1]) + x[0];
  }

  /// Two modes, cosines in x and in y, with variances 4 and 1.
  Expansion two_modes()
  {
    const double norm = std::sqrt(2 / 6.); // of an area of 6
    Expansion expansion;
    expansion.grid = grid;
    expansion.mean = at_nodes([](const Point<2> &x) { return x[0]; });
    expansion.eigenvalue = {4, 1};
    expansion.mode = {
        at_nodes([&](const Point<2> &x) { return norm * std::cos(M_PI * (x[0] - 1) / 3); }),
        at_nodes([&](const Point<2> &x) { return norm * std::cos(M_PI * (x[1] + 2) / 2); })};
    expansion.variance = expansion.variance_of_modes(2);
    for (double &value : expansion.variance) // and some that no mode holds
      value += .5;
    return expansion;
  }
} // namespace

TEST(GridField, is_exact_for_bilinear_functions_between_nodes)
{
  const GridField field(grid, at_nodes(product));
  const auto lower = grid.node(0, 0), upper = grid.node(5, 4);
  for (const double s : {0., .13, .5, .77, 1.})
    for (const double t : {0., .2, .41, .9, 1.})
    {
      const Point<2> x(lower[0] + s * (upper[0] - lower[0]), lower[1] + t * (upper[1] - lower[1]));
      EXPECT_NEAR(field(x), product(x), 1e-13);
    }
}

TEST(GridField, beyond_its_nodes_is_as_at_the_nearest_point_of_their_hull)
{
  const GridField field(grid, at_nodes(product));
  EXPECT_NEAR(field({-100, -.7}), field({1.25, -.7}), 1e-13);
  EXPECT_NEAR(field({4, 1e9}), field({3.75, -.2}), 1e-13);
  EXPECT_DOUBLE_EQ(field({1e300, -1e300}), product(grid.node(5, 0)));
}

TEST(GridField, piecewise_constant_has_its_jumps_at_the_edges_of_cells)
{
  const GridField field(grid, at_nodes(product), Interpolation::constant);
  EXPECT_EQ(field({1.99, -1.21}), product(grid.node(1, 1)));
  EXPECT_EQ(field({2.01, -1.21}), product(grid.node(2, 1)));
  EXPECT_EQ(field({2.01, -1.19}), product(grid.node(2, 2)));
  EXPECT_EQ(field({9, 9}), product(grid.node(5, 4)));
}

TEST(GridField, of_one_node_is_constant)
{
  const GridField field(Grid{{{0, 0}, {1, 1}}, {1, 1}}, {3});
  for (const double x : {-1., 0., .3, .5, 1., 2.})
    EXPECT_EQ(field({x, .5 * x}), 3);
}

TEST(GridField, knows_its_mean_and_range)
{
  const GridField field(grid, at_nodes([](const Point<2> &x) { return x[0] - x[1]; }));
  EXPECT_NEAR(field.mean(), 2.5 + 1, 1e-14);
  EXPECT_NEAR(field.smallest(), 1.25 + .2, 1e-14);
  EXPECT_NEAR(field.largest(), 3.75 + 1.8, 1e-14);
}

TEST(Grid, is_made_of_cells_near_to_squares_and_refuses_what_is_none)
{
  const Grid made = make_grid({{0, 0}, {800, 390}}, 20);
  EXPECT_EQ(made.n[0], 40);
  EXPECT_EQ(made.n[1], 20);
  EXPECT_DOUBLE_EQ(made.h(1), 19.5);
  EXPECT_DOUBLE_EQ(made.cell_area() * double(made.size()), 800 * 390);
  EXPECT_THROW(make_grid({{0, 0}, {1, 1}}, 0), InputError);
  EXPECT_THROW(make_grid({{0, 0}, {1, 1}}, std::nan("")), InputError);
  EXPECT_THROW(make_grid({{0, 0}, {1, 1}}, 1e-5), InputError);
  EXPECT_THROW(make_grid({{0, 0}, {1, 0}}, .1), InputError);
  EXPECT_THROW(check(Grid{{{0, 0}, {1, 1}}, {3, 0}}), InputError);
}

TEST(Expansion, says_how_much_of_the_variance_its_modes_hold)
{
  const Expansion e = two_modes();
  EXPECT_NEAR(e.total_variance(), 5 + .5 * 6, 1e-13);
  EXPECT_NEAR(e.variance_kept(1), 4 / 8., 1e-14);
  EXPECT_NEAR(e.variance_kept(), 5 / 8., 1e-14);
  EXPECT_EQ(e.variance_kept(0), 0);
  EXPECT_EQ(e.modes_for(.5 - 1e-9), 1u);
  EXPECT_EQ(e.modes_for(.6), 2u);
  EXPECT_FALSE(e.modes_for(.7).has_value());
  EXPECT_THROW(e.variance_kept(3), InputError);
}

TEST(Expansion, realises_fields_whose_numbers_it_finds_again)
{
  const Expansion e = two_modes();
  const GridField field = e.realise({-.7, 1.9});
  const Point<2> x = grid.node(1, 3);
  EXPECT_NEAR(field(x),
              x[0] - .7 * 2 * std::sqrt(1 / 3.) * std::cos(M_PI * (x[0] - 1) / 3) +
                  1.9 * std::sqrt(1 / 3.) * std::cos(M_PI * (x[1] + 2) / 2),
              1e-13);
  const std::vector<double> xi = e.coordinates(field.values());
  EXPECT_NEAR(xi[0], -.7, 1e-13);
  EXPECT_NEAR(xi[1], 1.9, 1e-13);
  EXPECT_EQ(e.realise({}).values(), e.mean);
  EXPECT_EQ(e.realise({1}).values(), e.realise({1, 0}).values());
  EXPECT_THROW(e.realise({1, 2, 3}), InputError);
}
