#include "reference/tetrahedra/bond_factors.h"

#include <vector>

namespace plumbline::reference
{
  void set_factors_of_cells(const BondFactors &factors, const TetrahedralSpace &space,
                            unsigned int n_components, algebra::CsrMatrix &rows)
  {
    std::vector<std::size_t> cell_of(space.n_dofs());
    for (std::size_t cell = 0; cell < space.mesh().cells.size(); ++cell)
      cell_of[space.dof(cell, 0)] = cell;
    std::vector<double> sum(n_components);
    for (std::size_t row = 0; row < rows.n_rows(); ++row)
    {
      const std::size_t own = row / n_components;
      sum.assign(n_components, 0);
      const auto for_each_entry = [&](const auto &action)
      {
        for (std::size_t k = rows.start[row]; k < rows.start[row + 1]; ++k)
          action(rows.column[k] / n_components, rows.column[k] % n_components, rows.value[k]);
      };
      for_each_entry(
          [&](std::size_t other, unsigned int component, double &value)
          {
            if (other == own)
              return;
            value *= factors.between(cell_of[own], cell_of[other]);
            sum[component] += value;
          });
      for_each_entry(
          [&](std::size_t other, unsigned int component, double &value)
          {
            if (other == own)
              value = -sum[component];
          });
    }
  }
} // namespace plumbline::reference
