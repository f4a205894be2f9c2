#pragma once

#include "measures.h"
#include "scene/scene.h"
#include "study/growth.h"

namespace plumbline::app
{
  struct GrowOptions : MeasureOptions
  {
    bool check = false; ///< Expected/growth, growth ends, and the audit of energy
  };

  /// What a growth that is not begun is expected to be.
  struct GrowthSize
  {
    problem::GrowthSolver solver = problem::GrowthSolver::factor; ///< not automatic
    double n_nodes = 0, n_bonds = 0;
    double factor_bytes = 0, multigrid_bytes = 0; ///< of all, by either solver
    double n_breaks = 0; ///< bonds that a straight crack breaks, the fewest; one that winds breaks
                         ///< up to three times as many
    double seconds = 0;  ///< CPU time of those, by rates that were measured on one machine; to a
                         ///< factor of two on others
  };
  /// @param n_jobs  processes that each take its memory side by side (--jobs), by which an
  /// automatic solver is chosen
  GrowthSize expected_size(const scene::Scene &scene, unsigned int n_jobs = 1);

  /// Memory for the growth of a scene: nothing is made before it is there.
  /// @throws InputError  it is not, naming Study/h
  GrowthSize check_growth_size(const scene::Scene &scene, unsigned int n_jobs = 1);

  /// The growth of a scene at its one level, from the checkpoint if there is one and no file that
  /// the scene names is newer.
  /// @param before_it_grows  called once the body stands
  /// @throws InputError, NumericalError  as grow
  study::GrowthResults grow_body(const scene::Scene &scene, const std::filesystem::path &checkpoint,
                                 const std::function<void()> &before_it_grows = {});

  /// Let a crack grow in equilibrium, bond by bond, as section Fracture of a scene says; print
  /// tables, write grow.html, .md and .json, grow/ with tables and pictures, and while it grows
  /// checkpoint.h5, from which the same command goes on after it was killed.
  /// @return  1 if check is set and something is not as expected, else 0
  /// @throws InputError  a scene that cannot be used, a folder that cannot be written
  /// @throws NumericalError  the equations cannot be solved; pictures cannot be drawn, all else is
  /// written then
  int grow(const GrowOptions &options);
} // namespace plumbline::app
