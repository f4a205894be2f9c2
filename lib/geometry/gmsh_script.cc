#include "geometry/gmsh_script.h"

#include "base/error.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <vector>

namespace plumbline::geometry
{
  namespace
  {
    namespace fs = std::filesystem;

    // Words of gmsh 4.8 (Parser/Gmsh.l and Gmsh.y, the fields' names in Mesh/Field.cpp).
    constexpr std::array starts_programs = {
        "System",       "SystemCall", "NonBlockingSystemCall", "ExternalProcess", "OnelabRun",
        "OnelabAction", "CommandLine"};
    constexpr std::array writes_files = {"Save", "Print", "CreateDir", "Plugin"};
    constexpr std::array reads_scripts = {"Include", "Merge", "MergeWithBoundingBox",
                                          "ShapeFromFile"};
    /// Messages, which a '>' turns into files.
    constexpr std::array prints = {"Printf", "Error"};

    /// Where gmsh skips a branch, a loop or a macro it looks for these, in quotes and as part of a
    /// word, too, and goes on behind them.
    constexpr std::array ends_skipping = {"EndIf", "Else", "EndFor", "Return"};

    /// gmsh's own buffer for a text in quotes holds 1023.
    constexpr std::size_t longest_quote = 1000;

    /// More of it is data, not a script.
    constexpr std::uintmax_t most_bytes = 50'000'000;

    template <std::size_t n>
    bool is_one_of(const std::array<const char *, n> &words, const std::string &word)
    {
      return std::any_of(words.begin(), words.end(), [&](const char *w) { return word == w; });
    }

    bool is_letter(char c)
    {
      return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_';
    }

    bool is_in_word(char c)
    {
      return is_letter(c) || std::isdigit(static_cast<unsigned char>(c)) != 0;
    }

    /// One file, read as gmsh reads it: words, texts in quotes and single marks.
    class Script
    {
    public:
      /// @param parents  the files that are being read, each including the next
      /// @param files    it and what it reads are added; outlives it
      Script(const std::string &file, std::vector<fs::path> parents,
             std::vector<std::string> &files)
          : file_(file), parents_(std::move(parents)), files_(files)
      {
        files_.push_back(file);
        std::error_code error;
        parents_.push_back(fs::weakly_canonical(file, error));
        std::ifstream in(file, std::ios::binary);
        if (!in || fs::is_directory(file, error))
          throw InputError("mesh file '" + file + "' cannot be read; check its name and folder");
        if (fs::file_size(file, error) > most_bytes)
          fail(
              "is longer than 50 MB, which is no script; mesh it with gmsh and name the .msh file");
        text_.assign(std::istreambuf_iterator<char>(in), {});
      }

      void check()
      {
        std::string word;
        bool is_printing = false; // between Printf or Error and the end of the command
        int depth = 0;
        for (; at_ < text_.size();)
        {
          const char c = text_[at_];
          if (skip_comment())
            continue;
          if (c == '"' || c == '\'')
          {
            const std::string quoted = quote(c);
            if (is_one_of(reads_scripts, word))
              follow(quoted);
            else if (std::error_code error; fs::is_regular_file(path_of(quoted), error))
              files_.push_back(path_of(quoted).string());
            word.clear();
          }
          else if (is_letter(c))
          {
            if (is_one_of(reads_scripts, word))
              fail_computed(word);
            word = take_word();
            is_printing = is_printing || is_one_of(prints, word);
            check_word(word);
          }
          else
          {
            if (std::isdigit(static_cast<unsigned char>(c)) != 0 && is_one_of(reads_scripts, word))
              fail_computed(word);
            depth += (c == '(') - (c == ')');
            if (is_printing && depth <= 0 && c == '>')
              fail("Printf writes a file ('>'), which meshes may not; take the command out");
            if (c == ';')
            {
              is_printing = false;
              depth = 0;
              word.clear();
            }
            advance();
          }
        }
      }

    private:
      [[noreturn]] void fail(const std::string &what) const
      {
        throw InputError("mesh file '" + file_ + "', line " + std::to_string(line_) + ": " + what);
      }
      [[noreturn]] void fail_computed(const std::string &word) const
      {
        fail(word +
             " with a name that is not written out, so that what it reads cannot be checked; "
             "write the file's name in quotes");
      }

