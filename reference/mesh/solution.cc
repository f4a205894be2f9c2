#include "reference/mesh/solution.h"

#include "algebra/sparse_system.h"
#include "base/error.h"
#include "reference/geometry_check.h"
#include "reference/mesh/assembly.h"
#include "reference/mesh/dilatation.h"
#include "reference/mesh/weighted_volume.h"

#include <deal.II/base/parallel.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <sstream>

namespace plumbline::reference
{
  namespace
  {
    /// ∫ b φ over this rank's share of the cells of Ω, shape (n_free n_components).
    std::vector<double> load_vector(const scene::Problem &problem, const MeshSpace &space,
                                    const base::Team &team)
    {
      const CellShapes &shapes = space.shapes();
      const unsigned int n_points = std::min(7u, shapes.degree() + 4), nc = problem.n_components;
      dealii::Quadrature<2> gauss = dealii::QGauss<2>(n_points);
      if (shapes.n_vertices() == 3)
        gauss = dealii::QWitherdenVincentSimplex<2>(n_points);
      std::vector<double> phi(gauss.size() * shapes.size());
      for (unsigned int q = 0; q < gauss.size(); ++q)
        shapes.values(gauss.point(q), &phi[q * shapes.size()]);

      const auto [first, last] = team.share(space.mesh().cells.size());
      const std::size_t n_values = shapes.size() * nc;
      std::vector<double> of_cells((last - first) * n_values); // shape (n_cells, n_shapes, nc)
      const auto integrate = [&, first = first](std::size_t begin, std::size_t end)
      {
        const scene::Field b = problem.load; // a thread's own
        for (std::size_t cell = begin; cell < end; ++cell)
          for (unsigned int q = 0; q < gauss.size() && space.mesh().cells[cell].is_inside; ++q)
          {
            const Point<2> x = space.map(cell).point(gauss.point(q));
            const double weight = gauss.weight(q) * space.map(cell).determinant(gauss.point(q));
            for (unsigned int c = 0; c < nc; ++c)
            {
              const double value = weight * (b.series ? (*b.series)(x, c) : b.value(x, c));
              for (unsigned int a = 0; a < shapes.size(); ++a)
                of_cells[(cell - first) * n_values + a * nc + c] +=
                    value * phi[q * shapes.size() + a];
            }
          }
      };
      constexpr unsigned int grain = 256;
      dealii::parallel::apply_to_subranges(first, last, integrate, grain);

      std::vector<double> load(space.n_free() * nc);
      const double *from = of_cells.data();
      for (std::size_t cell = first; cell < last; ++cell)
        for (unsigned int a = 0; a < shapes.size(); ++a, from += nc)
          if (const unsigned int dof = space.dofs(cell)[a]; dof < space.n_free())
            for (unsigned int c = 0; c < nc; ++c)
              load[dof * nc + c] += from[c];
      return load;
    }

    /// Solution and volume constraint at all degrees of freedom.
    std::vector<double> constraint_values(const scene::Problem &problem, const MeshSpace &space)
    {
      std::vector<double> values(space.n_dofs() * problem.n_components);
      for (std::size_t dof = space.n_free(); dof < space.n_dofs(); ++dof)
        for (unsigned int c = 0; c < problem.n_components; ++c)
          values[dof * problem.n_components + c] = problem.constraint.value(space.support(dof), c);
      return values;
    }

    /// Keep the columns of the free unknowns; what the others do goes to the right-hand side.
    void eliminate(const std::vector<double> &data, std::size_t n_free, algebra::Rows &rows,
                   std::vector<double> &right_hand_side)
    {
      std::size_t end = 0, k = 0;
      for (std::size_t row = 0; row < rows.n_rows(); ++row)
      {
        for (; k < rows.start[row + 1]; ++k)
          if (rows.column[k] < n_free)
          {
            rows.column[end] = rows.column[k];
            rows.value[end++] = rows.value[k];
          }
          else
            right_hand_side[row] -= rows.value[k] * data[rows.column[k]];
        rows.start[row + 1] = end;
      }
      rows.column.resize(end);
      rows.value.resize(end);
    }

    /// The coefficient of the bonds. Where families end at a free boundary, the part of the ball
    /// that is left carries all of the shear modulus.
    std::optional<physics::Coefficient> bond_coefficient(const scene::Problem &problem)
    {
      if (!problem.body)
        return problem.coefficient;
      const auto influence =
          physics::influence_function(problem.kernel.profile(), problem.horizon());
      const auto volume = std::make_shared<const WeightedVolume>(*problem.mesh, influence);
      return physics::Coefficient([mu = *problem.coefficient, volume](const Point<2> &x)
                                  { return mu.at(x) * 2 / (*volume)(x); },
                                  "shear modulus", physics::Mean::arithmetic);
    }

