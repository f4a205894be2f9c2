#pragma once

#include "base/solver_choices.h"
#include "geometry/ball_cell.h"

namespace plumbline::problem
{
  struct QuadratureSettings
  {
    bool exact_entries = true; ///< where an exact way is known, else by quadrature
    double tolerance = 1e-4;   ///< relative, of the solution
    unsigned int max_refinements = 4;
  };

  struct GeometrySettings
  {
    geometry::Backend backend = geometry::Backend::fast;
    unsigned int n_checks = 24, seed = 1;
  };

  struct SolverSettings
  {
    base::OperatorBackend operator_backend = base::OperatorBackend::automatic;
    base::SparseSolver linear_solver = base::SparseSolver::automatic;
    base::Iteration iteration = base::Iteration::automatic;
    bool is_full_model = false; ///< nothing is left out, to show that it is not missed
    bool is_mixed = false;      ///< dilatations are unknowns of the scattered nodes besides u
    double tolerance = 1e-12;
    unsigned int max_iterations = 1000;
  };

  /// What is asked of methods besides the problem.
  struct MethodSettings
  {
    bool nodes_are_vertices = false;   ///< of lattices, with their comparison cells; else centres
    bool loads_are_averages = false;   ///< of meshfree methods: over the cells, not at the nodes
    bool tends_to_local_limit = false; ///< horizon and mesh are refined together, m held fixed
    /// Where m grows from level to level: up to which order the moments of weights must tend to
    /// those of the ball; 0 elsewhere.
    unsigned int ball_order = 0;
    QuadratureSettings quadrature = {};
    GeometrySettings geometry = {};
    SolverSettings solver = {};
  };
} // namespace plumbline::problem
