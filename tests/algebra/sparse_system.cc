#include "tests/algebra/little_memory.h"
#include "tests/algebra/sparse_problems.h"

#include <limits>

using namespace plumbline;
using namespace plumbline::algebra;

namespace
{
  const auto solvers = {SparseSolver::direct, SparseSolver::amg, SparseSolver::jacobi};
} // namespace

TEST(Communicator, SharesCoverEverythingInOrderAndDifferByAtMostOne)
{
  const Communicator communicator = Communicator::all();
  for (const std::size_t n : {0, 1, 2, 3, 7, 1000, 1003})
  {
    const auto [first, last] = communicator.owned_range(n);
    std::vector<unsigned long> firsts(communicator.n_ranks()), lasts(communicator.n_ranks());
    MPI_Allgather(&first, 1, MPI_UNSIGNED_LONG, firsts.data(), 1, MPI_UNSIGNED_LONG,
                  communicator.mpi);
    MPI_Allgather(&last, 1, MPI_UNSIGNED_LONG, lasts.data(), 1, MPI_UNSIGNED_LONG,
                  communicator.mpi);
    EXPECT_EQ(firsts.front(), 0u);
    EXPECT_EQ(lasts.back(), n);
    for (unsigned int r = 0; r < communicator.n_ranks(); ++r)
    {
      EXPECT_EQ(lasts[r], r + 1 < communicator.n_ranks() ? firsts[r + 1] : n);
      EXPECT_GE(lasts[r] - firsts[r], n / communicator.n_ranks());
      EXPECT_LE(lasts[r] - firsts[r], n / communicator.n_ranks() + 1);
    }
  }
  EXPECT_EQ(Communicator::alone().n_ranks(), 1u);
  EXPECT_EQ(Communicator::alone().rank(), 0u);
}

TEST(SparseSystem, EverySolverFindsTheKnownSolutionHoweverTheEntriesAreSpread)
{
  for (const unsigned int n_components : {1, 2})
    for (const bool is_symmetric : {true, false})
    {
      const System system = known({20, 3.2, n_components, is_symmetric, true});
      const auto exact = wave(system.right_hand_side.size());
      for (const auto solver : solvers)
      {
        SparseOptions options = with(solver);
        options.n_components = n_components;
        options.is_symmetric = is_symmetric;
        options.tolerance = 1e-14;
        const SparseSolution alone = solve(system, options, Communicator::alone());
        EXPECT_LE(distance(alone.values, exact), 1e-12 * norm(exact)) << alone.solver;
        EXPECT_EQ(alone.n_iterations == 0, solver == SparseSolver::direct);
        for (const auto spread : {Spread::by_shares, Spread::on_last, Spread::split})
        {
          const SparseSolution all = solve(system, options, Communicator::all(), spread);
          EXPECT_LE(distance(all.values, alone.values), 1e-12 * norm(exact))
              << all.solver << " spread " << static_cast<int>(spread);
          EXPECT_EQ(all.n_nonzeros, system.rows.value.size());
        }
      }
    }
}

TEST(SparseSystem, ResidualAndMemoryAreTheMatrixOwn)
{
  const System system = known({30, 3.2, 1, true, true});
  SparseOptions options = with(SparseSolver::jacobi);
  options.tolerance = 1e-5;
  const SparseSolution solution = solve(system, options);
  const double residual = distance(times(system.rows, solution.values), system.right_hand_side) /
                          norm(system.right_hand_side);
  EXPECT_NEAR(solution.relative_residual, residual, 1e-13);
  EXPECT_LE(residual, 1e-5);
  EXPECT_GT(residual, 1e-8);
  EXPECT_GE(solution.bytes, 12 * solution.n_nonzeros / Communicator::all().n_ranks() / 2);
}

TEST(SparseSystem, AutomaticTakesDirectForFewUnknownsJacobiForWideAndMultigridForNarrowHorizons)
{
  const auto chosen = [](int n, double reach) {
    return solve(known({n, reach, 1, true, true}), with(SparseSolver::automatic)).solver;
  };
  EXPECT_EQ(chosen(20, 3.2), "direct");
  EXPECT_EQ(chosen(50, 6.2), "cg + jacobi");
  EXPECT_EQ(chosen(100, 3.2), "cg + amg");
}

