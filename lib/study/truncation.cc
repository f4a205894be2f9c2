#include "study/truncation.h"

#include "base/error.h"
#include "method/discretisation.h"
#include "method/discretisation_in_space.h"
#include "method/linear_equations.h"
#include "scene/choices.h"
#include "scene/study_sections.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumbline::study
{
  namespace
  {
    auto discretise(const Method &method, const problem::Problem<2> &problem)
    {
      return method.discretise(problem);
    }

    auto discretise(const Method &method, const problem::Problem<3> &problem)
    {
      return method.discretise_in_space(problem);
    }
  } // namespace

  template <int dim>
  Truncation truncation(const Method &method, const problem::Problem<dim> &problem,
                        const problem::Field<dim> &u)
  {
    constexpr double safety = 10, epsilon = std::numeric_limits<double>::epsilon();
    const auto discretisation = discretise(method, problem);
    const auto *able = dynamic_cast<const method::HasLinearEquations<dim> *>(discretisation.get());
    if (able == nullptr)
      throw InputError(
          "Study/norms: truncation errors need the sparse matrix of a rule, and bodies with "
          "a free boundary are solved without one; write nodal or averages norms");
    const method::LinearEquations<dim> of = able->equations(problem);
    const unsigned int n_components = of.n_components;
    std::vector<double> values;
    for (std::size_t k = 0; k < of.n_free; ++k)
      for (unsigned int c = 0; c < n_components; ++c)
        values.push_back(u(of.nodes[k], c));
    values.insert(values.end(), of.constraint.begin(), of.constraint.end());
    Truncation found;
    double cancelled = 0; // the largest sum of |a_ij u_j|
    for (std::size_t row = 0; row < of.rows.n_rows(); ++row)
    {
      double sum = 0, terms = 0;
      for (std::size_t k = of.rows.start[row]; k < of.rows.start[row + 1]; ++k)
      {
        const double term = of.rows.value[k] * values[of.rows.column[k]];
        sum += term;
        terms += std::abs(term);
      }
      const double tau = sum - of.load[row];
      found.largest = std::max(found.largest, std::abs(tau));
      found.l2 += of.volumes[row / n_components] * tau * tau;
      found.load = std::max(found.load, std::abs(of.load[row]));
      cancelled = std::max(cancelled, terms);
    }
    found.l2 = std::sqrt(found.l2);
    if (!std::isfinite(found.l2)) // the largest loses NaN
      throw NumericalError(
          "the truncation error is not a finite number: u, the load or the constraint is "
          "not, at a node");
    found.round_off = safety * epsilon * (cancelled + found.load);
    if (!(found.load > found.round_off))
      found.load = cancelled;
    return found;
  }

  template <int dim>
  void enter_truncation(const Method &method, const std::vector<scene::Norm> &norms,
                        const problem::Problem<dim> &problem, Record &record)
  {
    const auto is_meant = [](scene::Norm norm)
    { return scene::quantity(norm) == scene::Quantity::truncation; };
    if (method.family() != method::MethodFamily::meshfree ||
        std::none_of(norms.begin(), norms.end(), is_meant))
      return;
    const auto enter = [&](scene::Target target, const problem::Field<dim> &u)
    {
      const Truncation found = truncation(method, problem, u);
      for (const scene::Norm norm : norms)
        if (is_meant(norm))
          record.set(scene::DecisiveError{norm, target}.text(),
                     scene::is_largest(norm) ? found.largest : found.l2);
      record.set("largest load", found.load);
      record.set("truncation round-off", found.round_off);
    };
    if (problem.solution)
      enter(scene::Target::exact, *problem.solution);
    if (problem.local_solution)
      enter(scene::Target::local, *problem.local_solution);
  }

#define INSTANTIATE(dim)                                                                           \
  template Truncation truncation(const Method &, const problem::Problem<dim> &,                    \
                                 const problem::Field<dim> &);                                     \
  template void enter_truncation(const Method &, const std::vector<scene::Norm> &,                 \
                                 const problem::Problem<dim> &, Record &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace plumbline::study
