#include "driver/writable.h"

#include "base/text_file.h"

#include <fstream>

namespace plumbline::driver
{
  namespace fs = std::filesystem;

  void require_writable(const fs::path &file)
  {
    const bool is_there = fs::exists(file);
    if (!std::ofstream(file, std::ios::app))
      base::write_file(file, ""); // tells why not
    if (!is_there)
      fs::remove(file);
  }
} // namespace plumbline::driver
