#include "io/output_folder.h"

#include "base/choice.h"
#include "base/content_hash.h"
#include "base/error.h"
#include "base/first_rank.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <sstream>

namespace plumbline::io
{
  namespace
  {
    /// What a line of the record is about.
    enum class Line
    {
      whole, ///< a command that came to its end
      begun, ///< one that did not
      file
    };
  } // namespace
} // namespace plumbline::io

namespace plumbline::base
{
  template <>
  inline constexpr auto words<io::Line> = std::array{"whole", "begun", "file"};
} // namespace plumbline::base

namespace plumbline::io
{
  namespace fs = std::filesystem;

  namespace
  {
    constexpr auto record_name = ".plumbline";

    /// Whether a command that was killed may have written it: what is written before the end.
    bool is_unfinished(const std::string &file, const std::string &command)
    {
      static const std::set<std::string> begun = {"fields",     "points",  "frames", "samples",
                                                  "checkpoint", "results", "report", "dynamics"};
      const std::string stem = fs::path(*fs::path(file).begin()).stem().string();
      return begun.count(stem) > 0 || stem == command;
    }
  } // namespace

  OutputFolder::OutputFolder(fs::path folder, const Owner &owner, const base::Communicator &ranks)
      : folder_(std::move(folder)), tell_(owner.tell)
  {
    base::on_first_rank(ranks, [&] { open(owner); });
  }

  void OutputFolder::open(const Owner &owner)
  {
    make();
    lock();
    is_open_ = true;
    read_entries();
    const std::string hash = base::content_hash(owner.scene_text);
    std::vector<Entry> others;
    own_ = {owner.command, hash, owner.scene_name, false, {}};
    for (Entry &entry : entries_)
    {
      const bool is_own = entry.command == owner.command;
      if (is_own && entry.scene_hash == hash)
        own_.files = std::move(entry.files);
      else if (is_own || entry.scene_name != owner.scene_name)
        stale_.push_back(std::move(entry));
      else
        others.push_back(std::move(entry));
    }
    entries_ = std::move(others);
    for (const std::string &file : files())
      if (is_of(stale_, file))
      {
        std::error_code gone;
        stale_times_[file] = fs::last_write_time(folder_ / file, gone);
      }
      else if (!is_of(entries_, file) && own_.files.count(file) == 0)
        foreign_.insert(file);
    write_record(true);
  }

  OutputFolder::~OutputFolder()
  {
    if (!is_open_)
      return;
    try
    {
      finish();
      remove_if_empty();
    }
    catch (const std::exception &) // what is not noted stays
    {
    }
    close(lock_);
  }

  void OutputFolder::finish()
  {
    std::set<std::string> unchanged;
    own_.files.clear();
    for (const std::string &file : files())
    {
      std::error_code gone;
      const auto stale = stale_times_.find(file);
      if (stale != stale_times_.end() && stale->second == fs::last_write_time(folder_ / file, gone))
        unchanged.insert(file);
      else if (!is_of(entries_, file) && foreign_.count(file) == 0)
        own_.files.insert(file);
    }
    own_.is_whole = true;
    if (own_.files.empty()) // all is as it was
      return write_record(false);
    for (const std::string &file : unchanged)
      remove(file);
    std::string others;
    for (const Entry &entry : stale_)
      if (entry.scene_name != own_.scene_name)
        others += (others.empty() ? "" : ", ") + entry.command + " of " + entry.scene_name;
    if (!others.empty() && tell_)
      tell_("'" + folder_.string() + "' held results of another scene (" + others +
            "), which are removed");
    stale_.clear();
    write_record(true);
  }

