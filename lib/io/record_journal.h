#pragma once

#include "io/json_lines.h"
#include "study/study_results.h"

#include <cstddef>
#include <filesystem>
#include <string>

namespace plumbline::io
{
  /// What is finished of a study while it goes on: a file whose first line has everything that its
  /// records depend on, and then a line for each record, and for estimates, maps and other
  /// statements that came with records. Records read back to the same bits.
  class RecordJournal
  {
  public:
    /// @param subject  what records depend on, e.g. the scene as read; those of another subject, or
    /// of another version, are not taken over
    RecordJournal(const std::filesystem::path &file, const std::string &subject);

    /// What was finished before; an incomplete last line is left out.
    const analysis::Records &earlier() const { return earlier_; }

    /// Written at once: they belong together.
    /// @throws InputError  the file cannot be written
    void append(const analysis::Records &records);

    /// All that is found so far: what lists have beyond those of the last call is written. The
    /// first call replaces what was there, and holds the scene, too.
    /// @throws InputError  the file cannot be written
    void append(const study::StudyResults &results);

    /// The study is complete, and other files hold everything.
    void remove() const { lines_.remove(); }

  private:
    /// Of the lists that grow.
    struct Sizes
    {
      std::size_t records = 0, left_out = 0, references = 0, estimates = 0, savings = 0, maps = 0;
      bool operator==(const Sizes &other) const;
    };
    static Sizes sizes_of(const study::StudyResults &results);

    JsonLines lines_;
    std::string head_; ///< empty once it is written
    analysis::Records earlier_;
    Sizes written_;
  };

  /// What a journal holds, whatever its subject; an incomplete last line is left out.
  /// @throws InputError  no such file, another version, or a line that is neither a record nor
  /// statements
  study::StudyResults read_journal(const std::filesystem::path &file);

  /// The journal of a `plumbline run` that goes on or was killed, else its results.json.
  std::filesystem::path results_file(const std::filesystem::path &folder);

  /// What that file holds.
  /// @throws InputError  as read_journal and read_results
  study::StudyResults results_in(const std::filesystem::path &folder);
} // namespace plumbline::io
