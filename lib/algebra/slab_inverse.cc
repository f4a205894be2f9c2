#include "algebra/slab_inverse.h"

#include "algebra/simd.h"
#include "base/error.h"

#include <Eigen/Dense>

#include <cmath>

namespace plumbline::algebra
{
  using Complex = std::complex<double>;

  namespace
  {
    /// out = matrix in, real and imaginary parts one after the other; the matrix is symmetric.
    PLUMBLINE_VECTOR_CLONES void multiply(const double *matrix, int width, const double *in,
                                          double *out)
    {
      double *const real = out, *const imaginary = out + width;
      for (int i = 0; i < width; ++i)
        real[i] = imaginary[i] = 0;
      for (int j = 0; j < width; ++j, matrix += width)
      {
        const double a = in[j], b = in[width + j];
        for (int i = 0; i < width; ++i)
        {
          real[i] += matrix[i] * a;
          imaginary[i] += matrix[i] * b;
        }
      }
    }
  } // namespace

  double SlabInverse::bytes(unsigned int n_blocks, const std::array<int, 3> &n,
                            const std::array<int, 3> &period, unsigned int axis)
  {
    const unsigned int a = axis == 0 ? 1 : 0, b = axis == 2 ? 1 : 2;
    const double width = static_cast<double>(n_blocks) * (period[axis] - n[axis]);
    return sizeof(double) * width * width * (period[a] / 2 + 1) * period[b];
  }

  SlabInverse::SlabInverse(const PeriodicBox &box, unsigned int axis)
      : axis_(axis), a_(axis == 0 ? 1 : 0), b_(axis == 2 ? 1 : 2)
  {
    const auto &period = box.period();
    const int n_axis = period[axis], n_planes = n_axis - box.n()[axis], half = period[a_] / 2 + 1;
    const auto n_blocks = static_cast<int>(box.n_blocks());
    width_ = n_blocks * n_planes;
    n_points_ = static_cast<std::size_t>(period[a_]) * period[b_];
    n_modes_ = static_cast<std::size_t>(half) * period[b_];
    planes_ = base::AlignedArray<double>(width_ * n_points_);
    modes_ = base::AlignedArray<Complex>(width_ * n_modes_);
    base::set_plan_threads(0);
    const std::array<int, 2> extents = {period[b_], period[a_]};
    const auto modes = reinterpret_cast<fftw_complex *>(modes_.data());
    const int n_points = static_cast<int>(n_points_), n_modes = static_cast<int>(n_modes_);
    forward_ =
        base::Plan(fftw_plan_many_dft_r2c(2, extents.data(), width_, planes_.data(), nullptr, 1,
                                          n_points, modes, nullptr, 1, n_modes, FFTW_ESTIMATE));
    backward_ =
        base::Plan(fftw_plan_many_dft_c2r(2, extents.data(), width_, modes, nullptr, 1, n_modes,
                                          planes_.data(), nullptr, 1, n_points, FFTW_ESTIMATE));

    invert(box);
  }

