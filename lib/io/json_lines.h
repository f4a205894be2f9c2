#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace plumbline::io
{
  /// What is finished of a command while it goes on: a file with a line of JSON for each result,
  /// so that one that is killed loses nothing and n results cost O(n).
  class JsonLines
  {
  public:
    /// Nothing is written yet.
    explicit JsonLines(std::filesystem::path file) : file_(std::move(file)) {}

    /// Append to the existing file, which several processes do at the same time.
    void join() { is_begun_ = true; }

    /// Append whole lines. The first call replaces an existing file, unless it was joined. A
    /// last line that a kill has truncated is removed.
    /// @throws InputError  the file cannot be written
    void append(const std::string &lines);

    /// The command has ended, and another file holds everything.
    void remove() const;

    const std::filesystem::path &file() const { return file_; }

  private:
    std::filesystem::path file_;
    bool is_begun_ = false;
  };

  /// The lines of such a file, none if it is not there. What ends without a line break was cut off
  /// and is left out.
  std::vector<std::string> read_lines(const std::filesystem::path &file);
} // namespace plumbline::io
