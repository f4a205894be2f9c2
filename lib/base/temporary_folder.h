#pragma once

#include <filesystem>
#include <string>

namespace plumbline::base
{
  /// A new folder that vanishes with its files.
  class TemporaryFolder
  {
  public:
    /// @param user  which needs it, for its name and the message, e.g. "gmsh"
    /// @throws InputError  the system's folder for temporary files cannot be written
    explicit TemporaryFolder(const std::string &user);
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder &) = delete;
    TemporaryFolder &operator=(const TemporaryFolder &) = delete;

    const std::filesystem::path &path() const { return path_; }

  private:
    std::filesystem::path path_;
  };
} // namespace plumbline::base
