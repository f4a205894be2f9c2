#pragma once

#include "analysis/motion.h"

#include <optional>
#include <string>

namespace plumbline::analysis
{
  /// Where a motion stands and what it has gathered so far: enough to go on to the same bits after
  /// it was killed.
  struct Checkpoint
  {
    std::string subject; ///< what moves, in full: a run takes its own checkpoint alone
    State state;
    Vector records; ///< whatever the run adds to as it goes
  };

  /// As an HDF5 file with the datasets subject, t, u, v and records. A file of that name is
  /// replaced when the new one is whole, so that a kill leaves one or the other.
  /// @throws InputError  the file cannot be written
  void write_checkpoint(const std::string &file, const Checkpoint &checkpoint);

  /// Empty where there is no file.
  /// @throws InputError  a file that is no checkpoint, or not whole
  std::optional<Checkpoint> read_checkpoint(const std::string &file);
} // namespace plumbline::analysis
