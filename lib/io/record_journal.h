#pragma once

#include "io/json_lines.h"
#include "study/study_results.h"

#include <filesystem>
#include <string>

namespace plumbline::io
{
  /// What is finished of a study while it goes on: a file whose first line has everything that its
  /// records depend on, and then a line for each call of append(). Records read back to the same
  /// bits.
  class RecordJournal
  {
  public:
    /// @param subject  what records depend on, e.g. the scene as read; those of another subject, or
    /// of another version, are not taken over
    RecordJournal(const std::filesystem::path &file, const std::string &subject);

    /// What was finished before; an incomplete last line is left out.
    const study::StudyResults &earlier() const { return earlier_; }
    void forget() { earlier_ = {}; } ///< that: it is made again

    /// Records and the statements that came with them, as RunControl::on_made gives them: a kill
    /// leaves all of them or none. The first call replaces what was there by the same.
    /// @throws InputError  the file cannot be written
    void append(const study::StudyResults &made);

    /// This process appends to the file together with others, one of which has created it.
    void join();

    /// The study is complete, and other files hold everything.
    void remove() const { lines_.remove(); }

  private:
    JsonLines lines_;
    std::string head_; ///< empty once it is written
    study::StudyResults earlier_;
  };

  /// What a journal holds, whatever its subject; an incomplete last line is left out.
  /// @throws InputError  no such file, another version, or a line that has no results
  study::StudyResults read_journal(const std::filesystem::path &file);

  /// Where results of `plumbline run` are: the journal of one that goes on, was interrupted or
  /// killed, else results.json.
  std::filesystem::path results_file(const std::filesystem::path &folder);

  /// What is known of them: that file, or results.json where it holds as many records, as after an
  /// interrupt.
  /// @throws InputError  as read_journal and read_results
  study::StudyResults results_in(const std::filesystem::path &folder);
} // namespace plumbline::io
