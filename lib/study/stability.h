#pragma once

#include "analysis/stability.h"
#include "method/side.h"
#include "study/axis.h"
#include "study/strain_growth.h"

#include <cmath>

namespace plumbline::study
{
  using analysis::Consistency;
  using analysis::Modes;
  using analysis::Stability;
  using method::Side;

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

  /// @param stability  of its matrix, whose masses are lumped
  CriticalSteps critical_steps(const method::Discretisation &discretisation,
                               const scene::Problem &problem, const Stability &stability,
                               double density);

  /// One method at one level of a scene.
  struct StabilityRow
  {
    std::string method;
    Side side = Side::meshfree; ///< of the method
    std::string series;
    double h = 0, horizon = 0; ///< [length]
    Stability stability;
    Consistency consistency;
    std::string failure; ///< empty, or why there is no operator
    CriticalSteps steps = {};
    double seconds = 0; ///< CPU time
    double value = 0;   ///< of StabilityResults::variable

    double m() const { return horizon / h; }
  };

  /// How the measures of one method vary over one series: the powers of what varies at the finest
  /// three levels. Not a number: fewer levels have the measure, or their sizes are within a
  /// factor 2.
  struct StabilityTrend
  {
    std::string method, series;
    Axis axis = Axis::mesh_size;
    double smallest = 0, largest = 0, inverse_norm = 0;
  };

  /// One for each method and series, as they stand in the rows.
  /// @param rows  coarse to fine in each series
  std::vector<StabilityTrend> stability_trends(const std::vector<StabilityRow> &rows);

  enum class StabilityAnswer
  {
    stable,
    conditional, ///< see StabilityVerdict::condition
    unstable
  };

  /// What the levels of one method say together.
  struct StabilityVerdict
  {
    std::string method;
    StabilityAnswer verdict = StabilityAnswer::unstable;
    std::string condition;   ///< e.g. "m >= 2.24"; empty: none
    std::string explanation; ///< one sentence with the numbers
  };

  /// A level is sound if A is positive definite, and good if besides no weight is negative, the
  /// moments asked of families are independent, and bonds tie all nodes together. stable: all
  /// levels are good, and the coercivity constant does not fall with the mesh size by a power above
  /// ½. conditionally stable: a bound on m = δ / h parts good levels from others, or sound ones
  /// from others, or all are sound. Else unstable.
  /// @param rows      of one method, series by series, coarse to fine
  /// @param variable  that varies, see scene::StudySection; no bound on m parts its levels
  StabilityVerdict judge(const std::vector<StabilityRow> &rows, const std::string &variable = "");

  /// All that is measured of a scene.
  struct StabilityResults
  {
    std::string scene_name, purpose;
    std::string variable;           ///< that varies in its regime, else empty
    std::vector<StabilityRow> rows; ///< method by method, coarse to fine in each series
    std::vector<StabilityTrend> trends;
    std::vector<StabilityVerdict> verdicts;
    std::vector<StrainGrowth> strains = {}; ///< of double wells on a torus
    bool is_complete = true;                ///< else it was interrupted
  };
} // namespace plumbline::study

namespace plumbline::base
{
  template <>
  inline constexpr auto words<study::StabilityAnswer> =
      std::array{"stable", "conditionally stable", "unstable"};
} // namespace plumbline::base