TEST(SparseSystem, AutomaticTakesMultigridEarlierForTwoComponents)
{
  const auto chosen = [](unsigned int n_components, int n)
  {
    SparseOptions options = with(SparseSolver::automatic);
    options.n_components = n_components;
    return solve(known({n, 3.2, n_components, true, true}), options).solver;
  };
  EXPECT_EQ(chosen(1, 45), "cg + jacobi"); // 60 times more unknowns than entries in a row
  EXPECT_EQ(chosen(2, 45), "cg + amg");
}

TEST(SparseSystem, RotationsSaveMultigridIterationsOfSolids)
{
  const int n = 50;
  const System system = known({n, 3.2, 2, true, true});
  SparseOptions options = with(SparseSolver::amg);
  options.n_components = 2;
  const SparseSolution constants = solve(system, options);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      options.nodes.emplace_back(i - 1e4, j + 1e4); // far from the origin, which does not matter
  const SparseSolution rigid = solve(system, options);
  EXPECT_LE(10 * rigid.n_iterations, 9 * constants.n_iterations);
  EXPECT_LE(distance(rigid.values, constants.values), 1e-10 * norm(rigid.values));
}

TEST(SparseSystem, EveryIterationFindsTheSolution)
{
  const System system = known({40, 3.2, 1, false, true});
  const auto exact = wave(system.right_hand_side.size());
  for (const auto solver : {SparseSolver::amg, SparseSolver::jacobi})
    for (const auto iteration : {Iteration::gmres, Iteration::bicgstab})
    {
      const std::string name = base::word(iteration);
      SparseOptions options = with(solver);
      options.iteration = iteration;
      const SparseSolution solution = solve(system, options);
      EXPECT_LE(distance(solution.values, exact), 1e-10 * norm(exact)) << solution.solver;
      EXPECT_GT(solution.n_iterations, 0u);
      EXPECT_EQ(solution.solver.substr(0, name.size()), name);
    }
}

TEST(SparseSystem, ConjugateGradientsAreRefusedWhereTheMatrixIsNotSymmetric)
{
  SparseOptions options = with(SparseSolver::jacobi);
  options.iteration = Iteration::cg;
  options.is_symmetric = false; // not known to be, but it is
  EXPECT_EQ(solve(known({20, 3.2, 1, true, true}), options).solver, "cg + jacobi");
  options.solver = SparseSolver::direct; // as automatic may take
  System system = known({20, 3.2, 1, true, true});
  system.rows.value[system.rows.start[150]] *= 1.001; // one entry among thousands
  try
  {
    solve(system, options);
    FAIL();
  }
  catch (const InputError &error)
  {
    for (const std::string word : {"Solver/iteration", "cg", "e-06", "symmetric", "gmres"})
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
  }
}

TEST(SparseSystem, MultigridCoarsensRowsOfManySmallEntries)
{
  const System system = known({60, 12.2, 1, true, true});
  const SparseSolution solution = solve(system, with(SparseSolver::amg));
  EXPECT_LE(solution.n_iterations, 60u);
  EXPECT_LE(solution.bytes, 3 * 12 * system.rows.value.size()); // not a dense coarse factor
}

TEST(SparseSystem, ASingularSystemIsAnErrorOnEveryRank)
{
  for (const bool is_symmetric : {true, false})
  {
    System system = known({20, 3.2, 1, is_symmetric, false}); // constants are in the null space
    SparseOptions options = with(SparseSolver::direct);
    options.is_symmetric = is_symmetric;
    expect_error(
        system, options,
        {"the sparse solver 'direct' (Solver/linear solver, Solver/iteration) of 400 "
         "unknowns finds the system singular: 1 of its unknowns are not determined",
         "; tie all nodes to the boundary data: raise the horizon or refine"}); // though a solution
                                                                                // exists
    system.right_hand_side.assign(system.right_hand_side.size(), 1);
    for (const auto solver : solvers)
    {
      options.solver = solver;
      expect_error(system, options, {"singular"});
    }
    options.iteration = Iteration::bicgstab;
    expect_error(system, options, {"singular"});
  }
}

