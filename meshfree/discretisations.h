#pragma once

#include "meshfree/body/operator.h"
#include "meshfree/rules/rules.h"
#include "meshfree/scattered/operator.h"
#include "meshfree/surface/corrections.h"
#include "method/box_discretisation.h"
#include "method/interval_discretisation.h"
#include "method/method.h"

namespace plumbline::meshfree
{
  /// On the problem's lattice: one stencil for all nodes.
  std::unique_ptr<method::Discretisation> discretise_on_lattice(const Rule &rule,
                                                                const problem::Problem<2> &problem);

  /// On a box in space.
  /// @pre rule.in_space
  std::unique_ptr<method::BoxDiscretisation> discretise_on_box(const Rule &rule,
                                                               const problem::Problem<3> &problem);

  /// On scattered nodes in space: a sparse matrix.
  /// @pre problem.cells; with a dilatation whole families, and no factors
  std::unique_ptr<method::DiscretisationInSpace>
  discretise_on_nodes(const Rule &rule, const problem::Problem<3> &problem);

  /// On intervals.
  /// @pre rule.on_line
  std::unique_ptr<method::IntervalDiscretisation>
  discretise_on_intervals(const Rule &rule, const problem::Problem<1> &problem);

  /// On a lattice with one axis: motions of double wells.
  /// @pre is_axis_rule(rule.name)
  std::unique_ptr<method::Discretisation> discretise_on_line(const Rule &rule,
                                                             const problem::Problem<2> &problem);

  /// On the problem's scattered nodes: a sparse matrix whose rows all ranks build.
  /// @note Collective.
  std::unique_ptr<method::Discretisation>
  discretise_on_scattered_nodes(const Rule &rule, const problem::Problem<2> &problem,
                                const base::Communicator &communicator);

  /// The same with an operator of which every rank makes its share.
  /// @note Collective.
  std::unique_ptr<method::Discretisation> discretise_on_scattered_nodes(
      const std::function<ScatteredOperator(std::pair<std::size_t, std::size_t> share)> &make,
      const problem::Problem<2> &problem, const base::Communicator &communicator);

  /// On a body with a free boundary: sums over one family for all nodes. Its data throw InputError
  /// for a constraint that is not 0.
  std::unique_ptr<method::Discretisation> discretise_on_body(const Rule &rule,
                                                             const problem::Problem<2> &problem);

  /// On a body of bonds with a free boundary, see NetworkOperator.
  /// @pre no dilatation
  /// @throws InputError, NumericalError  as make_body_network
  std::unique_ptr<method::Discretisation> discretise_by_bonds(const Rule &rule,
                                                              const SurfaceCorrection &correction,
                                                              const problem::Problem<2> &problem);

  /// Of one of these, see method::Method::expected_bytes.
  double expected_bytes(const method::ProblemSize &size);

  /// A body's operator at its free nodes.
  method::DiscreteOperator make_discrete_operator(std::shared_ptr<const BodyOperator> matrix);
} // namespace plumbline::meshfree
