#include "method/limit_proof.h"

#include "physics/profile_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace plumbline::method
{
  namespace
  {
    using Answer = LimitProof::Answer;

    /// T_abcd of the local operator L u_a = -T_abcd ∂_c ∂_d u_b, symmetric in c and d.
    double local_tensor(const problem::Problem<2> &problem, unsigned int a, unsigned int b,
                        unsigned int c, unsigned int d)
    {
      std::array<int, 2> alpha{};
      ++alpha[c];
      ++alpha[d];
      double value = problem.kernel.moment(alpha, a, b) / 2;
      if (problem.dilatation)
      {
        const physics::Lame lame = problem.dilatation->material({});
        const int n_ways = (a == c && b == d ? 1 : 0) + (a == d && b == c ? 1 : 0);
        value += (lame.lambda - lame.mu) * n_ways / 2;
      }
      return value;
    }

    /// Of T by a stencil, with the sums that must vanish, relative to the largest T.
    double moment_defect(const problem::Problem<2> &problem, const algebra::Stencil &stencil,
                         double mass)
    {
      const double h = problem.h, horizon = problem.horizon();
      const int reach = stencil.reach();
      const auto sum = [&](unsigned int a, unsigned int b, int c, int d)
      {
        const auto factor = [](int axis, int k1, int k2) {
          return axis < 0 ? 1 : axis == 0 ? k1 : k2;
        };
        double value = 0;
        for (int k2 = -reach; k2 <= reach; ++k2)
          for (int k1 = -reach; k1 <= reach; ++k1)
            value += stencil(a, b, k1, k2) * factor(c, k1, k2) * factor(d, k1, k2);
        return value / mass;
      };
      double worst = 0, largest = 0;
      for (unsigned int a = 0; a < stencil.n_blocks(); ++a)
        for (unsigned int b = 0; b < stencil.n_blocks(); ++b)
        {
          worst = std::max(worst, std::abs(sum(a, b, -1, -1)) * horizon * horizon);
          for (unsigned int c = 0; c < 2; ++c)
          {
            const int axis = static_cast<int>(c);
            worst = std::max(worst, std::abs(sum(a, b, axis, -1)) * h * horizon);
            for (unsigned int d = c; d < 2; ++d)
            {
              const double exact = local_tensor(problem, a, b, c, d);
              const double found = -sum(a, b, axis, static_cast<int>(d)) * h * h / 2;
              worst = std::max(worst, std::abs(found - exact));
              largest = std::max(largest, std::abs(exact));
            }
          }
        }
      return worst / largest;
    }

    /// A homogeneous solid, or bonds whose coefficient is smooth.
    bool is_smooth(const problem::Problem<2> &problem)
    {
      return problem.is_homogeneous ||
             (!problem.dilatation && problem.coefficient && problem.coefficient->is_smooth());
    }
  } // namespace

  LimitProof prove_by_moments(const problem::Problem<2> &problem, const algebra::Stencil &stencil,
                              double mass)
  {
    LimitProof proof;
    if (!problem.settings.tends_to_local_limit)
      return proof;
    proof.defect = moment_defect(problem, stencil, mass);
    proof.answer = proof.has_wrong_moments() ? Answer::incompatible : Answer::compatible;
    std::ostringstream reason;
    if (proof.has_wrong_moments())
      reason << "second moments are off by " << std::setprecision(3) << 100 * proof.defect << " %";
    else
      reason << "second moments are exact (to " << std::setprecision(1) << proof.defect << ")";
    proof.reason = reason.str();
    return proof;
  }

  LimitProof limit_of(const problem::Problem<2> &problem, const LimitProof &of_families)
  {
    LimitProof proof;
    proof.ball_defect = of_families.ball_defect;
    proof.area_defect = of_families.area_defect;
    if (!problem.settings.tends_to_local_limit)
      return proof;
    if (!problem.damage.is_there())
      proof = of_families;
    else if (of_families.has_wrong_moments())
    {
      proof.defect = of_families.defect;
      proof.reason = of_families.reason + ", whatever bonds are broken besides";
    }
    if (proof.answer == Answer::compatible && !is_smooth(problem))
    {
      proof.answer = Answer::unknown;
      proof.reason += ", but the material is not known to be smooth";
    }
    return proof;
  }

  LimitProof prove_galerkin(const problem::Problem<2> &problem, const Diagnostics &diagnostics)
  {
    LimitProof proof;
    if (!problem.settings.tends_to_local_limit)
      return proof;
    const bool has_entries = problem.lattice() || diagnostics.is_outer_error_known;
    if (problem.body() || !is_smooth(problem))
      proof.reason = "no theorem for this material or boundary";
    else if (!is_positive_and_non_increasing(problem.kernel.profile(), problem.kernel.constant()))
      proof.reason = "no theorem for a kernel that is negative or increases with distance";
    else if (!has_entries)
      proof.reason = "its entries are quadrature of unknown error";
    else
    {
      proof.answer = Answer::compatible;
      proof.reason = "its space holds the continuous piecewise linear functions (Tian & Du 2014)";
      if (!problem.is_homogeneous)
        proof.reason += ", and the coefficient is smooth and positive";
    }
    return proof;
  }
} // namespace plumbline::method
