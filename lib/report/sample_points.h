#pragma once

#include "study/sampling.h"

#include <filesystem>

namespace plumbline::report
{
  /// A row for each sample: its number, the values of the variables, and its weight in each set of
  /// samples (empty where the set does not take it). A statistic is the sum of weight times value
  /// over the rows.
  void write_sample_points(const study::SamplingPlan &plan,
                           const std::vector<std::string> &variables,
                           const std::filesystem::path &file);

  /// A row for each node of the field's grid: x, y [length], mean and standard deviation [u], and
  /// the modes √λ_k φ_k [u], of which the field is mean + Σ_k ξ_k (mode k).
  /// @param origin  of the grid's coordinates, see scene::DomainSection
  void write_modes(const uq::Expansion &expansion, const dealii::Point<2> &origin,
                   const std::filesystem::path &file);
} // namespace plumbline::report
