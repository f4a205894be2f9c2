#include "method/sparse_discretisation.h"

#include <utility>

namespace plumbline::method
{
  PartitionedRows part(algebra::CsrMatrix rows, std::size_t n_free)
  {
    algebra::CsrMatrix constrained;
    constrained.start.assign(1, 0);
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
          constrained.column.push_back(rows.column[k] - static_cast<unsigned int>(n_free));
          constrained.value.push_back(rows.value[k]);
        }
      rows.start[row + 1] = end;
      constrained.start.push_back(constrained.column.size());
    }
    rows.column.resize(end);
    rows.value.resize(end);
    return {std::move(rows), std::move(constrained)};
  }

  algebra::CsrMatrix join(const algebra::CsrMatrix &free, const algebra::CsrMatrix &constrained)
  {
    const auto n_free = static_cast<unsigned int>(free.n_rows());
    algebra::CsrMatrix rows;
    rows.start.assign(1, 0);
    rows.column.reserve(free.column.size() + constrained.column.size());
    rows.value.reserve(rows.column.capacity());
    for (std::size_t row = 0; row < free.n_rows(); ++row)
    {
      for (std::size_t k = free.start[row]; k < free.start[row + 1]; ++k)
      {
        rows.column.push_back(free.column[k]);
        rows.value.push_back(free.value[k]);
      }
      for (std::size_t k = constrained.start[row]; k < constrained.start[row + 1]; ++k)
      {
        rows.column.push_back(n_free + constrained.column[k]);
        rows.value.push_back(constrained.value[k]);
      }
      rows.start.push_back(rows.column.size());
    }
    return rows;
  }

  void subtract_constrained(const algebra::CsrMatrix &constrained,
                            const std::vector<double> &values, Vector &load)
  {
    for (std::size_t i = 0; i < constrained.n_rows(); ++i)
      for (std::size_t k = constrained.start[i]; k < constrained.start[i + 1]; ++k)
        load[i] -= constrained.value[k] * values[constrained.column[k]];
  }

  SparseDiscretisation::SparseDiscretisation(const problem::SolverSettings &solver,
                                             algebra::SparseOptions options,
                                             const base::Communicator &communicator)
      : options_(std::move(options)), communicator_(communicator)
  {
    options_.solver = solver.linear_solver;
    options_.iteration = solver.iteration;
  }

  void SparseDiscretisation::set_rows(PartitionedRows rows)
  {
    free_ = std::make_shared<const algebra::CsrMatrix>(std::move(rows.free));
    constrained_ = std::make_shared<const algebra::CsrMatrix>(std::move(rows.constrained));
  }

  std::unique_ptr<algebra::LinearSystem> SparseDiscretisation::tangent() const
  {
    return std::make_unique<algebra::SparseSystem>(free_, options_, communicator_);
  }
} // namespace plumbline::method
