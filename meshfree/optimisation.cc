#include "base/error.h"
#include "meshfree/rules.h"

#include <Eigen/QR>

#include <cmath>
#include <sstream>

namespace plumbline::meshfree
{
  namespace
  {
    /// ∫ s1^a s2^b / |s|³ over the unit disc.
    double exact_integral(int a, int b)
    {
      if (a % 2 != 0 || b % 2 != 0)
        return 0;
      return 2 * std::tgamma(.5 * (a + 1)) * std::tgamma(.5 * (b + 1)) /
             std::tgamma(.5 * (a + b + 2)) / (a + b - 1);
    }
  } // namespace

  Bonds optimisation_based(const Kernel<2> &kernel, double h, Backend backend)
  {
    Bonds bonds = full_area(kernel, h, backend);
    const double horizon = kernel.horizon();
    constexpr int n_functions = 18;
    const auto n = static_cast<Eigen::Index>(bonds.family.size());
    Eigen::MatrixXd values(n_functions, n);
    Eigen::VectorXd integrals(n_functions);
    int row = 0;
    for (int order = 2; order <= 5; ++order)
      for (int a = 0; a <= order; ++a, ++row)
      {
        integrals[row] = exact_integral(a, order - a);
        for (Eigen::Index j = 0; j < n; ++j)
        {
          const double s1 = bonds.family[j].k1 * h / horizon, s2 = bonds.family[j].k2 * h / horizon;
          values(row, j) =
              std::pow(s1, a) * std::pow(s2, order - a) / std::pow(std::hypot(s1, s2), 3);
        }
      }

    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> factors;
    factors.setThreshold(1e-10);
    factors.compute(values);
    const Eigen::VectorXd weights = factors.solve(integrals);
    const double residual = (values * weights - integrals).cwiseAbs().maxCoeff();
    if (!(residual < 1e-9))
    {
      std::ostringstream message;
      message << "the optimisation-based rule is infeasible for m = " << horizon / h << ": the "
              << n << " neighbours span rank " << factors.rank() << " of " << n_functions
              << " and miss the moments by " << residual << "; use m >= 2";
      throw NumericalError(message.str());
    }
    if (factors.rank() < n_functions)
      bonds.notes.push_back("moment matrix of rank " + std::to_string(factors.rank()) + " of " +
                            std::to_string(n_functions) + ", feasible by symmetry");
    for (Eigen::Index j = 0; j < n; ++j)
      bonds.family[j].weight = horizon * horizon * weights[j];
    return bonds;
  }
} // namespace plumbline::meshfree
