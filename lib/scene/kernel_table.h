#pragma once

#include <array>
#include <string>
#include <vector>

namespace plumbline::scene
{
  /// A radial profile from a file with the columns t = r / horizon and rho, shape (n_rows, 2).
  /// @throws InputError  as base::Csv
  std::vector<std::array<double, 2>> read_kernel_table(const std::string &file);
} // namespace plumbline::scene
