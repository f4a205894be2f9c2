#pragma once

#include "scene/problem.h"
#include "study/comparison.h"

namespace plumbline::study
{
  using method::Method;

  /// A problem with cells of another size, whose solutions are still averaged over the comparison
  /// cells of the first one.
  struct Resized
  {
    problem::Problem<2> problem;
    /// Cells cut in pieces, not made anew: they fill the same polygon, however curved the domain.
    bool is_cut = false;
  };

  /// Its problem with cells of h / n, n = 2, 4, ... Meshes that a scene makes to measure (a .geo
  /// file, a generator, a map) are made anew and so follow curved boundaries; others are cut.
  Resized finer(const scene::Case &one, unsigned int n);

  /// Its problem with cells of n h, n = 2, 4, ...; nothing where the domain or the file has none.
  std::optional<Resized> coarser(const scene::Case &one, unsigned int n);

  /// A solution of a resized problem.
  struct ResizedSolution
  {
    std::vector<double> averages; ///< over the first problem's comparison cells
    Values value;
  };

  /// @param problem  that was resized
  /// @throws as Method::solve
  ResizedSolution solve_resized(const Resized &resized, const problem::Problem<2> &problem,
                                const Method &method);

  /// How fast the cells of a problem's domain tend to what they stand for, see
  /// problem::MeshDomain::boundary_order; 0: nothing is curved.
  unsigned int geometry_order(const problem::Problem<2> &problem);
} // namespace plumbline::study
