#include "reference/lattice/solution.h"

#include "reference/geometry_check.h"
#include "reference/lattice/dilatation.h"
#include "reference/lattice/stencil.h"
#include "study/lattice_solve.h"
#include "study/limit_proof.h"

#include <deal.II/base/quadrature_lib.h>

#include <cmath>
#include <utility>

namespace plumbline::reference
{
  namespace
  {
    using algebra::Vector;
    using geometry::NodeSet;
    using geometry::Point;

    /// ∫ T_k(x) φ_s,i(x) dx for all positions i along an axis: row-major, shape (n, n_terms).
    std::vector<double> test_basis(const physics::ChebyshevField &series, unsigned int axis,
                                   const geometry::Lattice &lattice, const AxisShapes &shapes,
                                   unsigned int family)
    {
      const unsigned int n_terms = series.n_terms();
      const int n = lattice.n_cells()[axis];
      const dealii::QGauss<1> gauss((n_terms + shapes.degree()) / 2 + 1);
      std::vector<double> rows(static_cast<std::size_t>(n) * n_terms);
      for (int cell = 0; cell < n; ++cell)
        for (unsigned int q = 0; q < gauss.size(); ++q)
        {
          const double x = gauss.point(q)[0];
          const auto basis = series.basis(axis, lattice.origin()[axis] + lattice.h() * (cell + x));
          for (const auto &part : shapes.restrictions(family))
          {
            const int i = cell - part.cell;
            if (i < 0 || i >= n)
              continue;
            const double weight = lattice.h() * gauss.weight(q) * shapes.value(part.local, x);
            for (unsigned int k = 0; k < n_terms; ++k)
              rows[static_cast<std::size_t>(i) * n_terms + k] += weight * basis[k];
          }
        }
      return rows;
    }

    /// ∫ b φ for a load that is not smooth: Gauss points on each cell.
    void test_by_cells(const scene::Problem &problem, const AxisShapes &shapes, unsigned int family,
                       unsigned int component, double *block)
    {
      const auto &n = problem.lattice->n_cells();
      const double h = problem.lattice->h();
      const dealii::QGauss<2> gauss(shapes.degree() + 4);
      const auto n_axis = static_cast<unsigned int>(shapes.families().size());
      for (int j = 0; j < n[1]; ++j)
        for (int i = 0; i < n[0]; ++i)
          if (problem.lattice->is_inside(i, j))
            for (unsigned int q = 0; q < gauss.size(); ++q)
            {
              const Point<2> x = gauss.point(q);
              const double value =
                  h * h * gauss.weight(q) *
                  problem.load.value(problem.lattice->point(i + x[0], j + x[1]), component);
              for (const auto &a : shapes.restrictions(family % n_axis))
                for (const auto &b : shapes.restrictions(family / n_axis))
                  if (i - a.cell >= 0 && i - a.cell < n[0] && j - b.cell >= 0 && j - b.cell < n[1])
                    block[static_cast<std::size_t>(j - b.cell) * n[0] + i - a.cell] +=
                        value * shapes.value(a.local, x[0]) * shapes.value(b.local, x[1]);
            }
    }

    Vector load_vector(const scene::Problem &problem, const AxisShapes &shapes,
                       const NodeSet &nodes)
    {
      Vector load(nodes.size());
      const auto n_axis = static_cast<unsigned int>(nodes.axis.size());
      std::size_t block = 0;
      for (unsigned int c = 0; c < nodes.n_components; ++c)
        for (unsigned int s = 0; s < nodes.n_families(); ++s, block += nodes.n_positions())
          if (problem.load.series)
          {
            const auto &series = *problem.load.series;
            const auto values =
                series.contract(c, test_basis(series, 0, *problem.lattice, shapes, s % n_axis),
                                test_basis(series, 1, *problem.lattice, shapes, s / n_axis));
            std::copy(values.begin(), values.end(), load.begin() + block);
          }
          else
            test_by_cells(problem, shapes, s, c, load.begin() + block);
      for (std::size_t i = 0; i < nodes.size(); ++i)
        if (nodes.is_free[i % nodes.is_free.size()] == 0)
          load[i] = 0;
      return load;
    }

    algebra::Stencil make_stencil(const scene::Scene &scene, const scene::Problem &problem,
                                  const AxisShapes &shapes)
    {
      const double h = problem.lattice->h();
      const algebra::Stencil bonds =
          galerkin_stencil(problem.kernel, h, shapes, scene.geometry.backend);
      if (!problem.dilatation)
        return bonds;
      const physics::Lame lame = problem.dilatation->material({});
      return add(bonds, dilatation_stencil(problem.dilatation->influence, lame.lambda - lame.mu, h,
                                           shapes));
    }

