#include "analysis/transient.h"
#include "method/discretisation.h"
#include "method/discretisation_in_space.h"
#include "study/stability.h"

namespace plumbline::study
{
  namespace
  {
    /// Of small motions about rest, of unit density.
    /// @param of_matrix  the largest eigenvalue of the method's matrix, whose masses are lumped
    template <int dim>
    double largest_eigenvalue(const method::MotionOf<dim> &equation,
                              const problem::Problem<dim> &problem, bool has_masses_of_matrix,
                              double of_matrix)
    {
      if (has_masses_of_matrix && !equation.largest_eigenvalue())
        return of_matrix;
      const analysis::Transient transient(equation, analysis::TimeSeries(equation.drive(problem)),
                                          1, 0);
      const double step = transient.critical_step(analysis::scheme("velocity Verlet"));
      return 4 / (step * step);
    }
  } // namespace

  template <int dim>
  CriticalSteps critical_steps(const DiscretisationOf<dim> &discretisation,
                               const problem::Problem<dim> &problem, const Stability &stability,
                               double density)
  {
    constexpr double rounding = 1e-8; // of the largest: accuracy of eigenvalues
    CriticalSteps steps{density};
    if (!stability.is_symmetric())
    {
      const algebra::Eigenvalues &e = stability.eigenvalues;
      steps.largest = e.n_computed > 0 ? e.largest_modulus : 0;
      steps.is_oscillating = e.largest_imaginary <= rounding * e.largest_modulus &&
                             e.smallest_real >= -rounding * e.largest_modulus;
      return steps;
    }
    steps.is_oscillating = stability.smallest >= -rounding * stability.largest;
    const auto own = discretisation.motion(false);
    steps.largest =
        own ? largest_eigenvalue(*own, problem, stability.is_collocated, stability.largest)
            : stability.largest;
    if (!stability.is_collocated && own)
      if (const auto lumped = discretisation.motion(true))
        steps.largest_lumped = largest_eigenvalue(*lumped, problem, true, stability.largest);
    return steps;
  }

  template CriticalSteps critical_steps(const method::Discretisation &, const problem::Problem<2> &,
                                        const Stability &, double);
  template CriticalSteps critical_steps(const method::DiscretisationInSpace &,
                                        const problem::Problem<3> &, const Stability &, double);
} // namespace plumbline::study
