#pragma once

#include "analysis/record.h"

#include <filesystem>

namespace plumbline::io
{
  /// A field of one or two components at points, as "u".
  /// @throws InputError  the file cannot be written
  void write_vtu(const analysis::PointField &field, const std::filesystem::path &file);
} // namespace plumbline::io
