#pragma once

#include "analysis/record.h"
#include "study/results.h"

#include <map>
#include <string>
#include <vector>

namespace plumbline::study
{
  using analysis::Key;
  using analysis::Record;
  using analysis::Records;

  enum class Rating
  {
    good,
    doubtful, ///< good under a condition, or undecided
    bad
  };

  /// What the records of one method say together.
  struct Verdict
  {
    std::string method, series; ///< series empty: of all of them
    std::string verdict;        ///< e.g. "conditionally stable"
    Rating rating = Rating::bad;
    std::string condition;   ///< e.g. "m >= 2.24"; empty: none
    std::string explanation; ///< one sentence with the numbers
  };

  /// The power of h, or of the horizon where h is fixed, that a scalar follows.
  struct Power
  {
    std::string method, series;
    Axis axis = Axis::mesh_size;
    std::map<std::string, double> of; ///< by the scalar's name
  };

  /// q(h) = value + C h^rate through the three finest levels.
  struct Limit
  {
    std::string method, series, quantity;
    double value = 0, rate = 0;
    double change = 0; ///< of the value, were the finest level left out; NaN: there are but three
  };

  /// What a study of one analysis finds.
  struct StudyResults
  {
    std::string analysis; ///< e.g. "stability"
    std::string scene_name, purpose;
    std::string scene_text; ///< the scene as read, all keys
    scene::Regime regime = scene::Regime::delta;
    std::string variable;                          ///< that varies in its regime, else empty
    std::string decisive_error;                    ///< "norm | target" of verdicts; empty: none
    std::map<std::string, std::string> provenance; ///< version, libraries, machine
    std::map<std::string, std::string> facts;      ///< of the study as a whole, by name
    Records records; ///< method by method or case by case, coarse to fine in each series
    std::vector<Trend> trends;
    std::vector<Power> powers;
    std::vector<Limit> limits;
    std::vector<Verdict> verdicts;
    std::vector<Advice> advice;
    std::vector<ErrorEstimate> references; ///< of the scene's reference
    std::vector<ErrorEstimate> estimates;  ///< of other Galerkin solutions
    std::vector<ErrorMap> maps;
    std::vector<SolutionGrid> solution_grids; ///< of the first method of each family
    std::vector<Omission> omissions;
    std::vector<Saving> savings; ///< at the coarsest level, of the first method of each side
    std::vector<Expectation> expectations;
    std::vector<std::string> left_out; ///< what the budget did not allow
    std::vector<std::string> warnings; ///< of the scene, e.g. that its solution and load contradict
    bool is_complete = true;           ///< false while it goes on, or after an interrupt
  };

  /// The records of an analysis' finest level of each method and series, without failures.
  std::vector<const Record *> finest_records(const StudyResults &results);
} // namespace plumbline::study

namespace plumbline::base
{
  template <>
  inline constexpr auto words<study::Rating> = std::array{"good", "doubtful", "bad"};
} // namespace plumbline::base