  void OutputFolder::make()
  {
    std::error_code error;
    for (fs::path one = (fs::absolute(folder_, error) / "").lexically_normal().parent_path();
         !fs::exists(one, error) && one.has_filename(); one = one.parent_path())
      made_.insert(made_.begin(), one);
    fs::create_directories(folder_, error);
    const fs::path probe = folder_ / ".write-test";
    const bool is_writable = !error && (std::ofstream(probe) << "x").flush().good();
    fs::remove(probe, error);
    if (is_writable)
      return;
    remove_if_empty();
    throw InputError("output folder '" + folder_.string() +
                     "' cannot be written; give a writable one with -o");
  }

  void OutputFolder::lock()
  {
    // children that run other programs do not hold it
    lock_ = ::open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (lock_ < 0 || flock(lock_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK)
      return; // some file systems have no locks
    close(lock_);
    throw InputError("output folder '" + folder_.string() +
                     "' is in use by another process of plumbline; wait for its end, or give "
                     "another folder with -o");
  }

  // A line for each command, 'whole COMMAND HASH SCENE' (or begun), and one for each of its files,
  // 'file NAME'.
  void OutputFolder::read_entries()
  {
    std::ifstream in(folder_ / record_name);
    for (std::string line; std::getline(in, line);)
    {
      std::istringstream words(line);
      std::string word;
      words >> word;
      const auto kind = base::from_word<Line>(word);
      if (kind == Line::begun || kind == Line::whole)
      {
        Entry &entry = entries_.emplace_back();
        words >> entry.command >> entry.scene_hash >> std::ws;
        std::getline(words, entry.scene_name);
        entry.is_whole = kind == Line::whole;
      }
      else if (kind == Line::file && !entries_.empty())
      {
        words >> std::ws;
        std::getline(words, word);
        entries_.back().files.insert(word);
      }
    }
    for (Entry &entry : entries_)
      for (const std::string &file : files())
        if (!entry.is_whole && !is_of(entries_, file) && is_unfinished(file, entry.command))
          entry.files.insert(file);
  }

  void OutputFolder::write_record(bool has_own) const
  {
    std::vector<Entry> all = entries_;
    all.insert(all.end(), stale_.begin(), stale_.end());
    if (has_own)
      all.push_back(own_);
    const fs::path record = folder_ / record_name, next = folder_ / ".plumbline.new";
    std::error_code error;
    if (all.empty())
    {
      fs::remove(record, error);
      return;
    }
    std::ofstream out(next);
    out << "# files in this folder, with the command and scene that wrote them; results of one "
           "scene are removed when those of another are written\n";
    for (const Entry &entry : all)
    {
      out << base::word(entry.is_whole ? Line::whole : Line::begun) << ' ' << entry.command << ' '
          << entry.scene_hash << ' ' << entry.scene_name << '\n';
      for (const std::string &file : entry.files)
        out << base::word(Line::file) << ' ' << file << '\n';
    }
    out.close();
    fs::rename(next, record, error);
  }

  void OutputFolder::remove(const std::string &file) const
  {
    const fs::path path = fs::path(file).lexically_normal();
    std::error_code error;
    fs::remove(folder_ / path, error);
    // folders that are empty now; of others this fails
    for (fs::path above = path.parent_path(); !above.empty(); above = above.parent_path())
      fs::remove(folder_ / above, error);
  }

  void OutputFolder::remove_if_empty() const
  {
    std::error_code not_empty;
    for (auto one = made_.rbegin(); one != made_.rend(); ++one)
      fs::remove(*one, not_empty);
  }

  bool OutputFolder::is_of(const std::vector<Entry> &entries, const std::string &file)
  {
    return std::any_of(entries.begin(), entries.end(),
                       [&](const Entry &entry) { return entry.files.count(file) > 0; });
  }

  std::set<std::string> OutputFolder::files() const
  {
    std::set<std::string> result;
    std::error_code error;
    for (fs::recursive_directory_iterator at(folder_, error), end; !error && at != end;
         at.increment(error))
      if (const std::string name = at->path().lexically_relative(folder_).string();
          !at->is_directory(error) && name != record_name)
        result.insert(name);
    return result;
  }
} // namespace plumbline::io
