#pragma once

#include "method/quasistatic_fracture_model.h"
#include "problem/fracture.h"

#include <functional>
#include <optional>
#include <vector>

// Growth of cracks in equilibrium, by bonds that break under a load that never falls.
namespace plumbline::analysis
{
  /// Bonds that broke together.
  struct Event
  {
    double critical = 0; ///< load at which the first of them reaches its limit
    double load = 0;     ///< at which they break: the largest so far
    std::vector<std::size_t> bonds;
    double reaction_before = 0, reaction = 0; ///< at the load, with the bonds and without
    // energies since load 0, after it
    double work = 0; ///< of the grips and of dead loads
    double stored = 0;
    double in_bonds = 0; ///< of broken bonds, each at its limit
    double released = 0; ///< what broke at more than its limit had beyond it, and what was set free
                         ///< where the others moved
    double residual = 0; ///< see QuasistaticFractureModel::Response
    bool is_factored = false; ///< see QuasistaticFractureModel::Release

    /// |work - stored - in_bonds - released| / work
    double imbalance() const;
  };

  struct Growth
  {
    std::vector<Event> events;
    problem::GrowthEnd end = problem::GrowthEnd::unknown;
    double last_load = 0;            ///< where it ended
    bool is_separated = false;       ///< no path of bonds joins the grips there, whatever ended it
    std::optional<double> load_left; ///< see QuasistaticFractureModel, where it ended
    double first_stiffness = 0;      ///< reaction at load 1 of the whole body
    std::size_t n_resumed = 0;       ///< events that were there already

    /// The reaction where it ended over the largest up to there, in [0, 1] but for rounding; 1
    /// where nothing broke.
    double reaction_left() const;
  };

  /// Called after each event; false: it is enough.
  using EventObserver = std::function<bool(const Growth &)>;

  /// Raise the load, and let bonds break as they reach their limits: one after the other with their
  /// ties (events), those together that are over-stretched (batches), or at load steps. Between two
  /// events the response is linear, so that loads of events are exact and the audit of energy
  ///   work = stored + in_bonds + released
  /// holds to rounding; its terms are computed independently of each other.
  /// @param earlier  events of the same growth, to go on from to the same bits
  /// @throws NumericalError  an audit that is wrong by more than 1e-8, of a body that has an
  /// energy; as QuasistaticFractureModel
  /// Not for: decreasing loads, bonds that heal.
  /// Source: sequentially linear analysis, Rots & Invernizzi 2004, doi:10.1002/nag.371.
  Growth grow(method::QuasistaticFractureModel &body, const problem::FractureSettings &rules,
              std::vector<Event> earlier = {}, const EventObserver &observe = {});
} // namespace plumbline::analysis
