#pragma once

#include "analysis/statics.h"
#include "study/analysis.h"
#include "study/values_at_points.h"

#include <functional>
#include <vector>

namespace plumbline::study
{
  using analysis::Solution;

  /// What is done with static solutions besides.
  struct StaticsOptions
  {
    /// Of finest levels: what writes the solution to a VTK file, whose name it ends.
    std::function<void(const std::function<void(const std::string &stem)> &write, const Record &)>
        on_finest = {};
    /// Where solutions are wanted, in the problem's coordinates; empty: nowhere.
    std::function<std::vector<dealii::Point<2>>(const problem::Problem<2> &)> points = {};
    std::function<std::vector<dealii::Point<3>>(const problem::Problem<3> &)> points_in_space = {};
    std::function<std::vector<dealii::Point<1>>(const problem::Problem<1> &)> points_on_line = {};
    /// Receives the values there for every solution, with estimates of the error for Galerkin
    /// methods; those of the reference with a record of reference_record().
    std::function<void(const ValuesAtPoints &, const Record &)> on_values = {};
    /// Records have the field that the decisive error is about: nodal values, or averages over the
    /// comparison cells.
    bool has_fields = false;
    /// How cases are solved; empty: analysis::solve.
    std::function<std::vector<analysis::Outcome>(const Method &,
                                                 const std::vector<const problem::Problem<2> *> &)>
        solve = {};
    /// That solve problems on boxes in space together.
    base::Communicator ranks = base::Communicator::alone();
  };

  /// The record, without results, that values of the reference at points come with: its method is
  /// reference_name.
  Record reference_record(const Place &place, const Method &method, const std::string &problem);

  /// Solutions of all cases, compared with the exact solution, the local limit, the reference and
  /// the method's own finest level. On several ranks all run it together.
  /// @param available  for references and the local limit
  Analysis statics_analysis(const Methods &available, const StaticsOptions &options = {});
} // namespace plumbline::study
