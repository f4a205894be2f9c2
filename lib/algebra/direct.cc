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

    constexpr int half_tile = tile / 2; // three components' sums fill the registers

    /// Half a tile of a three-component operator.
    template <class Triple>
    PLUMBLINE_VECTOR_CLONES void tile_triple(const double *u, std::size_t block, const double *a,
                                             const Triple *triple, const Triple *end,
                                             double *result)
    {
      constexpr int n = n_registers / 2;
      Simd sum0[n], sum1[n], sum2[n];
      for (int l = 0; l < n; ++l)
      {
        const double *const at = u + l * simd_width;
        const Simd u0 = load(at), u1 = load(at + block), u2 = load(at + 2 * block);
        sum0[l] = a[0] * u0 + a[1] * u1 + a[3] * u2;
        sum1[l] = a[1] * u0 + a[2] * u1 + a[4] * u2;
        sum2[l] = a[3] * u0 + a[4] * u1 + a[5] * u2;
      }
      for (; triple != end; ++triple)
      {
        const double *const w = triple->weight.data();
        for (int l = 0; l < n; ++l)
        {
          const double *const forward = u + triple->shift + l * simd_width, *const backward =
                                                                                u - triple->shift +
                                                                                l * simd_width;
          const Simd s0 = load(forward) + load(backward),
                     s1 = load(forward + block) + load(backward + block),
                     s2 = load(forward + 2 * block) + load(backward + 2 * block);
          sum0[l] += w[0] * s0 + w[1] * s1 + w[3] * s2;
          sum1[l] += w[1] * s0 + w[2] * s1 + w[4] * s2;
          sum2[l] += w[3] * s0 + w[4] * s1 + w[5] * s2;
        }
      }
      std::memcpy(result, sum0, sizeof(sum0));
      std::memcpy(result + tile, sum1, sizeof(sum1));
      std::memcpy(result + 2 * tile, sum2, sizeof(sum2));
    }
  } // namespace

  bool DirectStencil::fits(const Stencil &stencil)
  {
    return stencil.n_blocks() <= 3 && stencil.is_even();
  }

  DirectStencil::DirectStencil(const Stencil &stencil, std::array<int, 3> n, bool has_halo)
      : n_blocks_(stencil.n_blocks()), n_(n), reach_(stencil.reaches()),
        halo_(has_halo ? reach_[2] : 0), width_((n[0] + tile - 1) / tile * tile + 2 * reach_[0]),
        height_(n[1] + 2 * reach_[1]), block_size_(width_ * height_ * (n[2] + 2 * reach_[2])),
        padded_(n_blocks_ * block_size_)
  {
    const auto weights = [&](int k1, int k2, int k3)
    {
      std::array<double, 6> w{};
      for (unsigned int s = 0, at = 0; s < n_blocks_; ++s)
        for (unsigned int t = 0; t <= s; ++t, ++at)
          w[at] = stencil(t, s, k1, k2, k3);
      return w;
    };
    diagonal_ = weights(0, 0, 0);
    for (int k3 = 0; k3 <= reach_[2]; ++k3)
      for (int k2 = k3 == 0 ? 0 : -reach_[1]; k2 <= reach_[1]; ++k2)
        for (int k1 = k3 == 0 && k2 == 0 ? 1 : -reach_[0]; k1 <= reach_[0]; ++k1)
        {
          const auto w = weights(k1, k2, k3);
          if (w == std::array<double, 6>{})
            continue;
          const std::ptrdiff_t rows = k3 * static_cast<std::ptrdiff_t>(height_) + k2,
                               shift = rows * static_cast<std::ptrdiff_t>(width_) + k1;
          if (n_blocks_ == 3)
            triples_.push_back({shift, w});
          else
            pairs_.push_back({shift, {w[0], w[1], w[2]}});
        }
  }

  /// The first node of a row of nodes, of which there are n[1] in each plane.
  double *DirectStencil::padded_row(int j, int k, unsigned int block) const
  {
    return padded_.data() + block * block_size_ +
           ((k + reach_[2]) * height_ + (j + reach_[1])) * width_ + reach_[0];
  }

  template <unsigned int n_blocks>
  void DirectStencil::apply_rows(int from, int to, double *output) const
  {
    double result[3 * tile];
    const std::size_t n_rows = static_cast<std::size_t>(n_[1]) * n_[2];
    for (int j = from; j < to; ++j)
      for (int i = 0; i < n_[0]; i += tile)
      {
        const double *const u = padded_row(j % n_[1], j / n_[1], 0) + i;
        if constexpr (n_blocks == 1)
          tile_scalar(u, diagonal_[0], pairs_.data(), pairs_.data() + pairs_.size(), result);
        else if constexpr (n_blocks == 2)
          tile_pair(u, block_size_, diagonal_.data(), pairs_.data(), pairs_.data() + pairs_.size(),
                    result);
        else
          for (const int half : {0, half_tile})
            tile_triple(u + half, block_size_, diagonal_.data(), triples_.data(),
                        triples_.data() + triples_.size(), result + half);
        for (unsigned int s = 0; s < n_blocks; ++s)
          std::copy_n(result + s * tile, std::min(tile, n_[0] - i),
                      output + (s * n_rows + j) * n_[0] + i);
      }
  }

  void DirectStencil::apply(const double *input, double *output) const
  {
    take(input, -halo_, n_[2] + halo_);
    compute(0, n_[2], output);
  }

  void DirectStencil::take(const double *input, int from, int to) const
  {
    const std::size_t plane_size = static_cast<std::size_t>(n_[0]) * n_[1];
    for (unsigned int s = 0; s < n_blocks_; ++s)
      for (int k = from; k < to; ++k)
      {
        const double *row = input + (s * (n_[2] + 2 * halo_) + k + halo_) * plane_size;
        for (int j = 0; j < n_[1]; ++j, row += n_[0])
          std::copy_n(row, n_[0], padded_row(j, k, s));
      }
  }

  void DirectStencil::compute(int from, int to, double *output) const
  {
    dealii::parallel::apply_to_subranges(
        from * n_[1], to * n_[1],
        [&](int first, int last)
        {
          if (n_blocks_ == 1)
            apply_rows<1>(first, last, output);
          else if (n_blocks_ == 2)
            apply_rows<2>(first, last, output);
          else
            apply_rows<3>(first, last, output);
        },
        16);
  }

  double DirectStencil::estimated_seconds(const Stencil &stencil, const std::array<int, 3> &n)
  {
    constexpr double seconds_per_entry = .06e-9;
    return seconds_per_entry * static_cast<double>(stencil.n_entries()) * n[0] * n[1] * n[2];
  }
} // namespace plumbline::algebra
