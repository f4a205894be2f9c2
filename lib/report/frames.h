#pragma once

#include "study/dynamics.h"

#include <filesystem>
#include <map>

namespace plumbline::report
{
  /// States of motions as points with u and its rate: frames/NAME_NNNN.vtu, and frames/NAME.pvd
  /// with their times, for ParaView.
  class Frames
  {
  public:
    explicit Frames(std::filesystem::path folder) : folder_(std::move(folder)) {}

    /// Write one, and the list of those so far. @throws InputError  the folder cannot be written
    void write(const study::MotionRun &run, const study::Frame &frame);

    /// What a frame of so many nodes takes [bytes], within a factor of 1.5.
    static double expected_bytes(double n_nodes);

  private:
    std::filesystem::path folder_;
    std::map<std::string, std::string> listed_; ///< of each motion
  };
} // namespace plumbline::report
