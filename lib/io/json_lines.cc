#include "io/json_lines.h"

#include "base/error.h"
#include "base/text_file.h"

#include <cerrno>
#include <cstring>
#include <fstream>

namespace plumbline::io
{
  void JsonLines::append(const std::string &lines)
  {
    if (!is_begun_)
    {
      base::write_file(file_, lines);
      is_begun_ = true;
      return;
    }
    errno = 0;
    std::ofstream out(file_, std::ios::app);
    out << lines << std::flush;
    if (!out)
      throw InputError("'" + file_.string() + "' cannot be written (" + std::strerror(errno) +
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
