#pragma once

#include "base/choice.h"

#include <array>
#include <string>
#include <vector>

namespace plumbline::method
{
  /// What theory says of a method's limit as h and horizon go to 0 at a fixed ratio, whatever the
  /// field: see method/limit_proof.h.
  struct LimitProof
  {
    enum class Answer
    {
      unknown,     ///< no theory applies, or it was not asked: another regime
      compatible,  ///< it tends to the local limit of every smooth field
      incompatible ///< its local limit is another operator
    };
    Answer answer = Answer::unknown;
    /// Of the second moments from those of the local operator, relative to the largest of these; 0
    /// where they play no part. On scattered nodes: the worst of all families.
    double defect = 0;
    /// On scattered nodes: mean and standard deviation over the families of the moment up to the
    /// second, of all components, whose mean is farthest from exact; relative to the largest second
    /// moment. On a lattice all families are one.
    double mean_defect = 0, spread = 0;
    /// Where m grows from level to level (regimes m and delta-m): of the moments of the weights
    /// from those of the ball, up to the order that matters there; on scattered nodes the worst of
    /// all families. It must tend to 0.
    double ball_defect = 0;
    /// There: Σ |w - area| |C| |ξ|² over its value with areas, of cells or ball ∩ cell. Where it
    /// tends to 0, the operator tends to the nonlocal one for every smooth field.
    double area_defect = 0;
    std::string reason; ///< one clause with the numbers or the theorem; empty: not asked

    /// Known to be wrong somewhere: such a method is never advised.
    bool has_wrong_moments() const { return defect > tolerance; }
    static constexpr double tolerance = 1e-8; ///< for moments to count as exact
  };

  /// The net force of the surface terms of a linear peridynamic solid about a crack's tip.
  struct TipForce
  {
    std::array<double, 2> tip{};   ///< [length]
    std::array<double, 2> force{}; ///< sum over nodes near it [force]
    double sum_of_norms = 0;       ///< of the same forces, what `force` is to be compared with
    double norm = 0;               ///< F of `force`
    double over_root = 0;          ///< F / √horizon
  };

  /// What a method says about its own solution.
  struct Diagnostics
  {
    /// Bonds of one family, or entries of a Galerkin row besides the diagonal.
    unsigned int n_neighbours = 0;
    double smallest_weight_ratio = 1; ///< min over a family of weight / (ball ∩ cell area or cell)
    unsigned int n_negative_weights = 0;     ///< in the family of a lattice, or in all families
    unsigned int n_conditions = 0, rank = 0; ///< moments asked of the family of lowest rank
    double smallest_singular_value = 1; ///< of such conditions, least of all, see meshfree::Fit
    double relative_residual = 0;       ///< of the linear system when the solver stopped
    std::string operator_backend;       ///< "fft", "direct", "sparse" or "sparse, <solver>"
    unsigned int n_geometry_checks = 0; ///< cut cells recomputed with the exact backend
    double geometry_difference = 0;     ///< worst difference among them, relative to the cell
    double outer_change = 0;            ///< L2, relative: the last refinement of outer quadrature
    bool is_outer_error_known = true;   ///< false: outer quadrature was not refined
    unsigned int n_refinements = 0;     ///< of outer quadrature
    LimitProof limit;                   ///< at this ratio of horizon to h
    std::vector<TipForce> tip_forces;   ///< where a crack's tip has surface terms about it
    std::vector<std::string> notes;     ///< what the method had to do, e.g. clip a negative kernel
  };
} // namespace plumbline::method

namespace plumbline::base
{
  template <>
  inline constexpr auto words<method::LimitProof::Answer> =
      std::array{"unknown", "compatible", "incompatible"};
} // namespace plumbline::base
