#include "reference/lattice/double_well_galerkin.h"

#include "base/error.h"
#include "base/symmetric_eigen.h"
#include "geometry/ball_cell.h"

#include <deal.II/base/quadrature_lib.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <string>

namespace plumbline::reference
{
  namespace
  {
    using Pair = std::array<double, 2>;

    /// A point of a cell's axis, with where it goes by z: the shape functions of both cells there.
    struct AxisPoint
    {
      double weight;
      std::vector<double> here, there;
      int cell; ///< that x + z lies in, from that of x
    };

    std::vector<double> values_at(const AxisShapes &shapes, double x)
    {
      std::vector<double> values;
      for (unsigned int a = 0; a < shapes.n_local(); ++a)
        values.push_back(shapes.value(a, x));
      return values;
    }

    /// Gauss points on both sides of where x + z passes to the next cell.
    std::vector<AxisPoint> axis_points(const AxisShapes &shapes, double z, double h,
                                       unsigned int n_points)
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
          points.push_back({h * length * gauss.weight(q), values_at(shapes, x),
                            values_at(shapes, y), cell + (is_next ? 1 : 0)});
        }
      }
      return points;
    }

    int wrap(int i, int n)
    {
      return ((i % n) + n) % n;
    }

    /// ∫ φ_i φ_j of the periodic functions along an axis of n cells.
    Eigen::MatrixXd axis_mass(const AxisShapes &shapes, double h, int n)
    {
      const auto degree = static_cast<int>(shapes.degree());
      const dealii::QGauss<1> gauss(shapes.degree() + 1);
      Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(n * degree, n * degree);
      for (unsigned int q = 0; q < gauss.size(); ++q)
      {
        const auto values = values_at(shapes, gauss.point(q)[0]);
        for (int cell = 0; cell < n; ++cell)
          for (int a = 0; a <= degree; ++a)
            for (int b = 0; b <= degree; ++b)
              mass((cell * degree + a) % (n * degree), (cell * degree + b) % (n * degree)) +=
                  h * gauss.weight(q) * values[a] * values[b];
      }
      return mass;
    }
  } // namespace

  template <int dim>
  DoubleWellGalerkin<dim>::DoubleWellGalerkin(const physics::DoubleWell &law, double h,
                                              std::array<int, 2> n, unsigned int n_points,
                                              unsigned int degree, bool is_lumped)
      : law_(law), h_(h), n_(n), shapes_(true, degree), degree_(static_cast<int>(degree)),
        reach_(0), width_(0)
  {
    if (!(h > 0) || n[0] < 2 || n[1] < (dim == 1 ? 1 : 2) || n_points == 0)
      throw InputError("Galerkin: " + std::to_string(n[0]) + " x " + std::to_string(n[1]) +
                       " cells of size h = " + std::to_string(h) + " with " +
                       std::to_string(n_points) +
                       " points; give at least 2 cells a side, a positive size and 1 point");
    const double horizon = law.horizon();
    const int m = static_cast<int>(std::ceil(horizon / h * (1 - 1e-14)));
    reach_ = (m + 1) * degree_;
    width_ = n_along()[0] + 2 * reach_;
    for (int axis = 0; axis < dim; ++axis)
    {
      Eigen::MatrixXd mass = axis_mass(shapes_, h, n[axis]);
      if (is_lumped)
        mass = Eigen::MatrixXd((mass.diagonal() * (n[axis] * h / mass.trace())).asDiagonal());
      const auto eigen = base::symmetric_eigen(mass);
      for (const double power : {1., -1., .5, -.5})
      {
        const Eigen::VectorXd values = eigen.values.array().pow(power).matrix();
        const Eigen::MatrixXd matrix =
            eigen.vectors * values.asDiagonal() * eigen.vectors.transpose();
        mass_[axis][power] = {matrix.data(), matrix.data() + matrix.size()};
      }
    }
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
    const auto along_x = axis_points(shapes_, z[0], h_, n_points);
    const auto along_y = dim == 1 ? std::vector<AxisPoint>{{1, {1}, {1}, 0}}
                                  : axis_points(shapes_, z[1], h_, n_points);
    const auto row = static_cast<std::ptrdiff_t>(width_);
    for (const AxisPoint &y : along_y)
      for (const AxisPoint &x : along_x)
      {
        Sample sample{x.weight * y.weight, {}};
        for (std::size_t j = 0; j < y.here.size(); ++j)
          for (std::size_t i = 0; i < x.here.size(); ++i)
          {
            const auto node = static_cast<std::ptrdiff_t>(j) * row + static_cast<std::ptrdiff_t>(i);
            sample.terms.push_back(
                {x.there[i] * y.there[j], degree_ * (y.cell * row + x.cell) + node});
            sample.terms.push_back({-x.here[i] * y.here[j], node});
          }
        way.samples.push_back(std::move(sample));
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
    const auto [n_x, n_y] = n_along();
    padded.fill(std::vector<double>(width_ * (n_y + 2 * margin)));
    strains.fill(std::vector<double>(n_[0]));
    for (const Way &way : ways_)
    {
      for (std::size_t f = 0; f < n_fields; ++f)
        for (int j = -margin; j < n_y + margin; ++j)
          for (int i = -reach_; i < n_x + reach_; ++i)
          {
            const std::vector<double> &u = *fields[f];
            const std::size_t node = static_cast<std::size_t>(wrap(j, n_y)) * n_x + wrap(i, n_x);
            double value = way.e[0] * u[node];
            if constexpr (dim == 2)
              value += way.e[1] * u[n_nodes() + node];
            padded[f][(j + margin) * width_ + reach_ + i] = value / way.r;
          }
      for (const Sample &sample : way.samples)
        for (int j = 0; j < n_[1]; ++j)
        {
          const std::size_t row = (j * degree_ + margin) * width_ + reach_;
          for (std::size_t f = 0; f < n_fields; ++f)
          {
            std::vector<double> &strain = strains[f];
            std::fill(strain.begin(), strain.end(), 0.);
            for (const Term &term : sample.terms)
            {
              const double *const from = padded[f].data() + row + term.shift;
              for (int i = 0; i < n_[0]; ++i)
                strain[i] += term.coefficient * from[i * degree_];
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
    const auto [n_x, n_y] = n_along();
    const std::size_t block = width_ * (n_y + 2 * margin);
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
                            for (const Term &term : sample.terms)
                            {
                              double *const to = padded.data() + a * block + row + term.shift;
                              const double weight = way.e[a] * term.coefficient;
                              for (int i = 0; i < n_[0]; ++i)
                                to[i * degree_] -= weight * pulls[i];
                            }
                        });
    r.assign(size(), 0.);
    for (int a = 0; a < dim; ++a)
      for (int j = -margin; j < n_y + margin; ++j)
        for (int i = -reach_; i < n_x + reach_; ++i)
          r[(static_cast<std::size_t>(a) * n_y + wrap(j, n_y)) * n_x + wrap(i, n_x)] +=
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
          const double s = strains[0][i];
          return law_.tangent(length * s * s) * strains[1][i];
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

  template <int dim>
  void DoubleWellGalerkin<dim>::apply_along(int axis, double power, std::vector<double> &x) const
  {
    const Eigen::Index n = n_along()[axis];
    const Eigen::Map<const Eigen::MatrixXd> matrix(mass_[axis].at(power).data(), n, n);
    const Eigen::Index n_x = n_along()[0], n_rows = static_cast<Eigen::Index>(x.size()) / n_x;
    if (axis == 0)
    {
      Eigen::Map<Eigen::MatrixXd> rows(x.data(), n_x, n_rows); // one a column
      rows = (matrix * rows).eval();
      return;
    }
    for (Eigen::Index first = 0; first < n_rows; first += n)
    {
      Eigen::Map<Eigen::MatrixXd> block(x.data() + first * n_x, n_x, n);
      block = (block * matrix).eval();
    }
  }

  template <int dim>
  void DoubleWellGalerkin<dim>::apply_mass(std::vector<double> &x, double power) const
  {
    for (int axis = 0; axis < dim; ++axis)
      apply_along(axis, power, x);
  }

  template <int dim>
  void DoubleWellGalerkin<dim>::acceleration(const std::vector<double> &u,
                                             std::vector<double> &a) const
  {
    residual(u, a);
    apply_mass(a, -1);
  }

  template class DoubleWellGalerkin<1>;
  template class DoubleWellGalerkin<2>;
} // namespace plumbline::reference
