#include "random/toeplitz.h"

#include "base/error.h"
#include "base/number_text.h"

#include <fftw3.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

namespace plumbline::random
{
  namespace
  {
    struct Free
    {
      void operator()(void *data) const { fftw_free(data); }
      void operator()(fftw_plan plan) const { fftw_destroy_plan(plan); }
    };
    template <class T>
    using Aligned = std::unique_ptr<T[], Free>; // for FFTW's vector instructions
    using Plan = std::unique_ptr<std::remove_pointer_t<fftw_plan>, Free>;

    template <class T>
    Aligned<T> aligned(std::size_t n)
    {
      return Aligned<T>(static_cast<T *>(fftw_malloc(sizeof(T) * n)));
    }

    /// The least number >= n without prime factors beyond 5.
    int fast_length(int n)
    {
      for (;; ++n)
      {
        int rest = n;
        for (const int factor : {2, 3, 5})
          while (rest % factor == 0)
            rest /= factor;
        if (rest == 1)
          return n;
      }
    }
  } // namespace

  struct ToeplitzProduct::Transforms
  {
    std::array<int, 2> n{}, length{};
    std::size_t n_points = 0, n_waves = 0;
    Aligned<double> field;       ///< shape (length[1], length[0])
    Aligned<fftw_complex> waves; ///< its transform, the redundant half left out
    std::vector<double> symbol;  ///< of the matrix: real, as C is even
    Plan forward, backward;

    Transforms(const CovarianceFunction &covariance, const Grid &grid);
  };

  ToeplitzProduct::Transforms::Transforms(const CovarianceFunction &covariance, const Grid &grid)
      : n(grid.n)
  {
    for (unsigned int d = 0; d < 2; ++d)
      length[d] = fast_length(2 * n[d] - 1);
    n_points = static_cast<std::size_t>(length[0]) * length[1];
    n_waves = static_cast<std::size_t>(length[0] / 2 + 1) * length[1];
    field = aligned<double>(n_points);
    waves = aligned<fftw_complex>(n_waves);
    // others may have asked for plans of several threads, whose bits might be different
    static const bool has_threads = fftw_init_threads() != 0;
    if (has_threads)
      fftw_plan_with_nthreads(1);
    forward =
        Plan(fftw_plan_dft_r2c_2d(length[1], length[0], field.get(), waves.get(), FFTW_ESTIMATE));
    backward =
        Plan(fftw_plan_dft_c2r_2d(length[1], length[0], waves.get(), field.get(), FFTW_ESTIMATE));

    const double scale = grid.cell_area() / static_cast<double>(n_points);
    std::fill_n(field.get(), n_points, 0.);
    for (int j = 0; j < n[1]; ++j)
      for (int i = 1 - n[0]; i < n[0]; ++i)
      {
        const double value = covariance(i * grid.h(0), j * grid.h(1));
        if (!std::isfinite(value))
          throw NumericalError("the covariance of a random field is " + base::to_text(value, 6) +
                               " at distance (" + base::to_text(i * grid.h(0), 6) + ", " +
                               base::to_text(j * grid.h(1), 6) + ")");
        const auto place = [&](int p, int q)
        {
          const int column = (p + length[0]) % length[0], row = (q + length[1]) % length[1];
          return static_cast<std::size_t>(row) * length[0] + column;
        };
        field[place(i, j)] = field[place(-i, -j)] = scale * value;
      }
    fftw_execute(forward.get());
    symbol.resize(n_waves);
    for (std::size_t k = 0; k < n_waves; ++k)
      symbol[k] = waves[k][0];
  }

  ToeplitzProduct::ToeplitzProduct(const CovarianceFunction &covariance, const Grid &grid)
      : transforms_(std::make_unique<Transforms>(covariance, grid))
  {
  }

  ToeplitzProduct::ToeplitzProduct(ToeplitzProduct &&) noexcept = default;

  ToeplitzProduct::~ToeplitzProduct() = default;

  void ToeplitzProduct::apply(const double *x, double *y, unsigned int n_columns) const
  {
    const Transforms &t = *transforms_;
    const auto width = static_cast<std::size_t>(t.n[0]), height = static_cast<std::size_t>(t.n[1]);
    for (std::size_t column = 0; column < n_columns; ++column)
    {
      const std::size_t start = column * width * height;
      std::fill_n(t.field.get(), t.n_points, 0.);
      for (std::size_t j = 0; j < height; ++j)
        std::copy_n(x + start + j * width, width, t.field.get() + j * t.length[0]);
      fftw_execute(t.forward.get());
      for (std::size_t k = 0; k < t.n_waves; ++k)
      {
        t.waves[k][0] *= t.symbol[k];
        t.waves[k][1] *= t.symbol[k];
      }
      fftw_execute(t.backward.get());
      for (std::size_t j = 0; j < height; ++j)
        std::copy_n(t.field.get() + j * t.length[0], width, y + start + j * width);
    }
  }
} // namespace plumbline::random
