#include "algebra/slab_system.h"

#include "algebra/conjugate_gradients.h"
#include "algebra/convolution.h"
#include "algebra/direct.h"
#include "algebra/slab_sine.h"

#include <deal.II/base/index_set.h>
#include <deal.II/lac/la_parallel_vector.h>
#include <deal.II/lac/vector.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

namespace plumbline::algebra
{
  namespace
  {
    using Shared = dealii::LinearAlgebra::distributed::Vector<double>;

    /// The stencil on a slab.
    class SlabOperator
    {
    public:
      SlabOperator(const Stencil &stencil, const std::array<int, 3> &n, const base::Slabs &slabs,
                   OperatorBackend backend)
          : slabs_(slabs), n_blocks_(stencil.n_blocks()), halo_(stencil.reaches()[2]),
            plane_size_(static_cast<std::size_t>(n[0]) * n[1])
      {
        const std::array<int, 3> own = {n[0], n[1], slabs.n_owned()};
        // as for the whole box, so that rounding does not depend on the number of ranks
        is_direct_ = is_direct(stencil, n, backend);
        if (slabs.n_owned() == 0)
          return;
        with_halo_.resize(n_blocks_ * plane_size_ * (own[2] + 2 * halo_));
        if (is_direct_)
          direct_.emplace(stencil, own, true);
        else
          transforms_.emplace(stencil, own, std::array<int, 3>{0, 0, halo_});
      }

      void apply(const double *input, double *output) const
      {
        const auto wanted = [this](unsigned int rank) -> base::Slabs::Range
        {
          const auto [first, second] = slabs_.owned(rank);
          return first == second ? base::Slabs::Range{0, 0}
                                 : base::Slabs::Range{first - halo_, second + halo_};
        };
        const std::size_t n_own = plane_size_ * slabs_.n_owned();
        for (unsigned int s = 0; s < n_blocks_; ++s)
          slabs_.fetch(input + s * n_own, plane_size_, wanted,
                       with_halo_.data() + s * (with_halo_.size() / n_blocks_));
        if (direct_)
          direct_->apply(with_halo_.data(), output);
        else if (transforms_)
          transforms_->apply(with_halo_.data(), output);
      }

      std::string backend() const { return is_direct_ ? "direct" : "fft"; }

    private:
      base::Slabs slabs_;
      unsigned int n_blocks_;
      int halo_; ///< planes on either side
      std::size_t plane_size_;
      bool is_direct_ = false;
      std::optional<DirectStencil> direct_; ///< none of both: this rank has no planes
      std::optional<Convolution> transforms_;
      mutable std::vector<double> with_halo_; ///< shape (n_blocks, n_owned + 2 halo, n[1], n[0])
    };
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
