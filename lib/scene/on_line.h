#pragma once

#include "problem/on_line.h"
#include "scene/scene.h"

#include <string>
#include <vector>

// Static problems on intervals, Domain/dimension = 1 with a linear material.
namespace plumbline::scene
{
  // Read in keys.cc, as all boxes are.

  /// The first end of what Domain/boxes says has one coordinate.
  bool are_on_line(const std::string &boxes);

  /// Intervals 'x0 : x1' separated by ';', as boxes whose second coordinates are 0.
  /// @throws InputError  a text that says no intervals
  std::vector<geometry::Box> to_intervals(const std::string &text);

  /// A static problem; else dimension = 1 is a periodic interval with double-well bonds.
  bool is_on_intervals(const Scene &scene);

  /// @pre is_on_intervals()
  /// @throws InputError  as physics::Kernel<1>
  physics::Kernel<1> make_kernel_on_line(const Scene &scene, double horizon);

  /// @param case_index  into ProblemSection::case_names()
  /// @pre is_on_intervals()
  /// @throws InputError, NumericalError  as problem::complete
  problem::Problem<1> make_problem_on_line(const Scene &scene, unsigned int case_index,
                                           const Level &level);

  /// A scene on intervals has nothing that is for the plane or for space.
  void check_intervals(const Scene &scene);

  /// Expressions do not depend on y, which a line does not have.
  void check_without_y(const Scene &scene);
} // namespace plumbline::scene
