#pragma once

#include "meshfree/body/operator.h"
#include "meshfree/rules/rules.h"
#include "study/method.h"

namespace plumbline::meshfree
{
  /// Solve on the problem's lattice, by one stencil for all nodes.
  study::Solution lattice_solution(const Rule &rule, const scene::Scene &scene,
                                   const scene::Problem &problem);

  /// Solve on the problem's scattered nodes, by a sparse matrix whose rows all ranks build.
  /// @note Collective.
  study::Solution scattered_solution(const Rule &rule, const scene::Scene &scene,
                                     const scene::Problem &problem);

  /// Solve on a body with a free boundary, by sums over one family for all nodes.
  /// @throws InputError  a constraint that is not 0
  study::Solution body_solution(const Rule &rule, const scene::Scene &scene,
                                const scene::Problem &problem);

  /// Of one of these, see study::Method::expected_bytes.
  double expected_bytes(const scene::Scene &scene, const study::ProblemSize &size);

  // The operators that these solve with.

  study::DiscreteOperator lattice_discrete(const Rule &rule, const scene::Scene &scene,
                                           const scene::Problem &problem);
  study::DiscreteOperator scattered_discrete(const Rule &rule, const scene::Scene &scene,
                                             const scene::Problem &problem);
  study::DiscreteOperator body_discrete(const Rule &rule, const scene::Scene &scene,
                                        const scene::Problem &problem);

  /// Of a lattice's nodes, with the mass 1.
  study::SymbolData lattice_symbol(const Rule &rule, const scene::Scene &scene,
                                   const scene::Problem &problem);

  /// A body's operator at its free nodes, without notes on its weights.
  study::DiscreteOperator show(std::shared_ptr<const VariationalOperator> matrix);
} // namespace plumbline::meshfree
