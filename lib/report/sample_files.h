#pragma once

#include "study/sampling.h"

#include <filesystem>

namespace plumbline::report
{
  /// The records of a scene's samples in a folder, a file each, samples/000000.json, and, where it
  /// has fields, samples/000000.h5. Files are whole or not there, whoever writes them at once.
  class SampleFiles
  {
  public:
    /// @param scene_text  records of another are not taken for its own
    SampleFiles(std::filesystem::path folder, std::string scene_text);

    /// Make the folder; records of another scene are removed.
    /// @throws InputError  it cannot be written
    void prepare() const;

    bool has(std::size_t sample) const;

    /// @throws InputError  the folder cannot be written
    void write(const study::SampleRecord &record) const;

    /// Nothing where there is none, or it is not what this writes.
    std::optional<study::SampleRecord> read(std::size_t sample) const;

    std::filesystem::path folder() const { return folder_; }

  private:
    std::filesystem::path file(std::size_t sample, const std::string &ending) const;

    std::filesystem::path folder_;
    std::string scene_text_;
  };
} // namespace plumbline::report
