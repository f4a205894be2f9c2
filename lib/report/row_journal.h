#pragma once

#include "io/json_lines.h"

#include <filesystem>
#include <string>
#include <vector>

namespace plumbline::report
{
  /// What is finished of a command that measures level by level, while it goes on: a file whose
  /// first line has what all rows depend on, and then a line for each row. Numbers read back to the
  /// same bits. Of study::StripRow.
  template <class Row>
  class RowJournal
  {
  public:
    /// @param subject  what rows depend on, e.g. the scene as read; rows of another one, or of
    /// another version, are not taken
    RowJournal(const std::filesystem::path &file, const std::string &subject);

    /// What was finished before; a last line that is not whole is left out.
    const std::vector<Row> &earlier() const { return earlier_; }

    /// Those that stand together are written at once.
    /// @throws InputError  the file cannot be written
    void append(const std::vector<Row> &rows);

    /// The command has come to its end, and other files hold everything.
    void remove() const { lines_.remove(); }

  private:
    io::JsonLines lines_;
    std::string head_; ///< empty once it is written
    std::vector<Row> earlier_;
  };
} // namespace plumbline::report
