#include "reference/lattice/double_well_galerkin.h"

#include "base/error.h"
#include "geometry/ball_cell.h"

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace plumbline::reference
{
  namespace
  {
    using Pair = std::array<double, 2>;

    /// A point of a cell's axis, with where it goes by z: hat functions at both ends.
    struct AxisPoint
    {
      double weight;
      Pair here, there; ///< of the nodes 0, 1 and cell, cell + 1
      int cell;
    };

    /// Gauss points on both sides of where x + z passes to the next cell.
    std::vector<AxisPoint> axis_points(double z, double h, unsigned int n_points)
    {
      const int cell = static_cast<int>(std::floor(z / h));
      const double fraction = z / h - cell;
      const dealii::QGauss<1> gauss(n_points);
      std::vector<AxisPoint> points;
      for (const bool is_next : {false, true})
      {
        const double from = is_next ? 1 - fraction : 0, length = is_next ? fraction : 1 - fraction;
        for (unsigned int q = 0; q < n_points; ++q)
        {
          const double x = from + length * gauss.point(q)[0];
          const double y = x + fraction - (is_next ? 1 : 0);
          points.push_back(
              {h * length * gauss.weight(q), {1 - x, x}, {1 - y, y}, cell + (is_next ? 1 : 0)});
        }
      }
      return points;
    }

    int wrap(int i, int n)
    {
      return ((i % n) + n) % n;
    }

    /// Of a power of (h/6) (1, 4, 1), whose symbol is h (2 + cos t)/3: its Fourier coefficients,
    /// which fall like (2 - √3)^k, by the rule of rectangles.
    std::vector<double> mass_root_weights(double h, double power)
    {
      constexpr int reach = 30, n = 4 * reach;
      std::vector<double> weights(reach + 1);
      for (int q = 0; q < n; ++q)
      {
        const double t = 2 * M_PI * q / n, symbol = std::pow(h * (2 + std::cos(t)) / 3, power);
        for (int k = 0; k <= reach; ++k)
          weights[k] += symbol * std::cos(k * t) / n;
      }
      return weights;
    }
  } // namespace

  template <int dim>
  DoubleWellGalerkin<dim>::DoubleWellGalerkin(const physics::DoubleWell &law, double h,
                                              std::array<int, 2> n, unsigned int n_points)
      : law_(law), h_(h), n_(n), reach_(0), width_(0)
  {
    if (!(h > 0) || n[0] < 2 || n[1] < (dim == 1 ? 1 : 2) || n_points == 0)
      throw InputError("Galerkin: " + std::to_string(n[0]) + " x " + std::to_string(n[1]) +
                       " cells of size h = " + std::to_string(h) + " with " +
                       std::to_string(n_points) +
                       " points; give at least 2 cells a side, a positive size and 1 point");
    const double horizon = law.horizon();
    const int m = static_cast<int>(std::ceil(horizon / h * (1 - 1e-14)));
    reach_ = m + 1;
    width_ = n[0] + 2 * reach_;
    if constexpr (dim == 1)
    {
      const dealii::QGauss<1> gauss(n_points);
      for (int c = 0; c < m; ++c)
        for (unsigned int q = 0; q < n_points; ++q)
        {
          const double length = std::min(h, horizon - c * h);
          add_way(law, {c * h + length * gauss.point(q)[0], 0}, length * gauss.weight(q), n_points);
        }
    }
    else
      for (int c2 = 0; c2 < m; ++c2)
        for (int c1 = -m; c1 < m; ++c1)
        {
          const auto cell = geometry::square(geometry::Point<2>(c1 * h, c2 * h), h);
          const auto rule = geometry::polar_rule({geometry::Point<2>(), horizon},
                                                 geometry::view(cell), n_points, n_points);
          for (std::size_t q = 0; q < rule.points.size(); ++q)
            add_way(law, {rule.points[q][0], rule.points[q][1]}, rule.weights[q], n_points);
        }
  }

  template <int dim>
  void DoubleWellGalerkin<dim>::add_way(const physics::DoubleWell &law, const Pair &z,
                                        double weight, unsigned int n_points)
  {
    Way way;
    way.r = std::hypot(z[0], z[1]);
    way.e = {z[0] / way.r, z[1] / way.r};
    way.weight = weight * law.influence(way.r) * law.force_factor();
    const auto along_x = axis_points(z[0], h_, n_points);
    const auto along_y =
        dim == 1 ? std::vector<AxisPoint>{{1, {1, 0}, {1, 0}, 0}} : axis_points(z[1], h_, n_points);
    for (const AxisPoint &y : along_y)
      for (const AxisPoint &x : along_x)
      {
        Sample sample;
        sample.weight = x.weight * y.weight;
        for (int corner = 0; corner < n_corners; ++corner)
        {
          const int i = corner % 2, j = corner / 2;
          sample.coefficient[corner] = x.there[i] * y.there[j];
          sample.shift[corner] = (y.cell + j) * static_cast<std::ptrdiff_t>(width_) + x.cell + i;
          sample.coefficient[n_corners + corner] = -x.here[i] * y.here[j];
          sample.shift[n_corners + corner] = j * static_cast<std::ptrdiff_t>(width_) + i;
        }
        way.samples.push_back(sample);
      }
    n_evaluations_ += way.samples.size();
    ways_.push_back(std::move(way));
  }

  /// visit(way, sample, row, strains of each field in all cells of a row)
  template <int dim>
  template <std::size_t n_fields, typename Visit>
  void DoubleWellGalerkin<dim>::over_ways(const Fields<n_fields> &fields, const Visit &visit) const
  {
    const int margin = dim == 1 ? 0 : reach_;
    std::array<std::vector<double>, n_fields> padded, strains;
    padded.fill(std::vector<double>(width_ * (n_[1] + 2 * margin)));
    strains.fill(std::vector<double>(n_[0]));
    for (const Way &way : ways_)
    {
      for (std::size_t f = 0; f < n_fields; ++f)
        for (int j = -margin; j < n_[1] + margin; ++j)
          for (int i = -reach_; i < n_[0] + reach_; ++i)
          {
            const std::vector<double> &u = *fields[f];
            const std::size_t node =
                static_cast<std::size_t>(wrap(j, n_[1])) * n_[0] + wrap(i, n_[0]);
            double value = way.e[0] * u[node];
            if constexpr (dim == 2)
              value += way.e[1] * u[n_nodes() + node];
            padded[f][(j + margin) * width_ + reach_ + i] = value / way.r;
          }
      for (const Sample &sample : way.samples)
        for (int j = 0; j < n_[1]; ++j)
        {
          const std::size_t row = (j + margin) * width_ + reach_;
          for (std::size_t f = 0; f < n_fields; ++f)
          {
            std::vector<double> &strain = strains[f];
            std::fill(strain.begin(), strain.end(), 0.);
            for (int s = 0; s < 2 * n_corners; ++s)
            {
              const double *const from = padded[f].data() + row + sample.shift[s];
              for (int i = 0; i < n_[0]; ++i)
                strain[i] += sample.coefficient[s] * from[i];
            }
          }
          visit(way, sample, row, strains);
        }
    }
  }

  /// r = -Σ weight pull(r, strains of each field) ∂S/∂u.
  template <int dim>
  template <std::size_t n_fields, typename Pull>
  void DoubleWellGalerkin<dim>::test(const Fields<n_fields> &fields, const Pull &pull,
                                     std::vector<double> &r) const
  {
    const int margin = dim == 1 ? 0 : reach_;
    const std::size_t block = width_ * (n_[1] + 2 * margin);
    std::vector<double> padded(dim * block);
    over_ways<n_fields>(fields,
                        [&](const Way &way, const Sample &sample, std::size_t row,
                            std::array<std::vector<double>, n_fields> &strains)
                        {
                          const double factor = way.weight * sample.weight;
                          std::vector<double> &pulls = strains[0];
                          for (int i = 0; i < n_[0]; ++i)
                            pulls[i] = factor * pull(way.r, strains, i);
                          for (int a = 0; a < dim; ++a)
                            for (int s = 0; s < 2 * n_corners; ++s)
                            {
                              double *const to = padded.data() + a * block + row + sample.shift[s];
                              const double weight = way.e[a] * sample.coefficient[s];
                              for (int i = 0; i < n_[0]; ++i)
                                to[i] -= weight * pulls[i];
                            }
                        });
    r.assign(size(), 0.);
    for (int a = 0; a < dim; ++a)
      for (int j = -margin; j < n_[1] + margin; ++j)
        for (int i = -reach_; i < n_[0] + reach_; ++i)
          r[(static_cast<std::size_t>(a) * n_[1] + wrap(j, n_[1])) * n_[0] + wrap(i, n_[0])] +=
              padded[a * block + (j + margin) * width_ + reach_ + i];
  }

  template <int dim>
  void DoubleWellGalerkin<dim>::residual(const std::vector<double> &u, std::vector<double> &r) const
  {
    test<1>(
        {&u},
        [this](double length, const auto &strains, int i)
        {
          const double s = strains[0][i];
          return law_.derivative(length * s * s) * s;
        },
        r);
  }

  template <int dim>
  void DoubleWellGalerkin<dim>::tangent(const std::vector<double> &u, const std::vector<double> &v,
                                        std::vector<double> &out) const
  {
    test<2>(
        {&u, &v},
        [this](double length, const auto &strains, int i)
        {
          const double stretched = length * strains[0][i] * strains[0][i]; // f'' = -β f'
          return law_.derivative(stretched) * (1 - 2 * law_.beta() * stretched) * strains[1][i];
        },
        out);
  }

  template <int dim>
  double DoubleWellGalerkin<dim>::energy(const std::vector<double> &u) const
  {
    double sum = 0;
    over_ways<1>({&u},
                 [&](const Way &way, const Sample &sample, std::size_t, const auto &strains)
                 {
                   for (const double s : strains[0])
                     sum += way.weight * sample.weight * law_.potential(way.r * s * s);
                 });
    return .5 * sum;
  }

  /// x_i = Σ_k weights[|k|] x_{i+k} along each axis
  template <int dim>
  void DoubleWellGalerkin<dim>::convolve(const std::vector<double> &weights,
                                         std::vector<double> &x) const
  {
    const int reach = static_cast<int>(weights.size()) - 1;
    for (int axis = 0; axis < dim; ++axis)
    {
      const int n = n_[axis], stride = axis == 0 ? 1 : n_[0];
      std::vector<double> line(n);
      for (std::size_t first = 0; first < x.size(); ++first)
        if (first / stride % n == 0)
        {
          for (int i = 0; i < n; ++i)
            line[i] = x[first + static_cast<std::size_t>(i) * stride];
          for (int i = 0; i < n; ++i)
          {
            double sum = weights[0] * line[i];
            for (int k = 1; k <= reach; ++k)
              sum += weights[k] * (line[wrap(i - k, n)] + line[wrap(i + k, n)]);
            x[first + static_cast<std::size_t>(i) * stride] = sum;
          }
        }
    }
  }

  template <int dim>
  void DoubleWellGalerkin<dim>::apply_mass(std::vector<double> &x) const
  {
    convolve({2 * h_ / 3, h_ / 6}, x);
  }

  template <int dim>
  void DoubleWellGalerkin<dim>::apply_inverse_mass(std::vector<double> &x) const
  {
    // the inverse of (1, 4, 1)/6 is √3 (√3 - 2)^|k|, which falls below round-off at 28
    constexpr int reach = 30;
    std::vector<double> weights;
    for (int k = 0; k <= reach; ++k)
      weights.push_back(std::sqrt(3.) * std::pow(std::sqrt(3.) - 2, k) / h_);
    convolve(weights, x);
  }

  template <int dim>
  void DoubleWellGalerkin<dim>::apply_mass_root(std::vector<double> &x) const
  {
    convolve(mass_root_weights(h_, .5), x);
  }

  template <int dim>
  void DoubleWellGalerkin<dim>::apply_inverse_mass_root(std::vector<double> &x) const
  {
    convolve(mass_root_weights(h_, -.5), x);
  }

  template <int dim>
  void DoubleWellGalerkin<dim>::acceleration(const std::vector<double> &u,
                                             std::vector<double> &a) const
  {
    residual(u, a);
    apply_inverse_mass(a);
  }

  template class DoubleWellGalerkin<1>;
  template class DoubleWellGalerkin<2>;
} // namespace plumbline::reference