  /// With (u_a, u_b, i u_axis) for u, the matrix of each mode is real: couplings of u_axis with the
  /// others are odd along the axis.
  void SlabInverse::invert(const PeriodicBox &box)
  {
    const auto &period = box.period();
    const int n_axis = period[axis_], n_planes = n_axis - box.n()[axis_], half = period[a_] / 2 + 1,
              n_blocks = static_cast<int>(box.n_blocks()), normal = static_cast<int>(axis_);
    std::vector<double> cosines, sines;
    for (int k = 0; k < n_axis; ++k)
    {
      cosines.push_back(std::cos(2 * M_PI * k / n_axis) / n_axis);
      sines.push_back(std::sin(2 * M_PI * k / n_axis) / n_axis);
    }
    const double scale = 1. / static_cast<double>(n_points_);
    inverse_.resize(n_modes_ * width_ * width_);
    Eigen::MatrixXd matrix(width_, width_);
    for (std::size_t mode = 0; mode < n_modes_; ++mode)
    {
      matrix.setZero();
      std::array<int, 3> k{};
      k[a_] = static_cast<int>(mode % half);
      k[b_] = static_cast<int>(mode / half);
      for (k[axis_] = 0; k[axis_] < n_axis; ++k[axis_])
      {
        const double *packed = box.inverse(k);
        const bool is_constant = k == std::array<int, 3>{};
        for (int s = 0; s < n_blocks; ++s)
          for (int t = 0; t <= s; ++t, ++packed)
          {
            const double entry = !is_constant ? *packed : s == t ? 1 / box.longest_wave() : 0.;
            const bool is_odd = (s == normal) != (t == normal);
            const auto &waves = is_odd ? sines : cosines;
            // i e^{ikx} of the normal component's row, -i of its column
            const double factor = is_odd && s == normal ? -entry : entry;
            for (int x = 0; x < n_planes; ++x) // between the plane x and the first
              matrix(s * n_planes + x, t * n_planes) +=
                  factor * waves[static_cast<std::size_t>(k[axis_]) * x % n_axis];
          }
      }
      for (int s = 0; s < n_blocks; ++s)
        for (int t = 0; t <= s; ++t)
        {
          const double mirrored = (s == normal) != (t == normal) ? -1 : 1;
          for (int y = n_planes - 1; y >= 0; --y)
            for (int x = n_planes - 1; x >= 0; --x)
              matrix(s * n_planes + x, t * n_planes + y) =
                  x >= y ? matrix(s * n_planes + x - y, t * n_planes)
                         : mirrored * matrix(s * n_planes + y - x, t * n_planes);
        }
      const Eigen::LLT<Eigen::MatrixXd> cholesky(matrix); // of the lower triangle
      if (cholesky.info() != Eigen::Success)
        throw NumericalError("the flexibility of a slab of constrained nodes is not positive "
                             "definite to rounding");
      Eigen::Map<Eigen::MatrixXd>(inverse_.data() + mode * width_ * width_, width_, width_) =
          scale * cholesky.solve(Eigen::MatrixXd::Identity(width_, width_));
    }
  }

  /// visit(place in the planes, place on the layer, steps there, nodes) of rows along the axis a.
  template <class Visit>
  void SlabInverse::for_each_row(const PeriodicBox &box, const Visit &visit) const
  {
    const auto &period = box.period();
    std::size_t place = 0;
    for (unsigned int c = 0; c < box.n_blocks(); ++c)
      for (int x = box.n()[axis_]; x < period[axis_]; ++x)
        for (int y = 0; y < period[b_]; ++y)
          for (int z = 0; z < period[a_]; ++z, ++place)
          {
            std::array<int, 3> at{};
            at[axis_] = x;
            at[b_] = y;
            at[a_] = z;
            visit(place, c * box.n_layer() + box.number(at[0], at[1], at[2]));
          }
  }

  void SlabInverse::add(const PeriodicBox &box, const double *values, double *result) const
  {
    for_each_row(box,
                 [&](std::size_t place, std::size_t number) { planes_[place] = values[number]; });
    fftw_execute(forward_.get());
    std::vector<double> in(2 * width_), out(2 * width_);
    const int n_planes = box.period()[axis_] - box.n()[axis_],
              first_normal = n_planes * static_cast<int>(axis_),
              end_normal = first_normal + n_planes;
    for (std::size_t mode = 0; mode < n_modes_; ++mode)
    {
      const auto is_normal = [&](int i) { return i >= first_normal && i < end_normal; };
      for (int i = 0; i < width_; ++i)
      {
        const Complex value = modes_[i * n_modes_ + mode];
        in[i] = is_normal(i) ? -value.imag() : value.real(); // i u
        in[width_ + i] = is_normal(i) ? value.real() : value.imag();
      }
      multiply(inverse_.data() + mode * width_ * width_, width_, in.data(), out.data());
      for (int i = 0; i < width_; ++i)
        modes_[i * n_modes_ + mode] =
            is_normal(i) ? Complex(out[width_ + i], -out[i]) : Complex(out[i], out[width_ + i]);
    }
    fftw_execute(backward_.get());
    for_each_row(box,
                 [&](std::size_t place, std::size_t number) { result[number] += planes_[place]; });
  }
} // namespace plumbline::algebra