    /// The matrix with an outer rule refined so many times.
    MeshMatrix assemble_all(const scene::Problem &problem, const MeshField &field,
                            const AssemblyOptions &options, const base::Team &team)
    {
      MeshMatrix matrix = assemble(*field.space, *field.cells, problem.kernel,
                                   bond_coefficient(problem), options, team);
      if (problem.dilatation)
      {
        const DilatationOptions dilatation{options.refinement, problem.body.has_value(),
                                           options.backend};
        matrix.rows = add(matrix.rows, assemble_dilatation(*field.space, *field.cells,
                                                           *problem.dilatation, dilatation, team));
        matrix.is_exact = false;
      }
      return matrix;
    }

    /// One solution with an outer rule refined so many times.
    void solve_once(const scene::Scene &scene, const scene::Problem &problem,
                    const AssemblyOptions &options, const base::Team &team, MeshSolution &solution,
                    bool &is_exact)
    {
      const MeshSpace &space = *solution.field.space;
      base::CpuTimer timer;
      MeshMatrix matrix;
      team.together([&] { matrix = assemble_all(problem, solution.field, options, team); });
      is_exact = !team.any(!matrix.is_exact);
      solution.cost.setup_seconds += timer.seconds();

      timer.restart();
      std::vector<double> right_hand_side;
      team.together([&] { right_hand_side = load_vector(problem, space, team); });
      const std::size_t n = space.n_free() * problem.n_components;
      eliminate(solution.field.values, n, matrix.rows, right_hand_side);
      algebra::SparseOptions solver;
      solver.solver = scene.solver.linear_solver;
      solver.iteration = scene.solver.iteration;
      solver.is_symmetric = !problem.dilatation || problem.dilatation->is_symmetric();
      solver.n_components = problem.n_components;
      for (std::size_t dof = 0; dof < space.n_free(); ++dof)
        solver.nodes.push_back(space.support(dof));
      solver.tolerance = scene.solver.tolerance;
      solver.max_iterations = scene.solver.max_iterations;
      const auto solved = algebra::solve_sparse(matrix.rows, right_hand_side, solver, team);
      std::copy(solved.values.begin(), solved.values.end(), solution.field.values.begin());
      solution.cost.solve_seconds += timer.seconds();
      solution.cost.n_unknowns = n;
      solution.cost.n_bonds = solved.n_nonzeros;
      solution.cost.n_iterations = solved.n_iterations;
      solution.diagnostics.n_neighbours =
          static_cast<unsigned int>(solved.n_nonzeros / std::max<std::size_t>(1, n));
      solution.diagnostics.relative_residual = solved.relative_residual;
      solution.diagnostics.operator_backend = "sparse, " + solved.solver;
    }

    /// The field of a problem that is still to be solved: 0, and the constraint.
    MeshField empty_field(const scene::Problem &problem, bool is_continuous, unsigned int degree)
    {
      const auto space = std::make_shared<const MeshSpace>(problem.mesh, is_continuous, degree);
      if (space->n_free() == 0)
        throw NumericalError("no degree of freedom is free: every cell of the domain touches the "
                             "collar; refine the mesh");
      return {space, std::make_shared<const MeshCells>(*problem.mesh), problem.n_components,
              constraint_values(problem, *space)};
    }

    /// The diagonal of the mass matrix, scaled to the area of each cell.
    std::vector<double> lumped_masses(const MeshSpace &space)
    {
      const CellShapes &shapes = space.shapes();
      dealii::Quadrature<2> gauss = dealii::QGauss<2>(shapes.degree() + 2);
      if (shapes.n_vertices() == 3)
        gauss = dealii::QWitherdenVincentSimplex<2>(std::min(7u, shapes.degree() + 2));
      std::vector<double> masses(space.n_dofs()), squares, phi(shapes.size());
      for (std::size_t cell = 0; cell < space.mesh().cells.size(); ++cell)
      {
        squares.assign(shapes.size(), 0);
        double area = 0, sum = 0;
        for (unsigned int q = 0; q < gauss.size(); ++q)
        {
          const double weight = gauss.weight(q) * space.map(cell).determinant(gauss.point(q));
          shapes.values(gauss.point(q), phi.data());
          area += weight;
          for (unsigned int a = 0; a < shapes.size(); ++a)
          {
            squares[a] += weight * phi[a] * phi[a];
            sum += weight * phi[a] * phi[a];
          }
        }
        for (unsigned int a = 0; a < shapes.size(); ++a)
          masses[space.dofs(cell)[a]] += area * squares[a] / sum;
      }
      masses.resize(space.n_free());
      return masses;
    }

    double relative_change(const MeshField &before, const MeshField &now)
    {
      MeshField difference = now;
      for (std::size_t i = 0; i < now.values.size(); ++i)
        difference.values[i] -= before.values[i];
      const double size = l2_norm(now);
      return size > 0 ? l2_norm(difference) / size : l2_norm(difference);
    }
  } // namespace

