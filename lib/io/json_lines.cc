#include "io/json_lines.h"

#include "base/error.h"
#include "base/text_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

namespace plumbline::io
{
  namespace
  {
    /// Removes what follows the last line break.
    bool cut_to_lines(int file)
    {
      const off_t size = lseek(file, 0, SEEK_END);
      off_t end = size;
      for (char last = 0; end > 0 && pread(file, &last, 1, end - 1) == 1 && last != '\n';)
        --end;
      return end == size || ftruncate(file, end) == 0;
    }

    bool write_all(int file, const std::string &text)
    {
      for (std::size_t n = 0; n < text.size();)
      {
        const ssize_t more = write(file, text.data() + n, text.size() - n);
        if (more < 0 && errno != EINTR)
          return false;
        n += static_cast<std::size_t>(std::max<ssize_t>(0, more));
      }
      return true;
    }
  } // namespace

  void JsonLines::append(const std::string &lines)
  {
    if (!is_begun_)
    {
      base::write_file(file_, lines);
      is_begun_ = true;
      return;
    }
    const int file = open(file_.c_str(), O_RDWR | O_APPEND | O_CLOEXEC | O_CREAT, 0666);
    if (file >= 0)
      (void)flock(file, LOCK_EX); // where there are locks
    const bool is_written = file >= 0 && cut_to_lines(file) && write_all(file, lines);
    const int reason = errno;
    if (file >= 0)
      close(file); // which unlocks it
    if (!is_written)
      throw InputError("'" + file_.string() + "' cannot be written (" + std::strerror(reason) +
                       "); free some space, or give another folder with -o");
  }

  void JsonLines::remove() const
  {
    std::error_code not_there;
    std::filesystem::remove(file_, not_there);
  }

  std::vector<std::string> read_lines(const std::filesystem::path &file)
  {
    std::ifstream in(file);
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line) && !in.eof();)
      lines.push_back(line);
    return lines;
  }
} // namespace plumbline::io
