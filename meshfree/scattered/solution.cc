#include "algebra/sparse_system.h"
#include "meshfree/scattered/field.h"
#include "meshfree/scattered/operator.h"
#include "meshfree/scattered/state_based_operator.h"
#include "meshfree/solutions.h"
#include "scene/damage.h"
#include "study/lattice_solve.h"

#include <cmath>

namespace plumbline::meshfree
{
  namespace
  {
    using MakeOperator =
        std::function<ScatteredOperator(std::pair<std::size_t, std::size_t> share)>;

    algebra::SparseOptions solver_options(const scene::Scene &scene, const scene::Problem &problem)
    {
      algebra::SparseOptions options;
      options.is_symmetric = false;
      options.tolerance = scene.solver.tolerance;
      options.max_iterations = scene.solver.max_iterations;
      options.iteration = scene.solver.iteration;
      options.solver = scene.solver.linear_solver;
      options.n_components = problem.n_components;
      if (scene.solver.is_mixed)
        options.n_first = problem.n_components * problem.cells->n_free;
      const auto &nodes = problem.cells->nodes;
      options.nodes.assign(nodes.begin(),
                           nodes.begin() + static_cast<std::ptrdiff_t>(problem.cells->n_free));
      return options;
    }
  } // namespace

  study::Solution scattered_solution(const MakeOperator &make, const scene::Scene &scene,
                                     const scene::Problem &problem)
  {
    const base::MemoryGauge memory;
    base::CpuTimer timer;
    const base::Team team = base::Team::all();
    const geometry::NodeCells &cells = *problem.cells;
    const auto share = team.share(cells.n_free);
    ScatteredOperator matrix;
    team.together([&] { matrix = make(share); });
    const auto n =
        static_cast<std::size_t>(team.largest(static_cast<double>(matrix.right_hand_side.size())));
    matrix.right_hand_side.resize(n); // of ranks that gave nothing
    matrix.rows.start.resize(n + 1);
    study::Solution solution;
    solution.diagnostics = matrix.statistics.diagnostics(team);
    if (scene.study.regime != scene::Regime::delta || scene.domain.is_damaged() ||
        !scene.is_homogeneous())
      solution.diagnostics.limit = {}; // the moments of whole families decide nothing there
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
    const auto solved = algebra::solve_sparse(matrix.rows, matrix.right_hand_side,
                                              solver_options(scene, problem), team);
    solution.cost.solve_seconds = team.sum(timer.seconds());
    solution.cost.peak_bytes =
        static_cast<std::size_t>(team.largest(static_cast<double>(memory.peak_bytes())));
    solution.cost.n_unknowns = solved.values.size();
    solution.cost.n_bonds = solved.n_nonzeros;
    solution.cost.n_iterations = solved.n_iterations;
    solution.diagnostics.relative_residual = solved.relative_residual;
    solution.diagnostics.operator_backend = "sparse, " + solved.solver;

    const auto end = cells.nodes.begin() + static_cast<std::ptrdiff_t>(cells.n_free);
    solution.nodes.assign(cells.nodes.begin(), end);
    solution.nodal.assign(solved.values.begin(), // dilatations come after
                          solved.values.begin() +
                              static_cast<std::ptrdiff_t>(problem.n_components * cells.n_free));
    solution.averages = cell_averages(cells, solution.nodal, problem.n_components);
    const auto field =
        std::make_shared<const ScatteredField>(problem.cells, solution.nodal, problem.n_components);
    solution.value = [field](const Point<2> &x, unsigned int c) { return field->value(x, c); };
    solution.write_vtu = [field](const std::string &file) { field->write_vtu(file); };
    return solution;
  }

  namespace
  {
    /// @param keeps_dilatation  all of the system on the first rank, nothing on the others
    ScatteredOperator make_operator(const Rule &rule, const scene::Scene &scene,
                                    const scene::Problem &problem,
                                    std::pair<std::size_t, std::size_t> share,
                                    bool keeps_dilatation)
    {
      const Families families(rule.recipe(problem.kernel), problem.kernel, *problem.cells,
                              scene.geometry.backend);
      if (!problem.dilatation)
        return scattered_operator(families, problem, share);
      const auto make = [&](std::size_t node, Family &family) { families.make(node, family); };
      const StateBasedBody body{
          problem.cells.get(),
          *problem.dilatation,
          problem.constraint.value,
          {scene.domain.cracks, find_ghosts(scene, problem.horizon(), *problem.cells)},
          scene.material.has_collar_dilatation};
      if (!keeps_dilatation)
        return state_based_operator(make, body, share);
      const bool is_first = base::Team::all().rank() == 0;
      return is_first ? state_based_system(make, body) : ScatteredOperator();
    }
  } // namespace

  study::Solution scattered_solution(const Rule &rule, const scene::Scene &scene,
                                     const scene::Problem &problem)
  {
    return scattered_solution(
        [&](std::pair<std::size_t, std::size_t> share)
        { return make_operator(rule, scene, problem, share, scene.solver.is_mixed); },
        scene, problem);
  }

  study::DiscreteOperator scattered_discrete(const Rule &rule, const scene::Scene &scene,
                                             const scene::Problem &problem)
  {
    const geometry::NodeCells &cells = *problem.cells;
    const auto n = static_cast<std::ptrdiff_t>(cells.n_free);
    ScatteredOperator matrix = make_operator(rule, scene, problem, {0, cells.n_free}, false);
    study::DiscreteOperator result;
    result.n_components = problem.n_components;
    result.nodes.assign(cells.nodes.begin(), cells.nodes.begin() + n);
    result.mass.assign(cells.area.begin(), cells.area.begin() + n);
    result.diagnostics = matrix.statistics.diagnostics(base::Team::alone());
    result.rows = std::move(matrix.rows);
    for (std::size_t i = 0; i < result.rows.n_rows(); ++i)
      for (std::size_t k = result.rows.start[i]; k < result.rows.start[i + 1]; ++k)
        result.rows.value[k] *= result.mass[i / result.n_components];
    return result;
  }

  double expected_bytes(const scene::Scene &scene, const study::ProblemSize &size)
  {
    const double n_components = scene.is_vector() ? 2 : 1;
    const scene::Level &level = size.level;
    if (size.is_lattice())
      return study::expected_lattice_bytes(size, 1, scene.is_vector() ? 2 : 1,
                                           scene.reach(level.horizon) / level.h + 1);
    if (scene.domain.is_free_body) // two sums more by transforms than on a lattice
    {
      study::ProblemSize box = size;
      box.extents.fill(std::sqrt(size.n_cells * size.cell_area) / level.h);
      return 2 * study::expected_lattice_bytes(box, 1, 2, 2 * level.horizon / level.h + 1);
    }
    // rows that grow as vectors do, Trilinos' copy and a preconditioner; measured
    constexpr double of_entry = 40, of_node = 1000;
    const double m = scene.reach(level.horizon) / std::sqrt(size.cell_area) + .75;
    return size.n_free * (M_PI * m * m * n_components * n_components * of_entry + of_node);
  }
} // namespace plumbline::meshfree
