#pragma once

#include "report/json_lines.h"
#include "study/standing_crack.h"

#include <filesystem>
#include <string>
#include <vector>

namespace plumbline::report
{
  /// What is finished of a run of strips while it goes on: strip.jsonl, its scene in the first line
  /// and then a line for each strip. Numbers read back to the same bits.
  class StripJournal
  {
  public:
    /// @param scene_text  as read; strips of another scene, or of another version, are not taken
    StripJournal(const std::filesystem::path &folder, const std::string &scene_text);

    /// What was finished before; a last line that is not whole is left out.
    const std::vector<study::StripRow> &earlier() const { return earlier_; }

    /// @throws InputError  the file cannot be written
    void append(const study::StripRow &row);

    /// The run has come to its end, and strip.json holds everything.
    void remove() const { lines_.remove(); }

  private:
    JsonLines lines_;
    std::string head_; ///< empty once it is written
    std::vector<study::StripRow> earlier_;
  };
} // namespace plumbline::report
