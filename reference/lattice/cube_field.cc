#include "reference/lattice/cube_field.h"

#include "base/error.h"

#include <deal.II/base/quadrature_lib.h>

#include <sstream>
#include <utility>

namespace plumbline::reference
{
  CubeField::CubeField(geometry::CubeLattice lattice, AxisShapes shapes, std::vector<double> values)
      : lattice_(std::move(lattice)), shapes_(std::move(shapes)), n_(lattice_.n_cells()),
        values_(std::move(values))
  {
    for (int &n : n_)
      n += 2;
  }

  CubeField::Place CubeField::place(const dealii::Point<3> &x) const
  {
    const auto cell = lattice_.cell_at(x);
    if (!cell)
    {
      std::ostringstream message;
      message << "(" << x << ") is outside the domain; take points in Domain/boxes";
      throw NumericalError(message.str());
    }
    Place place{*cell, {}};
    for (unsigned int d = 0; d < 3; ++d)
      place.inner[d] = (x[d] - lattice_.coordinate(d, (*cell)[d])) / lattice_.h();
    return place;
  }

  double CubeField::sum(const std::array<int, 3> &cell, unsigned int component,
                        const Factors &factors) const
  {
    const std::size_t n_axis = shapes_.families().size(),
                      n_block = static_cast<std::size_t>(n_[0]) * n_[1] * n_[2];
    const auto n_local = static_cast<int>(shapes_.n_local());
    double result = 0;
    geometry::for_each_index({0, 0, 0}, {n_local, n_local, n_local},
                             [&](const std::array<int, 3> &a)
                             {
                               std::size_t block = component;
                               std::array<int, 3> at{};
                               double factor = 1;
                               for (unsigned int d = 3; d-- > 0;)
                               {
                                 const auto owner = shapes_.owner(static_cast<unsigned int>(a[d]));
                                 block = block * n_axis + owner.family;
                                 at[d] = cell[d] + owner.shift + 1;
                                 factor *= factors[d][a[d]];
                               }
                               result += factor *
                                         values_[block * n_block + geometry::number_within(at, n_)];
                             });
    return result;
  }

  double CubeField::value(const dealii::Point<3> &x, unsigned int component) const
  {
    const auto [cell, inner] = place(x);
    Factors factors;
    for (unsigned int d = 0; d < 3; ++d)
      for (unsigned int a = 0; a < shapes_.n_local(); ++a)
        factors[d].push_back(shapes_.value(a, inner[d]));
    return sum(cell, component, factors);
  }

  dealii::Tensor<1, 3> CubeField::gradient(const dealii::Point<3> &x, unsigned int component) const
  {
    const auto [cell, inner] = place(x);
    dealii::Tensor<1, 3> result;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      Factors factors;
      for (unsigned int d = 0; d < 3; ++d)
        for (unsigned int a = 0; a < shapes_.n_local(); ++a)
          factors[d].push_back(d == axis ? shapes_.derivative(a, inner[d]) / lattice_.h()
                                         : shapes_.value(a, inner[d]));
      result[axis] = sum(cell, component, factors);
    }
    return result;
  }

  std::vector<double> CubeField::averages() const
  {
    const dealii::QGauss<1> gauss(shapes_.degree() / 2 + 1);
    std::vector<double> means(shapes_.n_local());
    for (unsigned int q = 0; q < gauss.size(); ++q)
      for (unsigned int a = 0; a < means.size(); ++a)
        means[a] += gauss.weight(q) * shapes_.value(a, gauss.point(q)[0]);
    const Factors factors = {means, means, means};
    const std::size_t n_families = shapes_.families().size() * shapes_.families().size() *
                                   shapes_.families().size(),
                      n_block = static_cast<std::size_t>(n_[0]) * n_[1] * n_[2],
                      n_components = values_.size() / (n_families * n_block);
    std::vector<double> result;
    lattice_.for_each_cell(
        [&](const std::array<int, 3> &cell)
        {
          for (unsigned int c = 0; c < n_components; ++c)
            result.push_back(sum(cell, c, factors));
        });
    return result;
  }
} // namespace plumbline::reference
