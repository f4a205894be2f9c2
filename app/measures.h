#pragma once

#include "meshfree/rules/rules.h"
#include "report/row_journal.h"
#include "run_parts.h"
#include "scene/scene.h"

#include <filesystem>
#include <functional>
#include <iostream>
#include <vector>

// What the commands that measure operators, and solve nothing, have in common.
namespace plumbline::app
{
  struct MeasureOptions
  {
    std::string scene_file, output; ///< output empty: results/NAME of the scene
    std::vector<scene::Override> overrides;
    std::string methods; ///< comma separated, instead of the scene's
    unsigned int n_levels = 0;
    bool quiet = false, json = false;
  };

  /// The scene with its overrides, without a reference: nothing is held against one.
  scene::Scene read_alone(const MeasureOptions &options);

  std::filesystem::path output_folder(const MeasureOptions &options, const scene::Scene &scene);

  /// @throws InputError  no meshfree rule; cracks are open to those alone
  meshfree::Rule find_rule(const std::string &name);

  using ShouldStop = std::function<bool()>; ///< empty: never

  /// The first n_levels of each series, coarse to fine; 0: all.
  /// @param should_stop  asked before each
  void for_each_level(
      const scene::Scene &scene, unsigned int n_levels,
      const std::function<void(const problem::Series &, const problem::Level &, bool is_finest)> &visit,
      const ShouldStop &should_stop = {});

  /// The same, noting that it said so, and saying so from then on.
  /// @param is_complete  outlives it
  ShouldStop noting(const ShouldStop &should_stop, bool &is_complete);

  /// How rows are measured one after another.
  template <class Row>
  struct MeasureControl
  {
    ShouldStop should_stop; ///< asked before each method at each level
    /// Called with what is measured of one method at one level.
    std::function<void(const std::vector<Row> &)> on_rows;
    std::vector<Row> earlier; ///< that need not be measured again
  };

  /// Those of a method at a level, in their order; none if they are not there.
  /// @param is_of  whether a row is the method's
  template <class Row, class IsOf>
  std::vector<Row> known_rows(const std::vector<Row> &earlier, const std::string &series,
                              const problem::Level &level, const IsOf &is_of)
  {
    std::vector<Row> known;
    for (const Row &row : earlier)
      if (row.series == series && row.h == level.h && row.horizon == level.horizon && is_of(row))
        known.push_back(row);
    return known;
  }

  /// What an interrupted command of the same subject left in a file.
  template <class Row>
  report::RowJournal<Row> open_journal(const std::filesystem::path &file,
                                       const std::string &subject, bool is_quiet)
  {
    report::RowJournal<Row> journal(file, subject);
    if (!journal.earlier().empty() && !is_quiet)
      std::cerr << "continuing: " << journal.earlier().size() << " rows are in '" << file.string()
                << "' already\n";
    return journal;
  }
} // namespace plumbline::app
