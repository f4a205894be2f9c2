#pragma once

#include "callables.h"
#include "geometry/node_cells.h"
#include "meshfree/rules/rules.h"
#include "method/method.h"
#include "problem/problem.h"

namespace plumbline::python
{
  /// A rule that is written in Python: weights of a family from all its bonds, by one call.
  struct PythonRule
  {
    std::string name, help;
    Callable function;
    bool is_partial = false; ///< it is given ball ∩ cell instead of cells whose node is in the ball

    meshfree::Rule rule() const;
  };

  /// @param given  a name of the library's rules, or a rule of Python
  /// @throws InputError  unknown name; the message lists the known ones
  meshfree::Rule to_rule(const py::object &given);

  /// Of the cells of nodes; empty where they are None.
  std::vector<double> to_volumes(const py::object &given, std::size_t n_nodes);

  /// The bonds of the free nodes by a rule, as arrays.
  /// @param volumes  areas of cells in the order nodes were given; empty: those that cells have
  template <int dim>
  py::dict weights_on(const meshfree::NeighbourhoodQuadrature<dim> &rule,
                      const physics::Kernel<dim> &kernel, const std::vector<double> &volumes,
                      const std::function<geometry::NodeCells<dim>()> &make_cells);

  /// @param given  a name of the library's methods, or a rule of Python
  /// @throws InputError  unknown name; the message lists the known ones
  std::shared_ptr<const method::Method> to_method(const py::object &given);

  /// @throws InputError  the method cannot solve the problem
  void refuse_unless_able(const method::Method &method, const problem::Problem<2> &problem);

  /// A method for three dimensions by its name.
  /// @throws InputError  unknown name, or a method for the plane alone, or for other cells or
  /// kernels than the problem's
  std::shared_ptr<const method::Method> to_method_in_space(const std::string &name,
                                                           const problem::Problem<3> &problem);
} // namespace plumbline::python
