#include "arguments.h"

#include "base/error.h"
#include "base/similar_words.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>

namespace plumbline::app
{
  namespace
  {
    constexpr auto separators = ",; \t\n";

    std::vector<std::string> words_of(const std::string &text)
    {
      std::vector<std::string> words;
      for (std::size_t end = 0, begin = 0;
           (begin = text.find_first_not_of(separators, end)) != std::string::npos;)
      {
        end = std::min(text.find_first_of(separators, begin), text.size());
        words.push_back(text.substr(begin, end - begin));
      }
      return words;
    }

    std::optional<double> to_number(const std::string &word)
    {
      char *end = nullptr;
      const double value = std::strtod(word.c_str(), &end);
      return word.empty() || *end != 0 || !std::isfinite(value) ? std::nullopt
                                                                : std::optional(value);
    }

    bool is_numbers(const std::string &text)
    {
      const auto words = words_of(text);
      return !text.empty() &&
             std::all_of(words.begin(), words.end(),
                         [](const std::string &word) { return to_number(word).has_value(); });
    }
  } // namespace

  std::vector<double> to_numbers(const std::string &option, const std::vector<std::string> &given)
  {
    std::vector<double> numbers;
    for (const std::string &text : given)
    {
      const std::vector<std::string> words = words_of(text);
      for (const std::string &word : words)
        if (&word != &words.front() && word.size() > 1 && word[0] == '0' && word[1] != '.')
          throw InputError(
              option + ": '" + text +
              "' looks like a number with a decimal comma; write 3.015, not 3,015, and "
              "separate numbers by blanks or ', '");
        else if (const auto number = to_number(word))
          numbers.push_back(*number);
        else
          throw InputError(option + ": '" + word +
                           "' is no number; give numbers separated by commas, semicolons or "
                           "blanks");
    }
    if (numbers.empty())
      throw InputError(option + " has no numbers; give one or more, or leave it out");
    return numbers;
  }

  std::vector<std::array<double, 3>> to_vectors(const std::string &option,
                                                const std::vector<std::string> &given)
  {
    const std::vector<double> numbers = to_numbers(option, given);
    if (numbers.size() % 3 != 0)
      throw InputError(option + " has " + std::to_string(numbers.size()) +
                       " numbers; give three for each direction, e.g. 1,0,0 1,1,0");
    std::vector<std::array<double, 3>> vectors;
    for (std::size_t i = 0; i < numbers.size(); i += 3)
      vectors.push_back({numbers[i], numbers[i + 1], numbers[i + 2]});
    return vectors;
  }

  std::vector<std::string> join_numbers(const std::vector<std::string> &arguments,
                                        const std::string &option)
  {
    std::vector<std::string> result;
    bool takes_numbers = false;
    for (const std::string &argument : arguments)
    {
      const bool begins = argument == option;
      if (takes_numbers && is_numbers(argument))
        result.back() += (result.back() == option ? "=" : ",") + argument;
      else
        result.push_back(argument);
      takes_numbers =
          begins || argument.rfind(option + "=", 0) == 0 || (takes_numbers && is_numbers(argument));
    }
    return result;
  }

  namespace
  {
    std::vector<std::string> commands_of(const CLI::App &app)
    {
      std::vector<std::string> names;
      for (const CLI::App *one : app.get_subcommands([](const CLI::App *) { return true; }))
        names.push_back(one->get_name());
      return names;
    }

    /// What may be written in place of an argument that is not known: an option of the command that
    /// was parsed, or a command.
    std::string hint(const std::string &argument, const CLI::App &app)
    {
      const std::vector<CLI::App *> parsed = app.get_subcommands();
      const CLI::App &command = parsed.empty() ? app : *parsed.back();
      std::vector<std::string> known;
      if (argument.rfind('-', 0) == 0)
      {
        for (const CLI::Option *option : command.get_options())
          if (!option->get_lnames().empty() && !option->get_group().empty())
            known.push_back("--" + option->get_lnames()[0]);
      }
      else if (parsed.empty())
        known = commands_of(app);
      return base::did_you_mean(argument.substr(0, argument.find('=')), known);
    }

    /// What the value of an option must be, from "--threads = -1".
    std::string wanted(const std::string &given, const CLI::App &app)
    {
      const std::vector<CLI::App *> parsed = app.get_subcommands();
      if (parsed.empty())
        return "";
      const CLI::Option *option =
          parsed.back()->get_option_no_throw(given.substr(0, given.find(' ')));
      if (option == nullptr)
        return "";
      const std::string type = option->get_type_name();
      return type.rfind("UINT", 0) == 0    ? "; give a whole number, 0 or greater"
             : type.rfind("FLOAT", 0) == 0 ? "; give a number such as 0.5 or 1e-3"
                                           : "";
    }

    std::string explain_missing_command(const CLI::App &app)
    {
      std::string all;
      for (const std::string &name : commands_of(app))
        all += (all.empty() ? "" : ", ") + name;
      return "no known command is given; write plumbline run SCENE, or another command: " + all +
             (app.remaining().empty() ? "" : hint(app.remaining()[0], app));
    }

    std::string explain_extras(const CLI::App &app)
    {
      std::string all, hints;
      const std::vector<std::string> extras = app.remaining(true);
      for (const std::string &extra : extras)
      {
        all += (all.empty() ? "" : " ") + extra;
        if (hints.empty())
          hints = hint(extra, app);
      }
      const std::vector<CLI::App *> parsed = app.get_subcommands();
      return "the argument '" + all + "' is not known; " +
             (parsed.empty()
                  ? "'plumbline --help' lists the commands"
                  : "'plumbline " + parsed.back()->get_name() + " --help' lists the arguments") +
             hints;
    }
  } // namespace

  std::string explain(const CLI::ParseError &error, const CLI::App &app)
  {
    const std::string said = error.what();
    const auto behind = [&](const std::string &mark)
    {
      const std::size_t at = said.find(mark);
      return at == std::string::npos ? said : said.substr(at + mark.size());
    };
    const auto is = [&](const auto *kind)
    { return dynamic_cast<decltype(kind)>(&error) != nullptr; };
    const auto parsed = app.get_subcommands();
    const std::string help = "; 'plumbline " +
                             (parsed.empty() ? "COMMAND" : parsed.back()->get_name()) +
                             " --help' lists the arguments";
    if (is(static_cast<const CLI::ExtrasError *>(nullptr)))
      return explain_extras(app);
    if (is(static_cast<const CLI::RequiredError *>(nullptr)))
      return said.find("ubcommand") == std::string::npos
                 ? said.substr(0, said.find(' ')) + " is missing" + help
                 : explain_missing_command(app);
    if (is(static_cast<const CLI::ConversionError *>(nullptr)))
      return "the value of " + behind(": ") + " is not of the right kind" +
             wanted(behind(": "), app) + help;
    const std::string out_of_range = " not in range ";
    if (const std::size_t at = said.find(out_of_range);
        is(static_cast<const CLI::ValidationError *>(nullptr)) && at != std::string::npos)
    {
      const std::string value = behind(": Value ");
      return "the value of " + said.substr(0, said.find(':')) + " = " +
             value.substr(0, value.find(out_of_range)) +
             " is not of the right kind; give a whole number from " + behind(out_of_range) + help;
    }
    if (is(static_cast<const CLI::ArgumentMismatch *>(nullptr)))
      return said.substr(0, said.find(':')) + " has no value, or too many" + help;
    return "the arguments cannot be used (" + said + ")" + help;
  }
} // namespace plumbline::app
