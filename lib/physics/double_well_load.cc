#include "physics/double_well_load.h"

#include "base/error.h"

#include <deal.II/base/quadrature_lib.h>

#include <cmath>

namespace plumbline::physics
{
  template <int dim>
  WellForce<dim>::WellForce(const DoubleWell &law, unsigned int n_radii, unsigned int n_angles)
      : law_(law)
  {
    if (n_radii == 0 || n_angles == 0)
      throw InputError("force of a field: " + std::to_string(n_radii) + " radii and " +
                       std::to_string(n_angles) + " angles; take at least one of each");
    const dealii::QGauss<1> gauss(n_radii);
    const unsigned int n_directions = dim == 1 ? 2 : n_angles;
    for (unsigned int q = 0; q < n_radii; ++q)
      for (unsigned int k = 0; k < n_directions; ++k)
      {
        Bond bond;
        bond.r = law.horizon() * gauss.point(q)[0];
        const double angle = 2 * M_PI * (k + (dim == 1 ? 0 : .5)) / n_directions;
        bond.e[0] = std::cos(angle);
        double measure = 1; // of the line for a point, or of the circle
        if constexpr (dim == 2)
        {
          bond.e[1] = std::sin(angle);
          measure = bond.r * 2 * M_PI / n_directions;
        }
        bond.weight =
            law.force_factor() * law.horizon() * gauss.weight(q) * measure * law.influence(bond.r);
        bonds_.push_back(bond);
      }
  }

  template <int dim>
  dealii::Tensor<1, dim> WellForce<dim>::operator()(const Field &u,
                                                    const dealii::Point<dim> &x) const
  {
    const auto here = u(x);
    dealii::Tensor<1, dim> sum;
    for (const Bond &bond : bonds_)
    {
      const double strain = (u(x + bond.r * bond.e) - here) * bond.e / bond.r;
      sum += bond.weight * law_.derivative(bond.r * strain * strain) * strain * bond.e;
    }
    return sum;
  }

  template class WellForce<1>;
  template class WellForce<2>;
} // namespace plumbline::physics
