// Kernels and moments of rules on lattices, in the plane and in space.
#pragma once

#include "meshfree/rules/moments.h"
#include "meshfree/rules/rules.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <type_traits>

namespace plumbline::meshfree
{
  constexpr double h = .01; ///< of the lattice

  template <int dim>
  Kernel<dim> scalar_kernel(double m, const std::string &type = "linear-decay")
  {
    return Kernel<dim>::with_diffusion(physics::kernel_type(type).profile, m * h, .5);
  }

  template <int dim>
  Kernel<dim> tensor_kernel(double m)
  {
    return Kernel<dim>::with_bulk_modulus(physics::kernel_type("bond-tensor").profile, m * h, 1);
  }

  /// Σ C_ab(point) w ξ^α.
  template <int dim>
  double moment(const Kernel<dim> &kernel, const Bonds<dim> &bonds, unsigned int a, unsigned int b,
                const std::common_type_t<Exponents<dim>> &alpha)
  {
    double sum = 0;
    for (const Bond<dim> &bond : bonds.family)
    {
      double term = kernel_value(kernel, bond, a, b) * bond.weight;
      for (unsigned int d = 0; d < dim; ++d)
        term *= std::pow(bond.xi[d], alpha[d]);
      sum += term;
    }
    return sum;
  }

  /// Of weights to areas or volumes.
  template <int dim>
  double smallest_ratio(const Bonds<dim> &bonds)
  {
    double smallest = 1e300;
    for (const Bond<dim> &bond : bonds.family)
      smallest = std::min(smallest, bond.weight / bond.area);
    return smallest;
  }
} // namespace plumbline::meshfree
