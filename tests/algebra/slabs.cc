// Boxes in slabs of planes: on any number of ranks, more than there are planes included, the
// operator, the preconditioner and the solution of one rank.
#include "base/slabs.h"
#include "algebra/linear_system.h"
#include "algebra/rectangle_solver.h"
#include "algebra/slab_model.h"
#include "algebra/slab_operator.h"
#include "algebra/slab_system.h"
#include "base/error.h"
#include "geometry/maximal_boxes.h"

#include <deal.II/lac/vector.h>

#include <fftw3-mpi.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace
{
  using namespace plumbline;
  using namespace plumbline::algebra;
  using base::Communicator;
  using base::Slabs;
  using geometry::BoxNodes;

  using Extents = std::array<int, 3>;

  /// The same on all ranks.
  Vector random_values(std::size_t n)
  {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(-1, 1);
    Vector values(n);
    for (double &value : values)
      value = uniform(random);
    return values;
  }

  /// Symmetric, with other entries along each axis, diagonally dominant.
  /// @param is_even  each block, too
  Stencil make_stencil(unsigned int n_blocks, const Extents &reach, bool is_even)
  {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(.1, 1);
    Stencil stencil(n_blocks, reach);
    double total = 0;
    for (unsigned int s = 0; s < n_blocks; ++s)
      for (unsigned int t = 0; t <= s; ++t)
        stencil.for_each_offset(
            [&](int k1, int k2, int k3)
            {
              const double w = -uniform(random) * (s == t ? 1 : .3),
                           odd = is_even || s == t ? 1 : -.5;
              stencil(s, t, k1, k2, k3) = stencil(t, s, -k1, -k2, -k3) = w;
              stencil(s, t, -k1, -k2, -k3) = stencil(t, s, k1, k2, k3) = odd * w;
              total += std::abs(w);
            });
    for (unsigned int s = 0; s < n_blocks; ++s)
      for (unsigned int t = 0; t < n_blocks; ++t)
        stencil(s, t, 0, 0, 0) = s == t ? 4 * total : 0;
    return stencil;
  }

  /// What this rank has of values over all nodes, shape (n_blocks, n[2], n[1], n[0]).
  Vector own_part(const Vector &all, unsigned int n_blocks, const Extents &n, const Slabs &slabs)
  {
    const std::size_t plane = static_cast<std::size_t>(n[0]) * n[1];
    Vector own(n_blocks * plane * slabs.n_owned());
    auto value = own.begin();
    for (unsigned int s = 0; s < n_blocks; ++s)
      value = std::copy_n(all.begin() + (s * n[2] + slabs.owned().first) * plane,
                          plane * slabs.n_owned(), value);
    return own;
  }

  /// Of this rank's values from what they should be, relative to the largest of these.
  double difference(Vector own, const Vector &expected, unsigned int n_blocks, const Extents &n,
                    const Slabs &slabs)
  {
    const Vector right = own_part(expected, n_blocks, n, slabs);
    double largest = 0;
    for (std::size_t i = 0; i < right.size(); ++i)
      largest = std::max(largest, std::abs(own[i] - right[i])); // NaN is lost
    for (const double value : own)
      if (!std::isfinite(value))
        return value;
    return largest / expected.linfty_norm();
  }

  constexpr double rounding = 1e-12;

  /// An L-shaped body with a cavity, whose maximal boxes begin and end in several planes.
  BoxNodes with_constrained_nodes(const Extents &n)
  {
    BoxNodes nodes{n};
    geometry::for_each_index({0, 0, 0}, n,
                             [&](const Extents &at)
                             {
                               const bool is_beside = at[0] >= n[0] - 2 && at[2] >= n[2] / 2,
                                          is_cavity = at == Extents{2, 2, 1};
                               nodes.is_free.push_back(is_beside || is_cavity ? 0 : 1);
                             });
    return nodes;
  }

  /// Random where nodes are free.
  Vector random_values(const BoxNodes &nodes, unsigned int n_blocks)
  {
    Vector values = random_values(n_blocks * nodes.n_positions());
    for (std::size_t i = 0; i < values.size(); ++i)
      if (nodes.is_free[i % nodes.is_free.size()] == 0)
        values[i] = 0;
    return values;
  }

  /// What this rank sends to transpose planes to rows and back, by the sizes that FFTW tells.
  base::Traffic transposed_by_fftw(const Extents &n, const Slabs &slabs)
  {
    const Slabs row_slabs(slabs.ranks(), n[1]);
    const std::array<std::ptrdiff_t, 3> extents = {n[2], n[1], n[0]};
    std::ptrdiff_t n_planes = 0, first_plane = 0, n_rows = 0, first_row = 0;
    fftw_mpi_init();
    fftw_mpi_local_size_many_transposed(3, extents.data(), 1, slabs.block(), row_slabs.block(),
                                        slabs.ranks().mpi, &n_planes, &first_plane, &n_rows,
                                        &first_row);
    base::Traffic sent;
    for (unsigned int other = 0; other < slabs.ranks().n_ranks(); ++other)
    {
      std::array<std::ptrdiff_t, 2> there = {n_planes, n_rows};
      MPI_Bcast(there.data(), sizeof(there), MPI_BYTE, static_cast<int>(other), slabs.ranks().mpi);
      for (const std::size_t n_lines : {n_planes * there[1], n_rows * there[0]})
        if (other != slabs.ranks().rank() && n_lines > 0)
          sent += {1, sizeof(double) * n[0] * n_lines};
    }
    return sent;
  }
} // namespace

