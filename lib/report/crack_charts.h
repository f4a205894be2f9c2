#pragma once

#include "report/formats.h"
#include "study/crack.h"

#include <filesystem>
#include <string>
#include <vector>

namespace plumbline::report
{
  /// One picture of a crack, crack/NAME.svg.
  struct CrackPicture
  {
    std::string name, title, caption;
    std::string file; ///< its data
    bool is_large = false;
  };

  /// tip (over time, beside a Rayleigh wave), speed, energies, moments: the damage at six times.
  std::vector<CrackPicture> crack_pictures();

  /// Tip and energies over time, a row a sample.
  Table crack_samples_table(const study::CrackResults &results);

  /// Write crack/samples.csv and all pictures; charts.gp draws them again.
  /// @throws InputError  dir cannot be written
  /// @throws NumericalError  gnuplot is missing or fails
  void write_crack_pictures(const study::CrackResults &results, const std::filesystem::path &dir);
} // namespace plumbline::report
