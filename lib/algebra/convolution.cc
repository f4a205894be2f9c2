#include "algebra/convolution.h"

#include "base/fftw.h"

#include <algorithm>
#include <cmath>
#include <complex>

namespace plumbline::algebra
{
  using base::AlignedArray;
  using base::fast_length;
  using base::Plan;
  using base::set_plan_threads;

  using Complex = std::complex<double>;

  struct Convolution::Transforms
  {
    unsigned int n_blocks;
    std::array<int, 3> n, margin;
    std::array<int, 3> length;           ///< of the transform
    std::size_t n_real, n_modes;         ///< points of one transform, and its non-redundant modes
    bool is_real;                        ///< the symbol: true for even stencils
    std::vector<double> real_symbol;     ///< shape (n_modes, n_blocks (n_blocks+1) / 2)
    std::vector<Complex> complex_symbol; ///< the same shape, s >= t
    AlignedArray<double> field;          ///< shape (n_blocks, length[2], length[1], length[0])
    AlignedArray<Complex> modes;         ///< shape (n_blocks, n_modes)
    Plan forward, backward;

    fftw_complex *mode_data() const { return reinterpret_cast<fftw_complex *>(modes.data()); }
    int rank() const { return length[2] > 1 ? 3 : 2; }
    void make_plans();
    void transform_stencil(const Stencil &stencil);
    void multiply() const;
  };

  void Convolution::Transforms::make_plans()
  {
    const std::size_t n_rows = static_cast<std::size_t>(length[1]) * length[2];
    n_real = length[0] * n_rows;
    n_modes = (length[0] / 2 + 1) * n_rows;
    field = AlignedArray<double>(n_blocks * n_real);
    modes = AlignedArray<Complex>(n_blocks * n_modes);
    // in space two threads wake each other so often that some lengths take 70 times the CPU time
    set_plan_threads(rank() == 3 ? 0 : n_real);
    const std::array<int, 3> extents = {length[2], length[1], length[0]};
    forward =
        Plan(fftw_plan_many_dft_r2c(rank(), extents.data() + 3 - rank(), static_cast<int>(n_blocks),
                                    field.data(), nullptr, 1, static_cast<int>(n_real), mode_data(),
                                    nullptr, 1, static_cast<int>(n_modes), FFTW_ESTIMATE));
    backward = Plan(fftw_plan_many_dft_c2r(rank(), extents.data() + 3 - rank(),
                                           static_cast<int>(n_blocks), mode_data(), nullptr, 1,
                                           static_cast<int>(n_modes), field.data(), nullptr, 1,
                                           static_cast<int>(n_real), FFTW_ESTIMATE));
  }

  /// The symbol Σ_k A_st(k) exp(i k·t) of the lower triangle s >= t; the rest is its conjugate.
  void Convolution::Transforms::transform_stencil(const Stencil &stencil)
  {
    const std::size_t n_pairs = n_blocks * (n_blocks + 1) / 2;
    const auto &reach = stencil.reaches();
    is_real = stencil.is_even();
    (is_real ? real_symbol.resize(n_modes * n_pairs) : complex_symbol.resize(n_modes * n_pairs));
    const std::array<int, 3> extents = {length[2], length[1], length[0]};
    const Plan single(fftw_plan_dft_r2c(rank(), extents.data() + 3 - rank(), field.data(),
                                        mode_data(), FFTW_ESTIMATE));
    const double scale = 1. / static_cast<double>(n_real);
    std::size_t pair = 0;
    for (unsigned int s = 0; s < n_blocks; ++s)
      for (unsigned int t = 0; t <= s; ++t, ++pair)
      {
        std::fill_n(field.data(), n_real, 0.);
        for (int k3 = -reach[2]; k3 <= reach[2]; ++k3)
          for (int k2 = -reach[1]; k2 <= reach[1]; ++k2)
            for (int k1 = -reach[0]; k1 <= reach[0]; ++k1)
            {
              // u(i + k): the stencil stands mirrored, at -k
              const std::size_t plane = (length[2] - k3) % length[2],
                                row = plane * length[1] + (length[1] - k2) % length[1];
              field[row * length[0] + (length[0] - k1) % length[0]] +=
                  scale * stencil(s, t, k1, k2, k3);
            }
        fftw_execute(single.get());
        for (std::size_t q = 0; q < n_modes; ++q)
          if (is_real)
            real_symbol[q * n_pairs + pair] = modes[q].real();
          else
            complex_symbol[q * n_pairs + pair] = modes[q];
      }
  }

