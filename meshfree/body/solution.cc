#include "base/error.h"
#include "meshfree/body/operator.h"
#include "meshfree/rules/family_statistics.h"
#include "meshfree/scattered/field.h"
#include "meshfree/solutions.h"

#include <sstream>

namespace plumbline::meshfree
{
  namespace
  {
    VariationalBody make_body(const scene::Scene &scene, const scene::Problem &problem)
    {
      const auto lame = scene.material.lame();
      return body_of_cells(*problem.body, *problem.cells,
                           {[lame](const Point<2> &x) { return lame(x).lambda + lame(x).mu; },
                            [lame](const Point<2> &x) { return 8 * lame(x).mu; }});
    }

    VariationalOperator make_operator(const VariationalBody &body, const Bonds &bonds,
                                      const scene::Scene &scene, const scene::Problem &problem)
    {
      return {body, physics::influence_function(scene.kernel.profile, problem.horizon()), bonds,
              scene.solver.operator_backend};
    }

    /// ∫ b over the free cells: on each quarter by a rule of degree 5, so that loads may jump at
    /// nodes.
    algebra::Vector cell_integrals(const VariationalBody &body, const scene::Problem &problem)
    {
      constexpr unsigned int degree = 5;
      const geometry::NodeCells &cells = *problem.cells;
      algebra::Vector result(2 * body.size());
      for (std::size_t cell = 0; cell < cells.n_free; ++cell)
        for (std::size_t piece = cells.first_piece[cell]; piece < cells.first_piece[cell + 1];
             ++piece)
          for (unsigned int quarter = 0; quarter < 4; ++quarter)
          {
            const Point<2> &x = cells.nodes[cell];
            const auto square = geometry::square(
                {x[0] - (quarter % 2) * body.h, x[1] - (quarter / 2) * body.h}, body.h);
            const geometry::Polygon part =
                geometry::overlap(geometry::view(cells.pieces[piece]), geometry::view(square));
            const auto rule = geometry::polygon_rule(geometry::view(part), degree);
            for (std::size_t q = 0; q < rule.points.size(); ++q)
              for (unsigned int c = 0; c < 2; ++c)
                result[c * body.size() + cells.source[cell]] +=
                    rule.weights[q] * problem.load.value(rule.points[q], c);
          }
      return result;
    }

    void check_constraint(const VariationalBody &body, const scene::Problem &problem)
    {
      for (std::size_t i = 0; i < body.size(); ++i)
        for (unsigned int c = 0; c < 2 && body.is_fixed[i] != 0; ++c)
          if (const double value = problem.constraint.value(body.node(i), c); value != 0)
          {
            std::ostringstream message;
            message << "Problem/constraint is " << value << " at (" << body.node(i)
                    << "), but rules on free bodies hold the fixed part at 0; write 0, 0";
            throw InputError(message.str());
          }
    }
  } // namespace

  study::Solution body_solution(const Rule &rule, const scene::Scene &scene,
                                const scene::Problem &problem)
  {
    const base::MemoryGauge memory;
    base::CpuTimer timer;
    const VariationalBody body = make_body(scene, problem);
    check_constraint(body, problem);
    const Bonds bonds =
        lattice_bonds(rule.recipe(problem.kernel), problem.kernel, body.h, scene.geometry.backend);
    const VariationalOperator matrix = make_operator(body, bonds, scene, problem);
    study::Solution solution;
    solution.cost.setup_seconds = timer.seconds();

    timer.restart();
    const algebra::Vector load =
        scene.methods.loads_are_averages
            ? cell_integrals(body, problem)
            : nodal_load(body, [&](const Point<2> &x)
                         { return Point<2>(problem.load.value(x, 0), problem.load.value(x, 1)); });
    algebra::Vector u(load.size());
    const auto solved = solve(matrix, u, load, scene.solver.tolerance, scene.solver.max_iterations);
    solution.cost.solve_seconds = timer.seconds();
    solution.cost.peak_bytes = memory.peak_bytes();
    solution.cost.n_unknowns = 2 * problem.cells->n_free;
    solution.cost.n_bonds = matrix.n_bonds();
    solution.cost.n_iterations = solved.n_iterations;
    solution.diagnostics.relative_residual = solved.relative_residual;
    solution.diagnostics.operator_backend = matrix.backend();
    describe_weights(bonds.family, bonds.fit, solution.diagnostics);
    solution.diagnostics.notes = bonds.notes;

    const geometry::NodeCells &cells = *problem.cells; // numbered as the lattice
    for (std::size_t i = 0; i < cells.n_free; ++i)
    {
      solution.nodes.push_back(cells.nodes[i]);
      for (unsigned int c = 0; c < 2; ++c)
        solution.nodal.push_back(u[c * body.size() + cells.source[i]]);
    }
    solution.averages = solution.nodal;
    const auto field = std::make_shared<const ScatteredField>(problem.cells, solution.nodal, 2);
    solution.value = [field](const Point<2> &x, unsigned int c) { return field->value(x, c); };
    solution.write_vtu = [field](const std::string &file) { field->write_vtu(file); };
    return solution;
  }

  study::DiscreteOperator body_discrete(const Rule &rule, const scene::Scene &scene,
                                        const scene::Problem &problem)
  {
    const VariationalBody body = make_body(scene, problem);
    const Bonds bonds =
        lattice_bonds(rule.recipe(problem.kernel), problem.kernel, body.h, scene.geometry.backend);
    auto result = show(
        std::make_shared<const VariationalOperator>(make_operator(body, bonds, scene, problem)));
    describe_weights(bonds.family, bonds.fit, result.diagnostics);
    result.diagnostics.notes = bonds.notes;
    return result;
  }

  study::DiscreteOperator show(std::shared_ptr<const VariationalOperator> matrix)
  {
    const VariationalBody &body = matrix->body();
    study::DiscreteOperator result;
    result.n_components = 2;
    result.is_collocated = false;
    std::vector<std::size_t> positions;
    for (std::size_t i = 0; i < body.size(); ++i)
      if (body.V[i] > 0 && body.is_fixed[i] == 0)
      {
        result.nodes.push_back(body.node(i));
        result.mass.push_back(body.V[i]);
        positions.push_back(i);
        positions.push_back(body.size() + i);
      }
    const std::size_t n = 2 * body.size();
    result.action = algebra::restrict(std::move(matrix), n, positions);
    return result;
  }
} // namespace plumbline::meshfree
