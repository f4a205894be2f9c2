#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace plumbline::method
{
  /// A body held together by bonds, each whole or broken, whose response to its load is linear
  /// while none of them breaks: what analysis::grow needs of a discretisation. The load is a factor
  /// of the displacements of the grips and of dead loads; quantities are those at load 1 and go
  /// with the load (reactions, stretches) or its square (energies).
  class QuasistaticFractureModel
  {
  public:
    virtual ~QuasistaticFractureModel() = default;

    virtual std::size_t n_bonds() const = 0;
    virtual std::size_t n_unknowns() const = 0;

    /// Of what is whole, in equilibrium.
    struct Response
    {
      double energy = 0;   ///< stored [force]
      double reaction = 0; ///< Σ over constrained nodes of force times u at load 1, all forces
                           ///< included, and of dead loads times u: d(work)/d(load) [force]
      double residual =
          0; ///< largest force on a free node, over that of a bond when all were whole
      /// At which each bond breaks, infinite where it cannot or is broken; shape (n_bonds).
      std::vector<double> critical_loads;
    };
    virtual const Response &response() const = 0;

    /// What breaking releases, before and after the body finds its new equilibrium.
    struct Release
    {
      double bonds = 0;           ///< energy of those that break, together
      double relaxing = 0;        ///< set free where the others move
      double work = 0;            ///< of dead loads there
      std::vector<double> single; ///< energy that each would release if it broke alone
      bool is_factored = false;   ///< the equations were factored anew
    };
    /// @param bonds  whole ones
    /// @throws NumericalError  what is left is a mechanism
    virtual Release break_bonds(const std::vector<std::size_t> &bonds) = 0;

    /// As if it were made anew with these bonds broken, to the last bit the same as after a
    /// break_bonds that factored.
    virtual void restart(const std::vector<std::size_t> &broken) = 0;

    /// Its forces are those of an energy, so that work can be accounted for.
    virtual bool has_energy() const { return true; }

    /// No path of whole bonds joins the grips.
    virtual bool is_separated() const = 0;

    /// The part of the dead loads that acts on nodes that are not loose, in [0, 1]. Nothing if
    /// there are no dead loads.
    virtual std::optional<double> load_left() const { return {}; }

    /// What was done since it was made.
    struct Work
    {
      std::uint64_t n_factorisations = 0, n_updates = 0, largest_rank = 0;
      std::uint64_t n_iterations = 0, most_iterations = 0; ///< of GMRES, and of one solution
      double factor_seconds = 0, update_seconds = 0;       ///< CPU time
    };
    virtual const Work &work() const = 0;
  };
} // namespace plumbline::method
