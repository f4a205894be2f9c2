#pragma once

#include "report/data_charts.h"
#include "scene/scene.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

/// Toughness of a random two-phase material over the fraction of one phase, by samples of several
/// rules: Fan et al. 2022, doi:10.1016/j.cma.2022.115340, figure 8.
namespace plumbline::toughness
{
  namespace fs = std::filesystem;

  /// K of one kind over the samples of a run.
  struct Toughness
  {
    double mean = 0;                 ///< [force/length^1.5]
    std::optional<double> deviation; ///< none where the rule's variance is negative
    double standard_error = 0;       ///< of the mean of independent samples; 0: not known
  };

  /// `plumbline sample` at one fraction by one rule.
  struct Entry
  {
    double fraction = 0;
    std::string rule; ///< "Monte Carlo", or "Smolyak, 20 modes"
    std::size_t n_samples = 0, n_missing = 0;
    double seconds = 0;                           ///< CPU time
    std::optional<double> variance_kept;          ///< by modes
    std::optional<Toughness> by_bonds, by_energy; ///< none: too few samples yet
  };

  /// What needs no sample.
  struct Baselines
  {
    /// √(G E/(1 - ν²)) of each phase alone, R = 0 and 1.
    double first = 0, second = 0;
    /// Means of G and of E/(1 - ν²) over the phases: those of the mean material.
    double first_G = 0, second_G = 0, first_modulus = 0, second_modulus = 0;

    /// The straight line between the phases, which experiments are said to follow (Fan et al. 2022,
    /// section 5).
    double mixture(double fraction) const;
    /// √(Ḡ Ē), eqs. (5.2), (5.3) of a straight crack through the mean material.
    double mean_field(double fraction) const;
  };
  Baselines baselines(const scene::Scene &scene);

  /// A crack in one microstructure, as `plumbline grow` draws it.
  struct Crack
  {
    double fraction = 0;
    unsigned int realisation = 1;              ///< which sample's microstructure
    std::optional<double> by_bonds, by_energy; ///< K [force/length^1.5]; none: nothing broke
    fs::path picture;
  };

  struct Study
  {
    std::string scene_name;
    Baselines baselines;
    std::vector<Entry> entries; ///< by rule, then fraction
    std::vector<Crack> cracks;  ///< by fraction
  };

  /// All folders FOLDER/*/ with a sample.json, or a grow.html that says that grow.json and its
  /// picture are there.
  /// @throws InputError  there are no samples, or a file that cannot be read
  Study read_study(const fs::path &folder);

  report::Table study_table(const Study &study);

  /// K by bonds and K by energy over the fraction.
  std::vector<report::DataChart> study_charts(const Study &study);
} // namespace plumbline::toughness
