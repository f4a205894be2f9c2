#include "scene/keys.h"
#include "scene/study_sections.h"
#include "scene/values.h"

#include <limits>

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
        "Galerkin method whose cell averages are the reference solution: none, Q1, Q2, Q3, ...; "
        "torus for transient double wells.");
    keys.add("mesh size", h, between(0, std::numeric_limits<double>::max()),
             "Mesh size of the reference for all levels, in static problems in the plane; its "
             "averages are transferred to the cells of each level by the areas that these share. "
             "0: the mesh size of each level. [length]");
    keys.add("estimate", estimate,
             "Galerkin solutions whose error is estimated from outer quadrature, h/2, 2h and "
             "degree p+1: the reference, every solution, or none. The estimate can take ten to "
             "twenty times as long as the solution, especially on meshes: write none for first "
             "trials. automatic: the reference; every solution if there is neither a reference nor "
             "an exact solution.");
    keys.add("tolerance", tolerance, between(0, 1),
             "Largest permitted error estimate of the reference, relative to the solution; if it "
             "is exceeded the run ends with exit code 3. 0: the estimate is only reported.");
  }

  void QuadratureSection::declare(Keys &keys)
  {
    keys.add("entries", exact_entries, "quadrature", "exact",
             "Entries of Galerkin matrices on meshes. exact: to rounding where a formula is "
             "available (axis-aligned rectangles by correlation; triangles up to degree 2, "
             "parallelograms up to degree 1 and piecewise constants by integrals over pairs of "
             "sides, scalar kernels and bond tensors), else by quadrature, with the reason in the "
             "report. quadrature: all entries by quadrature.");
    keys.add(
        "tolerance", tolerance, between(0, 1),
        "Outer quadrature on meshes (in three dimensions for Q1 on hexahedra alone) is refined "
        "until the relative change of the solution is below this tolerance. 0: the first rule "
        "is used without an error estimate.");
    keys.add("max refinements", max_refinements, count(0, 8),
             "Maximum number of refinements; if they do not meet the tolerance the run ends with "
             "exit code 3.");
  }

  void GeometrySection::declare(Keys &keys)
  {
    keys.add("backend", backend,
             "Backend for intersections of balls and cells: fast (double precision) or cgal (exact "
             "circular kernel).");
    keys.add("checks", n_checks, count(0, 100000),
             "Number of cut cells of each reference that are recomputed with the exact backend, "
             "some 0.1 ms each.");
    keys.add("seed", seed, count(0), "Seed of the sample of checked cells.");
  }

  void SolverSection::declare(Keys &keys)
  {
    keys.add("operator", operator_backend,
             "Application of the operator: fft (Fourier transforms), direct (the shared stencil), "
             "sparse (a Trilinos matrix), or automatic (the faster of the first two).");
    keys.add("model", is_full_model, "smallest", "full",
             "smallest: the smallest model that the scene needs. full: a mesh and sparse matrices "
             "even if a lattice and a stencil suffice, and the dilatation even if lambda = mu; the "
             "results are the same, which verifies the smallest model.");
    keys.add("linear solver", linear_solver,
             "Solver of sparse systems, on meshes and scattered nodes: direct, or iterative with "
             "algebraic multigrid (amg) or Jacobi preconditioning.");
    keys.add("iteration", iteration,
             "Iterative method: automatic (cg if the operator is symmetric, else gmres), cg "
             "(conjugate gradients; refused if the operator is not symmetric), gmres or bicgstab "
             "(for sparse systems).");
    keys.add("dilatation", is_mixed, "condensed", "mixed",
             "Formulation of state-based solids on scattered nodes. condensed: u is the only "
             "unknown. mixed: the dilatation is an unknown besides u, which halves the memory; amg "
             "then preconditions the displacement block. Both give the same u.");
    keys.add("tolerance", tolerance, between(1e-15, 1e-3),
             "Relative residual of the linear system.");
    keys.add("max iterations", max_iterations, count(1), "Maximum number of iterations.");
  }

  void OutputSection::declare(Keys &keys)
  {
    keys.add(
        "fields", fields, yes_or_no(),
        "Write the solutions of the finest levels as VTK files (.vtu, in three dimensions .vti; in "
        "one dimension as a table of x and u, .csv); of 'sample' the modes of the random field "
        "(sample/modes.csv).");
    keys.add(
        "points", points, any_text(),
        "CSV file with columns x and y (x, y and z in three dimensions, x in one), or points "
        "themselves, '0.1, 0.2 : 0.3, 0.4': points in the domain at which "
        "'run' writes each static solution of Methods/names and of the reference, its error, its "
        "change from the level before and, for Galerkin methods, an estimate of its error "
        "(points/*.csv; no estimate with Reference/estimate = none). The path is relative to the "
        "scene file; empty: none.");
  }
} // namespace plumbline::scene
