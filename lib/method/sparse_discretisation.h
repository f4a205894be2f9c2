#pragma once

#include "method/method.h"

namespace plumbline::method
{
  /// Rows of the free unknowns in two parts: by columns of free ones, and of held ones, whose
  /// values are given. On several ranks the sum of all is the matrix.
  struct PartedRows
  {
    algebra::Rows free; ///< shape (n_free, n_free)
    algebra::Rows held; ///< shape (n_free, n_held)
  };

  /// Part the columns of rows: those from n_free on are of held unknowns.
  PartedRows part(algebra::Rows rows, std::size_t n_free);

  /// load -= held × values.
  void subtract_held(const algebra::Rows &held, const std::vector<double> &values, Vector &load);

  /// A problem whose rows differ from node to node, as both sides have it: a sparse matrix that the
  /// team makes together. A state is numbered node by node.
  class SparseDiscretisation : public Discretisation
  {
  public:
    /// What the scene chooses is added to the options given.
    SparseDiscretisation(const scene::SolverSection &solver, algebra::SparseOptions options,
                         const base::Team &team);

    std::size_t n_unknowns() const override { return free_->n_rows(); }
    std::unique_ptr<algebra::LinearSystem> tangent() const override;
    base::Team team() const override { return team_; }

  protected:
    void set_rows(PartedRows rows);
    const algebra::Rows &free() const { return *free_; }
    const algebra::Rows &held() const { return held_; }

  private:
    std::shared_ptr<const algebra::Rows> free_ = std::make_shared<algebra::Rows>();
    algebra::Rows held_;
    algebra::SparseOptions options_;
    base::Team team_;
  };
} // namespace plumbline::method
