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
    std::array<int, 2> n;
    int margin;
    std::array<int, 2> length;           ///< of the transform
    std::size_t n_real, n_modes;         ///< points of one transform, and its non-redundant modes
    bool is_real;                        ///< the symbol: true for even stencils
    std::vector<double> real_symbol;     ///< shape (n_modes, n_blocks (n_blocks+1) / 2)
    std::vector<Complex> complex_symbol; ///< the same shape, s >= t
    AlignedArray<double> field;          ///< shape (n_blocks, length[1], length[0])
    AlignedArray<Complex> modes;         ///< shape (n_blocks, n_modes)
    Plan forward, backward;

    fftw_complex *mode_data() const { return reinterpret_cast<fftw_complex *>(modes.data()); }
    void make_plans();
    void transform_stencil(const Stencil &stencil);
    void multiply() const;
  };

  void Convolution::Transforms::make_plans()
  {
    n_real = static_cast<std::size_t>(length[0]) * length[1];
    n_modes = static_cast<std::size_t>(length[0] / 2 + 1) * length[1];
    field = AlignedArray<double>(n_blocks * n_real);
    modes = AlignedArray<Complex>(n_blocks * n_modes);
    set_plan_threads(n_real);
    const int dims[2] = {length[1], length[0]};
    forward = Plan(fftw_plan_many_dft_r2c(2, dims, static_cast<int>(n_blocks), field.data(),
                                          nullptr, 1, static_cast<int>(n_real), mode_data(),
                                          nullptr, 1, static_cast<int>(n_modes), FFTW_ESTIMATE));
    backward = Plan(fftw_plan_many_dft_c2r(2, dims, static_cast<int>(n_blocks), mode_data(),
                                           nullptr, 1, static_cast<int>(n_modes), field.data(),
                                           nullptr, 1, static_cast<int>(n_real), FFTW_ESTIMATE));
  }

  /// The symbol Σ_k A_st(k) exp(i k·t) of the lower triangle s >= t; the rest is its conjugate.
  void Convolution::Transforms::transform_stencil(const Stencil &stencil)
  {
    const std::size_t n_pairs = n_blocks * (n_blocks + 1) / 2;
    const int reach = stencil.reach();
    is_real = stencil.is_even();
    (is_real ? real_symbol.resize(n_modes * n_pairs) : complex_symbol.resize(n_modes * n_pairs));
    const Plan single(
        fftw_plan_dft_r2c_2d(length[1], length[0], field.data(), mode_data(), FFTW_ESTIMATE));
    const double scale = 1. / static_cast<double>(n_real);
    std::size_t pair = 0;
    for (unsigned int s = 0; s < n_blocks; ++s)
      for (unsigned int t = 0; t <= s; ++t, ++pair)
      {
        std::fill_n(field.data(), n_real, 0.);
        for (int k2 = -reach; k2 <= reach; ++k2)
          for (int k1 = -reach; k1 <= reach; ++k1)
          {
            // u(i + k): the stencil stands mirrored, at -k
            const std::size_t row = (length[1] - k2) % length[1];
            field[row * length[0] + (length[0] - k1) % length[0]] += scale * stencil(s, t, k1, k2);
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

  Convolution::Convolution(const Stencil &stencil, std::array<int, 2> n, int margin)
      : transforms_(std::make_unique<Transforms>())
  {
    transforms_->n_blocks = stencil.n_blocks();
    transforms_->n = n;
    transforms_->margin = margin;
    for (unsigned int d = 0; d < 2; ++d)
      transforms_->length[d] =
          fast_length(std::max(n[d] + stencil.reach() + margin, 2 * stencil.reach() + 1));
    transforms_->make_plans();
    transforms_->transform_stencil(stencil);
  }

  Convolution::Convolution(Convolution &&) noexcept = default;

  Convolution::~Convolution() = default;

  void Convolution::apply(const double *input, double *output) const
  {
    const Transforms &T = *transforms_;
    const std::size_t width = T.n[0] + 2 * T.margin, height = T.n[1] + 2 * T.margin;
    std::fill_n(T.field.data(), T.field.size(), 0.);
    for (unsigned int s = 0; s < T.n_blocks; ++s)
      for (std::size_t j = 0; j < height; ++j)
        std::copy_n(input + (s * height + j) * width, width,
                    T.field.data() + s * T.n_real + j * T.length[0]);
    fftw_execute(T.forward.get());
    T.multiply();
    fftw_execute(T.backward.get());
    for (unsigned int s = 0; s < T.n_blocks; ++s)
      for (int j = 0; j < T.n[1]; ++j)
        std::copy_n(T.field.data() + s * T.n_real +
                        static_cast<std::size_t>(j + T.margin) * T.length[0] + T.margin,
                    T.n[0], output + (static_cast<std::size_t>(s) * T.n[1] + j) * T.n[0]);
  }

  double Convolution::estimated_seconds(unsigned int n_blocks, int reach, std::array<int, 2> n)
  {
    const double points =
        static_cast<double>(fast_length(n[0] + reach)) * fast_length(n[1] + reach);
    constexpr double seconds_per_point_and_level = .5e-9, seconds_per_product = 5e-9;
    return n_blocks * points * std::log2(points) * seconds_per_point_and_level +
           .5 * n_blocks * (n_blocks - 1) * points * seconds_per_product;
  }
} // namespace plumbline::algebra
