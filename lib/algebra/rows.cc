#include "algebra/rows.h"

#include <algorithm>

namespace plumbline::algebra
{
  Rows add(const Rows &a, const Rows &b)
  {
    Rows result;
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
} // namespace plumbline::algebra
