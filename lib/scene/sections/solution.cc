#include "scene/keys.h"
#include "scene/study_sections.h"
#include "scene/values.h"

namespace plumbline::base
{
  template <>
  inline constexpr auto words<geometry::Backend> = std::array{"fast", "cgal"};
} // namespace plumbline::base

namespace plumbline::scene
{
  void ReferenceSection::declare(Keys &keys)
  {
    const std::string none = "none";
    keys.add(
        "method", none, any_text(),
        [this, none](const std::string &text)
        {
          method.reset();
          if (text != none)
            method = method_name(text);
        },
        "Galerkin method whose cell averages are the reference: none, Q1, Q2, Q3, ...");
    keys.add("estimate", estimate,
             "Whose error is estimated by outer quadrature, h/2, 2h and degree p+1: of the "
             "reference, of every Galerkin solution, or of none. automatic: of the reference, and "
             "where there is neither one nor an exact solution of every Galerkin solution.");
    keys.add("tolerance", tolerance, between(0, 1),
             "Largest estimate of the reference's own error, relative to the solution; where it is "
             "not met the run ends with exit code 3. 0: the estimate is only reported.");
  }

  void QuadratureSection::declare(Keys &keys)
  {
    keys.add("entries", exact_entries, "quadrature", "exact",
             "Entries of Galerkin matrices on meshes. exact: to rounding where a way is known "
             "(axis-aligned rectangles by correlation; triangles up to degree 2, parallelograms "
             "up to degree 1 and constants by pairs of sides, scalar kernels and bond tensors), "
             "else by quadrature, and the report says why. quadrature: all of them.");
    keys.add("tolerance", tolerance, between(0, 1),
             "Outer quadrature on meshes is refined until the solution changes by less, relative "
             "to it. 0: the first rule is taken as it is, and nothing is known of its error.");
    keys.add(
        "max refinements", max_refinements, count(0, 8),
        "Most refinements; where the tolerance is not met by then the run ends with exit code 3.");
  }

  void GeometrySection::declare(Keys &keys)
  {
    keys.add(
        "backend", backend,
        "Who intersects balls and cells: fast (double precision) or cgal (exact circular kernel).");
    keys.add("checks", n_checks, count(0, 100000),
             "Cut cells of each reference that are recomputed with the exact backend, some 0.1 ms "
             "each.");
    keys.add("seed", seed, count(0), "Seed of the sample of checked cells.");
  }

  void SolverSection::declare(Keys &keys)
  {
    keys.add("operator", operator_backend,
             "How the operator is applied: by Fourier transforms, by the shared stencil, by a "
             "sparse Trilinos matrix, or whichever of the first two is faster.");
    keys.add("model", is_full_model, "smallest", "full",
             "smallest: no more than the scene needs. full: a mesh and sparse matrices where a "
             "lattice and a stencil would do, the dilatation also where lambda = mu; same numbers, "
             "to show that nothing is missed.");
    keys.add("linear solver", linear_solver,
             "Of sparse systems, on meshes and scattered nodes: direct, or iterations with "
             "algebraic multigrid or Jacobi.");
    keys.add(
        "iteration", iteration,
        "What iterates: automatic (cg where the operator is symmetric, else gmres), cg (conjugate "
        "gradients, refused where it is not), gmres or bicgstab (for sparse systems).");
    keys.add(
        "dilatation", is_mixed, "eliminated", "kept",
        "Of state-based solids on scattered nodes: eliminated, or kept as unknowns besides u, for "
        "half the memory; amg is multigrid of the rest of the system then. Both yield the same u.");
    keys.add("tolerance", tolerance, between(1e-15, 1e-3),
             "Relative residual of the linear system.");
    keys.add("max iterations", max_iterations, count(1), "Most iterations.");
  }

  void OutputSection::declare(Keys &keys)
  {
    keys.add("fields", fields, yes_or_no(),
             "Write the solutions of the finest levels as VTU files.");
  }
} // namespace plumbline::scene
