#include "scene/scene_file.h"

#include "base/choice.h"
#include "base/error.h"
#include "base/json_text.h"
#include "base/text_file.h"
#include "scene/aliases.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>

namespace plumbline::scene
{
  namespace
  {
    /// The first word of a line.
    enum class Command
    {
      subsection,
      end,
      set,
      include
    };
  } // namespace
} // namespace plumbline::scene

namespace plumbline::base
{
  template <>
  inline constexpr auto words<scene::Command> = std::array{"subsection", "end", "set", "include"};
} // namespace plumbline::base

namespace plumbline::scene
{
  namespace
  {
    namespace fs = std::filesystem;

    /// Scene files are a page or two.
    constexpr std::size_t most_bytes = 10'000'000;

    /// Total number of included files: two files that include each other twice would double at each
    /// level.
    constexpr unsigned int most_files = 100;

    bool is_blank(char c)
    {
      return c == ' ' || (c >= '\t' && c <= '\r');
    }

    std::string without_blanks(const std::string &text)
    {
      std::size_t from = 0, to = text.size();
      while (from < to && is_blank(text[from]))
        ++from;
      while (to > from && is_blank(text[to - 1]))
        --to;
      return text.substr(from, to - from);
    }

    /// Single blanks between words.
    std::string with_single_blanks(const std::string &text)
    {
      std::string result;
      for (const char c : without_blanks(text))
        if (!is_blank(c))
          result += c;
        else if (result.back() != ' ')
          result += ' ';
      return result;
    }

    /// Splits 'word rest'; the word in small letters.
    std::pair<std::string, std::string> first_word(const std::string &line)
    {
      const auto end = std::find_if(line.begin(), line.end(), is_blank);
      std::string word(line.begin(), end);
      std::transform(word.begin(), word.end(), word.begin(),
                     [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
      return {word, without_blanks(std::string(end, line.end()))};
    }

    /// Settings of all files of a scene.
    class Settings
    {
    public:
      explicit Settings(std::string what) : what_(std::move(what)) {}

      void read(const std::string &file, const std::string &text, std::vector<fs::path> parents,
                const std::string &suffix)
      {
        std::error_code is_pipe; // which has no path: it cannot include itself
        parents.push_back(fs::weakly_canonical(file, is_pipe));
        std::vector<std::pair<std::string, std::string>> sections; // and where they begin
        std::size_t at = 0, line = 0;
        while (at < text.size())
        {
          const std::size_t first = line + 1;
          const std::string place = "line " + std::to_string(first) + suffix;
          const std::string statement = next_statement(text, at, line);
          if (statement.empty())
            continue;
          const auto [word, rest] = first_word(statement);
          const auto command = base::from_word<Command>(word);
          if (command == Command::subsection && !rest.empty())
            sections.emplace_back(rest, place);
          else if (command == Command::end && rest.empty())
          {
            if (sections.empty())
              fail(place, "'end' closes no subsection; remove it");
            sections.pop_back();
          }
          else if (command == Command::set && rest.find('=') != std::string::npos)
          {
            const std::size_t equals = rest.find('=');
            std::string key;
            for (const auto &section : sections)
              key += section.first + "/";
            key += with_single_blanks(rest.substr(0, equals));
            add(key, without_blanks(rest.substr(equals + 1)), place);
          }
          else if (command == Command::include && !rest.empty())
            include(file, rest, parents, place);
          else
            fail(place, "'" + base::shown(statement) +
                            "' is not understood; write 'set key = value', 'subsection NAME', "
                            "'end', 'include FILE', or '#' before a comment");
        }
        if (!sections.empty())
          fail(sections.back().second, "subsection " + sections.back().first +
                                           " is not closed; write 'end' after its last line");
      }

      void add(const std::string &key, const std::string &value, const std::string &place)
      {
        const auto [found, is_new] = places_.emplace(current_key(key), place);
        if (!is_new)
          fail(place, key + " is given in " + found->second + " already; remove one of them");
        settings.push_back({key, value, place});
      }

      std::vector<Setting> settings;

      [[noreturn]] void fail(const std::string &place, const std::string &reason) const
      {
        throw InputError(what_ + ", " + place + ": " + reason);
      }

    private:
      /// A line, without its comment, with those that continue it.
      static std::string next_statement(const std::string &text, std::size_t &at, std::size_t &line)
      {
        std::string statement;
        bool is_continued = true;
        while (is_continued && at < text.size())
        {
          const std::size_t end = std::min(text.find('\n', at), text.size());
          std::string one = text.substr(at, end - at);
          at = end + 1;
          ++line;
          while (!one.empty() && is_blank(one.back()))
            one.pop_back();
          is_continued = !one.empty() && one.back() == '\\';
          if (is_continued)
            one.pop_back();
          const auto begin =
              statement.empty() ? one.begin() : std::find_if_not(one.begin(), one.end(), is_blank);
          statement.append(begin, one.end());
        }
        return without_blanks(statement.substr(0, statement.find('#')));
      }

      void include(const std::string &file, const std::string &name,
                   const std::vector<fs::path> &parents, const std::string &place)
      {
        const std::string path = (fs::path(file).parent_path() / name).string();
        std::error_code error;
        if (const fs::path whole = fs::weakly_canonical(path, error);
            std::find(parents.begin(), parents.end(), whole) != parents.end())
          fail(place,
               "'" + name +
                   "' is being read already, so that it would include itself; remove the line");
        if (++n_files_ > most_files)
          fail(place, "more than " + std::to_string(most_files) +
                          " files are included; write them in one");
        const std::string text =
            base::read_text_file(path, what_ + ", " + place + ": '" + name + "'", most_bytes,
                                 "a file named from the scene's folder");
        read(path, text, parents, " of '" + name + "'");
      }

      std::string what_;
      std::map<std::string, std::string> places_;
      unsigned int n_files_ = 0;
    };

    using Json = nlohmann::ordered_json;

    std::string to_text(const Json &value, const std::string &key, const Settings &settings)
    {
      if (value.is_string())
        return without_blanks(value.get<std::string>());
      if (!value.is_number() && !value.is_boolean())
        settings.fail(key, std::string("is ") + (value.is_null() ? "null" : "a list") +
                               "; give a text, a number, true or false" +
                               (value.is_null() ? "" : "; a list is a text with commas"));
      return value.dump();
    }

    void add_object(const Json &object, const std::string &section, Settings &settings)
    {
      for (const auto &[name, value] : object.items())
      {
        const std::string key = section + name;
        if (value.is_object())
          add_object(value, key + "/", settings);
        else
          settings.add(key, to_text(value, key, settings), key);
      }
    }
  } // namespace

  std::vector<Setting> read_settings(const std::string &file, const std::string &text,
                                     const std::string &what)
  {
    Settings all(what);
    all.read(file, text, {}, "");
    return all.settings;
  }

  std::vector<Setting> read_json_settings(const std::string &text, const std::string &what)
  {
    const Json json = base::parse_json(text, what, "mend the file");
    Settings all(what);
    if (!json.is_object())
      all.fail("line 1", "is not a JSON object; write {\"Section\": {\"key\": \"value\"}}");
    add_object(json, "", all);
    return all.settings;
  }
} // namespace plumbline::scene
