#pragma once

#include "base/cost.h"

#include <array>
#include <map>
#include <string>
#include <vector>

namespace plumbline::study
{
  /// What theory says of a method's limit as h and horizon go to 0 at a fixed ratio, whatever the
  /// field: see study/limit_proof.h.
  struct LimitProof
  {
    enum class Answer
    {
      unknown,     ///< no theory applies, or it was not asked: another regime
      compatible,  ///< it tends to the local limit of every smooth field
      incompatible ///< its local limit is another operator
    };
    Answer answer = Answer::unknown;
    /// Of the second moments from those of the local operator, relative to the largest of these; 0
    /// where they play no part. On scattered nodes: the worst of all families.
    double defect = 0;
    /// On scattered nodes: mean and standard deviation over the families of Σ w tr C |ξ|² relative
    /// to its exact value, less 1. On a lattice all families are one.
    double mean_defect = 0, spread = 0;
    std::string reason; ///< one clause with the numbers or the theorem; empty: not asked

    /// Known to be wrong somewhere: such a method is never advised.
    bool has_wrong_moments() const { return defect > tolerance; }
    static constexpr double tolerance = 1e-8; ///< for moments to count as exact
  };

  /// What a method says about its own solution.
  struct Diagnostics
  {
    /// Bonds of one family, or entries of a Galerkin row besides the diagonal.
    unsigned int n_neighbours = 0;
    double smallest_weight_ratio = 1; ///< min over a family of weight / (ball ∩ cell area or cell)
    unsigned int n_negative_weights = 0;     ///< in the family of a lattice, or in all families
    unsigned int n_conditions = 0, rank = 0; ///< moments asked of the family of lowest rank
    double smallest_singular_value = 1; ///< of such conditions, least of all, see meshfree::Fit
    double relative_residual = 0;       ///< of the linear system when the solver stopped
    std::string operator_backend;       ///< "fft", "direct", "sparse" or "sparse, <solver>"
    unsigned int n_geometry_checks = 0; ///< cut cells recomputed with the exact backend
    double geometry_difference = 0;     ///< worst difference among them, relative to the cell
    double outer_change = 0;            ///< L2, relative: the last refinement of outer quadrature
    bool is_outer_error_known = true;   ///< false: outer quadrature was not refined
    unsigned int n_refinements = 0;     ///< of outer quadrature
    LimitProof limit;                   ///< at this ratio of horizon to h
    std::vector<std::string> notes;     ///< what the method had to do, e.g. clip a negative kernel
  };

  /// One method on one case at one level.
  struct Run
  {
    std::string method;        ///< e.g. "IPA-AC"
    std::string family;        ///< "meshfree", "reference" or "local"
    std::string problem;       ///< case name, e.g. "case1"
    std::string series;        ///< what is held fixed, e.g. "m = 3"
    unsigned int level = 0;    ///< from coarse to fine
    double h = 0, horizon = 0; ///< [length]
    base::Cost cost;
    Diagnostics diagnostics;
    /// Of the solution: largest less least cell average of a component. A constant counts for
    /// nothing, as for the operator.
    double size = 0;
    double round_off = 0; ///< errors up to this are round-off, see study/round_off.h
    std::map<std::string, double> errors; ///< by "norm | target", e.g. "nodal Linf | exact"
    std::string failure;                  ///< empty, or why there is no solution
  };

  /// A convergence study has one of these answers.
  enum class Outcome
  {
    converges, ///< plateau statistically nil, rate at least 3/4
    stalls,    ///< significant plateau, or the error grows again
    undecided, ///< neither; the reason says what would help
    failed,    ///< no solution at some level
    field_only ///< it converges for this field, but its second moments are wrong: not for others
  };

  /// One error over a sweep, and what it says.
  struct Trend
  {
    std::string method, family, problem, series;
    std::string error;                           ///< "norm | target"
    std::string parameter;                       ///< what varies: "h" or "horizon"
    std::vector<double> x;                       ///< its values, coarse to fine [length]
    std::vector<double> values;                  ///< the errors
    double size = 0;                             ///< of the solution, how far it varies: see Run
    std::vector<double> rates;                   ///< between neighbours, size x.size() - 1
    double rate = 0, rate_uncertainty = 0;       ///< slope of the last three levels, log over log
    double plateau = 0, plateau_uncertainty = 0; ///< a of the fit
    Outcome outcome = Outcome::undecided;
    /// "AC", "not AC", "AC for this field only", "m-convergent", "not m-convergent", "undecided"
    /// ...
    std::string verdict;
    std::string reason;    ///< one sentence with the numbers
    double round_off = 0;  ///< errors up to this are round-off
    LimitProof proof = {}; ///< apart from this field; of the level with the worst moments
  };

  /// How far a Galerkin solution of one level may be wrong: bounds in practice, see
  /// `estimate_error`. L2 norms; averages are those over the comparison cells.
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

  /// The cheapest run of a method that converges with an error of at most a target.
  struct Choice
  {
    double target = 0;
    std::string method;
    double h = 0, error = 0, seconds = 0; ///< [length], of the decisive error, CPU [s]
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
  /// error in each block of cells, of what the decisive error is about.
  struct ErrorMap
  {
    std::string method, problem, series;
    std::string quantity; ///< "nodal values" or "cell averages"
    double h = 0, horizon = 0;
    std::array<double, 2> lower{}, upper{}; ///< corners of the bounding box [length]
    unsigned int n_x = 0, n_y = 0;          ///< blocks, at most 32 each
    std::vector<double> values;             ///< shape (n_y, n_x), NaN outside the domain
  };

  /// Everything of one run of a scene, as written to results.json.
  struct Results
  {
    std::string scene_name, purpose, regime;       ///< regime: "m", "delta", "delta-m" or "horizon"
    std::string scene_text;                        ///< the scene as read, all keys
    std::map<std::string, std::string> provenance; ///< version, libraries, machine
    std::string decisive_error;                    ///< the "norm | target" that verdicts rest on
    std::vector<Run> runs;
    std::vector<std::string> left_out; ///< solves that the budget did not allow
    std::vector<Trend> trends;
    std::vector<ErrorEstimate> references; ///< of the scene's reference
    std::vector<ErrorEstimate> estimates;  ///< of other Galerkin solutions
    std::vector<Omission> omissions;
    std::vector<Saving> savings; ///< at the coarsest level, of the first method of each side
    std::vector<Expectation> expectations;
    std::vector<Advice> advice;
    std::vector<ErrorMap> maps;
    bool is_complete = false; ///< false while a run is going on, or after an interrupt
  };
} // namespace plumbline::study
