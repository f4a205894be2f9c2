#include "geometry/lattice.h"

#include "base/error.h"

#include <gtest/gtest.h>

using namespace plumbline;
using namespace plumbline::geometry;

namespace
{
  const Box unit{{0, 0}, {1, 1}};
  const Domain l_shape{{unit}, {{{.5, .5}, {1, 1}}}};
  const Domain with_hole{{unit}, {{{.25, .25}, {.75, .5}}}};

  int n_inside(const Lattice &lattice)
  {
    int n = 0;
    for (int j = -3; j < lattice.n_cells()[1] + 3; ++j)
      for (int i = -3; i < lattice.n_cells()[0] + 3; ++i)
        n += lattice.is_inside(i, j) ? 1 : 0;
    return n;
  }

  std::string message(const Domain &domain, double h)
  {
    try
    {
      Lattice(domain, h);
    }
    catch (const InputError &error)
    {
      return error.what();
    }
    return "no error";
  }
} // namespace

TEST(Lattice, cells_have_the_area_of_the_domain)
{
  EXPECT_EQ(n_inside(Lattice({{unit}, {}}, .1)), 100);
  EXPECT_EQ(n_inside(Lattice(l_shape, .125)), 48);
  EXPECT_EQ(n_inside(Lattice(with_hole, .125)), 64 - 8);
  EXPECT_TRUE(Lattice({{unit}, {}}, .1).is_rectangle());
  EXPECT_FALSE(Lattice(l_shape, .125).is_rectangle());
}

TEST(Lattice, says_what_is_wrong_with_a_domain)
{
  EXPECT_NE(message({{unit}, {}}, .3).find("h = 0.3 does not divide the box [0 0; 1 1]"),
            std::string::npos);
  EXPECT_NE(message({{unit}, {}}, -1).find("must be a positive length"), std::string::npos);
  EXPECT_NE(message({{unit}, {unit}}, .5).find("no cell is left"), std::string::npos);
  EXPECT_NE(message({{}, {}}, .5).find("Domain/boxes is empty"), std::string::npos);
}

TEST(NodeSet, counts_free_nodes_of_each_family)
{
  const Lattice lattice(l_shape, .125);
  const NodeSet centres = free_nodes(lattice, {{.5, false, 0}}, 1);
  EXPECT_EQ(centres.n_unknowns(), 48u);
  // vertices with all four cells in Ω: 7 × 7 less the 4 × 4 that touch the notch
  const NodeSet vertices = free_nodes(lattice, {{0, true, 0}}, 2);
  EXPECT_EQ(vertices.n_unknowns(), 2u * (49 - 16));
  EXPECT_TRUE(vertices.free(0, 1, 1));
  EXPECT_FALSE(vertices.free(0, 0, 1));
  EXPECT_FALSE(vertices.free(0, 4, 4));
  EXPECT_FALSE(vertices.free(0, -1, 2));
  EXPECT_EQ(centres.place(0, 3, 4), Point<2>(3.5, 4.5));
}

TEST(NodeSet, refuses_a_domain_without_free_nodes)
{
  EXPECT_THROW(free_nodes(Lattice({{unit}, {}}, 1), {{0, true, 0}}, 1), InputError);
}

TEST(MaximalRectangles, are_one_for_a_box_two_for_an_l_and_four_around_a_hole)
{
  EXPECT_EQ(maximal_rectangles(Lattice({{unit}, {}}, .1)).size(), 1u);
  EXPECT_EQ(maximal_rectangles(Lattice(l_shape, .125)).size(), 2u);
  EXPECT_EQ(maximal_rectangles(Lattice(with_hole, .125)).size(), 4u);
}

TEST(MaximalRectangles, cover_the_domain_and_stay_inside)
{
  const Lattice lattice(
      {{unit, {{1, .25}, {1.5, .5}}}, {{{.25, .25}, {.5, .5}}, {{.75, .75}, {1, 1}}}}, .125);
  const auto rectangles = maximal_rectangles(lattice);
  for (int j = 0; j < lattice.n_cells()[1]; ++j)
    for (int i = 0; i < lattice.n_cells()[0]; ++i)
    {
      bool is_covered = false;
      for (const CellRange &r : rectangles)
        is_covered =
            is_covered || (i >= r.lower[0] && i < r.upper[0] && j >= r.lower[1] && j < r.upper[1]);
      EXPECT_EQ(is_covered, lattice.is_inside(i, j)) << i << ' ' << j;
    }
}
