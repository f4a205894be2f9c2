#pragma once

#include "analysis/statics.h"
#include "scene/scene.h"

#include <functional>

// What is settled before anything is solved.
namespace plumbline::study
{
  using method::Method;
  using method::Methods;

  /// @param key  of the scene, for the message
  /// @throws InputError  unknown name; the message names the known ones
  std::shared_ptr<const Method> find_method(const Methods &available, const std::string &name,
                                            const std::string &key);

  /// The methods that a scene names, each once and in order.
  /// @param is_meant  by "all", of those that are there to be taken so
  /// @throws InputError  unknown name
  Methods named_methods(const scene::Scene &scene, const Methods &available,
                        const std::function<bool(const Method &)> &is_meant);

  /// The methods that a scene names, in order; "all" gives those that can do it.
  /// @throws InputError  unknown name, or a named method that cannot do the scene, with the reason
  Methods choose_methods(const scene::Scene &scene, const Methods &available);

  /// Check that every method's memory is there at every level that is run, and that of what
  /// estimates of errors solve besides (h/2, degree p + 1). Nothing is made but the mesh of the
  /// coarsest level: a finer level has its cells times the square of what h falls by. Where that
  /// would not fit, a file .geo is meshed at half of its h, too: its cells may not follow h.
  /// @param n_levels  the first so many of each series; 0: all
  /// @param n_jobs    processes that each take it side by side (--jobs)
  /// @param n_ranks   that share what methods distribute in space
  /// @throws InputError  naming method, level, the memory it needs and what there is
  void check_memory(const scene::Scene &scene, const Methods &methods, const Methods &available,
                    unsigned int n_levels, unsigned int n_jobs = 1, unsigned int n_ranks = 1);

  /// The same of transient analyses in space: their vectors besides what a static solution takes.
  /// Accuracy: within a factor of 2 of the memory measured at 64³ and 96³ cells.
  /// @param n_ranks  that share what methods distribute in space
  /// @pre scene.domain.is_in_space()
  void check_memory_of_motion(const scene::Scene &scene, const Methods &methods,
                              unsigned int n_levels, unsigned int n_jobs = 1,
                              unsigned int n_ranks = 1);

  /// The methods whose analysis of the scene, static or transient, is not distributed over ranks.
  /// @pre scene.domain.is_in_space()
  Methods repeated_by_ranks(const scene::Scene &scene, const Methods &methods);

  /// Check that meshes, nodes and cracks of all levels can be used, and that expressions are finite
  /// in Ω and its collar on a grid of samples: for all cases and series, at the level whose ball
  /// reaches farthest.
  /// @throws InputError  naming key and place
  void check_data(const scene::Scene &scene);
} // namespace plumbline::study
