#include "study/truncation.h"

#include "analysis/stability.h"
#include "base/error.h"
#include "method/discrete_operator.h"
#include "scene/choices.h"
#include "scene/study_sections.h"
#include "study/equations.h"
#include "study/motion_norms.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace plumbline::study
{
  namespace
  {
    /// By how much a field fails the equations of a rule.
    struct Truncation
    {
      double largest = 0; ///< max|τ| [unit of the load]
      double l2 = 0;      ///< √(Σ volume |τ|²)
      /// max|b|, what largest is relative to; where b is round-off, max_i Σ|a_ij u_j|
      double load = 0;
      double round_off = 0; ///< up to which size |τ| is round-off
    };

    /// How much larger the norm "nodal L2" of a field may be than √(Σ volume |e|²).
    double nodal_over_volumes(const method::LinearEquations<2> &of,
                              const problem::Problem<2> &problem)
    {
      const double least = *std::min_element(of.volumes.begin(), of.volumes.end());
      return std::sqrt(area_of(problem) / static_cast<double>(of.n_free) / least);
    }

    /// Nodal norms in space are over volumes, or over cells that are all alike.
    double nodal_over_volumes(const method::LinearEquations<3> &of,
                              const problem::Problem<3> &problem)
    {
      (void)of;
      (void)problem;
      return 1;
    }

    template <int dim>
    Truncation truncation(const method::LinearEquations<dim> &of, const problem::Field<dim> &u)
    {
      constexpr double safety = 10, epsilon = std::numeric_limits<double>::epsilon();
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
            "the truncation error is not a finite number: u, the load or the constraint is not "
            "finite at some node; check Problem/solution, load and constraint");
      found.round_off = safety * epsilon * (cancelled + found.load);
      if (!(found.load > found.round_off))
        found.load = cancelled;
      return found;
    }
  } // namespace

  template <int dim>
  void enter_truncation(const Method &method, const std::vector<scene::Norm> &norms,
                        const problem::Problem<dim> &problem, Record &record)
  {
    using scene::Quantity;
    const auto has = [&](Quantity quantity)
    {
      return std::any_of(norms.begin(), norms.end(),
                         [&](scene::Norm norm) { return scene::quantity(norm) == quantity; });
    };
    if (method.family() != method::MethodFamily::meshfree ||
        !(has(Quantity::truncation) || has(Quantity::bound)))
      return;
    const auto of = equations_of(method, problem);
    analysis::Stability stability;
    if (has(Quantity::bound))
    {
      try
      {
        stability = analysis::measure(method::discrete_operator(of));
        record.set("smallest eigenvalue", stability.smallest, "b / u");
      }
      catch (const NumericalError &)
      {
        // eigenvalues do not settle: no bound
      }
      if (stability.inverse_norm > 0)
      {
        record.set("inverse norm", stability.inverse_norm, "u / b");
        record.set("inverse norm is exact", stability.is_norm_exact ? 1 : 0);
      }
    }
    const auto enter = [&](scene::Target target, const problem::Field<dim> &u)
    {
      const Truncation found = truncation(of, u);
      const auto value = [&](scene::Norm norm) -> std::optional<double>
      {
        const double tau = scene::is_largest(norm) ? found.largest : found.l2;
        if (scene::quantity(norm) == Quantity::truncation)
          return tau;
        if (scene::quantity(norm) != Quantity::bound || !(stability.inverse_norm > 0))
          return {};
        return scene::is_largest(norm) ? stability.inverse_norm * tau
                                       : nodal_over_volumes(of, problem) * tau / stability.smallest;
      };
      for (const scene::Norm norm : norms)
        if (const auto found_value = value(norm))
          record.set(scene::DecisiveError{norm, target}.text(), *found_value);
      record.set("largest load", found.load);
      record.set("truncation round-off", found.round_off);
    };
    if (problem.solution)
      enter(scene::Target::exact, *problem.solution);
    if (problem.local_solution)
      enter(scene::Target::local, *problem.local_solution);
  }

#define INSTANTIATE(dim)                                                                           \
  template void enter_truncation(const Method &, const std::vector<scene::Norm> &,                 \
                                 const problem::Problem<dim> &, Record &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace plumbline::study