  MeshSolution solve_on_mesh(const scene::Scene &scene, const scene::Problem &problem,
                             bool is_continuous, unsigned int degree, const base::Team &team)
  {
    const base::MemoryGauge memory;
    const base::CpuTimer timer;
    MeshSolution solution{empty_field(problem, is_continuous, degree), {}, {}};
    solution.cost.setup_seconds = timer.seconds();

    AssemblyOptions options{0, scene.quadrature.exact_rectangles, scene.geometry.backend};
    bool is_exact = false;
    solve_once(scene, problem, options, team, solution, is_exact);
    double &change = solution.diagnostics.outer_change;
    bool is_settled = is_exact || scene.quadrature.tolerance == 0;
    while (!is_settled)
    {
      if (options.refinement == scene.quadrature.max_refinements)
      {
        std::ostringstream message;
        if (options.refinement == 0)
          message
              << "outer quadrature is not refined, so it is not known whether the solution changes "
                 "by";
        else
          message << "outer quadrature, refinement " << options.refinement
                  << ", still changes the solution by " << change << " relative to it,";
        message << " more than Quadrature/tolerance = " << scene.quadrature.tolerance
                << "; raise Quadrature/max refinements or the tolerance, or refine the mesh";
        throw NumericalError(message.str());
      }
      const MeshField before = solution.field;
      ++options.refinement;
      solve_once(scene, problem, options, team, solution, is_exact);
      change = relative_change(before, solution.field);
      is_settled = change <= scene.quadrature.tolerance;
    }
    solution.diagnostics.n_refinements = options.refinement;
    solution.diagnostics.is_outer_error_known = is_exact || scene.quadrature.tolerance > 0;
    if (is_exact)
      solution.diagnostics.notes.push_back(
          "entries of axis-aligned rectangles exact by correlation");
    else if (scene.quadrature.tolerance == 0)
      solution.diagnostics.notes.push_back("outer quadrature not refined: its error is not known");
    solution.cost.setup_seconds = team.sum(solution.cost.setup_seconds);
    solution.cost.solve_seconds = team.sum(solution.cost.solve_seconds);
    solution.cost.peak_bytes =
        static_cast<std::size_t>(team.largest(static_cast<double>(memory.peak_bytes())));
    const auto check = check_geometry(*solution.field.cells, problem.horizon(),
                                      scene.geometry.n_checks, scene.geometry.seed);
    solution.diagnostics.n_geometry_checks = check.n_checked;
    solution.diagnostics.geometry_difference = check.worst_difference;
    return solution;
  }

  double expected_mesh_bytes(const scene::Scene &scene, const study::ProblemSize &size,
                             unsigned int n_vertices, bool is_continuous, unsigned int degree)
  {
    // assembled upper half, both halves, what eliminates, the solver's copy; space and geometry of
    // a cell; all measured
    constexpr double of_entry = 44, of_cell = 1000;
    const double p = degree, n_components = scene.is_vector() ? 2 : 1;
    const bool is_shared = is_continuous && degree > 0;
    const double n_dofs = n_vertices == 4 ? (is_shared ? p * p : (p + 1) * (p + 1))
                                          : (is_shared ? p * p / 2 : (p + 1) * (p + 2) / 2);
    // the support of a shape function widens the ball: by one cell, or by those about its vertex
    const double wider = !is_shared ? .85 : degree == 1 ? 1.9 : 1.4;
    const double reach = scene.reach(size.level.horizon) / std::sqrt(size.cell_area) + wider;
    const double n_columns = M_PI * reach * reach * n_dofs * n_components;
    return size.n_free * n_dofs * n_components * n_columns * of_entry + size.n_cells * of_cell;
  }

  study::DiscreteOperator mesh_discrete(const scene::Scene &scene, const scene::Problem &problem,
                                        bool is_continuous, unsigned int degree)
  {
    const MeshField field = empty_field(problem, is_continuous, degree);
    study::DiscreteOperator result;
    result.n_components = problem.n_components;
    result.is_collocated = false;
    for (std::size_t dof = 0; dof < field.space->n_free(); ++dof)
      result.nodes.push_back(field.space->support(dof));
    result.mass = lumped_masses(*field.space);
    result.rows =
        assemble_all(problem, field, {0, scene.quadrature.exact_rectangles, scene.geometry.backend},
                     base::Team::alone())
            .rows;
    std::vector<double> ignored(result.size());
    eliminate(field.values, result.size(), result.rows, ignored);
    return result;
  }

  study::Solution as_solution(const scene::Problem &problem, MeshSolution solved)
  {
    const auto field = std::make_shared<const MeshField>(std::move(solved.field));
    study::Solution solution;
    solution.cost = solved.cost;
    solution.diagnostics = solved.diagnostics;
    for (std::size_t dof = 0; dof < field->space->n_free(); ++dof)
    {
      solution.nodes.push_back(field->space->support(dof));
      for (unsigned int c = 0; c < field->n_components; ++c)
        solution.nodal.push_back(field->values[dof * field->n_components + c]);
    }
    solution.averages = field->averages(*problem.cells);
    solution.value = [field](const Point<2> &x, unsigned int c) { return field->value(x, c); };
    solution.write_vtu = [field](const std::string &file) { write_vtu(*field, file); };
    return solution;
  }

  study::Solution mesh_solution(const scene::Scene &scene, const scene::Problem &problem,
                                bool is_continuous, unsigned int degree)
  {
    return as_solution(problem, solve_on_mesh(scene, problem, is_continuous, degree));
  }
} // namespace plumbline::reference
