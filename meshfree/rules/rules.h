#pragma once

#include "meshfree/rules/quadrature_rule.h"

#include <functional>
#include <string>
#include <vector>

namespace plumbline::meshfree
{
  // Every rule for one kernel: lattice_bonds(rule, kernel, h, backend) makes the bonds on a
  // lattice of size h, where all nodes share one family, Families(rule, kernel, cells, backend)
  // those on scattered nodes, where each cell has its own area A and size √A. In space, dim = 3,
  // volumes take the place of areas, on a line, dim = 1, lengths.

  /// Full area: A for nodes in the ball, kernel at the node.
  /// Source: Silling & Askari 2005, doi:10.1016/j.compstruc.2004.11.026.
  template <int dim>
  NeighbourhoodQuadrature<dim> full_area(const Kernel<dim> &kernel);

  /// A times a ramp from 1 at r = δ - √A/2 to 1/2 at r = δ, 0 beyond, kernel at the node.
  /// Source: Parks et al. 2008, doi:10.1016/j.cpc.2008.06.011.
  template <int dim>
  NeighbourhoodQuadrature<dim> lammps(const Kernel<dim> &kernel);

  /// The same ramp down to 0 at r = δ + √A/2, kernel at the node, clipped at 0. Also known as HHB.
  /// Source: Le, Chan & Schwartz 2014, doi:10.1002/nme.4642.
  template <int dim>
  NeighbourhoodQuadrature<dim> qwj(const Kernel<dim> &kernel);

  /// Exact area of ball ∩ cell, also of cells whose node is outside; kernel at the node, clipped
  /// at 0. Source: Seleson 2014, doi:10.1016/j.cma.2014.06.016.
  template <int dim>
  NeighbourhoodQuadrature<dim> partial_area(const Kernel<dim> &kernel);

  /// Exact area, kernel at the centroid of ball ∩ cell. Second order at fixed horizon, not AC.
  /// Source: Seleson 2014, doi:10.1016/j.cma.2014.06.016.
  template <int dim>
  NeighbourhoodQuadrature<dim> improved_partial_area(const Kernel<dim> &kernel);

  /// IPA-AC areas A changed as little as possible, min Σ (w - A)²/A, so that the discrete operator
  /// has the exact moments up to a degree: asymptotically compatible of order 2 (degree 2) or 4
  /// (degree 4). On scattered nodes the odd moments are conditions as well: 5 or 14 for scalars, 9
  /// or 22 for tensors. Scalar kernels at the centroid; tensors at the node, since at the centroid
  /// a third, nearly dependent constraint asks for negative weights.
  /// Infeasible, a NumericalError, where a node has too few neighbours to meet the moments.
  template <int dim>
  NeighbourhoodQuadrature<dim> recalibrated(const Kernel<dim> &kernel, unsigned int degree);

  /// The same with tensors at the centroid, where IPA-AC takes them: a counterexample. The moments
  /// of C_ab ξ^α up to degree 2, 5 conditions on lattices and 15 on scattered nodes, of which those
  /// of C_11 ξ_2² and C_12 ξ_1 ξ_2, one and the same at the node, nearly depend on each other:
  /// weights turn negative, for non-integer m by many areas. For scalars it is `recalibrated`.
  template <int dim>
  NeighbourhoodQuadrature<dim> recalibrated_at_centroid(const Kernel<dim> &kernel);

  /// Weights of least Σ w² that integrate s^α / |s|³, 2 <= |α| <= 5, exactly.
  /// Source: Trask et al. 2019, doi:10.1016/j.cma.2018.08.016.
  /// Infeasible, a NumericalError, where a node has too few neighbours for the constraints.
  template <int dim>
  NeighbourhoodQuadrature<dim> optimisation_based(const Kernel<dim> &kernel);

  /// Generalised finite differences by weighted least squares of degree 2: coefficients c = w C of
  /// least Σ c²/(A g), g = exp(-(2r/δ)²), with the kernel's moments up to degree 2, odd ones too on
  /// scattered nodes. They depend on the kernel through its second moments, and on where it
  /// vanishes, to 1e-9: no weight has an effect there. Asymptotically compatible; wrong at a fixed
  /// horizon, where the kernel's profile matters. Kernel at the node; tensors by the moments of
  /// n⊗n, as recalibrated. Infeasible, a NumericalError, as above.
  /// Source: Liszka & Orkisz 1980, doi:10.1016/0045-7949(80)90149-2.
  template <int dim>
  NeighbourhoodQuadrature<dim> generalised_finite_differences(const Kernel<dim> &kernel);

  /// The peridynamic differential operator of degree 2: derivatives of the local limit by fitted
  /// values (see fitted_derivatives), ω = A exp(-(2r/δ)²). Generalised finite differences fit
  /// differences u_j - u instead, and have no condition on the sum of all coefficients. Because
  /// of this condition the coefficients of the nearest neighbours are negative on the square
  /// lattice from m = 2.12 on, and short waves may have eigenvalues <= 0 although second moments
  /// are exact. Scalar kernels only. Infeasible, a NumericalError, as above. Source: Madenci, Barut
  /// & Futch 2016, doi:10.1016/j.cma.2016.02.028.
  /// @throws InputError  a bond tensor
  template <int dim>
  NeighbourhoodQuadrature<dim> peridynamic_differential_operator(const Kernel<dim> &kernel);

  /// Generalised moving least squares of degree 2: the same with ω = (1 - r/δ)^4, without areas.
  /// No bond at r = δ.
  /// Source: Mirzaei, Schaback & Dehghan 2012, doi:10.1093/imanum/drr030.
  /// @throws InputError  a bond tensor
  template <int dim>
  NeighbourhoodQuadrature<dim> generalised_moving_least_squares(const Kernel<dim> &kernel);

  /// A row of the table of rules.
  struct Rule
  {
    std::string name, help;
    std::function<NeighbourhoodQuadrature<2>(const Kernel<2> &)> in_plane;
    std::function<NeighbourhoodQuadrature<3>(const Kernel<3> &)> in_space = {}; ///< empty: none
    bool is_scalar = false; ///< it has no weights for tensors
    std::function<NeighbourhoodQuadrature<1>(const Kernel<1> &)> on_line = {}; ///< empty: none
    std::string not_on_line = {}; ///< why there is none
  };

  /// All rules; a new one is one source file and one row here.
  const std::vector<Rule> &rules();

  /// Rules that `all` does not include: not m-convergent (GFD, PDDO, GMLS), or counterexamples.
  const std::vector<Rule> &rules_on_request();

  /// The rule of a name, in any case.
  /// @throws InputError  there is none; it begins with the key and names those that are there
  const Rule &find_rule(const std::string &name, const std::string &key);
} // namespace plumbline::meshfree
