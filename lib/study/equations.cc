#include "study/equations.h"

#include "base/error.h"

namespace plumbline::study
{
  namespace
  {
    template <int dim, class Discretised>
    method::LinearEquations<dim>
    equations(const Discretised &of, const problem::Problem<dim> &problem, const std::string &name)
    {
      const auto *able = dynamic_cast<const method::HasLinearEquations<dim> *>(&of);
      if (able == nullptr)
        throw InputError("Study/norms: truncation errors, bounds and energies need the sparse "
                         "matrix of a method, and " +
                         name +
                         " has none here (rules on bodies with a free boundary are solved without "
                         "one); write nodal or averages norms");
      return able->equations(problem);
    }

    auto discretise(const method::Method &method, const problem::Problem<2> &problem)
    {
      return method.discretise(problem);
    }

    auto discretise(const method::Method &method, const problem::Problem<3> &problem)
    {
      return method.discretise_in_space(problem);
    }
  } // namespace

  method::LinearEquations<2> equations_of(const method::Discretisation &of,
                                          const problem::Problem<2> &problem,
                                          const std::string &name)
  {
    return equations<2>(of, problem, name);
  }

  method::LinearEquations<3> equations_of(const method::DiscretisationInSpace &of,
                                          const problem::Problem<3> &problem,
                                          const std::string &name)
  {
    return equations<3>(of, problem, name);
  }

  template <int dim>
  method::LinearEquations<dim> equations_of(const method::Method &method,
                                            const problem::Problem<dim> &problem)
  {
    return equations_of(*discretise(method, problem), problem, method.name());
  }

#define INSTANTIATE(dim)                                                                           \
  template method::LinearEquations<dim> equations_of(const method::Method &,                       \
                                                     const problem::Problem<dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace plumbline::study
