// Counts of cells in boxes, and the largest boxes in a set of cells, against counting.
#include "geometry/maximal_boxes.h"
#include "geometry/for_each_index.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

using namespace plumbline;
using namespace plumbline::geometry;

namespace
{
  using Index = std::array<int, 3>;

  std::vector<char> random_cells(const Index &n, double share)
  {
    static std::mt19937 random(5);
    std::bernoulli_distribution is_inside(share);
    std::vector<char> cells(static_cast<std::size_t>(n[0]) * n[1] * n[2]);
    for (char &cell : cells)
      cell = is_inside(random) ? 1 : 0;
    return cells;
  }

  std::size_t count(const std::vector<char> &cells, const Index &n, const CubeRange &range)
  {
    std::size_t result = 0;
    for_each_index({}, n,
                   [&](const Index &at)
                   {
                     for (unsigned int d = 0; d < 3; ++d)
                       if (at[d] < range.lower[d] || at[d] >= range.upper[d])
                         return;
                     result += cells[at[0] + n[0] * (at[1] + n[1] * at[2])];
                   });
    return result;
  }

  bool contains(const CubeRange &big, const CubeRange &small)
  {
    for (unsigned int d = 0; d < 3; ++d)
      if (small.lower[d] < big.lower[d] || small.upper[d] > big.upper[d])
        return false;
    return true;
  }
} // namespace

TEST(CellCounts, agree_with_brute_force)
{
  const Index n = {4, 3, 5};
  const auto cells = random_cells(n, .6);
  const CellCounts counts(cells, n);
  for_each_index({-1, -1, -1}, {5, 4, 6},
                 [&](const Index &lower)
                 {
                   for_each_index(
                       lower, {6, 5, 7},
                       [&](const Index &upper) {
                         EXPECT_EQ(counts.in({lower, upper}), count(cells, n, {lower, upper}));
                       });
                 });
}

TEST(MaximalBoxes, are_all_that_fit_and_no_smaller_ones)
{
  const Index n = {4, 3, 3};
  for (const double share : {.5, .8, .95})
  {
    const auto cells = random_cells(n, share);
    std::vector<CubeRange> filled, expected;
    for_each_index({}, n,
                   [&](const Index &lower)
                   {
                     for_each_index({lower[0] + 1, lower[1] + 1, lower[2] + 1},
                                    {n[0] + 1, n[1] + 1, n[2] + 1},
                                    [&](const Index &upper)
                                    {
                                      std::size_t volume = 1;
                                      for (unsigned int d = 0; d < 3; ++d)
                                        volume *= upper[d] - lower[d];
                                      if (count(cells, n, {lower, upper}) == volume)
                                        filled.push_back({lower, upper});
                                    });
                   });
    for (const CubeRange &one : filled)
      if (std::count_if(filled.begin(), filled.end(),
                        [&](const CubeRange &other) { return contains(other, one); }) == 1)
        expected.push_back(one);
    const auto found = maximal_boxes(cells, n);
    EXPECT_EQ(found.size(), expected.size());
    for (const CubeRange &one : found)
      EXPECT_EQ(std::count_if(expected.begin(), expected.end(),
                              [&](const CubeRange &other)
                              { return contains(one, other) && contains(other, one); }),
                1);
  }
}
