#include "algebra/sparse_system.h"

#include "base/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace plumbline;
using namespace plumbline::algebra;
using base::Team;

namespace
{
  const auto solvers = {SparseSolver::direct, SparseSolver::amg, SparseSolver::jacobi};

  struct Lattice
  {
    int n = 20;         ///< nodes a side
    double reach = 3.2; ///< horizon over spacing
    unsigned int n_components = 1;
    bool is_symmetric = true; ///< else weights that differ by direction and node
    bool is_tied = true;      ///< to a collar of zero values
  };

  /// Σ_j w(r) e⊗e (u(i) - u(j)) with w = 1 - r/δ; e is 1 for one component, else the bond's
  /// direction.
  Rows matrix(const Lattice &lattice)
  {
    const int n = lattice.n, reach = static_cast<int>(lattice.reach);
    const unsigned int n_components = lattice.n_components;
    Rows rows;
    rows.start = {0};
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        for (unsigned int c = 0; c < n_components; ++c)
        {
          std::vector<double> own(n_components);
          std::size_t own_entry = 0;
          for (int l = -reach; l <= reach; ++l)
            for (int k = -reach; k <= reach; ++k)
            {
              const double r = std::hypot(k, l);
              const bool is_inside = i + k >= 0 && i + k < n && j + l >= 0 && j + l < n;
              if (r > lattice.reach || !(is_inside || lattice.is_tied))
                continue;
              const double bias = lattice.is_symmetric ? 0 : .4 * std::sin(i + 2. * j + 3 * k + l);
              const double w = (1 - r / lattice.reach) * (1 + bias);
              if (r == 0)
                own_entry = rows.value.size();
              for (unsigned int d = 0; d < n_components; ++d)
              {
                const double e[] = {k / r, l / r};
                const double a = r == 0 ? 0 : n_components == 1 ? w : w * e[c] * e[d];
                own[d] += a;
                if (is_inside)
                {
                  rows.column.push_back(n_components * ((j + l) * n + i + k) + d);
                  rows.value.push_back(-a);
                }
              }
            }
          for (unsigned int d = 0; d < n_components; ++d)
            rows.value[own_entry + d] = own[d];
          rows.start.push_back(rows.value.size());
        }
    return rows;
  }

  std::vector<double> times(const Rows &rows, const std::vector<double> &x)
  {
    std::vector<double> y(rows.n_rows());
    for (std::size_t i = 0; i < y.size(); ++i)
      for (std::size_t e = rows.start[i]; e < rows.start[i + 1]; ++e)
        y[i] += rows.value[e] * x[rows.column[e]];
    return y;
  }

  std::vector<double> wave(std::size_t n)
  {
    std::vector<double> x(n);
    for (std::size_t i = 0; i < n; ++i)
      x[i] = std::sin(.01 * static_cast<double>(i)) + .3 * std::cos(1.7 * static_cast<double>(i));
    return x;
  }

  double norm(const std::vector<double> &x)
  {
    double sum = 0;
    for (const double value : x)
      sum += value * value;
    return std::sqrt(sum);
  }

  double distance(std::vector<double> x, const std::vector<double> &y)
  {
    for (std::size_t i = 0; i < x.size(); ++i)
      x[i] -= y[i];
    return norm(x);
  }

  struct System
  {
    Rows rows;
    std::vector<double> right_hand_side;
  };

  enum class Spread
  {
    by_shares,
    on_last,
    split ///< every entry among all ranks
  };

  /// This rank's part of a system that all ranks know.
  System part(const System &whole, Spread spread, unsigned int n_components, const Team &team)
  {
    const unsigned int rank = team.rank(), n_ranks = team.n_ranks();
    const auto [first, last] = team.share(whole.right_hand_side.size() / n_components);
    System part{{{0}, {}, {}}, whole.right_hand_side};
    for (std::size_t i = 0; i < whole.rows.n_rows(); ++i)
    {
      const std::size_t node = i / n_components;
      double factor = 2. * (rank + 1) / (n_ranks * (n_ranks + 1));
      if (spread == Spread::by_shares)
        factor = first <= node && node < last;
      else if (spread == Spread::on_last)
        factor = rank + 1 == n_ranks;
      part.right_hand_side[i] *= factor;
      for (std::size_t e = whole.rows.start[i]; factor != 0 && e < whole.rows.start[i + 1]; ++e)
      {
        part.rows.column.push_back(whole.rows.column[e]);
        part.rows.value.push_back(factor * whole.rows.value[e]);
      }
      part.rows.start.push_back(part.rows.column.size());
    }
    return part;
  }

