#pragma once

#include "method/discretisation.h"
#include "method/method.h"

namespace plumbline::method
{
  /// Rows of the free unknowns in two parts: by columns of free ones, and of held ones, whose
  /// values are given. On several ranks the sum of all is the matrix.
  struct PartedRows
  {
    algebra::CsrMatrix free; ///< shape (n_free, n_free)
    algebra::CsrMatrix held; ///< shape (n_free, n_held)
  };

  /// Part the columns of rows: those from n_free on are of held unknowns.
  PartedRows part(algebra::CsrMatrix rows, std::size_t n_free);

  /// load -= held × values.
  void subtract_held(const algebra::CsrMatrix &held, const std::vector<double> &values,
                     Vector &load);

  /// A problem whose rows differ from node to node, as both sides have it: a sparse matrix that the
  /// communicator makes together. A state is numbered node by node.
  class SparseDiscretisation : public Discretisation
  {
  public:
    /// What the scene chooses is added to the options given.
    SparseDiscretisation(const scene::SolverSection &solver, algebra::SparseOptions options,
                         const base::Communicator &communicator);

    std::size_t n_unknowns() const override { return free_->n_rows(); }
    std::unique_ptr<algebra::LinearSystem> tangent() const override;
    base::Communicator communicator() const override { return communicator_; }

  protected:
    void set_rows(PartedRows rows);
    const algebra::CsrMatrix &free() const { return *free_; }
    const algebra::CsrMatrix &held() const { return held_; }

  private:
    std::shared_ptr<const algebra::CsrMatrix> free_ = std::make_shared<algebra::CsrMatrix>();
    algebra::CsrMatrix held_;
    algebra::SparseOptions options_;
    base::Communicator communicator_;
  };
} // namespace plumbline::method
