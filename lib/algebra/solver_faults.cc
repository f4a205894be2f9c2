#include "algebra/solver_faults.h"

#include <algorithm>
#include <array>
#include <sstream>

namespace plumbline::algebra
{
  namespace
  {
    template <std::size_t n>
    bool is_one_of(const std::array<int, n> &codes, int code)
    {
      return std::find(codes.begin(), codes.end(), code) != codes.end();
    }

    constexpr std::array no_memory = {-5, -7, -13, -19};
    constexpr std::array no_room = {-8, -9, -11, -12, -14, -15, -17, -18, -20};

    bool is_frame(const std::string &line)
    {
      return line.empty() || line.find_first_not_of("- ") == std::string::npos;
    }
  } // namespace

  std::string mumps_fault(int code, int detail)
  {
    std::string what = "does not end well; write Solver/linear solver = amg";
    if (code == -6 || code == -10)
      what = "finds the matrix singular; tie all nodes to the boundary data: raise the horizon or "
             "refine";
    else if (is_one_of(no_memory, code))
      what = "runs out of memory for the factors; write Solver/linear solver = amg, take larger h "
             "(Study/h), or a machine with more";
    else if (is_one_of(no_room, code))
      what = "needs more room for pivots than it has made; write Solver/linear solver = amg";
    else if (code == -1)
      what = "fails on another rank; see what that one says";
    return what + " (MUMPS' error " + std::to_string(code) + ", " + std::to_string(detail) + ")";
  }

  std::string iteration_fault(unsigned int n_iterations, unsigned int most_iterations,
                              double residual, double tolerance)
  {
    std::ostringstream message;
    const bool is_broken = n_iterations < most_iterations;
    message << (is_broken ? "breaks down after " : "stops after ") << n_iterations
            << " iterations, of " << most_iterations
            << " allowed (Solver/max iterations), at the relative residual " << residual
            << ", wanted " << tolerance
            << " (Solver/tolerance); allow more, or write Solver/linear solver = direct; where "
               "they do not get on the system is singular: tie all nodes to the boundary data, "
               "raise the horizon or refine";
    return message.str();
  }

  std::string library_fault(const std::string &text)
  {
    std::istringstream lines(text);
    std::string first;
    // deal.II's frame of dashes, and where in its sources, say nothing to users
    for (std::string line; first.empty() && std::getline(lines, line);)
    {
      line.erase(0, std::min(line.find_first_not_of(" \t"), line.size()));
      if (!is_frame(line) && line.compare(0, 20, "An error occurred in") != 0)
        first = line;
    }
    return "a library that it uses gives up; write another Solver/linear solver (direct, amg or "
           "jacobi)" +
           (first.empty() ? "" : " (it says: " + first + ")");
  }
} // namespace plumbline::algebra
