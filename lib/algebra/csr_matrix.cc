#include "algebra/csr_matrix.h"

#include <algorithm>
#include <cmath>

namespace plumbline::algebra
{
  CsrMatrix add(const CsrMatrix &a, const CsrMatrix &b)
  {
    CsrMatrix result;
    result.start.assign(1, 0);
    result.column.reserve(std::max(a.column.size(), b.column.size()));
    result.value.reserve(result.column.capacity());
    for (std::size_t row = 0; row < a.n_rows(); ++row)
    {
      std::size_t i = a.start[row], j = b.start[row];
      while (i < a.start[row + 1] || j < b.start[row + 1])
      {
        const bool takes_a =
            j == b.start[row + 1] || (i < a.start[row + 1] && a.column[i] <= b.column[j]);
        const bool takes_b =
            i == a.start[row + 1] || (j < b.start[row + 1] && b.column[j] <= a.column[i]);
        result.column.push_back(takes_a ? a.column[i] : b.column[j]);
        result.value.push_back((takes_a ? a.value[i] : 0) + (takes_b ? b.value[j] : 0));
        i += takes_a ? 1 : 0;
        j += takes_b ? 1 : 0;
      }
      result.start.push_back(result.column.size());
    }
    return result;
  }

  CsrMatrix transpose(const CsrMatrix &rows)
  {
    return transpose(rows, rows.n_rows());
  }

  CsrMatrix transpose(const CsrMatrix &rows, std::size_t n_columns)
  {
    CsrMatrix result;
    result.start.assign(n_columns + 1, 0);
    for (const unsigned int j : rows.column)
      ++result.start[j + 1];
    for (std::size_t j = 0; j < n_columns; ++j)
      result.start[j + 1] += result.start[j];
    result.column.resize(rows.column.size());
    result.value.resize(rows.value.size());
    auto next = result.start;
    for (unsigned int i = 0; i < rows.n_rows(); ++i)
      for (std::size_t k = rows.start[i]; k < rows.start[i + 1]; ++k)
      {
        const std::size_t at = next[rows.column[k]]++;
        result.column[at] = i;
        result.value[at] = rows.value[k];
      }
    return result;
  }

  CsrMatrix normal_matrix(const CsrMatrix &C, const std::vector<double> &s, std::size_t n)
  {
    const CsrMatrix of_columns = transpose(C, n);
    std::vector<double> sum(n);
    std::vector<char> is_there(n, 0);
    std::vector<unsigned int> columns; // of one row
    CsrMatrix result;
    result.start.assign(1, 0);
    for (std::size_t i = 0; i < n; ++i)
    {
      columns.clear();
      for (std::size_t t = of_columns.start[i]; t < of_columns.start[i + 1]; ++t)
      {
        const std::size_t row = of_columns.column[t];
        for (std::size_t k = C.start[row]; k < C.start[row + 1]; ++k)
        {
          const unsigned int j = C.column[k];
          if (is_there[j] == 0)
          {
            columns.push_back(j);
            is_there[j] = 1;
            sum[j] = 0;
          }
          sum[j] += s[row] * of_columns.value[t] * C.value[k];
        }
      }
      std::sort(columns.begin(), columns.end());
      for (const unsigned int j : columns)
      {
        result.column.push_back(j);
        result.value.push_back(sum[j]);
        is_there[j] = 0;
      }
      result.start.push_back(result.column.size());
    }
    return result;
  }

  double largest_row_sum(const CsrMatrix &rows)
  {
    double largest = 0;
    for (std::size_t i = 0; i < rows.n_rows(); ++i)
    {
      double sum = 0;
      for (std::size_t k = rows.start[i]; k < rows.start[i + 1]; ++k)
        sum += std::abs(rows.value[k]);
      largest = std::max(largest, sum);
    }
    return largest;
  }
} // namespace plumbline::algebra
