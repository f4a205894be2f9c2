#pragma once

#include "reference/mesh/edge_pairs.h"
#include "reference/mesh/side_traces.h"

namespace plumbline::reference
{
  /// Σ of a pair of sides for one function of a cell, as a functional of those of the other.
  struct SideFunctional
  {
    std::array<std::array<double, 5>, 3> of_value{};
    std::array<std::array<double, 4>, 2> of_normal{};

    double operator()(const SideTrace &p) const
    {
      double sum = 0;
      for (unsigned int m = 0; 2 * m <= p.degree; ++m)
        for (unsigned int i = 0; i + 2 * m <= p.degree; ++i)
        {
          sum += p.value[m][i] * of_value[m][i];
          if (i + 2 * m < p.degree)
            sum += p.normal[m][i] * of_normal[m][i];
        }
      return sum;
    }
  };

  /// @param degree  of functions that are paired, in all at most: twice that of shapes
  /// @tparam is_outer  the functional is of functions of the outer cell
  template <bool is_outer>
  SideFunctional apply(const SideTrace &q, const EdgeMoments &moments, double sign_p, double sign_q,
                       unsigned int degree)
  {
    // indices of outer functions come first
    const auto at = [](const EdgeMoments::Table &table, unsigned int i, unsigned int j)
    { return is_outer ? table[i][j] : table[j][i]; };
    const auto &of_p = is_outer ? moments.of_x : moments.of_y,
               &of_q = is_outer ? moments.of_y : moments.of_x;
    SideFunctional result;
    for (unsigned int n = 0; 2 * n <= q.degree; ++n)
      for (unsigned int j = 0; j + 2 * n <= q.degree; ++j)
      {
        const double value = sign_q * q.value[n][j];
        const bool has_normal = j + 2 * n < q.degree;
        for (unsigned int m = 0; 2 * (m + n) + j <= degree; ++m)
          for (unsigned int i = 0; 2 * (m + n) + i + j <= degree; ++i)
          {
            const unsigned int k = m + n, left = degree - 2 * k - i - j;
            result.of_value[m][i] += sign_p * value * at(moments.both[k], i, j);
            if (left < 1)
              continue;
            result.of_normal[m][i] -= value * at(of_q[k], i, j);
            if (!has_normal)
              continue;
            result.of_value[m][i] -= sign_p * q.normal[n][j] * at(of_p[k], i, j);
            if (left > 1 && k == 0)
              result.of_normal[m][i] += q.normal[n][j] * at(moments.value, i, j);
          }
      }
    return result;
  }
} // namespace plumbline::reference
