#pragma once

#include "method/discretisation.h"
#include "method/linear_equations.h"
#include "method/method.h"

namespace plumbline::method
{
  /// Rows of the free unknowns in two parts: by columns of free ones, and of constrained ones,
  /// whose values are given. On several ranks the sum of all is the matrix.
  struct PartitionedRows
  {
    algebra::CsrMatrix free;        ///< shape (n_free, n_free)
    algebra::CsrMatrix constrained; ///< shape (n_free, n_constrained)
  };

  /// Part the columns of rows: those from n_free on are of constrained unknowns.
  PartitionedRows part(algebra::CsrMatrix rows, std::size_t n_free);

  /// Undo part().
  algebra::CsrMatrix join(const algebra::CsrMatrix &free, const algebra::CsrMatrix &constrained);

  /// load -= constrained × values.
  void subtract_constrained(const algebra::CsrMatrix &constrained,
                            const std::vector<double> &values, Vector &load);

  /// A problem whose rows differ from node to node, as both sides have it: a sparse matrix that the
  /// communicator makes together. A state is numbered node by node.
  class SparseDiscretisation : public Discretisation, public HasLinearEquations<2>
  {
  public:
    /// What the scene chooses is added to the options given.
    SparseDiscretisation(const problem::SolverSettings &solver, algebra::SparseOptions options,
                         const base::Communicator &communicator);

    std::size_t n_unknowns() const override { return free_->n_rows(); }
    std::unique_ptr<algebra::LinearSystem> tangent() const override;
    base::Communicator communicator() const override { return communicator_; }

  protected:
    void set_rows(PartitionedRows rows);
    const std::shared_ptr<const algebra::CsrMatrix> &free() const { return free_; }
    const std::shared_ptr<const algebra::CsrMatrix> &constrained() const { return constrained_; }

  private:
    std::shared_ptr<const algebra::CsrMatrix> free_ = std::make_shared<algebra::CsrMatrix>(),
                                              constrained_ = free_;
    algebra::SparseOptions options_;
    base::Communicator communicator_;
  };
} // namespace plumbline::method
