#include "meshfree/lattice/stencil.h"

#include "meshfree/rules/family_moments.h"
#include "meshfree/rules/family_statistics.h"
#include "method/limit_proof.h"
#include "problem/on_line.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace plumbline::meshfree
{
  namespace
  {
    /// Where a bond ends, in cells.
    template <int dim>
    std::array<int, 3> offset(const Bond<dim> &bond, double h)
    {
      std::array<int, 3> cells{};
      for (unsigned int d = 0; d < dim; ++d)
        cells[d] = static_cast<int>(std::lround(bond.xi[d] / h));
      return cells;
    }
  } // namespace

  template <int dim>
  algebra::Stencil lattice_operator(const physics::Kernel<dim> &kernel, const Bonds<dim> &bonds)
  {
    int reach = 0;
    for (const Bond<dim> &bond : bonds.family)
      for (const int k : offset(bond, bonds.h))
        reach = std::max(reach, std::abs(k));
    algebra::Stencil stencil(kernel.n_components(),
                             std::array<int, 3>{reach, dim >= 2 ? reach : 0, dim == 3 ? reach : 0});
    for (const Bond<dim> &bond : bonds.family)
      for (unsigned int a = 0; a < kernel.n_components(); ++a)
        for (unsigned int b = 0; b < kernel.n_components(); ++b)
        {
          const auto k = offset(bond, bonds.h);
          const double entry = kernel_value(kernel, bond, a, b) * bond.weight;
          stencil(a, b, k[0], k[1], k[2]) -= entry;
          stencil(a, b, 0, 0) += entry;
        }
    return stencil;
  }

  template algebra::Stencil lattice_operator(const physics::Kernel<1> &, const Bonds<1> &);
  template algebra::Stencil lattice_operator(const physics::Kernel<2> &, const Bonds<2> &);
  template algebra::Stencil lattice_operator(const physics::Kernel<3> &, const Bonds<3> &);

  template <int dim>
  algebra::Stencil state_based_stencil(const physics::Dilatation<dim> &dilatation,
                                       const Bonds<dim> &bonds)
  {
    const physics::Lame lame = dilatation.material({});
    const auto deviatoric =
        lattice_operator(physics::deviatoric_kernel(dilatation.influence, lame.mu), bonds);
    std::array<int, 3> reaches = deviatoric.reaches();
    for (int &reach : reaches)
      reach *= 2;
    algebra::Stencil stencil(dim, reaches);
    const double factor = dilatation.factor(lame, lame);
    for (const Bond<dim> &one : bonds.family)
      for (const Bond<dim> &two : bonds.family)
      {
        const auto k = offset(one, bonds.h), l = offset(two, bonds.h);
        const double product = factor * one.weight * two.weight *
                               radial_value(dilatation.influence, one) *
                               radial_value(dilatation.influence, two);
        for (unsigned int a = 0; a < dim; ++a)
          for (unsigned int b = 0; b < dim; ++b)
            stencil(a, b, k[0] + l[0], k[1] + l[1], k[2] + l[2]) -= product * one.xi[a] * two.xi[b];
      }
    return add(deviatoric, stencil);
  }

  template algebra::Stencil state_based_stencil(const physics::Dilatation<2> &, const Bonds<2> &);
  template algebra::Stencil state_based_stencil(const physics::Dilatation<3> &, const Bonds<3> &);

  template <int dim>
  method::Diagnostics describe(const problem::Problem<dim> &problem, const Bonds<dim> &bonds,
                               const algebra::Stencil &stencil)
  {
    method::Diagnostics diagnostics;
    describe_weights(bonds.family, bonds.fit, diagnostics);
    diagnostics.notes = bonds.notes;
    diagnostics.limit = method::prove_by_moments(problem, stencil, 1);
    if (problem.settings.ball_order > 0)
    {
      const BallMoments ball(problem.kernel, problem.settings.ball_order);
      diagnostics.limit.ball_defect = ball.worst_defect(bonds.family);
      diagnostics.limit.area_defect = ball.area_defect(bonds.family);
    }
    return diagnostics;
  }

  template method::Diagnostics describe(const problem::Problem<1> &, const Bonds<1> &,
                                        const algebra::Stencil &);
  template method::Diagnostics describe(const problem::Problem<2> &, const Bonds<2> &,
                                        const algebra::Stencil &);
  template method::Diagnostics describe(const problem::Problem<3> &, const Bonds<3> &,
                                        const algebra::Stencil &);
} // namespace plumbline::meshfree
