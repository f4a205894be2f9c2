#include "meshfree/rules/quadrature_rule.h"

#include "base/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

namespace plumbline::meshfree
{
  namespace
  {
    /// Moments count as met up to this fraction of the largest.
    constexpr double moment_tolerance = 1e-10;

    constexpr auto remedy = "; raise m = horizon / h (Study/m, Study/horizon)";

    /// The next index of -n ... n along each axis, the first being the fastest.
    /// @return  whether there is one
    template <std::size_t dim>
    bool advance(std::array<int, dim> &k, int n)
    {
      for (int &one : k)
      {
        if (++one <= n)
          return true;
        one = -n;
      }
      return false;
    }

    /// The cell about node k of a lattice.
    template <class Use>
    void with_cell(const std::array<int, 1> &k, double h, const Use &use)
    {
      use(geometry::Interval{(k[0] - .5) * h, (k[0] + .5) * h});
    }

    template <class Use>
    void with_cell(const std::array<int, 2> &k, double h, const Use &use)
    {
      const auto square = geometry::square(Point<2>((k[0] - .5) * h, (k[1] - .5) * h), h);
      use(geometry::ConvexCell(geometry::view(square)));
    }

    template <class Use>
    void with_cell(const std::array<int, 3> &k, double h, const Use &use)
    {
      const Point<3> node(k[0] * h, k[1] * h, k[2] * h), half(.5 * h, .5 * h, .5 * h);
      use(geometry::ConvexPolyhedron::box(Point<3>(node - half), node + half));
    }
  } // namespace

  template <int dim>
  double ramp(const Kernel<dim> &kernel, const Candidate<dim> &candidate)
  {
    const double size = dim == 1   ? candidate.area
                        : dim == 2 ? std::sqrt(candidate.area)
                                   : std::cbrt(candidate.area);
    return std::min(1., (kernel.horizon() - candidate.xi.norm()) / size + .5);
  }

  template <int dim>
  bool add_bond(const NeighbourhoodQuadrature<dim> &rule, const Kernel<dim> &kernel,
                const Candidate<dim> &candidate, Family<dim> &family)
  {
    const Bond<dim> bond = rule.bond(kernel, candidate);
    if (bond.weight == 0)
      return false;
    const double r = bond.kernel_point.norm();
    family.is_clipped =
        family.is_clipped || (r > kernel.horizon() * (1 + tie_tolerance) && kernel.radial(r) < 0);
    family.bonds.push_back(bond);
    return true;
  }

  template <int dim>
  void finish(const NeighbourhoodQuadrature<dim> &rule, Family<dim> &family,
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

  template <int dim>
  Bonds<dim> lattice_bonds(const NeighbourhoodQuadrature<dim> &rule, const Kernel<dim> &kernel,
                           double h, Backend backend)
  {
    const double horizon = kernel.horizon();
    const int n = static_cast<int>(horizon / h + .5 + tie_tolerance);
    Family<dim> family;
    family.own_area = dim == 1 ? h : dim == 2 ? h * h : h * h * h;
    std::array<int, dim> k;
    k.fill(-n);
    for (bool is_more = true; is_more; is_more = advance(k, n))
      if (k != std::array<int, dim>{})
      {
        Point<dim> xi;
        for (unsigned int d = 0; d < dim; ++d)
          xi[d] = k[d] * h;
        with_cell(k, h,
                  [&](const auto &cell)
                  {
                    Candidate<dim> candidate;
                    candidate.ball = {Point<dim>(), horizon};
                    candidate.backend = backend;
                    candidate.xi = xi;
                    candidate.area = family.own_area;
                    candidate.pieces = {&cell, 1};
                    add_bond(rule, kernel, candidate, family);
                  });
      }
    finish(rule, family,
           [&]
           {
             std::ostringstream place;
             place << "for m = " << horizon / h;
             return place.str();
           });
    Bonds<dim> bonds{h, std::move(family.bonds), family.fit};
    if (family.is_clipped)
      bonds.notes.push_back("kernel negative at nodes beyond the horizon, clipped at 0");
    if (family.fit.rank < family.fit.n_conditions)
      bonds.notes.push_back("moment matrix of rank " + std::to_string(family.fit.rank) + " of " +
                            std::to_string(family.fit.n_conditions) + ", feasible by symmetry");
    return bonds;
  }

#define PLUMBLINE_INSTANTIATE(dim)                                                                 \
  template double ramp(const Kernel<dim> &, const Candidate<dim> &);                               \
  template bool add_bond(const NeighbourhoodQuadrature<dim> &, const Kernel<dim> &,                \
                         const Candidate<dim> &, Family<dim> &);                                   \
  template void finish(const NeighbourhoodQuadrature<dim> &, Family<dim> &,                        \
                       const std::function<std::string()> &);                                      \
  template Bonds<dim> lattice_bonds(const NeighbourhoodQuadrature<dim> &, const Kernel<dim> &,     \
                                    double, Backend);
  PLUMBLINE_INSTANTIATE(1)
  PLUMBLINE_INSTANTIATE(2)
  PLUMBLINE_INSTANTIATE(3)
#undef PLUMBLINE_INSTANTIATE
} // namespace plumbline::meshfree
