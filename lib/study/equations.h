#pragma once

#include "method/discretisation.h"
#include "method/discretisation_in_space.h"
#include "method/linear_equations.h"
#include "method/method.h"
#include "problem/in_space.h"
#include "problem/problem.h"

namespace plumbline::study
{
  /// The equations of a method with the constraint of the problem at constrained nodes, made anew.
  /// @throws InputError  they have no sparse matrix (bodies with a free boundary), or it does not
  ///                     fit into memory
  /// @param name  of the method, for the message
  method::LinearEquations<2> equations_of(const method::Discretisation &of,
                                          const problem::Problem<2> &problem,
                                          const std::string &name);
  method::LinearEquations<3> equations_of(const method::DiscretisationInSpace &of,
                                          const problem::Problem<3> &problem,
                                          const std::string &name);

  template <int dim>
  method::LinearEquations<dim> equations_of(const method::Method &method,
                                            const problem::Problem<dim> &problem);
} // namespace plumbline::study