TEST(Slabs, have_each_plane_once_in_order)
{
  for (const int n : {1, 5, 8, 17})
  {
    const Slabs slabs(Communicator::all(), n);
    int next = 0;
    for (unsigned int rank = 0; rank < slabs.ranks().n_ranks(); ++rank)
    {
      EXPECT_EQ(slabs.owned(rank).first, next);
      next = slabs.owned(rank).second;
    }
    EXPECT_EQ(next, n);
    EXPECT_EQ(slabs.ranks().sum(slabs.n_owned()), n);
  }
}

TEST(Slabs, fetch_planes_from_all_ranks_that_have_them)
{
  constexpr int n = 7, plane_size = 3, halo = 4; // beyond the next rank, and beyond the ends
  const Slabs slabs(Communicator::all(), n);
  std::vector<double> own;
  for (int k = slabs.owned().first; k < slabs.owned().second; ++k)
    for (int i = 0; i < plane_size; ++i)
      own.push_back(100 + 10 * k + i);
  const auto wanted = [&](unsigned int rank) -> Slabs::Range {
    return {slabs.owned(rank).first - halo, slabs.owned(rank).second + halo};
  };
  const auto found = slabs.fetch(own, plane_size, wanted);
  ASSERT_EQ(found.size(), static_cast<std::size_t>(plane_size) * (slabs.n_owned() + 2 * halo));
  auto value = found.begin();
  for (int k = slabs.owned().first - halo; k < slabs.owned().second + halo; ++k)
    for (int i = 0; i < plane_size; ++i)
      EXPECT_EQ(*value++, k < 0 || k >= n ? 0 : 100 + 10 * k + i);

  for (const Slabs::Range &outside : {Slabs::Range{-5, -2}, {n, n + 3}})
    EXPECT_EQ(slabs.fetch(own, plane_size, [&](unsigned int) { return outside; }),
              std::vector<double>(3 * plane_size));

  const auto all = slabs.gather(own, plane_size);
  ASSERT_EQ(all.size(), slabs.ranks().rank() == 0 ? n * plane_size : 0u);
  for (std::size_t i = 0; i < all.size(); ++i)
    EXPECT_EQ(all[i], 100 + 10 * (i / plane_size) + i % plane_size);
}

