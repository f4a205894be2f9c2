#include "reference/mesh/mass.h"

#include <algorithm>
#include <map>

namespace plumbline::reference
{
  namespace
  {
    /// Exact for products of two shape functions on triangles and parallelograms.
    CellRules mass_rules(const MeshSpace &space, const MeshCells &cells)
    {
      return gauss_on_cells(space, cells, std::min(7u, space.shapes().degree() + 2));
    }
  } // namespace

  algebra::CsrMatrix mass_rows(const MeshSpace &space, const MeshCells &cells,
                               unsigned int n_components)
  {
    const unsigned int n = space.shapes().size();
    const CellRules rules = mass_rules(space, cells);
    CellRule rule;
    std::vector<std::map<unsigned int, double>> entries(space.n_free());
    for (std::size_t cell = 0; cell < cells.size(); ++cell)
    {
      if (!space.mesh().cells[cell].is_inside)
        continue;
      rules.find(cell, rule);
      for (std::size_t q = 0; q < rule.points.size(); ++q)
      {
        const double *const phi = &rule.phi[q * n];
        for (unsigned int a = 0; a < n; ++a)
          for (unsigned int b = 0; b < n && space.dofs(cell)[a] < space.n_free(); ++b)
            entries[space.dofs(cell)[a]][space.dofs(cell)[b]] += rule.weights[q] * phi[a] * phi[b];
      }
    }
    algebra::CsrMatrix rows;
    rows.start.assign(1, 0);
    for (const auto &row : entries)
      for (unsigned int c = 0; c < n_components; ++c)
      {
        for (const auto &[dof, value] : row)
        {
          rows.column.push_back(dof * n_components + c);
          rows.value.push_back(value);
        }
        rows.start.push_back(rows.column.size());
      }
    return rows;
  }

  std::vector<double> lumped_masses(const MeshSpace &space, const MeshCells &cells)
  {
    const unsigned int n = space.shapes().size();
    const CellRules rules = mass_rules(space, cells);
    CellRule rule;
    std::vector<double> masses(space.n_dofs()), squares;
    for (std::size_t cell = 0; cell < cells.size(); ++cell)
    {
      squares.assign(n, 0);
      double area = 0, sum = 0;
      rules.find(cell, rule);
      for (std::size_t q = 0; q < rule.points.size(); ++q)
      {
        const double *const phi = &rule.phi[q * n];
        area += rule.weights[q];
        for (unsigned int a = 0; a < n; ++a)
        {
          squares[a] += rule.weights[q] * phi[a] * phi[a];
          sum += rule.weights[q] * phi[a] * phi[a];
        }
      }
      for (unsigned int a = 0; a < n; ++a)
        masses[space.dofs(cell)[a]] += area * squares[a] / sum;
    }
    masses.resize(space.n_free());
    return masses;
  }
} // namespace plumbline::reference
