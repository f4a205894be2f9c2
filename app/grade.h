#pragma once

#include <string>
#include <vector>

namespace plumbline::app
{
  constexpr auto sizes_option = "--h";

  struct GradeOptions
  {
    std::vector<std::string> files; ///< see io::read_values()
    std::string problem;            ///< see io::certificate_of()
    std::vector<std::string> h; ///< mesh size of each file, separated as base::to_numbers() says
    std::vector<std::string> required;        ///< digits=N, order=P, limit=certified
    bool is_points = false, is_scene = false; ///< print these of the problem, and grade nothing
    bool quiet = false;
  };

  /// Grade another code's values by a certificate, see study::grade, and print the answer last.
  /// @return  exit code: 0; 1: a requirement does not hold
  /// @throws InputError  files or options that cannot be used; points that are not those of the
  /// certificate
  int grade(const GradeOptions &options);
} // namespace plumbline::app
