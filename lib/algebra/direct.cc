#include "algebra/direct.h"

#include "algebra/simd.h"

#include <deal.II/base/parallel.h>

#include <algorithm>
#include <cstring>

namespace plumbline::algebra
{
  namespace
  {
    constexpr int n_registers = 4, tile = simd_width * n_registers;

    /// One tile of a scalar operator: result = a u + Σ w (u(+k) + u(-k)).
    template <class Pair>
    PLUMBLINE_VECTOR_CLONES void tile_scalar(const double *u, double a, const Pair *pair,
                                             const Pair *end, double *result)
    {
      Simd sum[n_registers];
      for (int l = 0; l < n_registers; ++l)
        sum[l] = a * load(u + l * simd_width);
      for (; pair != end; ++pair)
      {
        const double *const forward = u + pair->shift, *const backward = u - pair->shift;
        for (int l = 0; l < n_registers; ++l)
          sum[l] +=
              pair->weight[0] * (load(forward + l * simd_width) + load(backward + l * simd_width));
      }
      std::memcpy(result, sum, sizeof(sum));
    }

    /// One tile of a two-component operator; u1 stands `block` behind u0.
    template <class Pair>
    PLUMBLINE_VECTOR_CLONES void tile_pair(const double *u, std::size_t block, const double *a,
                                           const Pair *pair, const Pair *end, double *result)
    {
      Simd sum0[n_registers], sum1[n_registers];
      for (int l = 0; l < n_registers; ++l)
      {
        const Simd u0 = load(u + l * simd_width), u1 = load(u + block + l * simd_width);
        sum0[l] = a[0] * u0 + a[1] * u1;
        sum1[l] = a[1] * u0 + a[2] * u1;
      }
      for (; pair != end; ++pair)
      {
        const double *const forward = u + pair->shift, *const backward = u - pair->shift;
        for (int l = 0; l < n_registers; ++l)
        {
          const Simd s0 = load(forward + l * simd_width) + load(backward + l * simd_width);
          const Simd s1 =
              load(forward + block + l * simd_width) + load(backward + block + l * simd_width);
          sum0[l] += pair->weight[0] * s0 + pair->weight[1] * s1;
          sum1[l] += pair->weight[1] * s0 + pair->weight[2] * s1;
        }
      }
      std::memcpy(result, sum0, sizeof(sum0));
      std::memcpy(result + tile, sum1, sizeof(sum1));
    }
  } // namespace

  bool DirectStencil::fits(const Stencil &stencil)
  {
    return stencil.n_blocks() <= 2 && stencil.is_even();
  }

  DirectStencil::DirectStencil(const Stencil &stencil, std::array<int, 2> n)
      : n_blocks_(stencil.n_blocks()), n_(n), reach_(stencil.reach()),
        width_((n[0] + tile - 1) / tile * tile + 2 * reach_),
        block_size_(width_ * (n[1] + 2 * reach_)), padded_(n_blocks_ * block_size_)
  {
    const auto weights = [&](int k1, int k2)
    {
      std::array<double, 3> w{stencil(0, 0, k1, k2), 0, 0};
      if (n_blocks_ == 2)
      {
        w[1] = stencil(0, 1, k1, k2);
        w[2] = stencil(1, 1, k1, k2);
      }
      return w;
    };
    diagonal_ = weights(0, 0);
    for (int k2 = 0; k2 <= reach_; ++k2)
      for (int k1 = k2 == 0 ? 1 : -reach_; k1 <= reach_; ++k1)
      {
        const Pair pair{k2 * static_cast<std::ptrdiff_t>(width_) + k1, weights(k1, k2)};
        if (pair.weight != std::array<double, 3>{})
          pairs_.push_back(pair);
      }
  }

  template <unsigned int n_blocks>
  void DirectStencil::apply_rows(int from, int to, double *output) const
  {
    double result[2 * tile];
    for (int j = from; j < to; ++j)
      for (int i = 0; i < n_[0]; i += tile)
      {
        const double *const u = padded_.data() + (j + reach_) * width_ + reach_ + i;
        if constexpr (n_blocks == 1)
          tile_scalar(u, diagonal_[0], pairs_.data(), pairs_.data() + pairs_.size(), result);
        else
          tile_pair(u, block_size_, diagonal_.data(), pairs_.data(), pairs_.data() + pairs_.size(),
                    result);
        for (unsigned int s = 0; s < n_blocks; ++s)
          std::copy_n(result + s * tile, std::min(tile, n_[0] - i),
                      output + (static_cast<std::size_t>(s) * n_[1] + j) * n_[0] + i);
      }
  }

  void DirectStencil::apply(const double *input, double *output) const
  {
    for (unsigned int s = 0; s < n_blocks_; ++s)
      for (int j = 0; j < n_[1]; ++j)
        std::copy_n(input + (static_cast<std::size_t>(s) * n_[1] + j) * n_[0], n_[0],
                    padded_.data() + s * block_size_ + (j + reach_) * width_ + reach_);
    dealii::parallel::apply_to_subranges(
        0, n_[1],
        [&](int from, int to)
        {
          if (n_blocks_ == 1)
            apply_rows<1>(from, to, output);
          else
            apply_rows<2>(from, to, output);
        },
        16);
  }

  double DirectStencil::estimated_seconds(const Stencil &stencil, std::array<int, 2> n)
  {
    constexpr double seconds_per_entry = .06e-9;
    return seconds_per_entry * static_cast<double>(stencil.n_entries()) * n[0] * n[1];
  }
} // namespace plumbline::algebra
