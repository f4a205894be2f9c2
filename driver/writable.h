#pragma once

#include <filesystem>

namespace plumbline::driver
{
  /// So that no work is lost at the end.
  /// @throws NumericalError  the file cannot be written
  void require_writable(const std::filesystem::path &file);
} // namespace plumbline::driver
