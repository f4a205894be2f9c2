#include "algebra/shared_rows.h"

#include <deal.II/base/mpi.h>
#include <deal.II/base/parallel.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace plumbline::algebra
{
  namespace
  {
    using base::Team;

    /// Every rank sends pieces of its data to the others.
    /// @param out, out_from  sizes and places of the pieces in data, by receiver
    /// @param in             sizes of the pieces to receive, by sender
    template <class T>
    std::vector<T> exchange(const std::vector<T> &data, const std::vector<int> &out,
                            const std::vector<int> &out_from, const std::vector<int> &in,
                            const Team &team)
    {
      const auto type = dealii::Utilities::MPI::mpi_type_id_for_type<T>;
      std::vector<int> in_from(in.size());
      std::exclusive_scan(in.begin(), in.end(), in_from.begin(), 0);
      std::vector<T> received(in_from.back() + in.back());
      MPI_Alltoallv(data.data(), out.data(), out_from.data(), type, received.data(), in.data(),
                    in_from.data(), type, team.communicator);
      return received;
    }

    /// What all ranks give to this rank's share: shape (n_ranks × own_size) rows, by sender.
    Rows from_all(const Rows &rows, const Shares &shares)
    {
      const std::size_t n_ranks = shares.first.size();
      std::vector<std::size_t> length(rows.n_rows());
      for (std::size_t row = 0; row < length.size(); ++row)
        length[row] = rows.start[row + 1] - rows.start[row];
      std::vector<int> out(n_ranks), out_from(n_ranks), in(n_ranks);
      for (std::size_t r = 0; r < n_ranks; ++r)
      {
        out_from[r] = static_cast<int>(rows.start[shares.first[r]]);
        out[r] = static_cast<int>(rows.start[shares.first[r] + shares.size[r]]) - out_from[r];
      }
      MPI_Alltoall(out.data(), 1, MPI_INT, in.data(), 1, MPI_INT, shares.team.communicator);
      Rows received;
      received.start =
          exchange(length, shares.size, shares.first,
                   std::vector<int>(n_ranks, static_cast<int>(shares.own_size)), shares.team);
      received.start.insert(received.start.begin(), 0);
      std::partial_sum(received.start.begin(), received.start.end(), received.start.begin());
      received.column = exchange(rows.column, out, out_from, in, shares.team);
      received.value = exchange(rows.value, out, out_from, in, shares.team);
      return received;
    }

    /// Rows first ... first + n - 1 alone.
    Rows slice(const Rows &rows, std::size_t first, std::size_t n)
    {
      const auto at = [](const auto &data, std::size_t i)
      { return data.begin() + static_cast<std::ptrdiff_t>(i); };
      const std::size_t from = rows.start[first], to = rows.start[first + n];
      Rows result{{at(rows.start, first), at(rows.start, first + n + 1)},
                  {at(rows.column, from), at(rows.column, to)},
                  {at(rows.value, from), at(rows.value, to)}};
      for (std::size_t &start : result.start)
        start -= from;
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
  } // namespace

  Shares::Shares(std::size_t n, unsigned int n_components, const Team &team) : team(team)
  {
    for (unsigned int rank = 0; rank < team.n_ranks(); ++rank)
    {
      const auto [begin, end] = team.share(n / n_components, rank);
      first.push_back(static_cast<int>(begin * n_components));
      size.push_back(static_cast<int>((end - begin) * n_components));
    }
    own_first = first[team.rank()];
    own_size = size[team.rank()];
  }

  Shares::Shares(const Shares &others, std::size_t n) : Shares(others)
  {
    const int end = static_cast<int>(n);
    for (std::size_t rank = 0; rank < first.size(); ++rank)
    {
      first[rank] = std::min(first[rank], end);
      size[rank] = std::min(others.first[rank] + others.size[rank], end) - first[rank];
      size[rank] = std::max(size[rank], 0);
    }
    own_first = first[team.rank()];
    own_size = size[team.rank()];
  }

  dealii::IndexSet Shares::own() const
  {
    dealii::IndexSet rows(size_of_all());
    rows.add_range(own_first, own_first + own_size);
    return rows;
  }

  SharedRows::SharedRows(const Rows &rows, const Shares &shares) : shares_(shares), given_(rows)
  {
    const std::size_t n_ranks = shares.first.size(), n = shares.own_size;
    if (n_ranks == 1)
      return;
    const Rows all = from_all(rows, shares);
    sum_ = slice(all, 0, n);
    for (std::size_t rank = 1; rank < n_ranks; ++rank)
      sum_ = add(sum_, slice(all, rank * n, n));
  }

  void SharedRows::vmult(Vector &y, const Vector &x, std::size_t first_row) const
  {
    const double *all = x.begin();
    std::vector<double> gathered;
    if (shares_.first.size() > 1)
    {
      gathered.resize(x.size());
      MPI_Allgatherv(x.begin(), static_cast<int>(shares_.own_size), MPI_DOUBLE, gathered.data(),
                     shares_.size.data(), shares_.first.data(), MPI_DOUBLE,
                     shares_.team.communicator);
      all = gathered.data();
    }
    const Rows &rows = own();
    constexpr unsigned int grain = 128;
    const std::size_t begin = std::max(first_row, shares_.own_first) - shares_.own_first;
    dealii::parallel::apply_to_subranges(
        std::min(begin, shares_.own_size), shares_.own_size,
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

  double SharedRows::asymmetry() const
  {
    const Rows &rows = own();
    const std::size_t n = shares_.size_of_all();
    Rows transposed{std::vector<std::size_t>(n + 1), std::vector<unsigned int>(rows.column.size()),
                    std::vector<double>(rows.value.size())}; // this rank's part of -Aᵀ
    for (const unsigned int column : rows.column)
      ++transposed.start[column + 1];
    std::partial_sum(transposed.start.begin(), transposed.start.end(), transposed.start.begin());
    auto next = transposed.start;
    for (std::size_t row = 0; row < rows.n_rows(); ++row)
      for (std::size_t e = rows.start[row]; e < rows.start[row + 1]; ++e)
      {
        const std::size_t place = next[rows.column[e]]++;
        transposed.column[place] = static_cast<unsigned int>(shares_.own_first + row);
        transposed.value[place] = -rows.value[e];
      }
    const auto largest = [&](const std::vector<double> &values)
    {
      double result = 0;
      for (const double value : values)
        result = std::max(result, std::abs(value));
      return shares_.team.largest(result);
    };
    const SharedRows other(transposed, shares_);
    return largest(add(rows, other.own()).value) / largest(rows.value);
  }

  dealii::TrilinosWrappers::SparseMatrix to_trilinos(const Rows &own, const Shares &shares)
  {
    std::vector<unsigned int> length(own.n_rows() + 1); // one more, deal.II looks at the first
    for (std::size_t i = 0; i < own.n_rows(); ++i)
      length[i] = own.start[i + 1] - own.start[i];
    dealii::TrilinosWrappers::SparseMatrix result(shares.own(), shares.team.communicator, length);
    for (std::size_t i = 0; i < own.n_rows(); ++i)
      result.set(shares.own_first + i, length[i], &own.column[own.start[i]],
                 &own.value[own.start[i]]);
    result.compress(dealii::VectorOperation::insert);
    return result;
  }
} // namespace plumbline::algebra
