#pragma once

#include "analysis/statics.h"
#include "scene/problem.h"
#include "study/analysis.h"
#include "study/results.h"
#include "study/values_at_points.h"

namespace plumbline::study
{
  using analysis::Solution;
  using method::Method;

  /// Decimal digits of a solution of a given size that an estimate of its error leaves certain.
  unsigned int certified_digits(double estimate, double size);

  /// The scene without its reference and without error estimates.
  scene::Scene without_reference(scene::Scene scene);

  /// Whether a scene wants the error of a method's solutions, besides the reference, estimated.
  bool is_estimated(const scene::Scene &scene, const Method &method);

  /// The estimate with its case, series and level.
  ErrorEstimate placed(ErrorEstimate estimate, const Place &place, const std::string &problem);

  /// Raises estimates at points to at least twice their root mean square, since changes may pass
  /// through zero, and adds the errors that changes do not show.
  void raise_to_mean(std::vector<double> &estimates, double more);

  /// By how much an error falls as h is halved, as far as two changes show: `now` to h/2, `before`
  /// from 2 h (0: not known), but no less than is expected of the method and no more than 3/4.
  double contraction(double before, double now, double expected);

  /// The estimate that follows from the change to h/2.
  double error_of_change(double change, double contraction);

  /// What the linear solver leaves of a solution of a given size.
  double solver_error(double tolerance, double size);

  /// What follows from the changes of averages alone, with nothing of the field.
  /// @param contraction  see there
  /// @param size         of the solution
  /// @param tolerance    of the linear solver
  void conclude_from_changes(ErrorEstimate &estimate, double contraction, double size,
                             double tolerance);

  /// @param size    of the solution
  /// @param remedy  what to change
  /// @throws NumericalError  a reference's estimate is larger than Reference/tolerance
  void check_tolerance(const scene::ReferenceSection &wanted, const ErrorEstimate &estimate,
                       double size, const std::string &remedy);

  /// How far a Galerkin solution may be wrong, its averages and its field, in L2: a bound in
  /// practice. Changes d to h/2 and d' from 2 h to h give Richardson's e = d / (1 - q) with q the
  /// largest of 2^-(p+1), of 1/4 where sides stand for a curve (1/2 where cells are chosen by their
  /// centres), and of d / d' of averages and field; 3/2 of that, or 3/2 of the change to degree p +
  /// 1 if that is larger (where cells take that degree), the last change by outer quadrature, and
  /// ten times the solver's tolerance are the estimate. Meshes that a scene describes are made
  /// anew, so that they follow a curved boundary; of others the estimate holds for the polygon, and
  /// says so. Accuracy: audited by benchmarks/estimates, see there: no error is above its estimate.
  /// @param is_cheap  on meshes of 500 cells or more, compare with degrees p and p + 1 on a mesh of
  /// 2 h and with 4 h instead, where the scene has these: e = d' q / (1 - q), and 2 of that for
  /// 3/2. Cost: about that of the solution itself; else 17 times as much and more.
  /// @param points  where the error is estimated, too, by the same changes there; as a change may
  /// pass through zero, by no less than twice the root mean square of these over all points
  ErrorEstimate estimate_error(const scene::Case &one, const Method &method,
                               const Solution &solution, bool is_cheap,
                               const std::vector<dealii::Point<2>> &points = {});

  /// A reference solution's averages with their estimate, and its values at points.
  struct ReferenceAverages
  {
    std::vector<double> averages;
    ErrorEstimate estimate; ///< of outer quadrature alone if the scene asks for none
    ValuesAtPoints at_points;
  };

  /// @throws NumericalError  the estimate is larger than the scene's Reference/tolerance
  ReferenceAverages solve_reference(const scene::Case &one, const Method &method,
                                    const scene::ReferenceSection &wanted,
                                    const std::vector<dealii::Point<2>> &points = {});
} // namespace plumbline::study