TEST(SlabSystem, is_the_operator_of_one_rank)
{
  for (const unsigned int n_blocks : {1u, 3u})
    for (const bool is_even : {true, false})
      for (const Extents &reach : {Extents{1, 1, 1}, {2, 1, 3}})
        for (const Extents &n : {Extents{7, 6, 5}, {5, 4, 17}})
          for (const auto backend :
               {OperatorBackend::automatic, OperatorBackend::direct, OperatorBackend::fft})
          {
            const Stencil stencil = make_stencil(n_blocks, reach, is_even);
            if (backend == OperatorBackend::direct && !stencil.is_even())
              continue;
            const Slabs slabs(Communicator::all(), n[2]);
            const Vector input = random_values(n_blocks * n[0] * n[1] * n[2]);
            Vector expected(input.size());
            make_operator(stencil, BoxNodes{n}, backend)->vmult(expected, input);
            const Vector own = own_part(input, n_blocks, n, slabs);
            Vector output(own.size());
            SlabSystem(stencil, BoxNodes{n}, slabs, backend).vmult(output, own);
            EXPECT_LT(difference(output, expected, n_blocks, n, slabs), rounding)
                << n_blocks << ", " << is_even << ", " << reach[2] << ", " << n[2];
          }
}

TEST(SlabOperator, has_the_bits_of_one_rank_where_stencils_are_direct)
{
  for (const unsigned int n_blocks : {1u, 2u, 3u})
    for (const Extents &n :
         {Extents{7, 6, 5}, {35, 4, 30}, {5, 1, 23}}) // {5, 1, 23}: a plane lattice
    {
      const Stencil stencil = make_stencil(n_blocks, {2, n[1] == 1 ? 0 : 1, 3}, true);
      const Slabs slabs(Communicator::all(), n[2]);
      const Vector input = random_values(n_blocks * n[0] * n[1] * n[2]);
      Vector expected(input.size());
      DirectStencil(stencil, n).apply(input.begin(), expected.begin());
      const Vector own = own_part(input, n_blocks, n, slabs);
      Vector output(own.size());
      const SlabOperator slab(stencil, n, slabs, OperatorBackend::direct);
      for (int time = 0; time < 2; ++time) // the second finds planes of the first
      {
        output = 0.;
        slab.apply(own.begin(), output.begin());
        EXPECT_EQ(difference(output, expected, n_blocks, n, slabs), 0) << n_blocks << ", " << n[2];
      }
    }
}

TEST(SlabSystem, has_the_preconditioner_of_one_rank)
{
  for (const unsigned int n_blocks : {1u, 2u})
    for (const Extents &n : {Extents{7, 6, 5}, {6, 3, 17}, {4, 9, 1}, {1, 5, 6}, {5, 1, 9}})
    {
      const Stencil stencil = make_stencil(n_blocks, {2, 2, 2}, true);
      const Slabs slabs(Communicator::all(), n[2]);
      const Vector input = random_values(n_blocks * n[0] * n[1] * n[2]);
      Vector expected(input.size());
      make_box_sine_solver(stencil, n, {{}, n})->add_inverse(expected, input);
      const Vector own = own_part(input, n_blocks, n, slabs);
      Vector output(own.size());
      SlabSystem(stencil, BoxNodes{n}, slabs, OperatorBackend::automatic).precondition(output, own);
      EXPECT_LT(difference(output, expected, n_blocks, n, slabs), rounding);
    }
}

TEST(SlabSystem, has_blocks_that_leave_the_last_ranks_fewer_planes)
{
  // inner vertices have the blocks of the cells, of which there is one plane more
  const Extents n = {5, 4, 8};
  const Slabs slabs = Slabs(Communicator::all(), n[2] + 1).with_planes(n[2]);
  const Stencil stencil = make_stencil(1, {2, 2, 2}, true);
  const Vector input = random_values(static_cast<std::size_t>(n[0]) * n[1] * n[2]);
  Vector expected(input.size());
  make_box_sine_solver(stencil, n, {{}, n})->add_inverse(expected, input);
  const Vector own = own_part(input, 1, n, slabs);
  Vector output(own.size());
  SlabSystem(stencil, BoxNodes{n}, slabs, OperatorBackend::direct).precondition(output, own);
  EXPECT_LT(difference(output, expected, 1, n, slabs), rounding);
}