    /// Masses of the families along an axis, the cell's length being 1.
    std::vector<double> axis_masses(const AxisShapes &shapes)
    {
      const dealii::QGauss<1> gauss(shapes.degree() + 1);
      std::vector<double> squares(shapes.n_local());
      double sum = 0;
      for (unsigned int a = 0; a < shapes.n_local(); ++a)
        for (unsigned int q = 0; q < gauss.size(); ++q)
        {
          const double part = gauss.weight(q) * std::pow(shapes.value(a, gauss.point(q)[0]), 2);
          squares[a] += part;
          sum += part;
        }
      std::vector<double> masses(shapes.families().size());
      for (unsigned int s = 0; s < masses.size(); ++s)
        for (const auto &part : shapes.restrictions(s))
          masses[s] += squares[part.local] / sum;
      return masses;
    }
  } // namespace

  LatticeSolution solve_lattice(const scene::Scene &scene, const scene::Problem &problem,
                                const AxisShapes &shapes)
  {
    const base::MemoryGauge memory;
    const base::CpuTimer timer;
    const NodeSet nodes = free_nodes(*problem.lattice, shapes.families(), problem.n_components);
    const algebra::Stencil stencil = make_stencil(scene, problem, shapes);
    const double stencil_seconds = timer.seconds();
    study::LatticeSolve solved = study::solve_on_lattice(
        scene, problem, nodes, stencil, [&] { return load_vector(problem, shapes, nodes); });
    if (shapes.degree() == 0)
      solved.diagnostics.limit =
          study::prove_by_moments(scene, problem, stencil, problem.h * problem.h);
    LatticeField field(*problem.lattice, shapes, problem.n_components, std::move(solved.values));
    solved.cost.setup_seconds += stencil_seconds;
    solved.cost.peak_bytes = memory.peak_bytes();
    return {std::move(field), nodes, solved.cost, solved.diagnostics};
  }

  study::Solution lattice_solution(const scene::Scene &scene, const scene::Problem &problem,
                                   const AxisShapes &shapes)
  {
    auto result = std::make_shared<const LatticeSolution>(solve_lattice(scene, problem, shapes));
    const LatticeField &field = result->field;
    const NodeSet &nodes = result->nodes;

    study::Solution solution;
    solution.cost = result->cost;
    solution.diagnostics = result->diagnostics;
    const auto check = check_geometry(problem.horizon(), problem.lattice->h(),
                                      scene.geometry.n_checks, scene.geometry.seed);
    solution.diagnostics.n_geometry_checks = check.n_checked;
    solution.diagnostics.geometry_difference = check.worst_difference;

    for (unsigned int s = 0; s < nodes.n_families(); ++s)
      for (int j = 0; j < nodes.n[1]; ++j)
        for (int i = 0; i < nodes.n[0]; ++i)
          if (nodes.free(s, i, j))
          {
            const Point<2> place = nodes.place(s, i, j);
            solution.nodes.push_back(problem.lattice->point(place[0], place[1]));
            const auto local = [&](unsigned int family)
            { return field.shapes().is_continuous() && family == 0 ? 0 : family; };
            const auto n_axis = static_cast<unsigned int>(nodes.axis.size());
            for (unsigned int c = 0; c < nodes.n_components; ++c)
              solution.nodal.push_back(field.local(c, i, j, local(s % n_axis), local(s / n_axis)));
          }
    solution.averages =
        field.averages(study::comparison_nodes(scene, *problem.lattice, problem.n_components));
    solution.value = [result](const Point<2> &x, unsigned int c)
    { return result->field.value(x, c); };
    solution.write_vtu = [result](const std::string &file) { write_vtu(result->field, file); };
    return solution;
  }

  study::DiscreteOperator lattice_discrete(const scene::Scene &scene, const scene::Problem &problem,
                                           const AxisShapes &shapes)
  {
    const geometry::Lattice &lattice = *problem.lattice;
    std::vector<double> mass;
    const auto masses = axis_masses(shapes);
    for (const double b : masses)
      for (const double a : masses)
        mass.push_back(a * b * lattice.h() * lattice.h());
    auto result = study::show_on_lattice(
        lattice, free_nodes(lattice, shapes.families(), problem.n_components),
        make_stencil(scene, problem, shapes), mass);
    result.is_collocated = false;
    return result;
  }
} // namespace plumbline::reference
