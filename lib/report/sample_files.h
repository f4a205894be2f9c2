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
    /// @param subject  all that the records depend on; those of another are not taken for its own
    SampleFiles(std::filesystem::path folder, std::string subject);

    /// Whether the folder is of this subject.
    bool are_there() const;

    /// Make the folder, without the records of another subject.
    /// @throws InputError  it cannot be written, or holds what no samples wrote
    void begin() const;

    /// There is a file of it, whole or not.
    bool has(std::size_t sample) const;

    /// So that it is taken anew, where read() has nothing of its file.
    void remove(std::size_t sample) const;

    /// @throws InputError  the folder cannot be written
    void write(const study::SampleRecord &record) const;

    /// Nothing where there is none, or it is not what this writes.
    std::optional<study::SampleRecord> read(std::size_t sample) const;

    std::filesystem::path folder() const { return folder_; }
    std::filesystem::path subject_file() const { return folder_ / "subject.prm"; }

  private:
    std::filesystem::path file(std::size_t sample, const std::string &ending) const;

    std::filesystem::path folder_;
    std::string subject_;
  };
} // namespace plumbline::report
