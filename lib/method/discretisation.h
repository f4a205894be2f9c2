#pragma once

#include "algebra/linear_system.h"
#include "algebra/symbol.h"
#include "method/diagnostics.h"
#include "method/discrete_operator.h"
#include "method/equation_of_motion.h"
#include "method/field.h"
#include "problem/problem.h"

#include <deal.II/lac/vector.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace plumbline::method
{
  using algebra::Vector;

  /// What one case brings to a discretisation: its load, and the constraint around the unknowns.
  struct CaseData
  {
    Vector load; ///< M b less what the constraint adds to the force; the sum over the
                 ///< communicator's ranks
    std::function<Field(const Vector &u)> field;
    /// ‖v - u‖ / ‖v‖, L2 over Ω. Empty where quadrature is never refined.
    std::function<double(const Vector &u, const Vector &v)> relative_change;
    /// Of surface terms about tips of cracks; empty where there are none. Collective.
    std::function<std::vector<TipForce>(const Vector &u)> tip_forces = {};
  };

  /// What a method makes of a problem, for all cases that differ in load and constraint alone: the
  /// force F(u) on its free unknowns, whose static equation is F(u) = load. Alike on both sides;
  /// what is done with it is an analysis. A state u is a vector in the discretisation's own order.
  class Discretisation
  {
  public:
    virtual ~Discretisation() = default;

    virtual std::size_t n_unknowns() const = 0;

    /// @throws InputError  a load or constraint that is not finite
    virtual CaseData data(const problem::Problem<2> &problem) const = 0;

    /// F's derivative at any state, F being linear.
    /// @throws NumericalError  it has no solver, e.g. is not symmetric on a lattice
    virtual std::unique_ptr<algebra::LinearSystem> tangent() const = 0;

    virtual DiscreteOperator matrix() const = 0;

    /// What waves see of it, of unit density on an unbounded lattice; empty where nodes are not all
    /// alike.
    virtual std::optional<algebra::WaveOperator> waves() const { return {}; }

    /// What moves, which must not outlive it; nothing where motions are not there.
    /// @param is_lumped  Galerkin methods: masses by the scaled diagonal instead of the mass matrix
    virtual std::unique_ptr<EquationOfMotion> motion(bool is_lumped) const
    {
      (void)is_lumped;
      return nullptr;
    }

    /// The same with forces by finer quadrature, to see what quadrature does; nothing where they
    /// are exact, or as exact as motion() makes them.
    virtual std::unique_ptr<EquationOfMotion> finer_motion(bool is_lumped) const
    {
      (void)is_lumped;
      return nullptr;
    }

    /// What moves on a torus about a uniform gradient G of displacements: a state is u = G x and
    /// what is periodic. Nothing where that is not there.
    virtual std::unique_ptr<EquationOfMotion>
    motion_about(const dealii::Tensor<2, 2> &gradient) const
    {
      (void)gradient;
      return nullptr;
    }

    /// Weights, moments, geometry: what does not depend on a solution.
    virtual Diagnostics diagnostics() const = 0;

    /// The ranks that share it; each gives its part of loads and rows.
    virtual base::Communicator communicator() const { return base::Communicator::alone(); }

    /// Its entries are quadrature that can be refined; else exact, or a rule of their own.
    virtual bool has_quadrature_error() const { return false; }

    /// Make the entries anew by finer quadrature; a tangent made before is void.
    virtual void refine_quadrature() {}
  };
} // namespace plumbline::method
