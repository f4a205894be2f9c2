#include "meshfree/lattice/nodal_field.h"
#include "meshfree/lattice/stencil.h"
#include "meshfree/rules/family_statistics.h"
#include "meshfree/solutions.h"
#include "study/lattice_solve.h"
#include "study/limit_proof.h"

#include <utility>

namespace plumbline::meshfree
{
  namespace
  {
    using algebra::Vector;
    using geometry::NodeSet;

    /// b at the nodes.
    Vector nodal_load(const scene::Problem &problem, const NodeSet &nodes)
    {
      Vector load(nodes.size());
      const geometry::Lattice &lattice = *problem.lattice;
      std::size_t block = 0;
      for (unsigned int c = 0; c < nodes.n_components; ++c, block += nodes.n_positions())
      {
        std::vector<double> smooth;
        if (problem.load.series)
        {
          const auto at_nodes = [&](unsigned int axis)
          {
            std::vector<double> rows;
            for (int i = 0; i < nodes.n[axis]; ++i)
            {
              const auto basis = problem.load.series->basis(
                  axis, lattice.origin()[axis] + lattice.h() * (i + nodes.axis[0].offset));
              rows.insert(rows.end(), basis.begin(), basis.end());
            }
            return rows;
          };
          smooth = problem.load.series->contract(c, at_nodes(0), at_nodes(1));
        }
        std::size_t position = 0;
        for (int j = 0; j < nodes.n[1]; ++j)
          for (int i = 0; i < nodes.n[0]; ++i, ++position)
            if (nodes.is_free[position] != 0)
            {
              const auto place = nodes.place(0, i, j);
              load[block + position] =
                  smooth.empty() ? problem.load.value(lattice.point(place[0], place[1]), c)
                                 : smooth[position];
            }
      }
      return load;
    }

    Bonds make_bonds(const Rule &rule, const scene::Scene &scene, const scene::Problem &problem)
    {
      return lattice_bonds(rule.recipe(problem.kernel), problem.kernel, problem.lattice->h(),
                           scene.geometry.backend);
    }

    algebra::Stencil make_stencil(const scene::Problem &problem, const Bonds &bonds)
    {
      return problem.dilatation ? state_based_stencil(*problem.dilatation, bonds)
                                : lattice_operator(problem.kernel, bonds);
    }
  } // namespace

  study::Solution lattice_solution(const Rule &rule, const scene::Scene &scene,
                                   const scene::Problem &problem)
  {
    const base::MemoryGauge memory;
    const base::CpuTimer timer;
    const geometry::Lattice &lattice = *problem.lattice;
    const NodeSet nodes = study::comparison_nodes(scene, lattice, problem.n_components);
    const Bonds bonds = make_bonds(rule, scene, problem);
    const auto stencil = make_stencil(problem, bonds);
    const double rule_seconds = timer.seconds();
    study::LatticeSolve solved = study::solve_on_lattice(
        scene, problem, nodes, stencil, [&] { return nodal_load(problem, nodes); });

    study::Solution solution;
    solution.cost = solved.cost;
    solution.cost.setup_seconds += rule_seconds;
    solution.cost.peak_bytes = memory.peak_bytes();
    solution.diagnostics = solved.diagnostics;
    solution.diagnostics.n_neighbours = 0;
    solution.diagnostics.limit = study::prove_by_moments(scene, problem, stencil, 1);
    describe_weights(bonds.family, bonds.fit, solution.diagnostics);
    solution.diagnostics.notes = bonds.notes;
    const auto field =
        std::make_shared<const NodalField>(NodalField{lattice, nodes, std::move(solved.values)});
    for (int j = 0; j < nodes.n[1]; ++j)
      for (int i = 0; i < nodes.n[0]; ++i)
        if (nodes.free(0, i, j))
        {
          const auto place = nodes.place(0, i, j);
          solution.nodes.push_back(lattice.point(place[0], place[1]));
          for (unsigned int c = 0; c < nodes.n_components; ++c)
            solution.nodal.push_back(field->at(c, i, j));
        }
    solution.averages = solution.nodal;
    solution.value = [field](const Point<2> &x, unsigned int c) { return field->value(x, c); };
    solution.write_vtu = [field](const std::string &file) { field->write_vtu(file); };
    return solution;
  }

  study::DiscreteOperator lattice_discrete(const Rule &rule, const scene::Scene &scene,
                                           const scene::Problem &problem)
  {
    const NodeSet nodes = study::comparison_nodes(scene, *problem.lattice, problem.n_components);
    const Bonds bonds = make_bonds(rule, scene, problem);
    auto result =
        study::show_on_lattice(*problem.lattice, nodes, make_stencil(problem, bonds), {1});
    describe_weights(bonds.family, bonds.fit, result.diagnostics);
    result.diagnostics.notes = bonds.notes;
    return result;
  }
} // namespace plumbline::meshfree
