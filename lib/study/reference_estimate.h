#pragma once

#include "study/method.h"

namespace plumbline::study
{
  /// Decimal digits of a solution of a given size that an estimate of its error leaves certain.
  unsigned int certified_digits(double estimate, double size);

  /// How far the averages of a Galerkin solution move by the last refinement of outer quadrature,
  /// to h/2 and to degree p + 1.
  /// @param is_cheap  on meshes, compare with degrees p and p + 1 on a mesh of 2 h, where the scene
  /// has one: the first bounds the error where halving h halves it at least. Cost: about that of
  /// the solution itself; else 17 times as much and more.
  ErrorEstimate estimate_error(const scene::Scene &scene, const scene::Problem &problem,
                               unsigned int case_index, const Method &method,
                               const Solution &solution, bool is_cheap);

  /// A reference solution's averages with their estimate.
  struct ReferenceAverages
  {
    std::vector<double> averages;
    ErrorEstimate estimate; ///< of outer quadrature alone if the scene asks for none
  };

  /// @throws NumericalError  the estimate is larger than the scene's Reference/tolerance
  ReferenceAverages solve_reference(const scene::Scene &scene, const scene::Problem &problem,
                                    unsigned int case_index, const Method &method);
} // namespace plumbline::study
