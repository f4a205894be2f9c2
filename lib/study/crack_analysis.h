#pragma once

#include "method/method.h"
#include "scene/scene.h"
#include "study/crack.h"

#include <filesystem>
#include <functional>
#include <vector>

namespace plumbline::study
{
  using method::Method;
  using method::Methods;

  /// The strip at the last of some times: u of shape (2, n_nodes), and the nodes' damage.
  using WriteStrip = std::function<void(const std::vector<double> &times,
                                        const std::vector<dealii::Point<2>> &nodes, const Vector &u,
                                        const Vector &damage)>;

  /// Memory for the crack of a scene with a notched strip, and disk for its files.
  /// @param n_jobs  processes that each take the memory side by side (--jobs)
  /// @throws InputError  they are not there
  void check_crack_size(const scene::Scene &scene, unsigned int n_levels,
                        const std::filesystem::path &folder, unsigned int n_jobs = 1);

  /// The thresholds of all levels, and the crack's motion at the last one of the first series.
  /// @param folder  of its checkpoint
  /// @param write   called at each frame, see TimeSection
  /// @param before_it_moves  called once nothing is refused any more
  CrackResults move_crack(const scene::Scene &scene, const Methods &available,
                          unsigned int n_levels, const std::filesystem::path &folder,
                          const WriteStrip &write = {},
                          const std::function<void()> &before_it_moves = {});
} // namespace plumbline::study
