#include "uq/toeplitz.h"

#include "base/error.h"
#include "base/fftw.h"
#include "base/number_text.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

namespace plumbline::uq
{
  using base::AlignedArray;
  using base::Plan;

  struct ToeplitzProduct::Transforms
  {
    std::array<int, 2> n{}, length{};
    std::size_t n_points = 0, n_waves = 0;
    AlignedArray<double> field;       ///< shape (length[1], length[0])
    AlignedArray<fftw_complex> waves; ///< its transform, the redundant half left out
    std::vector<double> symbol;       ///< of the matrix: real, as C is even
    Plan forward, backward;

    Transforms(const CovarianceFunction &covariance, const Grid &grid);
  };

  ToeplitzProduct::Transforms::Transforms(const CovarianceFunction &covariance, const Grid &grid)
      : n(grid.n)
  {
    for (unsigned int d = 0; d < 2; ++d)
      length[d] = base::fast_length(2 * n[d] - 1);
    n_points = static_cast<std::size_t>(length[0]) * length[1];
    n_waves = static_cast<std::size_t>(length[0] / 2 + 1) * length[1];
    field = AlignedArray<double>(n_points);
    waves = AlignedArray<fftw_complex>(n_waves);
    base::set_plan_threads(0); // the bits of several might be different
    forward =
        Plan(fftw_plan_dft_r2c_2d(length[1], length[0], field.data(), waves.data(), FFTW_ESTIMATE));
    backward =
        Plan(fftw_plan_dft_c2r_2d(length[1], length[0], waves.data(), field.data(), FFTW_ESTIMATE));

    const double scale = grid.cell_area() / static_cast<double>(n_points);
    std::fill_n(field.data(), n_points, 0.);
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
      std::fill_n(t.field.data(), t.n_points, 0.);
      for (std::size_t j = 0; j < height; ++j)
        std::copy_n(x + start + j * width, width, t.field.data() + j * t.length[0]);
      fftw_execute(t.forward.get());
      for (std::size_t k = 0; k < t.n_waves; ++k)
      {
        t.waves[k][0] *= t.symbol[k];
        t.waves[k][1] *= t.symbol[k];
      }
      fftw_execute(t.backward.get());
      for (std::size_t j = 0; j < height; ++j)
        std::copy_n(t.field.data() + j * t.length[0], width, y + start + j * width);
    }
  }
} // namespace plumbline::uq
