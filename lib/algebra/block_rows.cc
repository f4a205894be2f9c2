#include "algebra/block_rows.h"

#include "algebra/simd.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace plumbline::algebra
{
  namespace
  {
    /// Rows of one number of components.
    struct Rows
    {
      const std::size_t *start;
      const unsigned int *column;
      const double *diagonal, *value;
    };

    template <unsigned int n>
    [[gnu::always_inline]] inline std::array<double, n> times(const double *block, const double *x)
    {
      std::array<double, n> y{};
      for (unsigned int c = 0; c < n; ++c)
        for (unsigned int d = 0; d < n; ++d)
          y[c] += block[n * c + d] * x[d];
      return y;
    }

    template <unsigned int n>
    [[gnu::always_inline]] inline void sum_directed(const Rows &rows, const double *x, double *y,
                                                    std::size_t from, std::size_t to)
    {
      for (std::size_t i = from; i < to; ++i)
      {
        auto sum = times<n>(rows.diagonal + n * n * i, x + n * i);
        const double *g = rows.value + n * rows.start[i];
        for (std::size_t k = rows.start[i]; k < rows.start[i + 1]; ++k, g += n)
        {
          const double *const other = x + n * static_cast<std::size_t>(rows.column[k]);
          double along = 0;
          for (unsigned int c = 0; c < n; ++c)
            along += g[c] * other[c];
          for (unsigned int c = 0; c < n; ++c)
            sum[c] -= g[c] * along;
        }
        std::copy(sum.begin(), sum.end(), y + n * i);
      }
    }

    template <unsigned int n>
    [[gnu::always_inline]] inline void sum_blocks(const Rows &rows, const double *x, double *y,
                                                  std::size_t from, std::size_t to)
    {
      for (std::size_t i = from; i < to; ++i)
      {
        auto sum = times<n>(rows.diagonal + n * n * i, x + n * i);
        const double *block = rows.value + n * n * rows.start[i];
        for (std::size_t k = rows.start[i]; k < rows.start[i + 1]; ++k, block += n * n)
        {
          const auto part = times<n>(block, x + n * static_cast<std::size_t>(rows.column[k]));
          for (unsigned int c = 0; c < n; ++c)
            sum[c] += part[c];
        }
        std::copy(sum.begin(), sum.end(), y + n * i);
      }
    }

    PLUMBLINE_VECTOR_CLONES void sum(const Rows &rows, unsigned int n, bool are_directed,
                                     const double *x, double *y, std::size_t from, std::size_t to)
    {
      if (n == 2)
        are_directed ? sum_directed<2>(rows, x, y, from, to) : sum_blocks<2>(rows, x, y, from, to);
      else
        are_directed ? sum_directed<3>(rows, x, y, from, to) : sum_blocks<3>(rows, x, y, from, to);
    }

    /// g of a block -g⊗g.
    /// @return  it is one
    bool find_direction(const double *block, unsigned int n, double *g)
    {
      unsigned int p = 0;
      for (unsigned int c = 1; c < n; ++c)
        if (block[(n + 1) * c] < block[(n + 1) * p])
          p = c;
      const double largest = -block[(n + 1) * p];
      if (largest < 0)
        return false;
      for (unsigned int c = 0; c < n; ++c)
        g[c] = largest == 0 ? 0 : -block[n * p + c] / std::sqrt(largest);
      constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();
      for (unsigned int c = 0; c < n; ++c)
        for (unsigned int d = 0; d < n; ++d)
          if (!(std::abs(block[n * c + d] + g[c] * g[d]) <= rounding * largest))
            return false;
      return true;
    }
  } // namespace

  std::optional<BlockRows> BlockRows::make(const CsrMatrix &rows, unsigned int n_components)
  {
    const std::size_t n = n_components, n_rows = rows.n_rows();
    if ((n != 2 && n != 3) || n_rows % n != 0)
      return {};
    BlockRows result;
    result.n_components_ = n_components;
    result.column_start_ = {0};
    result.value_.reserve(rows.value.size());
    for (std::size_t i = 0; i < n_rows / n; ++i)
    {
      const std::size_t first = rows.start[n * i], width = rows.start[n * i + 1] - first;
      bool has_own = false;
      for (std::size_t c = 0; c < n; ++c)
        if (rows.start[n * i + c + 1] - rows.start[n * i + c] != width || width % n != 0)
          return {};
      for (std::size_t k = 0; k < width; k += n)
      {
        const unsigned int node = rows.column[first + k] / n_components;
        std::vector<double> &to = node == i ? result.diagonal_ : result.value_;
        for (std::size_t c = 0; c < n; ++c)
          for (std::size_t d = 0; d < n; ++d)
          {
            if (rows.column[first + c * width + k + d] != n_components * node + d)
              return {};
            to.push_back(rows.value[first + c * width + k + d]);
          }
        if (node == i)
          has_own = true;
        else
          result.column_.push_back(node);
      }
      if (!has_own)
        return {};
      result.column_start_.push_back(result.column_.size());
    }
    result.are_directed_ = result.take_directions();
    return result;
  }

  bool BlockRows::take_directions()
  {
    const std::size_t size = static_cast<std::size_t>(n_components_) * n_components_;
    std::vector<double> directions(n_bonds() * n_components_);
    for (std::size_t k = 0; k < n_bonds(); ++k)
      if (!find_direction(value_.data() + k * size, n_components_,
                          directions.data() + k * n_components_))
        return false;
    value_ = std::move(directions);
    return true;
  }

  void BlockRows::vmult(const double *x, double *y, std::size_t from, std::size_t to) const
  {
    sum({column_start_.data(), column_.data(), diagonal_.data(), value_.data()}, n_components_,
        are_directed_, x, y, from, to);
  }
} // namespace plumbline::algebra