  void Convolution::Transforms::multiply() const
  {
    const std::size_t n_pairs = n_blocks * (n_blocks + 1) / 2;
    if (n_blocks == 1 && is_real)
    {
      for (std::size_t q = 0; q < n_modes; ++q)
        modes[q] *= real_symbol[q];
      return;
    }
    std::vector<Complex> in(n_blocks), out(n_blocks);
    for (std::size_t q = 0; q < n_modes; ++q)
    {
      for (unsigned int s = 0; s < n_blocks; ++s)
      {
        in[s] = modes[s * n_modes + q];
        out[s] = 0;
      }
      std::size_t pair = q * n_pairs;
      for (unsigned int s = 0; s < n_blocks; ++s)
      {
        for (unsigned int t = 0; t < s; ++t, ++pair)
          if (is_real)
          {
            out[s] += real_symbol[pair] * in[t];
            out[t] += real_symbol[pair] * in[s];
          }
          else
          {
            const Complex a = complex_symbol[pair];
            out[s] += Complex(a.real() * in[t].real() - a.imag() * in[t].imag(),
                              a.real() * in[t].imag() + a.imag() * in[t].real());
            out[t] += Complex(a.real() * in[s].real() + a.imag() * in[s].imag(),
                              a.real() * in[s].imag() - a.imag() * in[s].real());
          }
        out[s] += (is_real ? real_symbol[pair] : complex_symbol[pair].real()) * in[s];
        ++pair;
      }
      for (unsigned int s = 0; s < n_blocks; ++s)
        modes[s * n_modes + q] = out[s];
    }
  }

  Convolution::Convolution(const Stencil &stencil, std::array<int, 3> n,
                           const std::array<int, 3> &margins)
      : transforms_(std::make_unique<Transforms>())
  {
    transforms_->n_blocks = stencil.n_blocks();
    transforms_->n = n;
    for (unsigned int d = 0; d < 3; ++d)
    {
      const int reach = stencil.reaches()[d];
      const bool is_flat = d == 2 && reach == 0;
      transforms_->margin[d] = is_flat ? 0 : margins[d];
      transforms_->length[d] =
          is_flat ? n[d] : fast_length(std::max(n[d] + reach + margins[d], 2 * reach + 1));
    }
    transforms_->make_plans();
    transforms_->transform_stencil(stencil);
  }

  Convolution::Convolution(Convolution &&) noexcept = default;

  Convolution::~Convolution() = default;

  void Convolution::apply(const double *input, double *output) const
  {
    const Transforms &T = *transforms_;
    std::array<std::size_t, 3> extent{};
    for (unsigned int d = 0; d < 3; ++d)
      extent[d] = T.n[d] + 2 * T.margin[d];
    const auto row = [&](std::size_t s, std::size_t k, std::size_t j)
    { return T.field.data() + s * T.n_real + (k * T.length[1] + j) * T.length[0]; };
    std::fill_n(T.field.data(), T.field.size(), 0.);
    for (unsigned int s = 0; s < T.n_blocks; ++s)
      for (std::size_t k = 0; k < extent[2]; ++k)
        for (std::size_t j = 0; j < extent[1]; ++j, input += extent[0])
          std::copy_n(input, extent[0], row(s, k, j));
    fftw_execute(T.forward.get());
    T.multiply();
    fftw_execute(T.backward.get());
    for (unsigned int s = 0; s < T.n_blocks; ++s)
      for (int k = 0; k < T.n[2]; ++k)
        for (int j = 0; j < T.n[1]; ++j, output += T.n[0])
          std::copy_n(row(s, k + T.margin[2], j + T.margin[1]) + T.margin[0], T.n[0], output);
  }

  double Convolution::estimated_seconds(unsigned int n_blocks, const std::array<int, 3> &reaches,
                                        std::array<int, 3> n)
  {
    double points =
        static_cast<double>(fast_length(n[0] + reaches[0])) * fast_length(n[1] + reaches[1]);
    if (n[2] > 1)
      points *= fast_length(n[2] + reaches[2]);
    constexpr double seconds_per_point_and_level = .5e-9, seconds_per_product = 5e-9;
    return n_blocks * points * std::log2(points) * seconds_per_point_and_level +
           .5 * n_blocks * (n_blocks - 1) * points * seconds_per_product;
  }
} // namespace plumbline::algebra
