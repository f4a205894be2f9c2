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

  SparseOperator::SparseOperator(const Stencil &stencil, const geometry::NodeSet &nodes)
      : matrix_(std::make_unique<Matrix>())
  {
    const std::size_t n_positions = nodes.n_positions();
    auto &number = matrix_->number;
    number.assign(nodes.size(), not_free);
    dealii::types::global_dof_index n_unknowns = 0;
    for (std::size_t i = 0; i < number.size(); ++i)
      if (nodes.is_free[i % nodes.is_free.size()] != 0)
        number[i] = n_unknowns++;

    const unsigned int n_blocks = nodes.n_blocks();
    const auto most_entries =
        static_cast<unsigned int>((stencil.n_entries() + n_blocks - 1) / n_blocks);
    const MPI_Comm self = MPI_COMM_SELF;
    const dealii::IndexSet all = dealii::complete_index_set(n_unknowns);
    matrix_->entries.emplace(all, self, std::max(1u, most_entries));
    matrix_->in.reinit(all, self);
    matrix_->out.reinit(all, self);

    std::vector<dealii::types::global_dof_index> columns;
    std::vector<double> values;
    for (unsigned int s = 0; s < n_blocks; ++s)
      for (int j = 0; j < nodes.n[1]; ++j)
        for (int i = 0; i < nodes.n[0]; ++i)
        {
          const auto row = number[s * n_positions + static_cast<std::size_t>(j) * nodes.n[0] + i];
          if (row == not_free)
            continue;
          columns.clear();
          values.clear();
          for (unsigned int t = 0; t < n_blocks; ++t)
            for (int k2 = std::max(-stencil.reach(), -j);
                 k2 <= std::min(stencil.reach(), nodes.n[1] - 1 - j); ++k2)
              for (int k1 = std::max(-stencil.reach(), -i);
                   k1 <= std::min(stencil.reach(), nodes.n[0] - 1 - i); ++k1)
              {
                const double a = stencil(s, t, k1, k2);
                const auto column = number[t * n_positions +
                                           static_cast<std::size_t>(j + k2) * nodes.n[0] + i + k1];
                if (a != 0 && column != not_free)
                {
                  columns.push_back(column);
                  values.push_back(a);
                }
              }
          matrix_->entries->set(row, static_cast<dealii::types::global_dof_index>(columns.size()),
                                columns.data(), values.data());
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
