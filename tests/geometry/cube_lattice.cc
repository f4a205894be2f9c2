// Cubes of unions of boxes in space with holes, and nodes on them.
#include "geometry/cube_lattice.h"

#include "base/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

using namespace plumbline;
using namespace plumbline::geometry;

namespace
{
  using Index = std::array<int, 3>;

  const Cuboid unit = {{0, 0, 0}, {1, 1, 1}};
  const Solid l_shape = {{unit}, {{{.5, .5, 0}, {1, 1, 1}}}};
  const Solid with_cavity = {{unit}, {{{.25, .5, .25}, {.5, .75, .75}}}};

  std::string message_of(const Solid &solid, double h)
  {
    try
    {
      (void)CubeLattice(solid, h);
    }
    catch (const InputError &error)
    {
      return error.what();
    }
    return "";
  }
} // namespace

TEST(CubeLattice, has_the_cells_of_boxes_without_those_of_holes)
{
  const CubeLattice lattice(l_shape, .25);
  EXPECT_FALSE(lattice.is_box());
  EXPECT_EQ(lattice.size(), 48u);
  for_each_index({-1, -1, -1}, {5, 5, 5},
                 [&](const Index &at)
                 {
                   const bool is_in_box = *std::min_element(at.begin(), at.end()) >= 0 &&
                                          *std::max_element(at.begin(), at.end()) < 4;
                   EXPECT_EQ(lattice.is_inside(at), is_in_box && (at[0] < 2 || at[1] < 2));
                 });
  std::size_t n_visited = 0;
  lattice.for_each_cell([&](const Index &cell) { n_visited += lattice.is_inside(cell) ? 1 : 0; });
  EXPECT_EQ(n_visited, lattice.size());
  EXPECT_EQ(CubeLattice(with_cavity, .125).size(), 512u - 2 * 2 * 4);
}

TEST(CubeLattice, of_boxes_that_overlap_or_meet_is_that_of_their_union)
{
  const CubeLattice whole({{unit}, {}}, .25),
      parts({{{{0, 0, 0}, {.5, 1, 1}}, {{.25, 0, 0}, {.75, 1, 1}}, {{.75, 0, 0}, {1, 1, 1}}}, {}},
            .25);
  EXPECT_TRUE(parts.is_box());
  EXPECT_EQ(parts.size(), whole.size());
  EXPECT_EQ(parts.n_cells(), whole.n_cells());
  // a hole that reaches beyond the boxes is cut off
  EXPECT_EQ(CubeLattice({{unit}, {{{.5, .5, -1}, {2, 3, 1}}}}, .25).size(), 48u);
}

TEST(CubeLattice, tells_whether_larger_cubes_make_up_the_solid)
{
  EXPECT_TRUE(CubeLattice(l_shape, .25).fits(2));
  EXPECT_FALSE(CubeLattice(l_shape, .5).fits(2));
  EXPECT_FALSE(CubeLattice({{{{0, 0, 0}, {.75, 1, 1}}}, {}}, .25).fits(2));
  EXPECT_EQ(CubeLattice(l_shape, .25).at_spacing(.5).size(), 6u);
}

TEST(CubeLattice, rejects_boxes_that_are_not_whole_cells)
{
  const auto expect = [](const Solid &solid, double h, const std::string &words)
  { EXPECT_NE(message_of(solid, h).find(words), std::string::npos) << message_of(solid, h); };
  expect({{unit, {{1, 0, 0}, {1.3, 1, 1}}}, {}}, .25, "(1.2 along x)");
  expect({{unit, {{1.1, 0, 0}, {1.6, 1, 1}}}, {}}, .25,
         "begins 4.4 cells from the lower end of Domain/boxes along x");
  expect({{unit}, {{{.25, .3, .25}, {.5, .55, .5}}}}, .25, "begins 1.2 cells");
  expect({{unit}, {{{1, 0, 0}, {2, 1, 1}}}}, .25, "is outside of Domain/boxes");
  expect({{unit}, {unit}}, .25, "no cell is left");
  expect({{unit, {{1e6, 0, 0}, {1e6 + 1, 1, 1}}}, {}}, .001, "more than 1000000000 cells");
  expect({{unit}, {}}, -1, "must be a positive length");
  expect({}, 1, "Domain/boxes is empty");
  // two holes in the same place, of which the second one finds nothing left
  EXPECT_EQ(message_of({{unit}, {l_shape.exclude[0], l_shape.exclude[0]}}, .25), "");
}

