#pragma once

#include "method/method.h"
#include "scene/scene.h"
#include "study/growth.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

namespace plumbline::study
{
  using method::Method;
  using method::Methods;

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

  /// Memory for the growth of a scene: nothing is made before it is there.
  /// @throws InputError  it is not, naming Study/h
  GrowthSize check_growth_size(const scene::Scene &scene, unsigned int n_jobs = 1);

  /// The growth of a scene at its one level, from the checkpoint if there is one and no file that
  /// the scene names is newer.
  /// @param before_it_grows  called once the body stands
  /// @throws InputError  a scene that cannot be used, a checkpoint of another scene
  /// @throws NumericalError  the equations cannot be solved
  GrowthResults grow_body(const scene::Scene &scene, const Methods &available,
                          const std::filesystem::path &checkpoint,
                          const std::function<void()> &before_it_grows = {});
} // namespace plumbline::study
