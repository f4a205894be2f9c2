#pragma once

#include "meshfree/families.h"

namespace plumbline::meshfree
{
  using geometry::NodeCells;

  // Every rule on a lattice of size h, where all nodes share one family, and on scattered nodes,
  // where each cell has its own area A and size √A.

  /// Full area: A for nodes in the ball, kernel at the node.
  /// Source: Silling & Askari 2005, doi:10.1016/j.compstruc.2004.11.026.
  Bonds full_area(const Kernel<2> &kernel, double h, Backend backend);
  Families full_area(const Kernel<2> &kernel, const NodeCells &cells, Backend backend);

  /// A times a ramp from 1 at r = δ - √A/2 to 1/2 at r = δ, 0 beyond, kernel at the node.
  /// Source: Parks et al. 2008, doi:10.1016/j.cpc.2008.06.011.
  Bonds lammps(const Kernel<2> &kernel, double h, Backend backend);
  Families lammps(const Kernel<2> &kernel, const NodeCells &cells, Backend backend);

  /// The same ramp down to 0 at r = δ + √A/2, kernel at the node, clipped at 0.
  /// Source: Le, Chan & Schwartz 2014, doi:10.1002/nme.4642.
  Bonds qwj(const Kernel<2> &kernel, double h, Backend backend);
  Families qwj(const Kernel<2> &kernel, const NodeCells &cells, Backend backend);

  /// Exact area of ball ∩ cell, also of cells whose node is outside; kernel at the node, clipped
  /// at 0. Source: Seleson 2014, doi:10.1016/j.cma.2014.06.016.
  Bonds partial_area(const Kernel<2> &kernel, double h, Backend backend);
  Families partial_area(const Kernel<2> &kernel, const NodeCells &cells, Backend backend);

  /// Exact area, kernel at the centroid of ball ∩ cell. Second order at fixed horizon, not AC.
  /// Source: Seleson 2014, doi:10.1016/j.cma.2014.06.016.
  Bonds improved_partial_area(const Kernel<2> &kernel, double h, Backend backend);
  Families improved_partial_area(const Kernel<2> &kernel, const NodeCells &cells, Backend backend);

  /// IPA-AC areas A changed as little as possible, min Σ (w - A)²/A, so that the discrete operator
  /// has the exact moments up to a degree: asymptotically compatible of order 2 (degree 2) or 4
  /// (degree 4). On scattered nodes the odd moments are conditions as well: 5 or 14 for scalars, 9
  /// or 22 for tensors. Scalar kernels at the centroid; tensors at the node, since at the centroid
  /// a third, nearly dependent constraint asks for negative weights.
  /// @throws NumericalError  the moments cannot be met: too few neighbours
  Bonds recalibrated(const Kernel<2> &kernel, double h, Backend backend, unsigned int degree);
  Families recalibrated(const Kernel<2> &kernel, const NodeCells &cells, Backend backend,
                        unsigned int degree);

  /// Weights of least Σ w² that integrate s1^a s2^b / |s|³, 2 <= a + b <= 5, exactly.
  /// Source: Trask et al. 2019, doi:10.1016/j.cma.2018.08.016.
  /// @throws NumericalError  the family has too few neighbours for the constraints
  Bonds optimisation_based(const Kernel<2> &kernel, double h, Backend backend);
  Families optimisation_based(const Kernel<2> &kernel, const NodeCells &cells, Backend backend);

  /// A row of the table of rules.
  struct Rule
  {
    std::string name, help;
    Bonds (*bonds)(const Kernel<2> &, double h, Backend);
    Families (*families)(const Kernel<2> &, const NodeCells &, Backend);
  };

  /// All rules; a new one is one source file and one row here.
  const std::vector<Rule> &rules();
} // namespace plumbline::meshfree
