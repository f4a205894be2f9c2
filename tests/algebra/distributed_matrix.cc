// Products of rows that ranks share, as blocks of 2 x 2 or entry by entry, against plain sums.
#include "algebra/distributed_matrix.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
  using namespace plumbline;
  using algebra::CsrMatrix;
  using algebra::DistributedMatrix;

  /// Rows of pairs of unknowns, the i-th pair coupled to i % 12 others; each rank gives its
  /// own.
  CsrMatrix coupled_pairs(unsigned int n_pairs, const algebra::OwnedRanges &ranges)
  {
    CsrMatrix rows;
    rows.start.assign(1, 0);
    for (unsigned int row = 0; row < 2 * n_pairs; ++row)
    {
      const bool is_own = row >= ranges.own_first && row < ranges.own_first + ranges.own_size;
      for (unsigned int k = 0; is_own && k < row / 2 % 12; ++k)
        for (const unsigned int c : {0u, 1u})
        {
          rows.column.push_back(2 * (k * (n_pairs / 12) + k % 2) + c);
          rows.value.push_back(std::sin(1 + 3. * row + rows.column.back()));
        }
      rows.start.push_back(rows.column.size());
    }
    return rows;
  }

  void expect_products(const CsrMatrix &rows, const algebra::OwnedRanges &ranges,
                       std::size_t first_row = 0)
  {
    const DistributedMatrix shared(rows, ranges);
    DistributedMatrix::Vector x(ranges.own(), ranges.communicator.mpi), y(x);
    for (std::size_t i = 0; i < ranges.own_size; ++i)
      x.begin()[i] = std::cos(static_cast<double>(ranges.own_first + i));
    y = 7;
    shared.vmult(y, x, first_row);
    for (std::size_t i = 0; i < ranges.own_size; ++i)
    {
      const std::size_t row = ranges.own_first + i;
      double sum = 0;
      for (std::size_t k = rows.start[row]; k < rows.start[row + 1]; ++k)
        sum += rows.value[k] * std::cos(static_cast<double>(rows.column[k]));
      EXPECT_NEAR(y.begin()[i], row < first_row ? 7 : sum, 1e-14) << row;
    }
  }
} // namespace

TEST(DistributedMatrix, MultiplyBlocksAsTheyMultiplyEntries)
{
  constexpr unsigned int n_pairs = 60;
  const algebra::OwnedRanges ranges(2 * n_pairs, 2, base::Communicator::all());
  CsrMatrix rows = coupled_pairs(n_pairs, ranges);
  expect_products(rows, ranges);
  expect_products(rows, ranges, 31);       // rows that stay as they are
  for (unsigned int &column : rows.column) // no pair begins at an even column
    column = (column + 1) % (2 * n_pairs);
  expect_products(rows, ranges);
}

TEST(DistributedMatrix, SumsRowsOnTheirOwnersAndKeepsThemWithoutACopy)
{
  const base::Communicator all = base::Communicator::all();
  constexpr unsigned int n_rows = 50;
  const algebra::OwnedRanges ranges(n_rows, 1, all);
  CsrMatrix rows; // of every rank, those of others, too: rank r has entries at multiples of r + 1
  rows.start.assign(1, 0);
  for (unsigned int row = 0; row < n_rows; ++row)
  {
    for (unsigned int column = 0; column < n_rows; column += all.rank() + 1)
    {
      rows.column.push_back(column);
      rows.value.push_back(1 + all.rank() + row * column);
    }
    rows.start.push_back(rows.column.size());
  }
  const CsrMatrix sum = algebra::sum_own_rows(rows, ranges);
  ASSERT_EQ(sum.n_rows(), n_rows);
  for (unsigned int row = 0; row < n_rows; ++row)
  {
    const bool is_own = row >= ranges.own_first && row < ranges.own_first + ranges.own_size;
    ASSERT_EQ(sum.start[row + 1] - sum.start[row], is_own ? n_rows : 0) << row;
    for (unsigned int column = 0; is_own && column < n_rows; ++column)
    {
      double expected = 0;
      for (unsigned int rank = 0; rank < all.n_ranks(); ++rank)
        if (column % (rank + 1) == 0)
          expected += 1 + rank + row * column;
      EXPECT_EQ(sum.column[sum.start[row] + column], column);
      EXPECT_EQ(sum.value[sum.start[row] + column], expected) << row << ", " << column;
    }
  }
  const DistributedMatrix kept(sum, ranges), summed(rows, ranges);
  EXPECT_EQ(kept.own().value.data(), sum.value.data());
  ASSERT_EQ(summed.own().value.size(), kept.own().value.size());
  for (std::size_t k = 0; k < sum.value.size(); ++k)
    EXPECT_EQ(summed.own().value[k], sum.value[k]);
}
