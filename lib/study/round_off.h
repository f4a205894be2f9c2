#pragma once

#include "analysis/statics.h"
#include "problem/on_line.h"
#include "study/results.h"

namespace plumbline::study
{
  using analysis::Solution;

  /// Up to which size errors of a solution are round-off: 10 (ε (A v + max|u|) + r s). A = ∫|C|
  /// ‖L⁻¹‖ is by how much the operator's two terms, which cancel, exceed their difference; r the
  /// solver's relative residual, at least ε; s what is solved for: max|u|, or on lattices, where a
  /// constant is taken off first, how far u varies; v the same, but max|u| where the load is
  /// manufactured from u. ‖L⁻¹‖∞ is bounded by the barrier a² / ∫C ξ_1² of a strip of half-width a
  /// = half the domain's smaller side and the horizon (Yang & Yin, lemma 4.2, with the bound that
  /// holds for large horizons too). The factor 10 covers sums of many terms and transforms.
  /// @return  absolute, in the unit of the solution
  double round_off_error(const problem::Problem<2> &problem, const Solution &solution);

  /// The same in space.
  /// @param ranks  that share the solution
  double round_off_error(const problem::Problem<3> &problem,
                         const analysis::SolutionInSpace &solution,
                         const base::Communicator &ranks = base::Communicator::alone());

  /// The same on intervals. ∫|C| is taken from h/2 on: nearer there are no bonds, and kernels like
  /// 1/r have no such integral.
  double round_off_error(const problem::Problem<1> &problem, const std::vector<double> &averages,
                         const method::Diagnostics &diagnostics);

  /// How far a solution varies: largest less least cell average, of the component where it is most.
  /// @param averages  shape (n_cells, n_components)
  /// @param ranks     that share the cells
  double variation(unsigned int n_components, const std::vector<double> &averages,
                   const base::Communicator &ranks = base::Communicator::alone());
} // namespace plumbline::study
