#pragma once

#include "base/communicator.h"

#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace plumbline::io
{
  /// The folder that a command writes its results to, from before its work to its end: no other
  /// process writes there meanwhile, and what is left in it belongs together. The file '.plumbline'
  /// in it says which files are whose. Once the command has written its own, files are removed that
  /// are left of
  ///   - the same command, of a scene of another text, and
  ///   - other commands, of a scene of another name;
  /// those that no command wrote stay.
  class OutputFolder
  {
  public:
    struct Owner
    {
      std::string command;    ///< e.g. "run"
      std::string scene_name; ///< the scene's
      std::string scene_text; ///< as scene::Scene::text
      /// Receives a sentence where results of another scene are removed.
      std::function<void(const std::string &)> tell = {};
    };

    /// Make the folder and try it, so that no work is lost at the end. @note Collective.
    /// @param ranks  those that come here; the first of them acts
    /// @throws InputError  it cannot be written, or another process is at it
    OutputFolder(std::filesystem::path folder, const Owner &owner, const base::Communicator &ranks);

    /// Notes what was written, and removes what it replaces; a folder that it made and that is
    /// empty goes.
    ~OutputFolder();
    OutputFolder(const OutputFolder &) = delete;
    OutputFolder &operator=(const OutputFolder &) = delete;

  private:
    /// What a command has left.
    struct Entry
    {
      std::string command, scene_hash, scene_name;
      bool is_whole = false; ///< else it was killed, and its files are not known
      std::set<std::string> files;
    };

    void open(const Owner &owner);
    void make();
    void lock();
    void read_entries();
    void finish();
    void write_record(bool has_own) const;
    void remove(const std::string &file) const;
    void remove_if_empty() const;
    std::set<std::string> files() const; ///< that there are, but for '.plumbline'
    static bool is_of(const std::vector<Entry> &entries, const std::string &file);

    std::filesystem::path folder_;
    std::function<void(const std::string &)> tell_;
    std::vector<std::filesystem::path> made_; ///< folders, the outermost first
    Entry own_;                               ///< of this command
    std::vector<Entry> entries_;              ///< of other commands and the same scene
    std::vector<Entry> stale_;                ///< that go when this command has written its own
    std::map<std::string, std::filesystem::file_time_type> stale_times_; ///< of their files
    std::set<std::string> foreign_; ///< files that no command wrote
    int lock_ = -1;
    bool is_open_ = false; ///< by this rank
  };
} // namespace plumbline::io
