#pragma once

#include "base/team.h"
#include "reference/mesh/field.h"
#include "study/method.h"

namespace plumbline::reference
{
  struct MeshSolution
  {
    MeshField field;
    base::Cost cost;
    study::Diagnostics diagnostics;
  };

  /// Solve a problem on its mesh, outer quadrature refined until the solution moves by less than
  /// the scene's tolerance.
  /// @note Collective.
  /// @throws NumericalError  the tolerance is not met by the scene's most refinements, no solution
  MeshSolution solve_on_mesh(const scene::Scene &scene, const scene::Problem &problem,
                             bool is_continuous, unsigned int degree,
                             const base::Team &team = base::Team::all());

  /// The same, as the study compares it.
  study::Solution mesh_solution(const scene::Scene &scene, const scene::Problem &problem,
                                bool is_continuous, unsigned int degree);

  /// Memory of this at its peak [bytes], see study::Method::expected_bytes.
  double expected_mesh_bytes(const scene::Scene &scene, const study::ProblemSize &size,
                             unsigned int n_vertices, bool is_continuous, unsigned int degree);

  /// The matrix by the first outer rule. Masses as of `lattice_discrete`.
  /// @throws NumericalError  no degree of freedom is free
  study::DiscreteOperator mesh_discrete(const scene::Scene &scene, const scene::Problem &problem,
                                        bool is_continuous, unsigned int degree);

  /// The view of a field that a study compares: nodes, values, averages.
  study::Solution as_solution(const scene::Problem &problem, MeshSolution solution);
} // namespace plumbline::reference