TEST(SparseSystem, ValuesThatAreNotFiniteAreErrorsThatNameTheRow)
{
  const System sound = known({20, 3.2, 2, true, true});
  for (const auto solver : solvers)
  {
    SparseOptions options = with(solver);
    options.n_components = 2;
    System system = sound;
    system.right_hand_side[417] = std::numeric_limits<double>::quiet_NaN();
    expect_error(system, options, {"row 417", "node 208", "component 1", "finite"});
    system = sound;
    system.rows.value[system.rows.start[30]] = std::numeric_limits<double>::infinity();
    expect_error(system, options, {"row 30", "finite"});
  }
}

TEST(SparseSystem, ARowWithoutEntriesIsAnErrorThatNamesIt)
{
  System system{{{0, 1, 1, 2}, {0, 2}, {1, 1}}, {1, 1, 1}};
  for (const auto solver : solvers)
    expect_error(system, with(solver), {"row 1", "no entries"});
}

TEST(SparseSystem, AMissingDiagonalIsSolvedDirectlyAndRefusedByIterations)
{
  const System swap{{{0, 1, 2}, {1, 0}, {2, 4}}, {6, 4}};
  SparseOptions options = with(SparseSolver::direct);
  options.is_symmetric = false;
  EXPECT_LE(distance(solve(swap, options).values, {1, 3}), 1e-15);
  for (const auto solver : {SparseSolver::amg, SparseSolver::jacobi})
    expect_error(swap, with(solver),
                 {"row 0", "no diagonal entry", "; write Solver/linear solver = direct"});
}

TEST(SparseSystem, FewerUnknownsThanRanksAreSolved)
{
  const System one{{{0, 1}, {0}, {4}}, {8}};
  const System three{{{0, 2, 5, 7}, {0, 1, 0, 1, 2, 1, 2}, {2, -1, -1, 2, -1, -1, 2}}, {1, 0, 1}};
  for (const auto solver : solvers)
    for (const auto spread : {Spread::by_shares, Spread::on_last, Spread::split})
    {
      EXPECT_LE(distance(solve(one, with(solver), Communicator::all(), spread).values, {2}), 1e-14);
      EXPECT_LE(distance(solve(three, with(solver), Communicator::all(), spread).values, {1, 1, 1}),
                1e-12);
    }
}

TEST(SparseSystem, ZeroDataGiveZero)
{
  System system = known({20, 3.2, 1, true, true});
  system.right_hand_side.assign(400, 0);
  for (const auto solver : solvers)
    for (const auto iteration : {Iteration::cg, Iteration::gmres, Iteration::bicgstab})
    {
      SparseOptions options = with(solver);
      options.iteration = iteration;
      const SparseSolution solution = solve(system, options);
      EXPECT_EQ(norm(solution.values), 0);
      EXPECT_EQ(solution.relative_residual, 0);
    }
}

TEST(SparseSystem, TooFewIterationsAreAnErrorThatSaysHowFarTheyCame)
{
  for (const bool is_symmetric : {true, false})
  {
    SparseOptions options = with(SparseSolver::jacobi);
    options.is_symmetric = is_symmetric;
    options.max_iterations = 5;
    expect_error(known({20, 3.2, 1, is_symmetric, true}), options,
                 {std::string("the sparse solver '") + (is_symmetric ? "cg" : "gmres") +
                      " + jacobi' (Solver/linear solver, Solver/iteration) of 400 unknowns stops "
                      "after 5 iterations, of 5 allowed (Solver/max iterations), at the relative "
                      "residual ",
                  "wanted 1e-12 (Solver/tolerance); allow more, or write Solver/linear solver = "
                  "direct; where they do not get on the system is singular"});
  }
}

#ifndef __SANITIZE_ADDRESS__ // which takes all of the address space
TEST(SparseSystem, FactorsThatDoNotFitAreRefusedBeforeTheyAreMade)
{
  const auto system = known({300, 3.2, 1, true, true});
  const LittleMemory some(200'000'000); // the factors take 330 MB and more, on four ranks, too
  expect_error(system, with(SparseSolver::direct),
               {"90000 unknowns", "for its factors: needs some ", "Solver/linear solver = amg"});
}
#endif
