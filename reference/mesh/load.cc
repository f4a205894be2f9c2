#include "reference/mesh/load.h"

#include "geometry/rough_rule.h"
#include "reference/mesh/cell_rules.h"

#include <deal.II/base/parallel.h>

#include <algorithm>

namespace plumbline::reference
{
  namespace
  {
    /// A rule for each component of a load that is not smooth, on the cells of a mesh.
    std::vector<geometry::RoughRule> rough_rules(const problem::Problem<2> &problem,
                                                 const geometry::Mesh &mesh, unsigned int degree)
    {
      std::vector<std::size_t> inside;
      for (std::size_t i = 0; i < mesh.cells.size(); ++i)
        if (mesh.cells[i].is_inside)
          inside.push_back(i);
      std::vector<geometry::RoughRule> rules;
      for (unsigned int c = 0; c < problem.n_components; ++c)
        rules.emplace_back(
            degree, inside.size(), [&](std::size_t i) { return mesh.polygon(inside[i]); },
            [&](const Point<2> &x) { return problem.load(x, c); });
      return rules;
    }

    /// += ∫ f φ_a over a cell, n_apart from each other.
    void test_rough(const MeshSpace &space, const MeshCells &cells, std::size_t cell,
                    const geometry::RoughRule &rule, const geometry::RoughRule::Value &f,
                    unsigned int n_apart, double *values)
    {
      const unsigned int n = space.shapes().size();
      double phi[CellShapes::most];
      geometry::RoughRule::Sampled sampled;
      for (std::size_t part = cells.first_part(cell); part < cells.end_of_parts(cell); ++part)
      {
        const auto vertices = cells.part(part).vertices();
        rule.sample({vertices.begin(), vertices.end()}, f, sampled);
        for (std::size_t q = 0; q < sampled.values.size(); ++q)
        {
          space.values(cell, space.map(cell).unit(sampled.rule.points[q]), phi);
          for (unsigned int a = 0; a < n; ++a)
            values[a * n_apart] += sampled.rule.weights[q] * sampled.values[q] * phi[a];
        }
      }
    }
  } // namespace

  algebra::Vector load_vector(const problem::Problem<2> &problem, const MeshSpace &space,
                              const MeshCells &cells, const base::Communicator &communicator)
  {
    const CellShapes &shapes = space.shapes();
    const unsigned int n_points = std::min(7u, shapes.degree() + 4), nc = problem.n_components;
    const CellRules rules = gauss_on_cells(space, cells, n_points);
    const bool is_rough = !problem.load.is_smooth();
    const std::vector<geometry::RoughRule> rough = // of components
        is_rough ? rough_rules(problem, space.mesh(), 2 * n_points - 1)
                 : std::vector<geometry::RoughRule>();

    const auto [first, last] = communicator.owned_range(space.mesh().cells.size());
    const std::size_t n_values = shapes.size() * nc;
    std::vector<double> of_cells((last - first) * n_values); // shape (n_cells, n_shapes, nc)
    const auto integrate = [&, first = first](std::size_t begin, std::size_t end)
    {
      const problem::Field<2> b = problem.load; // a thread's own
      CellRule rule;
      for (std::size_t cell = begin; cell < end; ++cell)
      {
        if (!space.mesh().cells[cell].is_inside)
          continue;
        double *const values = &of_cells[(cell - first) * n_values];
        if (is_rough)
        {
          for (unsigned int c = 0; c < nc; ++c)
            test_rough(
                space, cells, cell, rough[c], [&](const Point<2> &x) { return b(x, c); }, nc,
                values + c);
          continue;
        }
        rules.find(cell, rule);
        for (std::size_t q = 0; q < rule.points.size(); ++q)
          for (unsigned int c = 0; c < nc; ++c)
          {
            const double value = rule.weights[q] * b(rule.points[q], c);
            for (unsigned int a = 0; a < shapes.size(); ++a)
              values[a * nc + c] += value * rule.phi[q * shapes.size() + a];
          }
      }
    };
    constexpr unsigned int grain = 256;
    dealii::parallel::apply_to_subranges(first, last, integrate, grain);

    algebra::Vector load(space.n_free() * nc);
    const double *from = of_cells.data();
    for (std::size_t cell = first; cell < last; ++cell)
      for (unsigned int a = 0; a < shapes.size(); ++a, from += nc)
        if (const unsigned int dof = space.dofs(cell)[a]; dof < space.n_free())
          for (unsigned int c = 0; c < nc; ++c)
            load[dof * nc + c] += from[c];
    return load;
  }
} // namespace plumbline::reference
