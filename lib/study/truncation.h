#pragma once

#include "method/method.h"
#include "problem/in_space.h"
#include "problem/problem.h"
#include "study/study_results.h"

namespace plumbline::study
{
  using method::Method;

  /// The truncation error of a rule is by how much a field u fails its equations,
  /// τ_i = Σ_j a_ij u_j - b_i at each free node i, and relates to the nodal error e by A e = τ
  /// (Yang & Yin, theorem 4.1). Consistency and stability bound e: max|e| <= ‖A⁻¹‖∞ max|τ|, and in
  /// L2 ‖e‖ <= ‖τ‖ / λ, λ the smallest eigenvalue of A's symmetric part; times √(max a/V) for the
  /// norm "nodal L2" of the plane, in which each node has the same area a instead of its cell's V.
  ///
  /// Enter into the record of a meshfree rule those of the norms that are of truncation or of
  /// these bounds, against the solutions that are known, and what they are made of: "largest
  /// load", "truncation round-off", and for bounds "inverse norm" (where "inverse norm is exact" is
  /// 0 a lower bound near it, so that "bound Linf" is an estimate) and "smallest eigenvalue". No
  /// bound where A is not positive definite, or its equations are not solved. Nothing of Galerkin
  /// methods, whose equations hold on average. The rule's equations are made anew for it.
  /// @throws InputError  the equations have no sparse matrix (bodies with a free boundary), or
  ///                     it does not fit into memory
  template <int dim>
  void enter_truncation(const Method &method, const std::vector<scene::Norm> &norms,
                        const problem::Problem<dim> &problem, Record &record);
} // namespace plumbline::study
