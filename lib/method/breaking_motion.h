#pragma once

#include "method/breakable_body.h"
#include "method/equation_of_motion.h"

#include <cstddef>
#include <memory>
#include <vector>

namespace plumbline::method
{
  /// A body in motion whose bonds are linear until their stretch reaches its limit and then break
  /// irreversibly. States are displacements of the free nodes, shape (n_free, 2). The loading,
  /// g, has shape (n_nodes, 2): the force per volume at free nodes, the displacement at nodes
  /// in grips. Broken bonds carry no force in compression either: crack faces may overlap.
  class BreakingMotion : public SemiDiscreteMotion
  {
  public:
    /// Bonds that broke at the same time.
    struct Breaks
    {
      std::vector<std::size_t> bonds;
      double energy = 0;    ///< decrease of the body's energy at fixed displacements
      double overshoot = 0; ///< sum of stretch / limit - 1 over these bonds
    };

    /// Break all bonds whose stretch has reached its limit.
    virtual Breaks break_bonds(const State &u, const std::vector<double> &g) = 0;

    /// Break these bonds as well, whatever their stretch.
    virtual void restart(const std::vector<std::size_t> &broken) = 0;

    virtual bool is_free(std::size_t node) const = 0;

    /// Displacements of all nodes, shape (n_nodes, 2).
    virtual std::vector<double> displacements(const State &u,
                                              const std::vector<double> &g) const = 0;
  };

  /// The motion with data of its nodes and bonds.
  struct MovingBody
  {
    std::unique_ptr<BreakingMotion> motion;
    BreakableBody<2> parts; ///< data only; there is no quasi-static body
  };
} // namespace plumbline::method
