#include "method/limit_proof.h"

#include "physics/profile_shape.h"
#include "problem/on_line.h"

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

    double cell_size(const problem::Problem<2> &problem)
    {
      return problem.h;
    }
    double cell_size(const problem::Problem<3> &problem)
    {
      return problem.h();
    }
    double cell_size(const problem::Problem<1> &problem)
    {
      return problem.h();
    }

    /// T_abcd of the local operator L u_a = -T_abcd ∂_c ∂_d u_b, symmetric in c and d.
    template <int dim>
    double local_tensor(const problem::Problem<dim> &problem, unsigned int a, unsigned int b,
                        unsigned int c, unsigned int d)
    {
      std::array<int, dim> alpha{};
      ++alpha[c];
      ++alpha[d];
      double value = problem.kernel.moment(alpha, a, b) / 2;
      if constexpr (dim > 1) // on a line there are scalar kernels alone
        if (problem.dilatation)
        {
          const physics::Lame lame = problem.dilatation->material({});
          const int n_ways = (a == c && b == d ? 1 : 0) + (a == d && b == c ? 1 : 0);
          value += (lame.lambda - lame.mu) * n_ways / 2;
        }
      return value;
    }

    /// Of T by a stencil, with the sums that must vanish, relative to the largest T.
    template <int dim>
    double moment_defect(const problem::Problem<dim> &problem, const algebra::Stencil &stencil,
                         double mass)
    {
      const double h = cell_size(problem), horizon = problem.horizon();
      const auto &reach = stencil.reaches();
      const auto sum = [&](unsigned int a, unsigned int b, int c, int d)
      {
        const auto factor = [](int axis, const std::array<int, 3> &k)
        { return axis < 0 ? 1 : k[axis]; };
        double value = 0;
        std::array<int, 3> k{};
        for (k[2] = -reach[2]; k[2] <= reach[2]; ++k[2])
          for (k[1] = -reach[1]; k[1] <= reach[1]; ++k[1])
            for (k[0] = -reach[0]; k[0] <= reach[0]; ++k[0])
              value += stencil(a, b, k[0], k[1], k[2]) * factor(c, k) * factor(d, k);
        return value / mass;
      };
      double worst = 0, largest = 0;
      for (unsigned int a = 0; a < stencil.n_blocks(); ++a)
        for (unsigned int b = 0; b < stencil.n_blocks(); ++b)
        {
          worst = std::max(worst, std::abs(sum(a, b, -1, -1)) * horizon * horizon);
          for (unsigned int c = 0; c < dim; ++c)
          {
            const int axis = static_cast<int>(c);
            worst = std::max(worst, std::abs(sum(a, b, axis, -1)) * h * horizon);
            for (unsigned int d = c; d < dim; ++d)
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

    constexpr auto theorem =
        "its space holds the continuous piecewise linear functions (Tian & Du 2014)";
    constexpr auto no_theorem =
        "no theorem for a kernel that is negative or increases with distance";

    template <int dim>
    bool has_theorem(const physics::Kernel<dim> &kernel)
    {
      return is_positive_and_non_increasing(kernel.profile(), kernel.constant());
    }

    /// A homogeneous solid, or bonds whose coefficient is smooth.
    bool is_smooth(const problem::Problem<2> &problem)
    {
      return problem.is_homogeneous ||
             (!problem.dilatation && problem.coefficient && problem.coefficient->is_smooth());
    }
  } // namespace

  template <int dim>
  LimitProof prove_by_moments(const problem::Problem<dim> &problem, const algebra::Stencil &stencil,
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

  template LimitProof prove_by_moments(const problem::Problem<1> &, const algebra::Stencil &,
                                       double);
  template LimitProof prove_by_moments(const problem::Problem<2> &, const algebra::Stencil &,
                                       double);
  template LimitProof prove_by_moments(const problem::Problem<3> &, const algebra::Stencil &,
                                       double);

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

  LimitProof limit_of(const problem::Problem<3> &problem, const LimitProof &of_families)
  {
    if (problem.settings.tends_to_local_limit && !problem.is_free)
    {
      LimitProof proof = of_families;
      if (proof.answer == Answer::compatible && !problem.is_homogeneous())
      {
        proof.answer = Answer::unknown;
        proof.reason += ", but the material is not known to be smooth";
      }
      return proof;
    }
    LimitProof proof;
    if (problem.is_free)
      return proof;
    proof.ball_defect = of_families.ball_defect;
    proof.area_defect = of_families.area_defect;
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
    else if (!has_theorem(problem.kernel))
      proof.reason = no_theorem;
    else if (!has_entries)
      proof.reason = "its entries are quadrature of unknown error";
    else
    {
      proof.answer = Answer::compatible;
      proof.reason = theorem;
      if (!problem.is_homogeneous)
        proof.reason += ", and the coefficient is smooth and positive";
    }
    return proof;
  }

  namespace
  {
    /// Of a homogeneous material, with exact entries.
    template <int dim>
    LimitProof prove_homogeneous(const problem::Problem<dim> &problem)
    {
      LimitProof proof;
      if (!problem.settings.tends_to_local_limit)
        return proof;
      const bool is_proven = has_theorem(problem.kernel);
      proof.answer = is_proven ? Answer::compatible : Answer::unknown;
      proof.reason = is_proven ? theorem : no_theorem;
      return proof;
    }
  } // namespace

  LimitProof prove_galerkin(const problem::Problem<3> &problem)
  {
    return prove_homogeneous(problem);
  }

  LimitProof prove_galerkin(const problem::Problem<1> &problem)
  {
    return prove_homogeneous(problem);
  }
} // namespace plumbline::method
