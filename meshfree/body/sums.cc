#include "meshfree/body/sums.h"

#include "algebra/convolution.h"
#include "algebra/simd.h"

#include <deal.II/base/parallel.h>

#include <algorithm>
#include <cstring>

namespace plumbline::meshfree
{
  namespace
  {
    using algebra::Simd, algebra::simd_width, algebra::load;
    constexpr int n_registers = 2, tile = simd_width * n_registers;

    /// One tile of all three sums; the fields stand `block` behind each other.
    template <class Pair>
    PLUMBLINE_VECTOR_CLONES void sum_tile(const double *u, std::size_t block, const Pair *pair,
                                          const Pair *end, double *result)
    {
      Simd sum[3][n_registers] = {};
      for (; pair != end; ++pair)
      {
        const double *const forward = u + pair->shift, *const backward = u - pair->shift;
        for (int l = 0; l < n_registers; ++l)
        {
          Simd even[2], odd[3];
          for (int s = 0; s < 3; ++s)
          {
            const Simd f = load(forward + s * block + l * simd_width),
                       b = load(backward + s * block + l * simd_width);
            if (s < 2)
              even[s] = f + b;
            odd[s] = f - b;
          }
          sum[0][l] += pair->even[0] * even[0] + pair->even[1] * even[1] - pair->odd[0] * odd[2];
          sum[1][l] += pair->even[1] * even[0] + pair->even[2] * even[1] - pair->odd[1] * odd[2];
          sum[2][l] += pair->odd[0] * odd[0] + pair->odd[1] * odd[1];
        }
      }
      std::memcpy(result, sum, sizeof(sum));
    }
  } // namespace

  int reach(const std::vector<Neighbour> &family)
  {
    int result = 0;
    for (const Neighbour &other : family)
      result = std::max({result, std::abs(other.k[0]), std::abs(other.k[1])});
    return result;
  }

  std::vector<double> correlate(const std::vector<Neighbour> &family, std::array<int, 2> n,
                                const std::vector<double> &field,
                                const std::function<double(const Neighbour &)> &weight)
  {
    algebra::Stencil stencil(1, reach(family));
    for (const Neighbour &other : family)
      stencil(0, 0, other.k[0], other.k[1]) = weight(other);
    std::vector<double> result(field.size());
    algebra::Convolution(stencil, n, 0).apply(field.data(), result.data());
    return result;
  }

  algebra::Stencil state_stencil(const std::vector<Neighbour> &family)
  {
    algebra::Stencil stencil(3, reach(family));
    for (const auto &[k, d, weight] : family)
      for (unsigned int a = 0; a < 2; ++a)
      {
        for (unsigned int b = 0; b < 2; ++b)
          stencil(a, b, k[0], k[1]) = weight * d[a] * d[b] / d.norm_square();
        stencil(2, a, k[0], k[1]) = weight * d[a];
        stencil(a, 2, k[0], k[1]) = -weight * d[a];
      }
    return stencil;
  }

  DirectSums::DirectSums(const algebra::Stencil &stencil, std::array<int, 2> n)
      : n_(n), reach_(stencil.reach()), width_((n[0] + tile - 1) / tile * tile + 2 * reach_),
        block_size_(width_ * (n[1] + 2 * reach_)), padded_(3 * block_size_)
  {
    for (int k2 = 0; k2 <= reach_; ++k2)
      for (int k1 = k2 == 0 ? 1 : -reach_; k1 <= reach_; ++k1)
      {
        const Pair pair{
            k2 * static_cast<std::ptrdiff_t>(width_) + k1,
            {stencil(0, 0, k1, k2), stencil(0, 1, k1, k2), stencil(1, 1, k1, k2)},
            {stencil(2, 0, k1, k2), stencil(2, 1, k1, k2)},
        };
        if (pair.even != std::array<double, 3>{})
          pairs_.push_back(pair);
      }
  }

  void DirectSums::apply(const double *input, double *output) const
  {
    const std::size_t n_nodes = static_cast<std::size_t>(n_[0]) * n_[1];
    for (unsigned int s = 0; s < 3; ++s)
      for (int j = 0; j < n_[1]; ++j)
        std::copy_n(input + s * n_nodes + static_cast<std::size_t>(j) * n_[0], n_[0],
                    padded_.data() + s * block_size_ + (j + reach_) * width_ + reach_);
    dealii::parallel::apply_to_subranges(
        0, n_[1],
        [&](int from, int to)
        {
          double result[3 * tile];
          for (int j = from; j < to; ++j)
            for (int i = 0; i < n_[0]; i += tile)
            {
              sum_tile(padded_.data() + (j + reach_) * width_ + reach_ + i, block_size_,
                       pairs_.data(), pairs_.data() + pairs_.size(), result);
              for (unsigned int s = 0; s < 3; ++s)
                std::copy_n(result + s * tile, std::min(tile, n_[0] - i),
                            output + s * n_nodes + static_cast<std::size_t>(j) * n_[0] + i);
            }
        },
        16);
  }

  double DirectSums::estimated_seconds(const algebra::Stencil &stencil, std::array<int, 2> n)
  {
    constexpr double seconds_per_entry = .036e-9;
    return seconds_per_entry * static_cast<double>(stencil.n_entries()) * n[0] * n[1];
  }
} // namespace plumbline::meshfree
