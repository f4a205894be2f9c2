#pragma once

#include "base/choice.h"
#include "geometry/lattice.h"
#include "problem/surface_terms.h"

#include <limits>
#include <string>
#include <vector>

namespace plumbline::problem
{
  /// Which bonds break together.
  enum class BreakMode
  {
    events,  ///< the next one and its ties: between two events the response is linear, so that its
             ///< load is known exactly and there are no load steps
    batches, ///< all that are over-stretched at an event's load
    steps    ///< the same at given loads, however far beyond their limit they are
  };

  /// Which stretch breaks a bond.
  enum class Criterion
  {
    toughness, ///< that of G in the continuum
    calibrated ///< less, so that a crack in this lattice goes on at G, as one in a strip shows
  };

  /// G of a bond.
  enum class BondToughness
  {
    mean,   ///< of G at its ends
    minimum ///< of G at samples along it
  };

  enum class Stretch
  {
    linear, ///< ξ·Δu / |ξ|²
    finite  ///< |ξ + Δu| / |ξ| - 1
  };

  /// How equilibrium is found, see meshfree::NetworkEquations.
  enum class GrowthSolver
  {
    automatic, ///< the factor where it fits the memory
    factor,
    multigrid
  };

  /// Why a growth came to its end.
  enum class GrowthEnd
  {
    unknown,
    parted,   ///< "separated": no path of bonds connects two grips
    unloaded, ///< the reaction fell below Fracture/min reaction
    loaded,   ///< the largest load is reached
    whole     ///< no bond is left that can break
  };

  /// How bonds break in equilibrium.
  struct FractureSettings
  {
    std::string toughness; ///< G, an expression in x and y; empty: nothing breaks [force/length]
    BondToughness of_bonds = BondToughness::mean;
    std::vector<std::vector<dealii::Point<2>>> interfaces; ///< lines; bonds across have their G
    std::vector<double> interface_toughness; ///< of each, or one for all [force/length]
    Criterion criterion = Criterion::toughness;
    BreakMode breaking = BreakMode::events;
    Stretch stretch = Stretch::linear;
    SurfaceTerms surface_terms = SurfaceTerms::automatic; ///< resolved by `complete`
    GrowthSolver solver = GrowthSolver::automatic;
    double load_step = 0; ///< of steps
    double largest_load = std::numeric_limits<double>::infinity();
    double least_reaction = .002;          ///< where a growth ends, over the largest so far
    double tie_tolerance = 1e-6;           ///< relative, of loads at which bonds break together
    std::vector<geometry::Box> unbreaking; ///< boxes whose bonds do not break
    unsigned int interval = 50;            ///< of checkpoints [events]

    bool is_there() const { return !toughness.empty(); }
    double toughness_of_interface(std::size_t line) const
    {
      return interface_toughness[interface_toughness.size() == 1 ? 0 : line];
    }
    /// Without a factor pieces that turn about a node are not found, where finite stretches and
    /// surface terms mean nothing.
    bool can_iterate() const { return stretch == Stretch::linear && !is_corrected(); }
    /// Dilatations at surfaces are corrected, whatever terms there are: no energy has the forces.
    bool is_corrected() const
    {
      return surface_terms != SurfaceTerms::automatic && surface_terms != SurfaceTerms::uncorrected;
    }
  };
} // namespace plumbline::problem

namespace plumbline::base
{
  template <>
  inline constexpr auto words<problem::Criterion> = std::array{"toughness", "calibrated"};
  template <>
  inline constexpr auto words<problem::BondToughness> = std::array{"mean", "minimum"};
  template <>
  inline constexpr auto words<problem::BreakMode> = std::array{"events", "batches", "steps"};
  template <>
  inline constexpr auto words<problem::Stretch> = std::array{"linear", "finite"};
  template <>
  inline constexpr auto words<problem::GrowthSolver> =
      std::array{"automatic", "factor", "multigrid"};
  template <>
  inline constexpr auto words<problem::GrowthEnd> =
      std::array{"unknown", "separated", "unloaded", "loaded", "whole"};
} // namespace plumbline::base
