#pragma once

#include "physics/double_well.h"

#include <deal.II/base/tensor.h>

#include <functional>

namespace plumbline::physics
{
  /// F(u)(x) of a given field with ω = 1, by Gauss points in the radius and equidistant angles:
  /// with it a manufactured body force is b = ρ u_tt - F(u). Instantiated for dim = 1 and 2.
  /// Accuracy for a field whose waves are 7 horizons long, strains up to the softening one: 3e-10
  /// of the largest force with (n_radii, n_angles) = (10, 24), 3e-14 with (12, 32); 3e-8 and 6e-11
  /// where f = r/(1 + r); more points for rougher fields.
  /// Not for: fields with kinks or jumps in the ball, or ω that is not smooth there.
  template <int dim>
  class WellForce
  {
  public:
    using Field = std::function<dealii::Tensor<1, dim>(const dealii::Point<dim> &x)>;

    /// @throws InputError  no radii or angles
    /// @pre law.dim() == dim
    explicit WellForce(const DoubleWell &law, unsigned int n_radii = 12,
                       unsigned int n_angles = 32);

    dealii::Tensor<1, dim> operator()(const Field &u, const dealii::Point<dim> &x) const;

  private:
    struct Bond
    {
      dealii::Tensor<1, dim> e;
      double r = 0, weight = 0;
    };
    DoubleWell law_;
    std::vector<Bond> bonds_;
  };
} // namespace plumbline::physics
