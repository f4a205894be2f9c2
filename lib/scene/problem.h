#pragma once

#include "problem/in_space.h"
#include "problem/problem.h"
#include "scene/scene.h"

#include <functional>
#include <memory>

namespace plumbline::scene
{
  using Problem = problem::Problem<2>;
  using Field = problem::Field<2>;
  using Damage = problem::Damage<2>;
  using CellsInSpace = std::shared_ptr<const geometry::NodeCells<3>>;

  /// @param case_index  into ProblemSection::case_names()
  /// @param t           of a scene that moves: its state at this time, the load being the static
  /// one, -F(u) of a manufactured u
  /// @param known_load  of the same case, horizon and time on another level, dear to make again
  /// @param same_place  a problem of the same level: its mesh, nodes and cells are taken, which
  /// would come out the same
  /// @throws InputError  an expression that is not finite somewhere in Ω or its collar, a mesh or
  /// nodes that cannot be used
  Problem make_problem(const Scene &scene, unsigned int case_index, const Level &level,
                       double t = 0, const Field *known_load = nullptr,
                       const Problem *same_place = nullptr);

  /// At other mesh sizes, and by the full model where that builds anything besides.
  using Case = problem::Case<2>;

  /// @throws as make_problem
  Case make_case(const Scene &scene, unsigned int case_index, const Level &level);

  /// The same of a problem that the scene poses, as it may have been changed since.
  Case make_case(const Scene &scene, unsigned int case_index, Problem problem);

  /// The same in space.
  /// @param same_cells  those of the same level, or null: they are made where nodes are scattered
  /// @pre scene.domain.is_in_space()
  /// @throws InputError, NumericalError  as problem::complete
  problem::Problem<3> make_problem_in_space(const Scene &scene, unsigned int case_index,
                                            const Level &level, double t = 0,
                                            const problem::Field<3> *known_load = nullptr,
                                            const CellsInSpace &same_cells = nullptr);

  /// Constants of the material that vary in space, by their keys.
  std::vector<problem::SpatialValue<2>> material_values(const Scene &scene);
} // namespace plumbline::scene
