#pragma once

#include "base/cost.h"
#include "method/box_discretisation.h"
#include "method/diagnostics.h"
#include "method/field.h"
#include "method/method.h"

#include <exception>
#include <optional>

// F(u) = load, by any method: one solve, the force being linear.
namespace plumbline::analysis
{
  struct Solution : method::Field
  {
    base::Cost cost;
    method::Diagnostics diagnostics;
  };

  /// What became of one case.
  struct Outcome
  {
    std::optional<Solution> solution;
    std::exception_ptr failure; ///< why there is none
  };

  /// Solve cases that differ in load and constraint alone, by one discretisation. Quadrature of
  /// its entries is refined until no case's solution moves by more than the scene's tolerance; a
  /// case is done when its own does not. Each case's cost is what it would be alone.
  /// @note Collective.
  /// @throws InputError  data that is not finite
  std::vector<Outcome> solve(const method::Method &method,
                             const std::vector<const problem::Problem<2> *> &cases,
                             const base::Communicator &communicator = base::Communicator::all());

  /// Refine the quadrature of a discretisation as `solve` does for a problem.
  /// @throws NumericalError  it does not settle, or there is no solution
  void settle_quadrature(method::Discretisation &discretisation,
                         const problem::Problem<2> &problem);

  struct SolutionInSpace : method::FieldInSpace
  {
    base::Cost cost;
    method::Diagnostics diagnostics;
  };

  /// In space, where entries are exact or the rule's own.
  /// @param ranks  each gets its share of nodes and cells: nodal values are those of some nodes,
  ///               averages those of the cells of its slab, see method::slabs_of_cells(); the
  ///               function of the solution is collective. Where methods do not distribute their
  ///               work, each rank does all of it.
  /// @note Collective over ranks.
  /// @pre one rank, or Ω is a box
  /// @pre method.can() has Capability::space
  /// @throws NumericalError  there is no solution
  SolutionInSpace solve(const method::Method &method, const problem::Problem<3> &problem,
                        const base::Communicator &ranks = base::Communicator::alone());

  /// One case.
  /// @throws NumericalError  there is no solution
  Solution solve(const method::Method &method, const problem::Problem<2> &problem,
                 const base::Communicator &communicator = base::Communicator::all());
} // namespace plumbline::analysis
