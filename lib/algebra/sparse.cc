#include "algebra/sparse.h"

#include "base/error.h"

#include <deal.II/lac/trilinos_solver.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>
#include <deal.II/lac/trilinos_vector.h>

#include <algorithm>
#include <optional>

namespace plumbline::algebra
{
  namespace
  {
    constexpr auto not_free = dealii::numbers::invalid_size_type;
  }

  struct SparseOperator::Matrix
  {
    std::vector<dealii::types::global_dof_index> number; ///< of each vector position, or not_free
    std::optional<dealii::TrilinosWrappers::SparseMatrix> entries;
    mutable dealii::TrilinosWrappers::MPI::Vector in, out;

    void gather(const Vector &values, dealii::TrilinosWrappers::MPI::Vector &unknowns) const
    {
      for (std::size_t i = 0; i < number.size(); ++i)
        if (number[i] != not_free)
          unknowns(number[i]) = values[i];
      unknowns.compress(dealii::VectorOperation::insert);
    }
    void scatter(const dealii::TrilinosWrappers::MPI::Vector &unknowns, Vector &values) const
    {
      const double *const from = unknowns.begin();
      for (std::size_t i = 0; i < number.size(); ++i)
        values[i] = number[i] == not_free ? 0 : from[number[i]];
    }
  };

  std::vector<std::size_t> free_positions(const geometry::NodeSet &nodes)
  {
    std::vector<std::size_t> positions;
    for (std::size_t k = 0; k < nodes.is_free.size(); ++k)
      for (unsigned int c = 0; c < nodes.n_components && nodes.is_free[k] != 0; ++c)
        positions.push_back(c * nodes.is_free.size() + k);
    return positions;
  }

  CsrMatrix assemble(const Stencil &stencil, const geometry::NodeSet &nodes)
  {
    const auto positions = free_positions(nodes);
    const std::size_t n_positions = nodes.n_positions();
    std::vector<std::size_t> number(nodes.size(), not_free);
    for (std::size_t i = 0; i < positions.size(); ++i)
      number[positions[i]] = i;

    CsrMatrix rows;
    rows.start.assign(1, 0);
    std::vector<std::pair<std::size_t, double>> row;
    for (const std::size_t position : positions)
    {
      const auto s = static_cast<unsigned int>(position / n_positions);
      const int i = static_cast<int>(position % n_positions % nodes.n[0]),
                j = static_cast<int>(position % n_positions / nodes.n[0]);
      row.clear();
      for (unsigned int t = 0; t < nodes.n_blocks(); ++t)
        for (int k2 = std::max(-stencil.reach(), -j);
             k2 <= std::min(stencil.reach(), nodes.n[1] - 1 - j); ++k2)
          for (int k1 = std::max(-stencil.reach(), -i);
               k1 <= std::min(stencil.reach(), nodes.n[0] - 1 - i); ++k1)
          {
            const double a = stencil(s, t, k1, k2);
            const auto column =
                number[t * n_positions + static_cast<std::size_t>(j + k2) * nodes.n[0] + i + k1];
            if (a != 0 && column != not_free)
              row.emplace_back(column, a);
          }
      std::sort(row.begin(), row.end());
      for (const auto &[column, a] : row)
      {
        rows.column.push_back(static_cast<unsigned int>(column));
        rows.value.push_back(a);
      }
      rows.start.push_back(rows.column.size());
    }
    return rows;
  }

  SparseOperator::SparseOperator(const Stencil &stencil, const geometry::NodeSet &nodes)
      : matrix_(std::make_unique<Matrix>())
  {
    matrix_->number.assign(nodes.size(), not_free);
    const auto positions = free_positions(nodes);
    for (std::size_t i = 0; i < positions.size(); ++i)
      matrix_->number[positions[i]] = i;

    const CsrMatrix rows = assemble(stencil, nodes);
    unsigned int most_entries = 1;
    for (std::size_t i = 0; i < rows.n_rows(); ++i)
      most_entries =
          std::max(most_entries, static_cast<unsigned int>(rows.start[i + 1] - rows.start[i]));
    const MPI_Comm self = MPI_COMM_SELF;
    const dealii::IndexSet all = dealii::complete_index_set(positions.size());
    matrix_->entries.emplace(all, self, most_entries);
    matrix_->in.reinit(all, self);
    matrix_->out.reinit(all, self);
    std::vector<dealii::types::global_dof_index> columns;
    for (std::size_t i = 0; i < rows.n_rows(); ++i)
    {
      const std::size_t first = rows.start[i], last = rows.start[i + 1];
      columns.assign(rows.column.begin() + static_cast<std::ptrdiff_t>(first),
                     rows.column.begin() + static_cast<std::ptrdiff_t>(last));
      matrix_->entries->set(i, static_cast<dealii::types::global_dof_index>(last - first),
                            columns.data(), &rows.value[first]);
    }
    matrix_->entries->compress(dealii::VectorOperation::insert);
  }

  SparseOperator::~SparseOperator() = default;

  void SparseOperator::vmult(Vector &result, const Vector &input) const
  {
    matrix_->gather(input, matrix_->in);
    matrix_->entries->vmult(matrix_->out, matrix_->in);
    matrix_->scatter(matrix_->out, result);
  }

  std::uint64_t SparseOperator::n_bonds() const
  {
    return matrix_->entries->n_nonzero_elements();
  }

  void SparseOperator::solve_directly(Vector &solution, const Vector &right_hand_side) const
  {
    dealii::SolverControl control;
    dealii::TrilinosWrappers::SolverDirect solver(control);
    matrix_->gather(right_hand_side, matrix_->in);
    try
    {
      solver.initialize(*matrix_->entries);
      solver.solve(matrix_->out, matrix_->in);
    }
    catch (const dealii::ExceptionBase &error)
    {
      throw NumericalError("the direct solver finds the matrix singular: the nodes are not tied to "
                           "the collar by bonds; raise the horizon or refine");
    }
    matrix_->scatter(matrix_->out, solution);
  }
} // namespace plumbline::algebra
