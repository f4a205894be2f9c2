#pragma once

#include "analysis/record.h"

#include <filesystem>

namespace plumbline::io
{
  /// A field at points in 64-bit floating point that reads back to the same bits, as "u"; of more
  /// than two components each as "u1", "u2" and so on.
  /// @throws InputError  the file cannot be written
  void write_vtu(const analysis::PointField &field, const std::filesystem::path &file);
} // namespace plumbline::io
