#include "algebra/sparse_system.h"
#include "meshfree/roads.h"
#include "meshfree/scattered_field.h"
#include "meshfree/scattered_operator.h"
#include "meshfree/state_based_operator.h"

namespace plumbline::meshfree
{
  study::Solution scattered_solution(
      const std::function<ScatteredOperator(std::pair<std::size_t, std::size_t> share)> &make,
      const scene::Scene &scene, const scene::Problem &problem)
  {
    const base::MemoryGauge memory;
    base::CpuTimer timer;
    const base::Team team = base::Team::all();
    const geometry::NodeCells &cells = *problem.cells;
    const auto share = team.share(cells.n_free);
    ScatteredOperator matrix;
    team.together([&] { matrix = make(share); });
    study::Solution solution;
    solution.diagnostics = matrix.statistics.diagnostics(team);
    solution.cost.setup_seconds = team.sum(timer.seconds());

    timer.restart();
    team.together(
        [&]
        {
          const auto &load = problem.load;
          for (std::size_t i = share.first; i < share.second; ++i)
            for (unsigned int c = 0; c < problem.n_components; ++c)
              matrix.right_hand_side[i * problem.n_components + c] +=
                  load.series ? (*load.series)(cells.nodes[i], c) : load.value(cells.nodes[i], c);
        });
    algebra::SparseOptions options;
    options.is_symmetric = false;
    options.solver = algebra::sparse_solver_from_name(scene.linear_solver);
    options.n_components = problem.n_components;
    options.tolerance = scene.tolerance;
    options.max_iterations = scene.max_iterations;
    const auto solved = algebra::solve_sparse(matrix.rows, matrix.right_hand_side, options, team);
    solution.cost.solve_seconds = team.sum(timer.seconds());
    solution.cost.peak_bytes =
        static_cast<std::size_t>(team.largest(static_cast<double>(memory.peak_bytes())));
    solution.cost.n_unknowns = solved.values.size();
    solution.cost.n_bonds = solved.n_nonzeros;
    solution.cost.n_iterations = solved.n_iterations;
    solution.diagnostics.relative_residual = solved.relative_residual;
    solution.diagnostics.operator_road = "sparse, " + solved.solver;

    const auto end = cells.nodes.begin() + static_cast<std::ptrdiff_t>(cells.n_free);
    solution.nodes.assign(cells.nodes.begin(), end);
    solution.nodal = solved.values;
    solution.averages = cell_averages(cells, solved.values, problem.n_components);
    const auto field =
        std::make_shared<const ScatteredField>(problem.cells, solved.values, problem.n_components);
    solution.value = [field](const Point<2> &x, unsigned int c) { return field->value(x, c); };
    solution.write_vtu = [field](const std::string &file) { field->write_vtu(file); };
    return solution;
  }

  namespace
  {
    Damage damage(const scene::Scene &scene, const scene::Problem &problem)
    {
      Damage result{scene.cracks, {}};
      if (!scene.outside.empty())
      {
        const physics::Expression outside("Domain/outside", scene.outside,
                                          {{"delta", problem.horizon()}});
        for (const Point<2> &x : problem.cells->nodes)
          result.is_ghost.push_back(static_cast<char>(outside(x) > 0));
      }
      return result;
    }
  } // namespace

  study::Solution scattered_road(const Rule &rule, const scene::Scene &scene,
                                 const scene::Problem &problem)
  {
    return scattered_solution(
        [&](std::pair<std::size_t, std::size_t> share)
        {
          const Families families(rule.recipe(problem.kernel), problem.kernel, *problem.cells,
                                  scene.backend);
          if (!problem.dilatation)
            return scattered_operator(families, problem, share);
          return state_based_operator([&](std::size_t node, Family &family)
                                      { families.make(node, family); },
                                      {problem.cells.get(), *problem.dilatation,
                                       problem.constraint.value, damage(scene, problem)},
                                      share);
        },
        scene, problem);
  }
} // namespace plumbline::meshfree
