#include "algebra/slab_system.h"

#include "algebra/conjugate_gradients.h"
#include "algebra/slab_operator.h"
#include "algebra/slab_sine.h"
#include "geometry/maximal_boxes.h"
#include "geometry/node_planes.h"

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
    using base::Slabs;
    using geometry::CubeRange;

    std::array<int, 3> extents(const CubeRange &box)
    {
      return {box.upper[0] - box.lower[0], box.upper[1] - box.lower[1],
              box.upper[2] - box.lower[2]};
    }

    /// The sine solver of one of the boxes in a lattice: its planes are distributed over all ranks,
    /// whichever of them have planes of the lattice there.
    class BoxInSlabs
    {
    public:
      /// @param n      nodes of the lattice
      /// @param slabs  of its planes
      BoxInSlabs(const Stencil &stencil, const std::array<int, 3> &n, const Slabs &slabs,
                 const CubeRange &box)
          : n_{n[0], n[1], slabs.n_owned()}, box_(box), n_box_(extents(box)),
            n_components_(stencil.n_blocks()), of_lattice_(slabs),
            of_box_(slabs.ranks(), n_box_[2]), sine_(stencil, n_box_, of_box_)
      {
      }

      /// output += approximate inverse of what input holds in the box.
      void add_inverse(const double *input, double *output) const
      {
        const std::size_t plane = static_cast<std::size_t>(n_box_[0]) * n_box_[1],
                          n_own = plane * of_box_.n_owned();
        std::vector<double> rows(plane * n_[2]), in_box(n_components_ * n_own);
        for (unsigned int c = 0; c < n_components_; ++c)
        {
          for_each_row(c, [&](std::size_t place, std::size_t row)
                       { std::copy_n(input + place, n_box_[0], &rows[row]); });
          of_lattice_.fetch(
              rows.data(), plane,
              [this](unsigned int rank) { return moved(of_box_.owned(rank), box_.lower[2]); },
              in_box.data() + c * n_own);
        }
        sine_.apply(in_box.data(), in_box.data());
        for (unsigned int c = 0; c < n_components_; ++c)
        {
          of_box_.fetch(
              in_box.data() + c * n_own, plane,
              [this](unsigned int rank) { return moved(of_lattice_.owned(rank), -box_.lower[2]); },
              rows.data());
          for_each_row(c,
                       [&](std::size_t place, std::size_t row)
                       {
                         for (int i = 0; i < n_box_[0]; ++i)
                           output[place + i] += rows[row + i];
                       });
        }
      }

    private:
      static Slabs::Range moved(const Slabs::Range &planes, int by)
      {
        return {planes.first + by, planes.second + by};
      }

      /// visit(its place in vectors, its place among the rows) of each row across the box in this
      /// rank's planes.
      template <class Visit>
      void for_each_row(std::size_t component, const Visit &visit) const
      {
        std::size_t row = 0;
        for (int k = 0; k < n_[2]; ++k)
          for (int j = box_.lower[1]; j < box_.upper[1]; ++j, row += n_box_[0])
            visit(box_.lower[0] + n_[0] * (j + n_[1] * (k + n_[2] * component)), row);
      }

      std::array<int, 3> n_; ///< of this rank's nodes
      CubeRange box_;
      std::array<int, 3> n_box_;
      unsigned int n_components_;
      Slabs of_lattice_, of_box_;
      SlabSine sine_;
    };
  } // namespace

  struct SlabSystem::Parts
  {
    SlabOperator matrix;
    geometry::BoxNodes own;           ///< nodes of this rank
    std::optional<SlabSine> on_all;   ///< where all nodes are free
    std::vector<BoxInSlabs> on_boxes; ///< else
    dealii::IndexSet owned;           ///< of all unknowns, numbered rank by rank
    MPI_Comm mpi;
    std::uint64_t n_bonds;

    void apply(double *y, const double *x) const
    {
      matrix.apply(x, y);
      for (const double *const end = y + owned.n_elements(); y != end && !own.is_free.empty();)
        for (const char is_free : own.is_free)
          *y++ *= is_free != 0 ? 1. : 0.;
    }

    void precondition(double *y, const double *x) const
    {
      if (on_all)
        return on_all->apply(x, y);
      std::fill_n(y, owned.n_elements(), 0.);
      for (const BoxInSlabs &box : on_boxes)
        box.add_inverse(x, y);
    }

    /// For deal.II's solvers.
    struct Matrix
    {
      const Parts &of;
      void vmult(Shared &y, const Shared &x) const { of.apply(y.begin(), x.begin()); }
    };
    struct Preconditioner
    {
      const Parts &of;
      void vmult(Shared &y, const Shared &x) const { of.precondition(y.begin(), x.begin()); }
    };
  };

  SlabSystem::SlabSystem(const Stencil &stencil, const geometry::BoxNodes &nodes,
                         const base::Slabs &slabs, OperatorBackend backend)
  {
    const auto &n = nodes.n;
    const std::size_t of_plane = static_cast<std::size_t>(n[0]) * n[1] * stencil.n_blocks();
    dealii::IndexSet owned(of_plane * n[2]);
    owned.add_range(of_plane * slabs.owned().first, of_plane * slabs.owned().second);
    owned.compress();
    parts_ = std::make_unique<Parts>(Parts{{symmetric(stencil), n, slabs, backend},
                                           geometry::planes_of(nodes, slabs.owned()),
                                           {},
                                           {},
                                           std::move(owned),
                                           slabs.ranks().mpi,
                                           stencil.n_entries() * nodes.n_free()});
    if (nodes.is_free.empty())
      parts_->on_all.emplace(stencil, n, slabs);
    else
      for (const CubeRange &box : geometry::maximal_boxes(nodes.is_free, n))
        parts_->on_boxes.emplace_back(stencil, n, slabs, box);
  }

  SlabSystem::~SlabSystem() = default;

  void SlabSystem::vmult(Vector &y, const Vector &x) const
  {
    parts_->apply(y.begin(), x.begin());
  }

  void SlabSystem::precondition(Vector &y, const Vector &x) const
  {
    parts_->precondition(y.begin(), x.begin());
  }

  LinearSolve SlabSystem::solve(Vector &x, const Vector &b, const Stopping &stopping) const
  {
    Shared solution(parts_->owned, parts_->mpi), right_hand_side(parts_->owned, parts_->mpi);
    std::copy(x.begin(), x.end(), solution.begin());
    std::copy(b.begin(), b.end(), right_hand_side.begin());
    const SolveResult solved =
        solve_with(Parts::Matrix{*parts_}, Parts::Preconditioner{*parts_}, solution,
                   right_hand_side, stopping.tolerance, stopping.max_iterations);
    std::copy(solution.begin(), solution.end(), x.begin());
    return {solved.n_iterations, solved.relative_residual, parts_->matrix.backend() + " in slabs",
            parts_->n_bonds};
  }
} // namespace plumbline::algebra
