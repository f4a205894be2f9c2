#include "algebra/asymmetry.h"

#include <algorithm>
#include <cmath>

namespace plumbline::algebra
{
  double asymmetry(const CsrMatrix &rows)
  {
    double size = 0, difference = 0;
    for (const double value : rows.value)
      size = std::max(size, std::abs(value));
    const auto look_at = [&](double value) { difference = std::max(difference, std::abs(value)); };
    // the first entry of each row, left of the diagonal, whose partner was not met
    std::vector<std::size_t> next = rows.start;
    const auto pass = [&](std::size_t row, std::size_t before)
    {
      std::size_t &k = next[row];
      for (; k < rows.start[row + 1] && rows.column[k] < before; ++k)
        look_at(rows.value[k]);
      return k < rows.start[row + 1] && rows.column[k] == before;
    };
    for (std::size_t i = 0; i < rows.n_rows(); ++i)
    {
      pass(i, i);
      for (std::size_t k = rows.start[i]; k < rows.start[i + 1]; ++k)
        if (const std::size_t j = rows.column[k]; j > i)
          look_at(rows.value[k] - (pass(j, i) ? rows.value[next[j]++] : 0));
    }
    return size > 0 ? difference / size : 0;
  }
} // namespace plumbline::algebra
