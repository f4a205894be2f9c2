#pragma once

#include "check/in_space.h"
#include "study/analysis.h"

#include <filesystem>

namespace plumbline::check
{
  /// Whether names of files stand for a series, one for each mesh size: nodes_{h}.csv.
  /// @throws InputError  one of the names does, the other does not
  bool is_series(const Input &input);

  /// The levels of a scene's only series that both files are there for.
  struct LevelFiles
  {
    scene::Scene scene; ///< with these levels, and an error that a check takes
    std::vector<problem::Level> levels;
    std::vector<Input> inputs; ///< of each level
    std::string missing;       ///< names of files of levels that are left out, each in quotes
  };

  /// @throws InputError  several series of levels, less than two levels with files
  LevelFiles find_level_files(const scene::Scene &scene, const Input &input);

  /// All that the records of a series depend on; empty: one of its files cannot be read again.
  std::string subject_of(const LevelFiles &files);

  /// What is found of the weights of each level, and what the errors of the solutions by them say
  /// together: rates, and whether they converge to the limit. In space nothing is solved.
  struct Series
  {
    std::vector<Findings<2>> levels;
    std::vector<Findings<3>> levels_in_space; ///< instead of those
    study::StudyResults results;
    std::vector<study::Trend> trends; ///< of the weights, by the error that decides
    std::string assumed;              ///< see assumptions()
  };

  /// The study of these levels by find() or find_in_space(), one after the other; those before an
  /// interrupt. Solutions whose records an earlier run has left are not computed again.
  /// @param references  as of find(), whose errors it throws
  Series find_series(const LevelFiles &files, const method::Methods &references,
                     const study::RunControl &control);

  /// Of all levels, and 'required ac' where the errors stall.
  std::vector<std::string> complaints(const Series &found, const Requirements &required);

  /// A row for each level and the verdicts; the answer last.
  /// @param page  of the report
  std::string text(const Series &found, const Requirements &required, const std::string &page);

  std::string to_json(const Series &found, const LevelFiles &files, const Requirements &required);

  /// check.json, levels.csv and a page for each level; in the plane that of the study with charts
  /// over h, too.
  void write_series(const Series &found, const LevelFiles &files, const Requirements &required,
                    const std::filesystem::path &folder);
} // namespace plumbline::check
