#include "algebra/block_preconditioner.h"
#include "tests/algebra/sparse_problems.h"

#include <limits>

using namespace plumbline;
using namespace plumbline::algebra;

namespace
{
  /// A u + B θ = f, θ - D u = g on n × n nodes, with differences over the four neighbours as D
  /// and a tenth of Dᵀ as B, so that eliminating θ makes A stiffer.
  System with_divergences(const CsrMatrix &A, int n)
  {
    CsrMatrix D;
    D.start = {0};
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
      {
        const auto add = [&](int k, int l, unsigned int c, double value)
        {
          if (k < 0 || k >= n || l < 0 || l >= n)
            return;
          D.column.push_back(2 * (l * n + k) + c);
          D.value.push_back(value);
        };
        add(i, j - 1, 1, -.5);
        add(i - 1, j, 0, -.5);
        add(i + 1, j, 0, .5);
        add(i, j + 1, 1, .5);
        D.start.push_back(D.column.size());
      }
    const unsigned int n_first = 2 * n * n;
    CsrMatrix square = D;
    square.start.resize(n_first + 1, D.column.size());
    CsrMatrix B = transpose(square);
    for (std::size_t e = 0; e < B.column.size(); ++e)
    {
      B.column[e] += n_first;
      B.value[e] *= .1;
    }
    System system;
    system.rows = add(A, B);
    for (unsigned int row = 0; row < D.n_rows(); ++row)
    {
      for (std::size_t e = D.start[row]; e < D.start[row + 1]; ++e)
      {
        system.rows.column.push_back(D.column[e]);
        system.rows.value.push_back(-D.value[e]);
      }
      system.rows.column.push_back(n_first + row);
      system.rows.value.push_back(1);
      system.rows.start.push_back(system.rows.column.size());
    }
    system.right_hand_side = times(system.rows, wave(system.rows.n_rows()));
    return system;
  }
} // namespace

TEST(BlockPreconditioner, UnknownsThatOthersGiveCostFewIterationsMoreThanTheseAlone)
{
  constexpr int n = 36; // 2592 displacements: above the 2000 that multigrid does not coarsen
  const System displacements = known({n, 3.2, 2, true, true});
  const System system = with_divergences(displacements.rows, n);
  const auto exact = wave(system.right_hand_side.size());
  SparseOptions options = with(SparseSolver::direct);
  options.is_symmetric = false;
  options.n_components = 2;
  options.n_first = 2 * n * n;
  EXPECT_LE(distance(solve(system, options).values, exact), 1e-11 * norm(exact));
  options.solver = SparseSolver::amg;
  for (const auto spread : {Spread::by_shares, Spread::on_last, Spread::split})
    for (const auto iteration : {Iteration::gmres, Iteration::bicgstab})
    {
      options.iteration = iteration;
      const SparseSolution solution = solve(system, options, Communicator::all(), spread);
      EXPECT_LE(distance(solution.values, exact), 1e-10 * norm(exact)) << solution.solver;
    }
  options.iteration = Iteration::gmres;
  const unsigned int n_iterations = solve(system, options).n_iterations;
  options.n_first = 0;
  const unsigned int n_alone = solve(displacements, options).n_iterations;
  EXPECT_LE(n_iterations, n_alone + 3); // measured: 15 to 16 both, on 1 to 4 ranks
}

TEST(BlockPreconditioner, MeetsTheRowsOfUnknownsThatOthersGiveExactly)
{
  constexpr int n = 10;
  constexpr std::size_t n_first = 2 * n * n;
  const System system = with_divergences(matrix({n, 3.2, 2, true, true}), n);
  const auto data = wave(system.right_hand_side.size());
  const OwnedRanges ranges(data.size(), 1, Communicator::alone());
  const DistributedMatrix whole(system.rows, ranges);
  const BlockPreconditioner blocks(whole, n_first, 2, {});
  DistributedMatrix::Vector r(ranges.own(), ranges.communicator.mpi), z(r), product(r);
  std::copy(data.begin(), data.end(), r.begin());
  blocks.vmult(z, r);
  whole.vmult(product, z);
  for (std::size_t i = n_first; i < data.size(); ++i)
    EXPECT_NEAR(product.begin()[i], data[i], 1e-13) << i;
}

TEST(BlockPreconditioner, FaultsInRowsOfUnknownsThatOthersGiveAreToldByTheirNumber)
{
  System system = with_divergences(matrix({10, 3.2, 2, true, true}), 10);
  system.right_hand_side[217] = std::numeric_limits<double>::quiet_NaN();
  SparseOptions options = with(SparseSolver::amg);
  options.n_components = 2;
  options.n_first = 200;
  expect_error(system, options, {"row 217", "unknown 17 of those", "finite"});
}
