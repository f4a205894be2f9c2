#pragma once

#include "analysis/stability.h"
#include "study/analysis.h"

#include <cmath>
#include <type_traits>

namespace plumbline::study
{
  using analysis::Consistency;
  using analysis::Modes;
  using analysis::Stability;

  /// The longest time steps of central differences, 2/√(λ/ρ) with λ the largest eigenvalue of small
  /// motions about rest; where the operator is not symmetric, its largest in modulus.
  struct CriticalSteps
  {
    double density = 1;
    double largest = 0;         ///< λ with the method's own masses; 0: not known
    double largest_lumped = 0;  ///< of Galerkin methods by lumped masses; 0: these are its own
    bool is_oscillating = true; ///< λ are real and not negative; else motions grow at any step

    double own() const { return of(largest); } ///< [time]; 0: not known
    double lumped() const { return of(largest_lumped); }

  private:
    double of(double eigenvalue) const
    {
      return eigenvalue > 0 ? 2 * std::sqrt(density / eigenvalue) : 0;
    }
  };

  template <int dim>
  using DiscretisationOf =
      std::conditional_t<dim == 2, method::Discretisation, method::DiscretisationInSpace>;

  /// @param stability  of its matrix, whose masses are lumped
  template <int dim>
  CriticalSteps critical_steps(const DiscretisationOf<dim> &discretisation,
                               const problem::Problem<dim> &problem, const Stability &stability,
                               double density);

  /// What is measured of an operator, as a record.
  /// @param record  of the place and the method
  Record stability_record(Record record, const Stability &stability, const Consistency &consistency,
                          const CriticalSteps &steps);

  /// A record's operator has no positive off-diagonal entries and so on, see
  /// algebra::SignCheck::is_m_matrix.
  bool is_m_matrix(const Record &record);

  /// Positive definite, the eigenvalues being known up to 1e-10 of the largest.
  bool is_definite(const Record &record);

  /// "3", or "12 or more".
  std::string zero_modes(const Record &record);

  /// For each method and series the powers of h, or of the horizon where h is fixed, of smallest
  /// and largest eigenvalue and norm of the inverse, at the finest three levels. Absent: fewer
  /// levels have the scalar, or their sizes are within a factor 2.
  /// @param records  coarse to fine in each series
  std::vector<Power> stability_powers(const Records &records);

  /// A level is sound if A is positive definite, and good if besides no weight is negative, the
  /// moments asked of families are independent, and bonds tie all nodes together. stable: all
  /// levels are good, and the coercivity constant does not fall with the mesh size by a power above
  /// ½. conditionally stable: a bound on m = δ / h separates good levels from others, or sound ones
  /// from others, or all are sound. Else unstable.
  /// @param records   of one method, series by series, coarse to fine
  /// @param variable  that varies, see scene::StudySection; no bound on m separates its levels
  Verdict judge_stability(const Records &records, const std::string &variable = "");

  /// Operators on displacements; where double wells are periodic also how waves on strains grow.
  Analysis stability_analysis();
} // namespace plumbline::study
