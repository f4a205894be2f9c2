#pragma once

#include "method/method.h"
#include "problem/in_space.h"
#include "problem/problem.h"
#include "study/study_results.h"

namespace plumbline::study
{
  using method::Method;

  /// The truncation error of a rule: by how much a field u fails its equations,
  /// τ_i = Σ_j a_ij u_j - b_i at each free node i. A e = τ relates it to the nodal error e, so that
  /// max|e| <= ‖A⁻¹‖∞ max|τ|: consistency and stability (Yang & Yin, theorem 4.1).
  struct Truncation
  {
    double largest = 0; ///< max|τ| [unit of the load]
    double l2 = 0;      ///< √(Σ volume |τ|²)
    double load =
        0; ///< max|b|, what largest is relative to; where b is round-off, max_i Σ|a_ij u_j|
    double round_off = 0; ///< up to which size |τ| is round-off
  };

  /// Of the method's equations, which are made anew; instantiated for dim = 2 and 3.
  /// @param u  with the problem's constraint at constrained nodes
  /// @pre method is meshfree: its equations hold at nodes
  /// @throws InputError      the equations have no sparse matrix (bodies with a free boundary), or
  ///                         it does not fit into memory
  template <int dim>
  Truncation truncation(const Method &method, const problem::Problem<dim> &problem,
                        const problem::Field<dim> &u);

  /// Enter into the record of a meshfree rule those of the norms that are of truncation, against
  /// the solutions that are known, and what they are relative to. Nothing of Galerkin methods,
  /// whose equations hold on average.
  template <int dim>
  void enter_truncation(const Method &method, const std::vector<scene::Norm> &norms,
                        const problem::Problem<dim> &problem, Record &record);
} // namespace plumbline::study
