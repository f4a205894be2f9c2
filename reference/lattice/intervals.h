#pragma once

#include "algebra/stencil.h"
#include "method/interval_discretisation.h"
#include "physics/kernel.h"
#include "reference/shapes.h"

#include <memory>
#include <string>

namespace plumbline::reference
{
  /// The Galerkin matrix of a scalar kernel on a uniform lattice with one axis:
  ///   A_st(k) = ∫_{|z|<δ} C(z) [c_k(0) - c_k(z)] dz = h ∫_0^δ C(z) E(z/h) dz,
  ///   E(τ) = 2 r_st(-k) - r_st(τ - k) - r_st(-τ - k),
  /// with the correlations c_k(z) = h r_st(z/h - k) of shapes.h. E is a polynomial on each cell. On
  /// the first one its powers from τ (continuous spaces: τ²) on are integrated one by one, so that
  /// kernels need not be integrable: r^-1 (continuous spaces: r^-2) makes finite entries. Elsewhere
  /// Gauss's rule is exact to rounding, between the breaks of the profile.
  /// Blocks are the families; entries [unit of C length^2].
  /// Accuracy: 1e-14 of the largest entry; constants are in the kernel of the operator to
  /// round-off.
  /// @pre  why_not_on_intervals() is empty
  algebra::Stencil galerkin_stencil(const physics::Kernel<1> &kernel, double h,
                                    const AxisShapes &shapes);

  /// Empty, or why a space has no finite entries with this kernel.
  std::string why_not_on_intervals(const physics::Kernel<1> &kernel, bool is_continuous);

  std::unique_ptr<method::IntervalDiscretisation>
  discretise_on_intervals(const problem::Problem<1> &problem, const AxisShapes &shapes);
} // namespace plumbline::reference
