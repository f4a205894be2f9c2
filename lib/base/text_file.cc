#include "base/text_file.h"

#include "base/error.h"

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace plumbline::base
{
  namespace
  {
    /// The bytes of the UTF-8 character that begins at i; 0: there is none.
    std::size_t character_size(const std::string &text, std::size_t i)
    {
      const auto byte = [&](std::size_t k)
      { return k < text.size() ? static_cast<unsigned char>(text[k]) : 0U; };
      const unsigned int first = byte(i), second = byte(i + 1);
      const std::size_t n = first < 0x80                     ? 1
                            : first >= 0xC2 && first <= 0xDF ? 2
                            : first >= 0xE0 && first <= 0xEF ? 3
                            : first >= 0xF0 && first <= 0xF4 ? 4
                                                             : 0;
      for (std::size_t k = 1; k < n; ++k)
        if ((byte(i + k) & 0xC0U) != 0x80U)
          return 0;
      const bool is_overlong = (first == 0xE0 && second < 0xA0) || (first == 0xF0 && second < 0x90);
      const bool is_no_code = (first == 0xED && second > 0x9F) || (first == 0xF4 && second > 0x8F);
      return is_overlong || is_no_code ? 0 : n;
    }
  } // namespace

  void check_text(const std::string &text, const std::string &what)
  {
    std::size_t line = 1;
    for (std::size_t i = 0; i < text.size();)
    {
      const auto c = static_cast<unsigned char>(text[i]);
      const auto place = [&] { return what + ", line " + std::to_string(line); };
      if ((c < 32 && (c < '\t' || c > '\r')) || c == 127)
        throw InputError(place() + ": has the control character " + std::to_string(c) +
                         "; give a plain text file");
      const std::size_t n = character_size(text, i);
      if (n == 0)
        throw InputError(place() + ": has a character that is not UTF-8; store the file as UTF-8");
      line += c == '\n' ? 1 : 0;
      i += n;
    }
  }

  std::string read_text_file(const std::string &file, const std::string &what,
                             std::size_t most_bytes, const std::string &kind)
  {
    std::error_code error;
    std::ifstream in(file, std::ios::binary);
    if (!in || std::filesystem::is_directory(file, error))
      throw InputError(what + " cannot be read; give " + kind);
    std::string text;
    for (char c; text.size() <= most_bytes && in.get(c);)
      text += c;
    if (text.size() > most_bytes)
      throw InputError(what + " is longer than " + std::to_string(most_bytes) + " bytes; give " +
                       kind);
    if (text.compare(0, 3, "\xEF\xBB\xBF") == 0)
      text.erase(0, 3);
    check_text(text, what);
    return text;
  }

  bool has_ending(const std::string &file, const std::string &ending)
  {
    return std::filesystem::path(file).extension() == ending;
  }

  std::string shown(const std::string &text, std::size_t longest)
  {
    std::string result;
    for (const char c : text.substr(0, longest))
      result += c >= ' ' && c <= '~' ? c : '?';
    return result + (text.size() > longest ? "..." : "");
  }

  void write_file(const std::filesystem::path &file, const std::string &text)
  {
    std::error_code error, ignored;
    if (file.has_parent_path())
      std::filesystem::create_directories(file.parent_path(), error);
    std::filesystem::path part = file;
    part += ".part";
    errno = 0;
    std::ofstream out(part, std::ios::binary);
    out << text;
    out.close();
    if (out)
      std::filesystem::rename(part, file, error);
    else if (!error)
      error.assign(errno, std::generic_category());
    if (out && !error)
      return;
    std::filesystem::remove(part, ignored);
    throw InputError("output file '" + file.string() + "' cannot be written" +
                     (error ? " (" + error.message() + ")" : "") +
                     "; free some space or choose a folder you may write to with -o");
  }
} // namespace plumbline::base