TEST(BoxNodes, are_free_where_all_cells_around_them_are_in_the_domain)
{
  const BoxNodes box = inner_vertices(CubeLattice({{unit}, {}}, .25));
  EXPECT_TRUE(box.is_free.empty());
  EXPECT_EQ(box.n_free(), 27u);
  const CubeLattice lattice(with_cavity, .125);
  const BoxNodes vertices = inner_vertices(lattice), centres = cell_centres(lattice);
  EXPECT_EQ(centres.n_free(), lattice.size());
  EXPECT_EQ(vertices.n_free(), 7u * 7 * 7 - 3 * 3 * 5);
  for_each_index({-1, -1, -1}, {8, 8, 8},
                 [&](const Index &at)
                 {
                   bool is_free = true;
                   for_each_index(at, {at[0] + 2, at[1] + 2, at[2] + 2},
                                  [&](const Index &cell)
                                  { is_free = is_free && lattice.is_inside(cell); });
                   EXPECT_EQ(vertices.free(at), is_free);
                 });
  // one cell thick
  EXPECT_EQ(inner_vertices(CubeLattice({{unit}, {}}, 1)).n_free(), 0u);
  EXPECT_EQ(inner_vertices(CubeLattice(l_shape, .5)).n_free(), 0u);
}

TEST(CubeLattice, has_two_largest_boxes_in_an_l_and_six_around_a_cavity)
{
  EXPECT_EQ(CubeLattice({{unit}, {}}, .25).boxes().size(), 1u);
  EXPECT_EQ(CubeLattice(with_cavity, .125).boxes().size(), 6u);
  const auto boxes = CubeLattice(l_shape, .125).boxes();
  ASSERT_EQ(boxes.size(), 2u);
  EXPECT_EQ(boxes[0].upper, dealii::Point<3>(.5, 1, 1));
  EXPECT_EQ(boxes[1].upper, dealii::Point<3>(1, .5, 1));
}

TEST(CubeLattice, finds_the_cell_of_a_point_in_the_closed_domain)
{
  const CubeLattice lattice(l_shape, .125);
  EXPECT_EQ(lattice.cell_at({.3, .8, .1}), (Index{2, 6, 0}));
  for (const dealii::Point<3> &x :
       {dealii::Point<3>(0, 0, 0), {1, .5, 1}, {.5, 1, .3}, {.5, .5, .5}, {1 + 1e-12, .2, .2}})
  {
    const auto cell = lattice.cell_at(x);
    ASSERT_TRUE(cell.has_value()) << x;
    EXPECT_TRUE(lattice.is_inside(*cell)) << x;
    for (unsigned int d = 0; d < 3; ++d)
    {
      EXPECT_GE(x[d], lattice.coordinate(d, (*cell)[d]) - 1e-10) << x;
      EXPECT_LE(x[d], lattice.coordinate(d, (*cell)[d] + 1) + 1e-10) << x;
    }
  }
  for (const dealii::Point<3> &x : {dealii::Point<3>(.75, .75, .5),
                                    {.5 + 1e-6, .5 + 1e-6, .5},
                                    {-1e-6, .5, .5},
                                    {.2, .2, 1.5},
                                    {std::nan(""), .5, .5},
                                    {1e300, .5, .5}})
    EXPECT_FALSE(lattice.cell_at(x).has_value()) << x;
}
