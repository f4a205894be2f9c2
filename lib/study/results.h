#pragma once

#include "base/cost.h"
#include "method/diagnostics.h"
#include "method/method_family.h"
#include "study/axis.h"

#include <array>
#include <limits>
#include <string>
#include <vector>

namespace plumbline::study
{
  using method::Diagnostics;
  using method::LimitProof;
  using method::MethodFamily;

  /// A convergence study has one of these answers.
  enum class Outcome
  {
    converges, ///< plateau statistically nil, rate at least 3/4
    stalls,    ///< significant plateau, or the error grows again
    undecided, ///< neither; the reason says what would help
    failed,    ///< no solution at some level
    field_only ///< it converges for this field, but its moments are wrong: not for others
  };

  /// What the errors of an undecided trend leave open, which a proof settles.
  enum class Leaning
  {
    none,
    plateau_or_power, ///< a plateau and a slow power or a logarithm fit alike
    none_or_plateau   ///< the rate is surely 3/4, the plateau neither nil nor significant
  };

  constexpr double not_fitted = std::numeric_limits<double>::quiet_NaN();

  /// One error over a sweep, and what it says.
  struct Trend
  {
    std::string method;
    MethodFamily family = MethodFamily::meshfree; ///< of the method
    std::string problem, series;
    std::string error; ///< "norm | target"
    Axis axis = Axis::mesh_size;
    std::vector<double> x;      ///< values on the axis, coarse to fine
    std::vector<double> values; ///< the errors
    double size =
        0; ///< of the solution, how far it varies, see size_of(); in the unit of the errors
    std::vector<double> rates; ///< between neighbours, size x.size() - 1
    /// Slope of the last three levels, log over log, and a of the fit; NaN where nothing is fitted:
    /// fewer than four levels above round-off, or no refinement.
    double rate = not_fitted, rate_uncertainty = not_fitted;
    double plateau = not_fitted, plateau_uncertainty = not_fitted;
    Outcome outcome = Outcome::undecided;
    /// "AC", "not AC", "AC for this field only", "m-convergent", "not m-convergent", "undecided"
    /// ...
    std::string verdict;
    std::string reason;    ///< one sentence with the numbers
    double round_off = 0;  ///< errors up to this are round-off, in their unit
    LimitProof proof = {}; ///< apart from this field; of the level with the worst moments
    /// Where errors are differences to the own finest level: its place on the axis; else 0.
    double finest = 0;
    Leaning leaning = Leaning::none;
    std::string variant = {}; ///< of the method, e.g. a scheme in time
  };

  /// How far a Galerkin solution of one level may be wrong: bounds in practice, see
  /// `estimate_error`. L2 norms; averages are those over the comparison cells. NaN: not estimated,
  /// as the field and the change to degree p + 1 in three dimensions.
  struct ErrorEstimate
  {
    std::string problem, series, method; ///< method: e.g. "Q2"
    unsigned int level = 0;
    double h = 0, horizon = 0;
    double h_change = 0;               ///< averages: change to h/2, or from 2 h where that is cheap
    double p_change = 0;               ///< averages: change to degree p + 1
    double outer_change = 0;           ///< averages, of outer quadrature; 0 if entries are exact
    double estimate = 0;               ///< of the averages' error
    unsigned int certified_digits = 0; ///< floor(-log10(estimate / size of the solution))
    unsigned int n_geometry_checks = 0; ///< cut cells recomputed with the exact backend
    double geometry_difference = 0;     ///< worst difference among them, relative to the cell
    double coarse_change = 0;           ///< averages: the change before h_change; 0 if not known
    double rate = 0;                    ///< at which h_change is taken to go on falling
    /// The same of the field.
    double field_h_change = 0, field_coarse_change = 0, field_p_change = 0, field_rate = 0;
    double field_estimate = 0;
    /// Cells of h/2 or 2 h fill the same polygon: a curved boundary that it stands for is in no
    /// estimate.
    bool is_of_polygon = false;
    /// Of the largest component at each point that estimate_error was given; in no file of results.
    std::vector<double> at_points = {};
  };

  /// Something the scene did not need.
  struct Omission
  {
    std::string what, why, saving;
  };

  /// One level solved by the full model too.
  struct Saving
  {
    std::string method;
    double h = 0, horizon = 0; ///< [length]
    base::Cost smallest, full;
    double difference = 0; ///< of nodal values, relative to the largest
  };

  /// One line of the scene's Expected section.
  struct Expectation
  {
    std::string subject, expected, found;
    bool holds = false;
  };

  /// The cheapest run of a method that converges with an error of at most a target, see `cheapest`.
  struct Choice
  {
    double target = 0; ///< relative to how far the solution varies
    std::string method;
    double h = 0, error = 0, seconds = 0; ///< [length], of the decisive error, CPU [s]
    std::vector<std::string> tied = {};   ///< other methods that cost the same, to noise
  };

  /// Which method to take for one problem and series, and which not to.
  struct Advice
  {
    std::string problem, series;
    std::vector<Choice> choices;       ///< targets 1e-2, 1e-4, ... as far as a run reaches them
    std::vector<std::string> stalling; ///< methods that do not converge to this limit
    std::vector<std::string> field_only = {}; ///< methods that do, but not for other fields
  };

  /// Where a method errs at the finest level of the last problem and the first series: the largest
  /// error in each block of cells, of what the decisive error is about; and its solution there.
  struct ErrorMap
  {
    std::string method, problem, series;
    std::string quantity;    ///< "nodal values" or "cell averages"
    std::string axes = "xy"; ///< across and up: "xy", in space also "xz" and "yz"
    double h = 0, horizon = 0;
    std::array<double, 2> lower{}, upper{}; ///< corners of the bounding box [length]
    /// Blocks, at most 32 each; of a curve, a problem on intervals, up to 256 and 1: it has no
    /// height.
    unsigned int n_x = 0, n_y = 0;
    double size = 1;               ///< of the solution, see size_of()
    std::vector<double> values;    ///< shape (n_y, n_x), NaN outside the domain
    unsigned int n_components = 1; ///< of u
    /// Mean of u in each block, of |u| if it is a vector; as `values`, or empty.
    std::vector<double> solution = {};
  };

  /// A solution in space at the finest level of the last problem and the first series, for pictures
  /// of the whole body: the averages of u, of |u| if it is a vector, over every k-th cell along
  /// each axis, at the centres of these cells.
  struct SolutionGrid
  {
    std::string method, problem, series;
    double h = 0, horizon = 0;
    std::array<double, 3> lower{}, upper{}; ///< corners of the bounding box [length]
    std::array<double, 3> first{};          ///< centre of the first cell [length]
    double spacing = 0;                     ///< of the centres [length]
    std::array<unsigned int, 3> n{};
    unsigned int n_components = 1; ///< of u
    std::vector<double> values;    ///< shape (n[2], n[1], n[0]), NaN outside the domain
  };
} // namespace plumbline::study

namespace plumbline::base
{
  template <>
  inline constexpr auto words<study::Outcome> =
      std::array{"converges", "stalls", "undecided", "failed", "field only"};
} // namespace plumbline::base
