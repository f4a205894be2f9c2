#pragma once

#include "analysis/transient.h"
#include "study/analysis.h"

// Scenes with a time (Time/final time > 0): what is run, how far it is off, and at which rates.
namespace plumbline::study
{
  /// A state to show.
  struct Frame
  {
    double t = 0;
    std::vector<dealii::Point<3>> nodes; ///< z = 0 in two dimensions
    unsigned int n_components = 1;
    std::vector<double> u, v; ///< shape (n_nodes, n_components)
  };

  struct TransientOptions
  {
    bool keeps_end = false; ///< u at the final time: the field "displacement" of each record
    /// Where Time/frames asks for states, on the first rank.
    std::function<void(const Record &, const Frame &)> on_frame = {};
    /// That make the study together: in three dimensions they share what methods distribute, see
    /// repeated_by_ranks(); of everything else each of them does all.
    base::Communicator ranks = base::Communicator::alone();
  };

  /// All schemes and time steps of a scene by each method: a record each, whose variant says which
  /// where there are several. Scalars are errors at the final time by "norm | target" of u, by
  /// "velocity norm | target" of its rate, and "nodal L2 | time" against the same equation solved
  /// exactly in time, at the finest level; and what lib/report/schema.md lists. The curve "energy"
  /// is over time, and so is "error", the decisive one, where a solution is known.
  /// @param available  among which there is one that solves on a torus without a mesh, where that
  /// is the reference; empty: no reference is made
  Analysis transient_analysis(const Methods &available, const TransientOptions &options = {});

  /// What can be refused before anything is solved: schemes that are not known or that a method
  /// cannot do, steps beyond the critical one at the finest levels.
  /// @param ranks  as in TransientOptions
  /// @throws InputError  naming the key, and the critical step
  void check_transient(const scene::Scene &scene, const Methods &methods, unsigned int n_levels,
                       const base::Communicator &ranks = base::Communicator::alone());

  inline const std::string time_error = "nodal L2 | time";

  /// The least ω² [1/time^2] of plane waves on the lattice, where it is negative.
  inline const std::string growing_waves = "least squared frequency";

  /// The beginning of the names of facts about what was left out.
  inline const std::string left_out_of_model = "left out: ";

  /// Of a record over time, the start first.
  std::vector<analysis::Energies> energies_of(const Record &record);

  /// Trends over levels of the decisive error and the velocity's, with the shortest step of each
  /// scheme, their variant; and over time steps at the finest level. Facts of the model,
  /// expectations, warnings.
  void conclude_transient(const scene::Scene &scene, StudyResults &results);
} // namespace plumbline::study
