#pragma once

#include "report/data_charts.h"
#include "report/template.h"

#include <filesystem>
#include <string>
#include <vector>

/// What pages are made of: data for the templates of the same names.
namespace plumbline::report::page
{
  /// A small picture of a method's line and symbol, as in the charts: HTML.
  std::string marker(const Style &style);

  /// A picture to stand inside a page: without its prologue, its ids made unique by the prefix, and
  /// a label for those who cannot see it.
  std::string inline_svg(const std::string &svg, const std::string &prefix,
                         const std::string &label);

  /// The picture of a file, empty where there is none.
  std::string inline_svg(const std::filesystem::path &picture, const std::string &prefix,
                         const std::string &label);

  /// The fact that results are not all that was asked for.
  inline constexpr const char *interrupted = "interrupted: what was finished";

  /// For `begin`: what every page has; what stands there besides may be set afterwards.
  /// @param page  what it is, e.g. "strip"
  Data begin(const std::string &page, const std::string &scene_name, const std::string &purpose,
             const std::vector<std::string> &facts);

  /// For `table`; null where there are no rows.
  Data table(const Table &table);

  /// For `figure`.
  struct Figure
  {
    std::filesystem::path picture;
    std::string prefix; ///< of its ids on the page, e.g. "c1-"
    std::string title, caption;
    std::string source, file; ///< e.g. "Data", and where they are
    bool is_large = false;
    std::string again = "run again"; ///< what to do where it is not drawn
  };
  Data figure(const Figure &figure);

  /// For `grid`: charts from a folder of the page's own, with their data.
  Data charts(const std::vector<DataChart> &charts, const std::filesystem::path &dir,
              const std::string &folder);

  /// How many of the scene's expectations hold; those that do not are shown, the others folded.
  /// Null where there are none.
  Data expectations(const study::StudyResults &results);

  /// Of its table, without ending.
  std::string file_of(const Part &part);

  /// It has rows, words or a list.
  bool is_shown(const Part &part);

  /// Those whose table has rows.
  std::vector<Part> with_rows(std::vector<Part> parts);

  /// For `part`: those that are shown.
  /// @param folder  where write_study writes the tables; empty: they are in no files
  Data parts(const std::vector<Part> &parts, const std::string &folder = {});
} // namespace plumbline::report::page
