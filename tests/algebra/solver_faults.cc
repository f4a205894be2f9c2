#include "algebra/solver_faults.h"

#include <gtest/gtest.h>

using namespace plumbline::algebra;

TEST(SolverFaults, of_mumps_are_said_in_words_with_a_remedy)
{
  const auto expect = [](int code, const std::string &words)
  {
    const std::string fault = mumps_fault(code, 7);
    EXPECT_EQ(fault.find(words), 0u) << fault;
    const std::string own = " (MUMPS' error " + std::to_string(code) + ", 7)";
    EXPECT_EQ(fault.find(own), fault.size() - own.size()) << fault;
  };
  for (const int code : {-6, -10})
    expect(code, "finds the matrix singular; tie all nodes to the boundary data: raise");
  for (const int code : {-5, -7, -13, -19})
    expect(code, "runs out of memory for the factors; write Solver/linear solver = amg, take");
  for (const int code : {-8, -9, -17, -20})
    expect(code, "needs more room for pivots than it has made; write Solver/linear solver = amg");
  expect(-1, "fails on another rank");
  expect(-90, "does not end well; write Solver/linear solver = amg");
}

TEST(SolverFaults, of_libraries_are_a_remedy_and_then_their_first_line)
{
  const std::string remedy = "a library that it uses gives up; write another Solver/linear solver "
                             "(direct, amg or jacobi)";
  EXPECT_EQ(library_fault(""), remedy);
  EXPECT_EQ(library_fault("------\n  \nAn error occurred in line <5> of file <a.cc>\n"
                          "   The matrix has no columns.\nStacktrace\n"),
            remedy + " (it says: The matrix has no columns.)");
  EXPECT_EQ(library_fault("Trilinos' error code -3"),
            remedy + " (it says: Trilinos' error code -3)");
}