  SparseSolution solve(const System &system, const SparseOptions &options,
                       const Team &team = Team::all(), Spread spread = Spread::by_shares)
  {
    const System own = part(system, spread, options.n_components, team);
    return solve_sparse(own.rows, own.right_hand_side, options, team);
  }

  System known(const Lattice &lattice)
  {
    const Rows rows = matrix(lattice);
    return {rows, times(rows, wave(rows.n_rows()))};
  }

  SparseOptions with(SparseSolver solver)
  {
    SparseOptions options;
    options.solver = solver;
    return options;
  }

  /// Fails unless every rank gets a NumericalError that says all of the words.
  void expect_error(const System &system, const SparseOptions &options,
                    const std::vector<std::string> &words)
  {
    try
    {
      const System own = part(system, Spread::by_shares, options.n_components, Team::all());
      solve_sparse(own.rows, own.right_hand_side, options, Team::all());
      ADD_FAILURE() << "no error";
    }
    catch (const NumericalError &error)
    {
      for (const auto &word : words)
        EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
  }
} // namespace

TEST(Team, SharesCoverEverythingInOrderAndDifferByAtMostOne)
{
  const Team team = Team::all();
  for (const std::size_t n : {0, 1, 2, 3, 7, 1000, 1003})
  {
    const auto [first, last] = team.share(n);
    std::vector<unsigned long> firsts(team.n_ranks()), lasts(team.n_ranks());
    MPI_Allgather(&first, 1, MPI_UNSIGNED_LONG, firsts.data(), 1, MPI_UNSIGNED_LONG,
                  team.communicator);
    MPI_Allgather(&last, 1, MPI_UNSIGNED_LONG, lasts.data(), 1, MPI_UNSIGNED_LONG,
                  team.communicator);
    EXPECT_EQ(firsts.front(), 0u);
    EXPECT_EQ(lasts.back(), n);
    for (unsigned int r = 0; r < team.n_ranks(); ++r)
    {
      EXPECT_EQ(lasts[r], r + 1 < team.n_ranks() ? firsts[r + 1] : n);
      EXPECT_GE(lasts[r] - firsts[r], n / team.n_ranks());
      EXPECT_LE(lasts[r] - firsts[r], n / team.n_ranks() + 1);
    }
  }
  EXPECT_EQ(Team::alone().n_ranks(), 1u);
  EXPECT_EQ(Team::alone().rank(), 0u);
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
        const SparseSolution alone = solve(system, options, Team::alone());
        EXPECT_LE(distance(alone.values, exact), 1e-12 * norm(exact)) << alone.solver;
        EXPECT_EQ(alone.n_iterations == 0, solver == SparseSolver::direct);
        for (const auto spread : {Spread::by_shares, Spread::on_last, Spread::split})
        {
          const SparseSolution all = solve(system, options, Team::all(), spread);
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
  EXPECT_GE(solution.bytes, 12 * solution.n_nonzeros / Team::all().n_ranks() / 2);
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
    for (const std::string name : {"gmres", "bicgstab"})
    {
      SparseOptions options = with(solver);
      options.iteration = iteration_from_name(name);
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
    expect_error(system, options, {"singular", "1 of its unknowns"}); // though a solution exists
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
    expect_error(swap, with(solver), {"row 0", "diagonal"});
}

TEST(SparseSystem, FewerUnknownsThanRanksAreSolved)
{
  const System one{{{0, 1}, {0}, {4}}, {8}};
  const System three{{{0, 2, 5, 7}, {0, 1, 0, 1, 2, 1, 2}, {2, -1, -1, 2, -1, -1, 2}}, {1, 0, 1}};
  for (const auto solver : solvers)
    for (const auto spread : {Spread::by_shares, Spread::on_last, Spread::split})
    {
      EXPECT_LE(distance(solve(one, with(solver), Team::all(), spread).values, {2}), 1e-14);
      EXPECT_LE(distance(solve(three, with(solver), Team::all(), spread).values, {1, 1, 1}), 1e-12);
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
                 {"after 5 iterations", "wanted 1e-12"});
  }
}

TEST(SparseSystem, UnknownSolverNamesAreInputErrorsThatListTheKnown)
{
  EXPECT_EQ(sparse_solver_from_name("amg"), SparseSolver::amg);
  EXPECT_EQ(sparse_solver_from_name("automatic"), SparseSolver::automatic);
  try
  {
    sparse_solver_from_name("multigrid");
    FAIL();
  }
  catch (const InputError &error)
  {
    EXPECT_NE(std::string(error.what()).find("'multigrid'"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("jacobi"), std::string::npos);
  }
  EXPECT_EQ(iteration_from_name("bicgstab"), Iteration::bicgstab);
  EXPECT_THROW(iteration_from_name("minres"), InputError);
}
