#include "algebra/distributed_matrix.h"

#include "algebra/simd.h"

#include <deal.II/base/mpi.h>
#include <deal.II/base/parallel.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace plumbline::algebra
{
  namespace
  {
    using base::Communicator;

    /// Every rank sends pieces of its data to the others.
    /// @param out, out_from  sizes and places of the pieces in data, by receiver
    /// @param in             sizes of the pieces to receive, by sender
    template <class T>
    std::vector<T> exchange(const std::vector<T> &data, const std::vector<int> &out,
                            const std::vector<int> &out_from, const std::vector<int> &in,
                            const Communicator &communicator)
    {
      const auto type = dealii::Utilities::MPI::mpi_type_id_for_type<T>;
      std::vector<int> in_from(in.size());
      std::exclusive_scan(in.begin(), in.end(), in_from.begin(), 0);
      std::vector<T> received(in_from.back() + in.back());
      MPI_Alltoallv(data.data(), out.data(), out_from.data(), type, received.data(), in.data(),
                    in_from.data(), type, communicator.mpi);
      return received;
    }

    /// What the others give to this rank's share: shape (n_ranks × own_size) rows, by sender.
    CsrMatrix from_others(const CsrMatrix &rows, const OwnedRanges &ranges)
    {
      const std::size_t n_ranks = ranges.first.size(), self = ranges.communicator.rank();
      std::vector<std::size_t> length(rows.n_rows());
      for (std::size_t row = 0; row < length.size(); ++row)
        length[row] = rows.start[row + 1] - rows.start[row];
      std::fill_n(length.begin() + static_cast<std::ptrdiff_t>(ranges.own_first), ranges.own_size,
                  0);
      std::vector<int> out(n_ranks), out_from(n_ranks), in(n_ranks);
      for (std::size_t r = 0; r < n_ranks; ++r)
      {
        const std::size_t from = rows.start[ranges.first[r]],
                          to = rows.start[ranges.first[r] + ranges.size[r]];
        out_from[r] = static_cast<int>(from);
        out[r] = r == self ? 0 : static_cast<int>(to - from);
      }
      MPI_Alltoall(out.data(), 1, MPI_INT, in.data(), 1, MPI_INT, ranges.communicator.mpi);
      CsrMatrix received;
      received.start = exchange(length, ranges.size, ranges.first,
                                std::vector<int>(n_ranks, static_cast<int>(ranges.own_size)),
                                ranges.communicator);
      received.start.insert(received.start.begin(), 0);
      std::partial_sum(received.start.begin(), received.start.end(), received.start.begin());
      received.column = exchange(rows.column, out, out_from, in, ranges.communicator);
      received.value = exchange(rows.value, out, out_from, in, ranges.communicator);
      return received;
    }

    /// Adds one row of a matrix to the last row of another, which begins at `begin`.
    void add_to_last(const CsrMatrix &from, std::size_t row, std::size_t begin, CsrMatrix &sum)
    {
      std::size_t k = from.start[row];
      const std::size_t end = from.start[row + 1];
      if (k == end)
        return;
      const auto first = static_cast<std::ptrdiff_t>(begin);
      const std::vector<unsigned int> column(sum.column.begin() + first, sum.column.end());
      const std::vector<double> value(sum.value.begin() + first, sum.value.end());
      sum.column.resize(begin);
      sum.value.resize(begin);
      for (std::size_t i = 0; i < column.size() || k < end;)
      {
        const bool has_old = i < column.size() && (k == end || column[i] <= from.column[k]),
                   has_new = k < end && (i == column.size() || from.column[k] <= column[i]);
        sum.column.push_back(has_old ? column[i] : from.column[k]);
        sum.value.push_back((has_old ? value[i] : 0) + (has_new ? from.value[k] : 0));
        i += has_old ? 1 : 0;
        k += has_new ? 1 : 0;
      }
    }

    /// Whether all entries are in rows of this rank.
    bool is_own(const CsrMatrix &rows, const OwnedRanges &ranges)
    {
      return rows.start[ranges.own_first] == 0 &&
             rows.start[ranges.own_first + ranges.own_size] == rows.start.back();
    }

    /// max |a_ij + b_ij|.
    double largest_of_sum(const CsrView &a, const CsrView &b)
    {
      double result = 0;
      for (std::size_t row = 0; row < a.n_rows(); ++row)
      {
        std::size_t k = a.start[row], l = b.start[row];
        const std::size_t end = a.start[row + 1], end_of_b = b.start[row + 1];
        while (k < end || l < end_of_b)
        {
          const bool has_a = k < end && (l == end_of_b || a.column[k] <= b.column[l]),
                     has_b = l < end_of_b && (k == end || b.column[l] <= a.column[k]);
          result = std::max(result, std::abs((has_a ? a.value[k] : 0) + (has_b ? b.value[l] : 0)));
          k += has_a ? 1 : 0;
          l += has_b ? 1 : 0;
        }
      }
      return result;
    }

    /// Σ value[i] x[column[i]] in four sums that do not wait for each other.
    double product(const double *value, const unsigned int *column, std::size_t n, const double *x)
    {
      double sum[4] = {};
      std::size_t i = 0;
      for (; i + 4 <= n; i += 4)
        for (unsigned int k = 0; k < 4; ++k)
          sum[k] += value[i + k] * x[column[i + k]];
      for (; i < n; ++i)
        sum[0] += value[i] * x[column[i]];
      return (sum[0] + sum[1]) + (sum[2] + sum[3]);
    }
    /// Both rows of n blocks of 2 x 2, in sums that do not wait for each other.
    PLUMBLINE_VECTOR_CLONES
    void multiply(const double *upper, const double *lower, const unsigned int *column,
                  std::size_t n, const double *x, double *y)
    {
      Simd sum[2][2] = {};
      const auto add = [&](std::size_t k, unsigned int to) __attribute__((always_inline))
      {
        const double *const a = x + 2 * column[k], *const b = x + 2 * column[k + 1];
        const Simd values = {a[0], a[1], b[0], b[1]};
        sum[0][to] += load(upper + 2 * k) * values;
        sum[1][to] += load(lower + 2 * k) * values;
      };
      std::size_t k = 0;
      for (; k + 4 <= n; k += 4)
      {
        add(k, 0);
        add(k + 2, 1);
      }
      for (unsigned int c = 0; c < 2; ++c)
      {
        const Simd all = sum[c][0] + sum[c][1];
        y[c] = (all[0] + all[1]) + (all[2] + all[3]);
      }
      for (; k < n; ++k)
        for (unsigned int d = 0; d < 2; ++d)
        {
          y[0] += upper[2 * k + d] * x[2 * column[k] + d];
          y[1] += lower[2 * k + d] * x[2 * column[k] + d];
        }
    }

    /// Half the even columns of every second row if the columns of rows 2 i and 2 i + 1 are the
    /// same pairs 2 j, 2 j + 1; else empty.
    std::vector<unsigned int> block_columns(const CsrView &rows)
    {
      std::vector<unsigned int> columns;
      if (rows.n_rows() % 2 != 0)
        return columns;
      columns.reserve(rows.column.size() / 4);
      for (std::size_t row = 0; row < rows.n_rows(); row += 2)
      {
        const unsigned int *const own = rows.column.data() + rows.start[row],
                                  *const next = rows.column.data() + rows.start[row + 1];
        const std::size_t n = rows.start[row + 1] - rows.start[row];
        if (n % 2 != 0 || rows.start[row + 2] - rows.start[row + 1] != n ||
            !std::equal(own, next, next))
          return {};
        for (std::size_t k = 0; k < n; k += 2)
        {
          if (own[k] % 2 != 0 || own[k + 1] != own[k] + 1)
            return {};
          columns.push_back(own[k] / 2);
        }
      }
      return columns;
    }
  } // namespace

  OwnedRanges::OwnedRanges(std::size_t n, unsigned int n_components,
                           const Communicator &communicator)
      : communicator(communicator)
  {
    for (unsigned int rank = 0; rank < communicator.n_ranks(); ++rank)
    {
      const auto [begin, end] = communicator.owned_range(n / n_components, rank);
      first.push_back(static_cast<int>(begin * n_components));
      size.push_back(static_cast<int>((end - begin) * n_components));
    }
    own_first = first[communicator.rank()];
    own_size = size[communicator.rank()];
  }

  OwnedRanges::OwnedRanges(const OwnedRanges &others, std::size_t n) : OwnedRanges(others)
  {
    const int end = static_cast<int>(n);
    for (std::size_t rank = 0; rank < first.size(); ++rank)
    {
      first[rank] = std::min(first[rank], end);
      size[rank] = std::min(others.first[rank] + others.size[rank], end) - first[rank];
      size[rank] = std::max(size[rank], 0);
    }
    own_first = first[communicator.rank()];
    own_size = size[communicator.rank()];
  }

  dealii::IndexSet OwnedRanges::own() const
  {
    dealii::IndexSet rows(size_of_all());
    rows.add_range(own_first, own_first + own_size);
    return rows;
  }

  CsrView::CsrView(const CsrMatrix &rows) : CsrView(rows, 0, rows.n_rows()) {}

  CsrView::CsrView(const CsrMatrix &rows, std::size_t first, std::size_t n)
  {
    if (rows.start.empty())
      return;
    Assert(rows.start[first] == 0, dealii::ExcInternalError());
    const std::size_t n_entries = rows.start[first + n];
    start = {rows.start.data() + first, n + 1};
    column = {rows.column.data(), n_entries};
    value = {rows.value.data(), n_entries};
  }

  CsrMatrix sum_own_rows(const CsrMatrix &rows, const OwnedRanges &ranges)
  {
    const std::size_t n_ranks = ranges.first.size(), n = ranges.own_size,
                      self = ranges.communicator.rank();
    const CsrMatrix others = from_others(rows, ranges);
    const std::size_t most =
        rows.start[ranges.own_first + n] - rows.start[ranges.own_first] + others.column.size();
    CsrMatrix sum;
    sum.column.reserve(most);
    sum.value.reserve(most);
    sum.start.assign(ranges.own_first + 1, 0);
    for (std::size_t row = 0; row < n; ++row)
    {
      const std::size_t begin = sum.start.back();
      for (std::size_t rank = 0; rank < n_ranks; ++rank) // in this order on every rank
        if (rank == self)
          add_to_last(rows, ranges.own_first + row, begin, sum);
        else
          add_to_last(others, rank * n + row, begin, sum);
      sum.start.push_back(sum.column.size());
    }
    sum.start.resize(rows.start.size(), sum.column.size());
    return sum;
  }

  DistributedMatrix::DistributedMatrix(const CsrMatrix &rows, const OwnedRanges &ranges)
      : ranges_(ranges)
  {
    const bool is_sum = !ranges.communicator.any(!is_own(rows, ranges));
    if (!is_sum)
      sum_ = sum_own_rows(rows, ranges);
    own_ = CsrView(is_sum ? rows : sum_, ranges.own_first, ranges.own_size);
    block_column_ = block_columns(own());
    if (ranges.first.size() > 1)
      import_columns();
  }

  /// Finds which values of x come from other ranks.
  void DistributedMatrix::import_columns()
  {
    const std::size_t n = ranges_.size_of_all(), begin = ranges_.own_first,
                      end = begin + ranges_.own_size;
    std::vector<bool> is_imported(n, false);
    for (const unsigned int column : own_.column)
      is_imported[column] = column < begin || column >= end;
    dealii::IndexSet imported(n);
    for (std::size_t column = 0; column < n; ++column)
      if (is_imported[column])
        imported.add_index(column);
    imported.compress();
    columns_ = std::make_shared<const dealii::Utilities::MPI::Partitioner>(
        ranges_.own(), imported, ranges_.communicator.mpi);
    values_.reset(new double[n]); // pages that are not written take no memory
  }

  /// Indexed by columns, of which those of own rows have values.
  const double *DistributedMatrix::values_at_columns(const Vector &x) const
  {
    if (!columns_)
      return x.begin();
    std::vector<double> imported(columns_->n_ghost_indices()), buffer(columns_->n_import_indices());
    std::vector<MPI_Request> requests;
    columns_->export_to_ghosted_array_start<double>(0, {x.begin(), ranges_.own_size},
                                                    dealii::make_array_view(buffer),
                                                    dealii::make_array_view(imported), requests);
    std::copy_n(x.begin(), ranges_.own_size, values_.get() + ranges_.own_first);
    columns_->export_to_ghosted_array_finish<double>(dealii::make_array_view(imported), requests);
    auto value = imported.begin();
    for (const auto column : columns_->ghost_indices())
      values_[column] = *value++;
    return values_.get();
  }

  /// Rows 2 first ... 2 last - 1.
  void DistributedMatrix::multiply_blocks(std::size_t first, std::size_t last, const double *x,
                                          double *y) const
  {
    const CsrView &rows = own();
    for (std::size_t pair = first; pair < last; ++pair)
    {
      const std::size_t start = rows.start[2 * pair], next = rows.start[2 * pair + 1];
      multiply(rows.value.data() + start, rows.value.data() + next,
               block_column_.data() + start / 4, (next - start) / 2, x, y + 2 * pair);
    }
  }

  void DistributedMatrix::vmult(Vector &y, const Vector &x, std::size_t first_row) const
  {
    const double *const all = values_at_columns(x);
    const CsrView &rows = own();
    constexpr unsigned int grain = 128;
    const std::size_t begin = std::max(first_row, ranges_.own_first) - ranges_.own_first;
    if (!block_column_.empty() && begin == 0)
    {
      dealii::parallel::apply_to_subranges(
          static_cast<std::size_t>(0), ranges_.own_size / 2,
          [&, to = y.begin()](std::size_t first, std::size_t last)
          { multiply_blocks(first, last, all, to); },
          grain);
      return;
    }
    dealii::parallel::apply_to_subranges(
        std::min(begin, ranges_.own_size), ranges_.own_size,
        [&, to = y.begin()](std::size_t first, std::size_t last)
        {
          for (std::size_t row = first; row < last; ++row)
          {
            const std::size_t start = rows.start[row];
            to[row] = product(rows.value.data() + start, rows.column.data() + start,
                              rows.start[row + 1] - start, all);
          }
        },
        grain);
  }

  double DistributedMatrix::asymmetry() const
  {
    const CsrView &rows = own();
    const std::size_t n = ranges_.size_of_all();
    CsrMatrix transposed{std::vector<std::size_t>(n + 1),
                         std::vector<unsigned int>(rows.column.size()),
                         std::vector<double>(rows.value.size())}; // this rank's part of -Aᵀ
    for (const unsigned int column : rows.column)
      ++transposed.start[column + 1];
    std::partial_sum(transposed.start.begin(), transposed.start.end(), transposed.start.begin());
    auto next = transposed.start;
    for (std::size_t row = 0; row < rows.n_rows(); ++row)
      for (std::size_t e = rows.start[row]; e < rows.start[row + 1]; ++e)
      {
        const std::size_t place = next[rows.column[e]]++;
        transposed.column[place] = static_cast<unsigned int>(ranges_.own_first + row);
        transposed.value[place] = -rows.value[e];
      }
    double largest = 0;
    for (const double value : rows.value)
      largest = std::max(largest, std::abs(value));
    const DistributedMatrix other(transposed, ranges_);
    return ranges_.communicator.largest(largest_of_sum(rows, other.own())) /
           ranges_.communicator.largest(largest);
  }

  double DistributedMatrix::largest_row_sum() const
  {
    const CsrView &rows = own();
    double largest = 0;
    for (std::size_t row = 0; row < rows.n_rows(); ++row)
    {
      double sum = 0;
      for (std::size_t e = rows.start[row]; e < rows.start[row + 1]; ++e)
        sum += std::abs(rows.value[e]);
      largest = std::max(largest, sum);
    }
    return ranges_.communicator.largest(largest);
  }

  dealii::TrilinosWrappers::SparseMatrix to_trilinos(const CsrView &own, const OwnedRanges &ranges)
  {
    std::vector<unsigned int> length(own.n_rows() + 1); // one more, deal.II looks at the first
    for (std::size_t i = 0; i < own.n_rows(); ++i)
      length[i] = own.start[i + 1] - own.start[i];
    dealii::TrilinosWrappers::SparseMatrix result(ranges.own(), ranges.communicator.mpi, length);
    for (std::size_t i = 0; i < own.n_rows(); ++i)
      result.set(ranges.own_first + i, length[i], &own.column[own.start[i]],
                 &own.value[own.start[i]]);
    result.compress(dealii::VectorOperation::insert);
    return result;
  }
} // namespace plumbline::algebra
