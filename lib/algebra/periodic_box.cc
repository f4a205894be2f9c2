#include "algebra/periodic_box.h"

#include "algebra/sine_symbol.h"
#include "base/error.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace plumbline::algebra
{
  using Block = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 3>;

  std::array<int, 3> PeriodicBox::periods(const std::array<int, 3> &reaches,
                                          const std::array<int, 3> &n)
  {
    std::array<int, 3> result{};
    for (unsigned int d = 0; d < 3; ++d)
      result[d] = reaches[d] == 0 ? n[d] : base::fast_length(n[d] + reaches[d]);
    return result;
  }

  PeriodicBox::PeriodicBox(const Stencil &stencil, const std::array<int, 3> &n)
      : n_blocks_(stencil.n_blocks()), n_(n), period_(periods(stencil.reaches(), n)),
        n_points_(static_cast<std::size_t>(period_[0]) * period_[1] * period_[2]),
        n_modes_(n_points_ / period_[0] * (period_[0] / 2 + 1)), field_(n_blocks_ * n_points_),
        modes_(n_blocks_ * n_modes_)
  {
    for (int k = 0; k < period_[2]; ++k)
      for (int j = 0; j < period_[1]; ++j)
      {
        row_start_.push_back(n_layer_);
        n_layer_ += period_[0] - (crosses_box(j, k) ? n_[0] : 0);
      }
    base::set_plan_threads(0); // see Convolution
    const std::array<int, 3> extents = {period_[2], period_[1], period_[0]};
    const auto modes = reinterpret_cast<fftw_complex *>(modes_.data());
    const int n_fields = static_cast<int>(n_blocks_), n_points = static_cast<int>(n_points_),
              n_modes = static_cast<int>(n_modes_);
    forward_ =
        base::Plan(fftw_plan_many_dft_r2c(3, extents.data(), n_fields, field_.data(), nullptr, 1,
                                          n_points, modes, nullptr, 1, n_modes, FFTW_ESTIMATE));
    backward_ =
        base::Plan(fftw_plan_many_dft_c2r(3, extents.data(), n_fields, modes, nullptr, 1, n_modes,
                                          field_.data(), nullptr, 1, n_points, FFTW_ESTIMATE));
    invert_symbol(stencil);
  }

  void PeriodicBox::invert_symbol(const Stencil &stencil)
  {
    const unsigned int n_pairs = n_blocks_ * (n_blocks_ + 1) / 2;
    inverse_.resize(n_modes_ * n_pairs);
    const std::array<int, 3> extents = {period_[2], period_[1], period_[0]};
    const base::Plan single(fftw_plan_dft_r2c(3, extents.data(), field_.data(),
                                              reinterpret_cast<fftw_complex *>(modes_.data()),
                                              FFTW_ESTIMATE));
    unsigned int pair = 0;
    for (unsigned int s = 0; s < n_blocks_; ++s)
      for (unsigned int t = 0; t <= s; ++t, ++pair)
      {
        std::fill_n(field_.data(), n_points_, 0.);
        stencil.for_each_offset(
            [&](int k1, int k2, int k3)
            {
              const auto wrap = [&](int k, unsigned int d)
              { return static_cast<std::size_t>((k % period_[d] + period_[d]) % period_[d]); };
              field_[wrap(k1, 0) + period_[0] * (wrap(k2, 1) + period_[1] * wrap(k3, 2))] +=
                  stencil(s, t, k1, k2, k3);
            });
        fftw_execute(single.get());
        for (std::size_t q = 0; q < n_modes_; ++q)
          inverse_[q * n_pairs + pair] = modes_[q].real();
      }
    const std::size_t row = static_cast<std::size_t>(period_[0]) / 2 + 1, plane = row * period_[1];
    Block block(n_blocks_, n_blocks_);
    for (std::size_t q = 0; q < n_modes_; ++q)
    {
      double *const packed = inverse_.data() + q * n_pairs;
      if (q == 0)
      {
        std::fill_n(packed, n_pairs, 0.);
        continue;
      }
      for (unsigned int s = 0, at = 0; s < n_blocks_; ++s)
        for (unsigned int t = 0; t <= s; ++t, ++at)
          block(s, t) = block(t, s) = packed[at];
      const Eigen::LLT<Block> cholesky(block);
      const bool is_factored = cholesky.info() == Eigen::Success,
                 is_longest = q == 1 || q == row || q == plane;
      if (is_longest || !is_factored || block.trace() > largest_) // the trace is the larger one
      {
        const auto values =
            Eigen::SelfAdjointEigenSolver<Block>(block, Eigen::EigenvaluesOnly).eigenvalues();
        check_positive(values.minCoeff(), values.maxCoeff());
        if (!is_factored)
          throw NumericalError("the symbol of the periodic operator is singular to rounding");
        largest_ = std::max(largest_, values.maxCoeff());
        if (is_longest && (longest_wave_ == 0 || values.minCoeff() < longest_wave_))
          longest_wave_ = values.minCoeff();
      }
      block = cholesky.solve(Block::Identity(n_blocks_, n_blocks_));
      for (unsigned int s = 0, at = 0; s < n_blocks_; ++s)
        for (unsigned int t = 0; t <= s; ++t, ++at)
          packed[at] = block(s, t);
    }
  }

  const double *PeriodicBox::inverse(std::array<int, 3> k) const
  {
    if (k[0] > period_[0] / 2) // the symbol is even
      for (unsigned int d = 0; d < 3; ++d)
        k[d] = (period_[d] - k[d]) % period_[d];
    const std::size_t row = k[1] + static_cast<std::size_t>(period_[1]) * k[2],
                      mode = row * (period_[0] / 2 + 1) + k[0];
    return inverse_.data() + mode * (n_blocks_ * (n_blocks_ + 1) / 2);
  }

  /// visit(place in the field, place in the layer, nodes of the box, of the layer) of each row of
  /// one component.
  template <class Visit>
  void PeriodicBox::for_each_row(const Visit &visit) const
  {
    for (unsigned int c = 0; c < n_blocks_; ++c)
      for (int k = 0; k < period_[2]; ++k)
        for (int j = 0; j < period_[1]; ++j)
        {
          const std::size_t row = j + static_cast<std::size_t>(period_[1]) * k;
          const int n_box = crosses_box(j, k) ? n_[0] : 0;
          visit(c * n_points_ + row * period_[0], c * n_layer_ + row_start_[row], n_box,
                period_[0] - n_box);
        }
  }

  void PeriodicBox::set_box(const double *values)
  {
    for_each_row(
        [&](std::size_t place, std::size_t, int n_box, int n_around)
        {
          std::copy_n(values, n_box, field_.data() + place);
          values += n_box;
          std::fill_n(field_.data() + place + n_box, n_around, 0.);
        });
  }

  void PeriodicBox::add_layer(const double *values)
  {
    for_each_row(
        [&](std::size_t place, std::size_t number, int n_box, int n_around)
        {
          double *const to = field_.data() + place + n_box;
          for (int i = 0; i < n_around; ++i)
            to[i] += values[number + i];
        });
  }

  void PeriodicBox::get_box(double *values) const
  {
    for_each_row([&](std::size_t place, std::size_t, int n_box, int)
                 { values = std::copy_n(field_.data() + place, n_box, values); });
  }

  void PeriodicBox::get_layer(double *values) const
  {
    for_each_row([&](std::size_t place, std::size_t number, int n_box, int n_around)
                 { std::copy_n(field_.data() + place + n_box, n_around, values + number); });
  }

  void PeriodicBox::invert()
  {
    fftw_execute(forward_.get());
    const double scale = 1. / static_cast<double>(n_points_);
    const double *packed = inverse_.data();
    std::array<std::complex<double>, 3> in, out;
    for (std::size_t q = 0; q < n_modes_; ++q)
    {
      for (unsigned int s = 0; s < n_blocks_; ++s)
      {
        in[s] = scale * modes_[s * n_modes_ + q];
        out[s] = 0;
      }
      for (unsigned int s = 0; s < n_blocks_; ++s, ++packed)
      {
        for (unsigned int t = 0; t < s; ++t, ++packed)
        {
          out[s] += *packed * in[t];
          out[t] += *packed * in[s];
        }
        out[s] += *packed * in[s];
      }
      for (unsigned int s = 0; s < n_blocks_; ++s)
        modes_[s * n_modes_ + q] = out[s];
    }
    fftw_execute(backward_.get());
  }
} // namespace plumbline::algebra