      void advance()
      {
        const auto c = static_cast<unsigned char>(text_[at_]);
        if (c < 32 && std::isspace(c) == 0)
          fail("has the control character " + std::to_string(c) +
               "; write plain text, not compressed and not binary");
        line_ += text_[at_++] == '\n' ? 1 : 0;
      }
      bool starts(const char *mark) const { return text_.compare(at_, 2, mark) == 0; }

      bool skip_comment()
      {
        if (starts("//"))
        {
          while (at_ < text_.size() && text_[at_] != '\n')
            advance();
          return true;
        }
        if (!starts("/*"))
          return false;
        advance();
        advance();
        while (at_ < text_.size() && !starts("*/"))
          advance();
        if (at_ >= text_.size())
          fail("the file ends within a comment; close it by */");
        advance();
        advance();
        return true;
      }

      std::string take_word()
      {
        const std::size_t from = at_;
        while (at_ < text_.size() && is_in_word(text_[at_]))
          advance();
        return text_.substr(from, at_ - from);
      }

      std::string quote(char mark)
      {
        const std::size_t from = at_ + 1;
        advance();
        while (at_ < text_.size() && text_[at_] != mark)
        {
          if (text_[at_] == '\n')
            fail("a text in quotes does not end on its line; close the quotes");
          advance();
        }
        if (at_ >= text_.size())
          fail("the file ends within a text in quotes; close the quotes");
        std::string quoted = text_.substr(from, at_ - from);
        advance();
        check_quoted(quoted);
        return quoted;
      }

      void check_quoted(const std::string &quoted) const
      {
        const auto refuse = [&](const std::string &what)
        { fail("a text in quotes " + what + "; take it out, it could hide commands"); };
        if (quoted.size() > longest_quote)
          refuse("is longer than " + std::to_string(longest_quote) + " characters");
        for (const char *mark : {"//", "/*", "*/"})
          if (quoted.find(mark) != std::string::npos)
            refuse(std::string("holds the mark of a comment ") + mark);
        for (const char *word : ends_skipping)
          if (quoted.find(word) != std::string::npos)
            refuse(std::string("holds the command ") + word);
      }

      void check_word(const std::string &word) const
      {
        const bool is_solver = word.compare(0, 10, "Executable") == 0; // Executable0, ...
        if (is_one_of(starts_programs, word) || is_solver)
          fail(word + " would start a program, which meshes may not; take the command out");
        if (is_one_of(writes_files, word))
          fail(word + " would write a file or more, which meshes may not; take the command out");
      }

      /// Of a file named from this one.
      fs::path path_of(const std::string &name) const
      {
        return fs::path(file_).parent_path() / name; // an absolute name stays
      }

      /// A file that is included or merged.
      void follow(const std::string &name)
      {
        const fs::path path = path_of(name);
        std::string ending = path.extension().string();
        std::transform(ending.begin(), ending.end(), ending.begin(),
                       [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
        std::error_code error;
        if (!fs::is_regular_file(path, error))
          fail("'" + name + "' is not there to be read; check its name and folder");
        // gmsh reads these by their own readers, whatever is in them, all others as scripts unless
        // they begin as its own meshes do
        constexpr std::array shapes = {".stl", ".step", ".stp", ".brep", ".iges", ".igs"};
        std::ifstream in(path, std::ios::binary);
        if (is_one_of(shapes, ending) || in.peek() == '$')
        {
          files_.push_back(path.string());
          return;
        }
        if (const fs::path whole = fs::weakly_canonical(path, error);
            std::find(parents_.begin(), parents_.end(), whole) != parents_.end())
          fail("'" + name +
               "' is being read already, so that it would include itself; take the "
               "line out");
        Script(path.string(), parents_, files_).check();
      }

      std::string file_, text_;
      std::vector<fs::path> parents_;
      std::vector<std::string> &files_;
      std::size_t at_ = 0, line_ = 1;
    };
  } // namespace

  std::vector<std::string> files_of_script(const std::string &file)
  {
    std::vector<std::string> files;
    Script(file, {}, files).check();
    return files;
  }

  void check_script(const std::string &file)
  {
    (void)files_of_script(file);
  }
} // namespace plumbline::geometry
