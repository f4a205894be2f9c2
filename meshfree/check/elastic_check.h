#pragma once

#include "meshfree/rules/quadrature_rule.h"

#include <string>
#include <vector>

namespace plumbline::meshfree
{
  /// An elastic constant over all families.
  struct ElasticRange
  {
    std::string name; ///< e.g. "C1111", or "E, plane stress"
    double least = 0, median = 0, largest = 0;
    double exact = 0; ///< of the kernel: what exact second moments give
  };

  /// The stiffness of the weights, see `stiffness`, its anisotropy, and Young's modulus and
  /// Poisson's ratio that follow, in the plane in plane stress and plane strain, in the unit of the
  /// kernel. Empty for scalar kernels.
  template <int dim>
  std::vector<ElasticRange> elastic_ranges(const std::vector<Family<dim>> &families,
                                           const Kernel<dim> &kernel);
} // namespace plumbline::meshfree
