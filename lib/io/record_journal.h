#pragma once

#include "analysis/record.h"
#include "io/json_lines.h"

#include <filesystem>
#include <string>

namespace plumbline::io
{
  /// What is finished of a study while it goes on: a file whose first line has everything that its
  /// records depend on, and then a line for each record. Records read back to the same bits.
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

    /// The study is complete, and other files hold everything.
    void remove() const { lines_.remove(); }

  private:
    JsonLines lines_;
    std::string head_; ///< empty once it is written
    analysis::Records earlier_;
  };
} // namespace plumbline::io
