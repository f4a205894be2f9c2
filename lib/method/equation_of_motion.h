#pragma once

#include "problem/in_space.h"
#include "problem/problem.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace plumbline::method
{
  /// ü = a(u, g) of unit density and without damping, as a method discretises it in space: what
  /// schemes need. States are vectors in an order and a scaling of its own, in which the tangent is
  /// symmetric. g, what drives it, comes from load and constraint at an instant; a is affine in g.
  class SemiDiscreteMotion
  {
  public:
    using State = std::vector<double>;

    virtual ~SemiDiscreteMotion() = default;
    virtual std::size_t size() const = 0;

    /// Overwrites a, of the same size.
    virtual void acceleration(const State &u, const std::vector<double> &g, State &a) const = 0;

    /// ∂a/∂u v; where that is not symmetric, its symmetric part.
    virtual void tangent(const State &u, const std::vector<double> &g, const State &v,
                         State &out) const = 0;
    virtual bool has_tangent() const { return true; }
    virtual bool is_symmetric() const { return true; } ///< ∂a/∂u: implicit schemes need it

    /// max λ of -∂a/∂u at rest, where it is known in closed form.
    virtual std::optional<double> largest_eigenvalue() const { return {}; }

    /// ∫ u·v: twice the kinetic energy of unit density with both the velocity.
    virtual double product(const State &u, const State &v) const = 0;

    /// Of the bonds, constrained nodes' drive given.
    virtual double energy(const State &u, const std::vector<double> &g) const = 0;

    /// The rate at which load and constraint do work.
    /// @param rate  of g in time
    virtual double power(const State &u, const State &v, const std::vector<double> &g,
                         const std::vector<double> &rate) const = 0;

    /// Numbers about it by name, for reports.
    virtual std::map<std::string, double> facts() const { return {}; }

    virtual unsigned int n_components() const = 0;

    /// Values at the free nodes, shape (n_nodes, n_components).
    virtual std::vector<double> nodal(const State &u) const = 0;
  };

  /// A SemiDiscreteMotion that also computes g and states from the fields of a problem.
  template <int dim>
  class MotionOf : public SemiDiscreteMotion
  {
  public:
    /// @throws InputError  a load or constraint that is not finite
    virtual std::vector<double> drive(const problem::Problem<dim> &instant) const = 0;

    /// The contribution of ü to g: pass ü as the solution and constraint of `instant`.
    /// @pre instant.solution
    virtual std::vector<double> inertia(const problem::Problem<dim> &instant) const = 0;

    /// A field at the nodes.
    virtual State state(const problem::Field<dim> &field) const = 0;

    virtual const std::vector<dealii::Point<dim>> &nodes() const = 0; ///< that are free
  };

  using EquationOfMotion = MotionOf<2>;

  /// One whose states are functions of all x: a reference without nodes of its own.
  class ContinuousMotion : public EquationOfMotion
  {
  public:
    virtual double value(const State &u, const dealii::Point<2> &x,
                         unsigned int component) const = 0;
  };
} // namespace plumbline::method
