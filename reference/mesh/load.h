#pragma once

#include "algebra/operator.h"
#include "base/communicator.h"
#include "problem/problem.h"
#include "reference/mesh/cells.h"
#include "reference/mesh/space.h"

namespace plumbline::reference
{
  /// ∫ b φ over this rank's share of the cells of Ω, shape (n_free n_components): by Gauss's points
  /// for loads that are smooth in cells, else by geometry::RoughRule.
  algebra::Vector load_vector(const problem::Problem<2> &problem, const MeshSpace &space,
                              const MeshCells &cells, const base::Communicator &communicator);
} // namespace plumbline::reference