TEST(SlabSystem, solves_as_one_rank_does)
{
  for (const unsigned int n_blocks : {1u, 3u})
    for (const Extents &n : {Extents{9, 8, 6}, {5, 4, 19}})
    {
      const Stencil stencil = make_stencil(n_blocks, {2, 2, 2}, n_blocks == 1);
      const Slabs slabs(Communicator::all(), n[2]);
      const Vector right_hand_side = random_values(n_blocks * n[0] * n[1] * n[2]);
      Vector expected(right_hand_side.size());
      const LinearSolve alone = StencilSystem(stencil, BoxNodes{n}, OperatorBackend::automatic)
                                    .solve(expected, right_hand_side, {1e-13, 100});
      const Vector own = own_part(right_hand_side, n_blocks, n, slabs);
      Vector solution(own.size());
      const LinearSolve together =
          SlabSystem(stencil, BoxNodes{n}, slabs, OperatorBackend::automatic)
              .solve(solution, own, {1e-13, 100});
      EXPECT_LT(difference(solution, expected, n_blocks, n, slabs), rounding);
      EXPECT_EQ(together.n_iterations, alone.n_iterations);
      EXPECT_EQ(together.n_bonds, alone.n_bonds);
      EXPECT_EQ(together.backend, alone.backend + " in slabs");
    }
}

TEST(SlabSystem, has_the_operator_and_preconditioner_of_one_rank_where_nodes_are_constrained)
{
  for (const unsigned int n_blocks : {1u, 3u})
    for (const Extents &n : {Extents{7, 6, 5}, {6, 5, 17}})
    {
      const BoxNodes nodes = with_constrained_nodes(n);
      const Stencil stencil = make_stencil(n_blocks, {2, 1, 3}, true);
      const Slabs slabs = Slabs(Communicator::all(), n[2] + 1).with_planes(n[2]); // of cells
      const SlabSystem system(stencil, nodes, slabs, OperatorBackend::automatic);
      const Vector input = random_values(nodes, n_blocks),
                   own = own_part(input, n_blocks, n, slabs);
      Vector expected(input.size()), output(own.size());
      make_operator(stencil, nodes, OperatorBackend::automatic)->vmult(expected, input);
      system.vmult(output, own);
      EXPECT_LT(difference(output, expected, n_blocks, n, slabs), rounding)
          << n_blocks << ", " << n[2];

      expected = 0.;
      const auto boxes = geometry::maximal_boxes(nodes.is_free, n);
      EXPECT_GT(boxes.size(), 2u);
      for (const geometry::CubeRange &box : boxes)
        make_box_sine_solver(stencil, n, box)->add_inverse(expected, input);
      system.precondition(output, own);
      EXPECT_LT(difference(output, expected, n_blocks, n, slabs), rounding)
          << n_blocks << ", " << n[2];
    }
}

TEST(SlabSystem, solves_as_one_rank_does_where_nodes_are_constrained)
{
  for (const unsigned int n_blocks : {1u, 3u})
    for (const Extents &n : {Extents{9, 8, 6}, {6, 5, 19}})
    {
      const BoxNodes nodes = with_constrained_nodes(n);
      const Stencil stencil = make_stencil(n_blocks, {2, 2, 2}, n_blocks == 1);
      const Slabs slabs(Communicator::all(), n[2]);
      const Vector right_hand_side = random_values(nodes, n_blocks);
      Vector expected(right_hand_side.size());
      const LinearSolve alone = StencilSystem(stencil, nodes, OperatorBackend::automatic)
                                    .solve(expected, right_hand_side, {1e-13, 100});
      const Vector own = own_part(right_hand_side, n_blocks, n, slabs);
      Vector solution(own.size());
      const LinearSolve together = SlabSystem(stencil, nodes, slabs, OperatorBackend::automatic)
                                       .solve(solution, own, {1e-13, 100});
      EXPECT_LT(difference(solution, expected, n_blocks, n, slabs), rounding);
      EXPECT_EQ(together.n_iterations, alone.n_iterations);
      EXPECT_EQ(together.n_bonds, alone.n_bonds);
      EXPECT_EQ(together.backend, alone.backend + " in slabs");
    }
}

TEST(SlabSystem, is_refused_by_all_ranks)
{
  const Extents n = {6, 5, 9};
  const Slabs slabs(Communicator::all(), n[2]);
  Stencil stencil = make_stencil(1, {1, 1, 1}, true);
  const double diagonal = stencil(0, 0, 0, 0, 0);
  stencil(0, 0, 0, 0, 0) = 0; // its symbol is negative where others have their modes
  EXPECT_THROW(SlabSystem(stencil, BoxNodes{n}, slabs, OperatorBackend::automatic), NumericalError);
  stencil(0, 0, 0, 0, 0) = diagonal;
  EXPECT_THROW(SlabSystem(stencil, BoxNodes{n}, slabs, OperatorBackend::sparse), InputError);
  stencil(0, 0, 1, 0, 0) *= 2;
  EXPECT_THROW(SlabSystem(stencil, BoxNodes{n}, slabs, OperatorBackend::automatic), NumericalError);
}

