#pragma once

#include "problem/problem.h"
#include "scene/scene.h"

#include <functional>

namespace plumbline::scene
{
  using Problem = problem::Problem<2>;
  using Field = problem::Field<2>;
  using Damage = problem::Damage<2>;

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

  /// A problem with the scene that poses it, for whatever makes it again: on other cells, by the
  /// full model.
  struct Case
  {
    const Scene &scene;     ///< outlives it
    unsigned int index = 0; ///< into ProblemSection::case_names()
    Problem problem;

    std::string name() const { return scene.problem.case_names()[index]; }
    Level level() const { return {problem.h, problem.horizon()}; }
  };

  /// @throws as make_problem
  Case make_case(const Scene &scene, unsigned int case_index, const Level &level);

  /// L u of the scene's solution: what its load would be if it were not given.
  /// @pre the case has a solution
  /// @throws NumericalError  when called, as physics::ManufacturedLoad
  std::function<double(const dealii::Point<2> &, unsigned int component)>
  operator_on_solution(const Case &one);
} // namespace plumbline::scene
