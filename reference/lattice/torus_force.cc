#include "reference/lattice/torus_force.h"

#include "base/error.h"
#include "base/fftw.h"

#include <deal.II/base/quadrature_lib.h>

#include <cmath>
#include <complex>
#include <string>

namespace plumbline::reference
{
  namespace
  {
    using Complex = std::complex<double>;

    /// A point of the bond integral.
    template <int dim>
    struct Direction
    {
      double radius, weight; ///< the weight has r^(dim-1) in it
      std::array<double, dim> e;
      double mean_strain; ///< e·E e
    };

    /// exp(2πi k z / side) for all wave numbers of an axis; the real part at the highest, which the
    /// values alone do not tell apart from its opposite.
    std::vector<Complex> shifts(unsigned int n, double z, unsigned int n_modes)
    {
      std::vector<Complex> result(n_modes);
      for (unsigned int i = 0; i < n_modes; ++i)
      {
        const int k = i <= n / 2 ? static_cast<int>(i) : static_cast<int>(i) - static_cast<int>(n);
        result[i] =
            2 * i == n ? Complex(std::cos(2 * M_PI * k * z)) : std::polar(1., 2 * M_PI * k * z);
      }
      return result;
    }
  } // namespace

  template <int dim>
  struct TorusForce<dim>::Data
  {
    physics::DoubleWell law;
    unsigned int n, n_half; ///< points and modes a row
    double side;
    std::size_t n_points, n_modes;
    std::vector<Direction<dim>> directions;
    base::AlignedArray<double> field;  ///< shape (dim, n_points)
    base::AlignedArray<Complex> modes; ///< of u, shape (dim, n_modes)
    base::AlignedArray<Complex> moved; ///< of u(x + ξ), one component
    base::Plan forward, backward;

    Data(const physics::DoubleWell &the_law, unsigned int n_side, double the_side);
    void transform(const std::vector<double> &u);
    void shift(const Direction<dim> &direction);
    template <typename Add>
    void over_bonds(const std::vector<double> &u, const Add &add);
  };

  template <int dim>
  TorusForce<dim>::Data::Data(const physics::DoubleWell &the_law, unsigned int n_side,
                              double the_side)
      : law(the_law), n(n_side), n_half(n / 2 + 1), side(the_side), n_points(dim == 1 ? n : n * n),
        n_modes(dim == 1 ? n_half : n * n_half), field(dim * n_points), modes(dim * n_modes),
        moved(n_modes)
  {
    const int extents[] = {static_cast<int>(n), static_cast<int>(n)};
    const auto to = reinterpret_cast<fftw_complex *>(moved.data());
    forward = base::Plan(fftw_plan_dft_r2c(dim, extents, field.data(), to, FFTW_ESTIMATE));
    backward = base::Plan(fftw_plan_dft_c2r(dim, extents, to, field.data(), FFTW_ESTIMATE));
  }

  template <int dim>
  TorusForce<dim>::TorusForce(const physics::DoubleWell &law, unsigned int n, double side,
                              unsigned int n_radii, unsigned int n_angles, Strain mean_strain)
  {
    if (n < 4 || n % 2 != 0 || !(side > 0) || n_radii == 0 || n_angles == 0)
      throw InputError("torus: " + std::to_string(n) + " points on a side of " +
                       std::to_string(side) + " with " + std::to_string(n_radii) + " radii and " +
                       std::to_string(n_angles) +
                       " angles; take an even number of points from 4, a positive side and at "
                       "least one radius and angle");
    data_ = std::make_unique<Data>(law, n, side);
    const dealii::QGauss<1> gauss(n_radii);
    const double horizon = law.horizon();
    for (unsigned int q = 0; q < n_radii; ++q)
    {
      const double r = horizon * gauss.point(q)[0], weight = horizon * gauss.weight(q);
      if constexpr (dim == 1)
        for (const double sign : {1., -1.})
          data_->directions.push_back({r, weight, {sign}, mean_strain[0][0]});
      else
        for (unsigned int k = 0; k < n_angles; ++k)
        {
          const double angle = 2 * M_PI * (k + .5) / n_angles;
          const std::array<double, 2> e{std::cos(angle), std::sin(angle)};
          double strain = 0;
          for (unsigned int a = 0; a < 2; ++a)
            for (unsigned int b = 0; b < 2; ++b)
              strain += e[a] * mean_strain[a][b] * e[b];
          data_->directions.push_back({r, weight * r * 2 * M_PI / n_angles, e, strain});
        }
    }
  }

