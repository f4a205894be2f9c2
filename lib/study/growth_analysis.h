#pragma once

#include "study/analysis.h"
#include "study/crack_analysis.h"
#include "study/growth.h"

#include <memory>
#include <string>

namespace plumbline::study
{
  /// The method of this name, whose bodies have bonds that can break.
  /// @throws InputError  there is none; the message names those that there are
  std::shared_ptr<const Method> fracture_method(const std::string &name, const Methods &available);

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

  /// Take the damage of the nodes of a body in space, after each of its moments in turn; empty:
  /// nobody does.
  /// @param loads  of all moments so far, this one the last
  using WriteDamage = std::function<void(const std::vector<double> &loads,
                                         const std::vector<dealii::Point<3>> &nodes,
                                         const std::vector<double> &damage)>;
  /// Quasi-static fracture of a scene (section Fracture) at its one level; of records see
  /// growth_record. Besides, scalars and texts say what was solved, and how. With Time/final time
  /// the body is in motion, see breaking_record.
  /// @param write_motion  called for each frame of a motion; empty: no frames are written
  Analysis growth_analysis(const Checkpoints &checkpoints, const WriteDamage &write,
                           const WriteStrip &write_motion = {});
} // namespace plumbline::study
