#include "method/sparse_discretisation.h"

#include <utility>

namespace plumbline::method
{
  PartedRows part(algebra::CsrMatrix rows, std::size_t n_free)
  {
    algebra::CsrMatrix held;
    held.start.assign(1, 0);
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
        {
          held.column.push_back(rows.column[k] - static_cast<unsigned int>(n_free));
          held.value.push_back(rows.value[k]);
        }
      rows.start[row + 1] = end;
      held.start.push_back(held.column.size());
    }
    rows.column.resize(end);
    rows.value.resize(end);
    return {std::move(rows), std::move(held)};
  }

  void subtract_held(const algebra::CsrMatrix &held, const std::vector<double> &values,
                     Vector &load)
  {
    for (std::size_t i = 0; i < held.n_rows(); ++i)
      for (std::size_t k = held.start[i]; k < held.start[i + 1]; ++k)
        load[i] -= held.value[k] * values[held.column[k]];
  }

  SparseDiscretisation::SparseDiscretisation(const scene::SolverSection &solver,
                                             algebra::SparseOptions options,
                                             const base::Communicator &communicator)
      : options_(std::move(options)), communicator_(communicator)
  {
    options_.solver = solver.linear_solver;
    options_.iteration = solver.iteration;
  }

  void SparseDiscretisation::set_rows(PartedRows rows)
  {
    free_ = std::make_shared<const algebra::CsrMatrix>(std::move(rows.free));
    held_ = std::move(rows.held);
  }

  std::unique_ptr<algebra::LinearSystem> SparseDiscretisation::tangent() const
  {
    return std::make_unique<algebra::SparseSystem>(free_, options_, communicator_);
  }
} // namespace plumbline::method
