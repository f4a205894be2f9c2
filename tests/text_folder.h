#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include <unistd.h>

namespace plumbline::tests
{
  /// A folder for the files of a test, which vanishes with it.
  class TextFolder
  {
  public:
    /// @param name  of its own among the tests
    explicit TextFolder(const std::string &name)
        : path_(std::filesystem::temp_directory_path() /
                ("plumbline_" + name + "_" + std::to_string(getpid())))
    {
      std::filesystem::create_directory(path_);
    }
    ~TextFolder() { std::filesystem::remove_all(path_); }
    TextFolder(const TextFolder &) = delete;
    TextFolder &operator=(const TextFolder &) = delete;

    const std::filesystem::path &path() const { return path_; }

    /// @return  the file's place
    std::string write(const std::string &name, const std::string &text) const
    {
      std::ofstream(path_ / name, std::ios::binary) << text;
      return (path_ / name).string();
    }

  private:
    std::filesystem::path path_;
  };
} // namespace plumbline::tests
