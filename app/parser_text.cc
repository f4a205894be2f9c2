#include "parser_text.h"

#include "base/choice.h"
#include "base/error.h"

#include <array>
#include <vector>

namespace plumbline::app
{
  namespace
  {
    enum class Shell
    {
      bash,
      zsh
    };
  } // namespace
} // namespace plumbline::app

namespace plumbline::base
{
  template <>
  inline constexpr auto words<app::Shell> = std::array{"bash", "zsh"};
} // namespace plumbline::base

namespace plumbline::app
{
  namespace
  {
    constexpr auto program = "plumbline";

    std::vector<const CLI::App *> subcommands_of(const CLI::App &app)
    {
      return app.get_subcommands([](const CLI::App *one) { return !one->get_name().empty(); });
    }

    /// Those that are shown: "-o" and "--output" of each, or "SCENE".
    std::vector<const CLI::Option *> options_of(const CLI::App &command, bool positional)
    {
      std::vector<const CLI::Option *> options;
      for (const CLI::Option *one : command.get_options())
        if (!one->get_group().empty() && one->get_positional() == positional)
          options.push_back(one);
      return options;
    }

    std::vector<std::string> names_of(const CLI::Option &option)
    {
      std::vector<std::string> names;
      for (const std::string &name : option.get_snames())
        names.push_back("-" + name);
      for (const std::string &name : option.get_lnames())
        names.push_back("--" + name);
      return names;
    }

    bool takes_value(const CLI::Option &option)
    {
      return option.get_items_expected_max() > 0;
    }

    /// A text with a mark before each of some characters.
    std::string escaped(const std::string &text, const std::string &characters)
    {
      std::string result;
      for (const char c : text)
      {
        if (characters.find(c) != std::string::npos)
          result += '\\';
        result += c;
      }
      return result;
    }

    /// One word of a shell script.
    std::string shell_word(const std::string &text)
    {
      std::string result = "'";
      for (const char c : text)
        result += c == '\'' ? std::string("'\\''") : std::string(1, c);
      return result + "'";
    }

    std::string option_words(const CLI::App &command)
    {
      std::string words;
      for (const CLI::Option *option : options_of(command, false))
        for (const std::string &name : names_of(*option))
          words += (words.empty() ? "" : " ") + name;
      return words;
    }

    std::string bash_completion(const CLI::App &app)
    {
      std::string commands, cases;
      for (const CLI::App *one : subcommands_of(app))
      {
        commands += one->get_name() + " ";
        cases += "    " + one->get_name() + ") words=" + shell_word(option_words(*one)) + " ;;\n";
      }
      return std::string("# bash completion of plumbline\n") + "_" + program +
             "()\n{\n  local current=${COMP_WORDS[COMP_CWORD]} words=\n  COMPREPLY=()\n"
             "  if [ \"$COMP_CWORD\" -eq 1 ]; then\n    words=" +
             shell_word(commands + option_words(app)) +
             "\n  elif [[ $current == -* ]]; then\n    case ${COMP_WORDS[1]} in\n" + cases +
             "    esac\n  elif [ \"${COMP_WORDS[1]}\" = help ]; then\n    words=" +
             shell_word(commands) +
             "\n  fi\n"
             "  [ -z \"$words\" ] || COMPREPLY=($(compgen -W \"$words\" -- \"$current\"))\n}\n"
             "complete -o default -F _" +
             program + " " + program + "\n";
    }

    std::string zsh_completion(const CLI::App &app)
    {
      std::string commands, cases;
      for (const CLI::App *one : subcommands_of(app))
      {
        commands += "    " +
                    shell_word(escaped(one->get_name() + "", ":") + ":" + one->get_description()) +
                    "\n";
        cases += "    " + one->get_name() + ")\n      _arguments";
        for (const CLI::Option *option : options_of(*one, false))
          for (const std::string &name : names_of(*option))
            cases += " \\\n        " +
                     shell_word(name + "[" + escaped(option->get_description(), "[]:\\") + "]" +
                                (takes_value(*option) ? ":value:_files" : ""));
        cases += " \\\n        '*:file:_files' ;;\n";
      }
      return std::string("#compdef ") + program +
             "\nlocal -a commands\nif (( CURRENT == 2 )); then\n  commands=(\n" + commands +
             "  )\n  _describe command commands\nelse\n  shift words\n  (( CURRENT-- ))\n"
             "  case $words[1] in\n" +
             cases + "  esac\nfi\n";
    }

    /// A line of text in a page for man.
    std::string roff(const std::string &text)
    {
      const std::string line = escaped(text, "\\-");
      return (line.rfind('.', 0) == 0 || line.rfind('\'', 0) == 0 ? "\\&" : "") + line;
    }

    std::string roff_options(const CLI::App &command)
    {
      std::string text;
      for (const bool positional : {true, false})
        for (const CLI::Option *option : options_of(command, positional))
        {
          std::string names;
          for (const std::string &name : names_of(*option))
            names += (names.empty() ? "" : ", ") + name;
          if (positional)
            names = option->get_name(true);
          else if (takes_value(*option))
            names += " VALUE";
          text += ".TP\n\\fB" + roff(names) + "\\fR\n" + roff(option->get_description()) + "\n";
        }
      return text;
    }
  } // namespace

  std::string help_text(const CLI::App &app, const std::string &subcommand)
  {
    const auto help = [](const CLI::App &one, const std::string &name)
    { return one.get_formatter()->make_help(&one, name, CLI::AppFormatMode::Normal); };
    if (subcommand.empty())
      return help(app, program);
    for (const CLI::App *one : subcommands_of(app))
      if (one->check_name(subcommand))
        return help(*one, std::string(program) + " " + one->get_name());
    return "";
  }

  std::string completion(const CLI::App &app, const std::string &shell)
  {
    const auto known = base::from_word<Shell>(shell);
    if (!known)
      throw InputError("completion: shell '" + shell + "' is not known; choose bash or zsh");
    return *known == Shell::bash ? bash_completion(app) : zsh_completion(app);
  }

  std::string man_page(const CLI::App &app, const std::string &version)
  {
    std::string page = ".TH PLUMBLINE 1 \"\" \"" + roff(std::string(program) + " " + version) +
                       "\" \"User Commands\"\n.SH NAME\n" + program + " \\- " +
                       roff(app.get_description()) + "\n.SH SYNOPSIS\n.B " + program +
                       "\nCOMMAND [ARGUMENTS] [OPTIONS]\n.SH OPTIONS\n" + roff_options(app) +
                       ".SH COMMANDS\n";
    for (const CLI::App *one : subcommands_of(app))
      page += ".SS " + roff(one->get_name()) + "\n" + roff(one->get_description()) + "\n" +
              roff_options(*one);
    return page + ".SH EXIT STATUS\n0: done; 1: a check failed; 2: bad input; 3: no result\n";
  }
} // namespace plumbline::app