// What PlaneExchange counts as it posts messages, for boxes and for a lattice in the plane.
TEST(SlabModel, knows_the_messages_that_an_operator_sends)
{
  for (const unsigned int n_blocks : {1u, 3u})
    for (const Extents &n : {Extents{7, 6, 5}, {5, 4, 17}, {9, 1, 40}})
      for (const int planes_more : {0, 1}) // of cells, where nodes are vertices
        for (const auto backend : {OperatorBackend::direct, OperatorBackend::fft})
        {
          const Stencil stencil = make_stencil(n_blocks, {2, n[1] == 1 ? 0 : 1, 3}, true);
          const Slabs slabs = Slabs(Communicator::all(), n[2] + planes_more).with_planes(n[2]);
          const auto layout =
              SlabLayout::of(stencil, n, slabs.ranks().n_ranks(), n[2] + planes_more);
          EXPECT_EQ(layout.owned(slabs.ranks().rank()), slabs.owned());
          Vector own(n_blocks * n[0] * n[1] * slabs.n_owned()), output(own.size());
          const SlabOperator slab(stencil, n, slabs, backend);
          slab.apply(own.begin(), output.begin());
          const base::Traffic expected = halo_traffic(layout, slabs.ranks().rank());
          EXPECT_EQ(slab.sent().n_messages, expected.n_messages);
          EXPECT_EQ(slab.sent().n_bytes, expected.n_bytes);
          const double n_sent = slabs.ranks().sum(static_cast<double>(expected.n_messages));
          EXPECT_EQ(n_sent > 0, slabs.ranks().n_ranks() > 1);
        }
}

TEST(SlabModel, knows_what_transposes_send)
{
  for (const unsigned int n_blocks : {1u, 2u})
    for (const Extents &n : {Extents{7, 6, 5}, {5, 4, 17}, {6, 19, 3}})
    {
      const Slabs slabs(Communicator::all(), n[2]);
      const auto layout =
          SlabLayout::of(Stencil(n_blocks, Extents{1, 1, 1}), n, slabs.ranks().n_ranks(), n[2]);
      const base::Traffic expected = n_blocks * transposed_by_fftw(n, slabs),
                          found = transpose_traffic(layout, slabs.ranks().rank());
      EXPECT_EQ(found.n_messages, expected.n_messages);
      EXPECT_EQ(found.n_bytes, expected.n_bytes);
    }
}

// By hand: 4 planes of 6 nodes on 3 ranks, blocks of 2, so that the last rank has none; reach 1.
TEST(SlabModel, adds_latency_bandwidth_and_work)
{
  const Extents n = {3, 2, 4};
  Stencil stencil(1, Extents{1, 1, 1});
  stencil(0, 0, 0, 0, 0) = 1;
  const auto layout = SlabLayout::of(stencil, n, 3, n[2]);
  EXPECT_EQ(layout.n_working(), 2u);
  EXPECT_EQ(halo_traffic(layout, 0), (base::Traffic{1, 48}));
  EXPECT_EQ(halo_traffic(layout, 2), base::Traffic{});
  Rates rates;
  rates.latency = 1000;
  rates.byte = 1;
  rates.bond = 1e6;
  rates.level = 0;
  rates.value = 0;
  EXPECT_DOUBLE_EQ(operator_time(layout, stencil, rates).seconds(), 12e6 + 1000 + 48);
  // two planes of one row to the rank of the other row, and back a row of the two planes there
  EXPECT_DOUBLE_EQ(preconditioner_time(layout, rates).seconds(), 2 * (1000 + 48));
  // three sums of two stages
  EXPECT_DOUBLE_EQ(iteration_time(layout, stencil, rates).seconds(),
                   12e6 + 3 * (1000 + 48) + 6 * (1000 + 8));
}
