#pragma once

#include "study/method.h"

namespace plumbline::study
{
  /// Decimal digits of a solution of a given size that an estimate of its error leaves certain.
  unsigned int certified_digits(double estimate, double size);

  /// A reference solution's averages, and how far they move by the last refinement of outer
  /// quadrature, to h/2 and to degree p + 1.
  struct ReferenceAverages
  {
    std::vector<double> averages;
    ReferenceEstimate estimate;
  };

  /// @throws NumericalError  the estimate is larger than the scene's Reference/tolerance
  ReferenceAverages solve_reference(const scene::Scene &scene, const scene::Problem &problem,
                                    unsigned int case_index, const Method &method);
} // namespace plumbline::study
