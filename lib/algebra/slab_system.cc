#include "algebra/slab_system.h"

#include "algebra/conjugate_gradients.h"
#include "algebra/slab_operator.h"
#include "algebra/slab_sine.h"

#include <deal.II/base/index_set.h>
#include <deal.II/lac/la_parallel_vector.h>
#include <deal.II/lac/vector.h>

#include <algorithm>
#include <utility>

namespace plumbline::algebra
{
  namespace
  {
    using Shared = dealii::LinearAlgebra::distributed::Vector<double>;
  } // namespace

  struct SlabSystem::Parts
  {
    SlabOperator matrix;
    SlabSine preconditioner;
    dealii::IndexSet owned; ///< of all unknowns, numbered rank by rank
    MPI_Comm mpi;
    std::uint64_t n_bonds;

    /// For deal.II's solvers.
    struct Matrix
    {
      const SlabOperator &of;
      void vmult(Shared &y, const Shared &x) const { of.apply(x.begin(), y.begin()); }
    };
    struct Preconditioner
    {
      const SlabSine &of;
      void vmult(Shared &y, const Shared &x) const { of.apply(x.begin(), y.begin()); }
    };
  };

  SlabSystem::SlabSystem(const Stencil &stencil, const std::array<int, 3> &n,
                         const base::Slabs &slabs, OperatorBackend backend)
  {
    const std::size_t of_plane = static_cast<std::size_t>(n[0]) * n[1] * stencil.n_blocks(),
                      n_all = of_plane * n[2];
    dealii::IndexSet owned(n_all);
    owned.add_range(of_plane * slabs.owned().first, of_plane * slabs.owned().second);
    owned.compress();
    parts_ = std::make_unique<Parts>(Parts{{symmetric(stencil), n, slabs, backend},
                                           {stencil, n, slabs},
                                           std::move(owned),
                                           slabs.ranks().mpi,
                                           stencil.n_entries() * (n_all / stencil.n_blocks())});
  }

  SlabSystem::~SlabSystem() = default;

  void SlabSystem::vmult(Vector &y, const Vector &x) const
  {
    parts_->matrix.apply(x.begin(), y.begin());
  }

  void SlabSystem::precondition(Vector &y, const Vector &x) const
  {
    parts_->preconditioner.apply(x.begin(), y.begin());
  }

  LinearSolve SlabSystem::solve(Vector &x, const Vector &b, const Stopping &stopping) const
  {
    Shared solution(parts_->owned, parts_->mpi), right_hand_side(parts_->owned, parts_->mpi);
    std::copy(x.begin(), x.end(), solution.begin());
    std::copy(b.begin(), b.end(), right_hand_side.begin());
    const SolveResult solved =
        solve_with(Parts::Matrix{parts_->matrix}, Parts::Preconditioner{parts_->preconditioner},
                   solution, right_hand_side, stopping.tolerance, stopping.max_iterations);
    std::copy(solution.begin(), solution.end(), x.begin());
    return {solved.n_iterations, solved.relative_residual, parts_->matrix.backend() + " in slabs",
            parts_->n_bonds};
  }
} // namespace plumbline::algebra
