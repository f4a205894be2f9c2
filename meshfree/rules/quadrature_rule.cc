#include "meshfree/rules/quadrature_rule.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace plumbline::meshfree
{
  namespace
  {
    /// Moments count as met up to this fraction of the largest.
    constexpr double moment_tolerance = 1e-10;

    constexpr auto remedy = "; raise m = horizon / h (Study/m, Study/horizon)";
  } // namespace

  double ramp(const Kernel<2> &kernel, const Candidate &candidate)
  {
    const double size = std::sqrt(candidate.area);
    return std::min(1., (kernel.horizon() - candidate.xi.norm()) / size + .5);
  }

  bool add_bond(const NeighbourhoodQuadrature &rule, const Kernel<2> &kernel,
                const Candidate &candidate, Family &family)
  {
    const Bond bond = rule.bond(kernel, candidate);
    if (bond.weight == 0)
      return false;
    const double r = bond.kernel_point.norm();
    family.is_clipped =
        family.is_clipped || (r > kernel.horizon() * (1 + tie_tolerance) && kernel.radial(r) < 0);
    family.bonds.push_back(bond);
    return true;
  }

  void finish(const NeighbourhoodQuadrature &rule, Family &family,
              const std::function<std::string()> &where)
  {
    if (family.bonds.empty())
      throw NumericalError("there are no neighbours " + where() + remedy);
    if (!rule.adjust)
      return;
    rule.adjust(family);
    const Fit &fit = family.fit;
    if (fit.residual < moment_tolerance)
      return;
    std::ostringstream message;
    message << "weights with exact moments up to degree " << fit.degree << " are infeasible "
            << where() << ": the " << family.bonds.size() << " neighbours span rank " << fit.rank
            << " of " << fit.n_conditions << " and miss the moments by " << fit.residual
            << ", too few neighbours for the asked degree" << remedy
            << ", or take a rule of lower degree";
    throw NumericalError(message.str());
  }

  Bonds lattice_bonds(const NeighbourhoodQuadrature &rule, const Kernel<2> &kernel, double h,
                      Backend backend)
  {
    const double horizon = kernel.horizon();
    const int n = static_cast<int>(horizon / h + .5 + tie_tolerance);
    Family family;
    for (int k2 = -n; k2 <= n; ++k2)
      for (int k1 = -n; k1 <= n; ++k1)
        if (k1 != 0 || k2 != 0)
        {
          const auto square = geometry::square(Point<2>((k1 - .5) * h, (k2 - .5) * h), h);
          const geometry::ConvexCell cell(geometry::view(square));
          add_bond(rule, kernel,
                   {{Point<2>(), horizon}, backend, Point<2>(k1 * h, k2 * h), h * h, {&cell, 1}},
                   family);
        }
    finish(rule, family,
           [&]
           {
             std::ostringstream place;
             place << "for m = " << horizon / h;
             return place.str();
           });
    Bonds bonds{h, std::move(family.bonds), family.fit};
    if (family.is_clipped)
      bonds.notes.push_back("kernel negative at nodes beyond the horizon, clipped at 0");
    if (family.fit.rank < family.fit.n_conditions)
      bonds.notes.push_back("moment matrix of rank " + std::to_string(family.fit.rank) + " of " +
                            std::to_string(family.fit.n_conditions) + ", feasible by symmetry");
    return bonds;
  }
} // namespace plumbline::meshfree