  template <int dim>
  TorusForce<dim>::TorusForce(TorusForce &&) noexcept = default;
  template <int dim>
  TorusForce<dim>::~TorusForce() = default;

  template <int dim>
  std::size_t TorusForce<dim>::size() const
  {
    return dim * data_->n_points;
  }

  template <int dim>
  void TorusForce<dim>::Data::transform(const std::vector<double> &u)
  {
    for (unsigned int a = 0; a < dim; ++a)
    {
      for (std::size_t i = 0; i < n_points; ++i)
        field[i] = u[a * n_points + i] / static_cast<double>(n_points);
      fftw_execute(forward.get());
      std::copy_n(moved.data(), n_modes, modes.data() + a * n_modes);
    }
  }

  /// field = u(x + r e), all components
  template <int dim>
  void TorusForce<dim>::Data::shift(const Direction<dim> &direction)
  {
    std::array<std::vector<Complex>, dim> factor;
    for (unsigned int a = 0; a < dim; ++a)
      factor[a] = shifts(n, direction.radius * direction.e[a] / side, a == 0 ? n_half : n);
    for (unsigned int a = dim; a-- > 0;) // the first one last: the plan's output is its place
    {
      for (std::size_t i = 0; i < n_modes; ++i)
      {
        moved[i] = modes[a * n_modes + i] * factor[0][i % n_half];
        if constexpr (dim == 2)
          moved[i] *= factor[1][i / n_half];
      }
      fftw_execute(backward.get());
      if (a > 0)
        std::copy_n(field.data(), n_points, field.data() + a * n_points);
    }
  }

  template <int dim>
  template <typename Add>
  void TorusForce<dim>::Data::over_bonds(const std::vector<double> &u, const Add &add)
  {
    transform(u);
    for (const Direction<dim> &direction : directions)
    {
      shift(direction);
      const double r = direction.radius, weight = direction.weight * law.influence(r);
      for (std::size_t i = 0; i < n_points; ++i)
      {
        double strain = direction.mean_strain;
        for (unsigned int a = 0; a < dim; ++a)
          strain += direction.e[a] * (field[a * n_points + i] - u[a * n_points + i]) / r;
        add(i, direction, weight, strain);
      }
    }
  }

  template <int dim>
  void TorusForce<dim>::force(const std::vector<double> &u, std::vector<double> &f) const
  {
    const physics::DoubleWell &law = data_->law;
    f.assign(size(), 0.);
    data_->over_bonds(
        u,
        [&](std::size_t i, const Direction<dim> &direction, double weight, double strain)
        {
          const double value = law.force_factor() * weight *
                               law.derivative(direction.radius * strain * strain) * strain;
          for (unsigned int a = 0; a < dim; ++a)
            f[a * data_->n_points + i] += value * direction.e[a];
        });
  }

  template <int dim>
  double TorusForce<dim>::energy(const std::vector<double> &u) const
  {
    double sum = 0;
    data_->over_bonds(
        u, [&](std::size_t, const Direction<dim> &direction, double weight, double strain)
        { sum += weight * data_->law.potential(direction.radius * strain * strain); });
    return .25 * data_->law.force_factor() * sum * std::pow(data_->side, dim) /
           static_cast<double>(data_->n_points);
  }

  template <int dim>
  double TorusForce<dim>::interpolate(const double *values, const std::array<double, dim> &x) const
  {
    // cardinal functions of each axis
    const unsigned int n = data_->n;
    std::array<std::vector<double>, dim> cardinal;
    for (unsigned int a = 0; a < dim; ++a)
      for (unsigned int i = 0; i < n; ++i)
      {
        const double angle = 2 * M_PI * (x[a] / data_->side - static_cast<double>(i) / n);
        double sum = 1 + std::cos(.5 * n * angle);
        for (unsigned int k = 1; 2 * k < n; ++k)
          sum += 2 * std::cos(k * angle);
        cardinal[a].push_back(sum / n);
      }
    double result = 0;
    for (std::size_t i = 0; i < data_->n_points; ++i)
    {
      double product = cardinal[0][i % n];
      if constexpr (dim == 2)
        product *= cardinal[1][i / n];
      result += product * values[i];
    }
    return result;
  }

  template class TorusForce<1>;
  template class TorusForce<2>;
} // namespace plumbline::reference
