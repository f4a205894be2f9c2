#pragma once

#include "io/json_lines.h"
#include "study/dynamics.h"

#include <cstddef>
#include <filesystem>

namespace plumbline::report
{
  /// What is finished of a run of motions while it goes on: dynamics.jsonl, its scene in the first
  /// line and then a line for each motion or torus, in the form of dynamics.json (schema.md).
  /// Numbers read back to the same bits.
  class MotionJournal
  {
  public:
    explicit MotionJournal(const std::filesystem::path &folder) : lines_(folder / "dynamics.jsonl")
    {
    }

    /// Append what results have beyond those of the last call. The first one begins the file anew;
    /// a run that goes on gives it what it goes on from, which its own results then begin with.
    /// @throws InputError  the file cannot be written
    void append(const study::DynamicResults &results);

    /// The run has come to its end, and dynamics.json holds everything.
    void remove() const { lines_.remove(); }

  private:
    io::JsonLines lines_;
    std::size_t n_runs_ = 0, n_references_ = 0;
    bool is_begun_ = false;
  };

  /// With the motions and tori that a run of the scene left in the folder before its end; none if
  /// there is no journal, or one of another scene, of other levels, or of another version. A last
  /// line that is not whole is left out.
  study::DynamicResults read_motions(const std::filesystem::path &folder,
                                     const study::DynamicResults &begun);
} // namespace plumbline::report
