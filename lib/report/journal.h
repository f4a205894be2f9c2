#pragma once

#include "io/json_lines.h"
#include "study/results.h"

#include <cstddef>
#include <filesystem>

namespace plumbline::report
{
  /// What is finished while a run is going on: results.jsonl, a line for each solve with what came
  /// with it, in the form of results.json (schema.md).
  class Journal
  {
  public:
    /// @param folder  of the run; nothing is written yet
    explicit Journal(const std::filesystem::path &folder) : lines_(folder / "results.jsonl") {}

    /// Append what results have beyond those of the last call. The first line holds the scene, too,
    /// and replaces a file that is there at once.
    /// @throws InputError  the file cannot be written
    void append(const study::Results &results);

    /// The run has ended, and results.json holds everything.
    void remove() const { lines_.remove(); }

  private:
    /// Of the lists that grow.
    struct Sizes
    {
      std::size_t runs = 0, left_out = 0, references = 0, estimates = 0, savings = 0, maps = 0;
    };
    io::JsonLines lines_;
    Sizes written_;
    bool is_begun_ = false;
  };

  /// The journal of a run that goes on or was killed, else results.json.
  std::filesystem::path results_file(const std::filesystem::path &folder);

  /// What that file holds; a last line that is not whole is left out.
  /// @throws InputError  as read_json
  study::Results read_results(const std::filesystem::path &folder);
} // namespace plumbline::report
