#include "arguments.h"

#include "base/number_list.h"
#include "base/similar_words.h"

#include <algorithm>

namespace plumbline::app
{
  std::vector<std::string> join_numbers(const std::vector<std::string> &arguments,
                                        const std::string &option)
  {
    std::vector<std::string> result;
    bool takes_numbers = false;
    for (const std::string &argument : arguments)
    {
      const bool begins = argument == option;
      if (takes_numbers && base::is_numbers(argument))
        result.back() += (result.back() == option ? "=" : ",") + argument;
      else
        result.push_back(argument);
      takes_numbers = begins || argument.rfind(option + "=", 0) == 0 ||
                      (takes_numbers && base::is_numbers(argument));
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
      const std::string name = argument.substr(0, argument.find('='));
      const std::string similar = base::did_you_mean(name, known);
      if (!similar.empty())
        return similar;
      std::vector<std::string> swapped; // two letters of a short word are two edits
      for (const std::string &one : known)
        if (std::is_permutation(name.begin(), name.end(), one.begin(), one.end()))
          swapped.push_back(one);
      return base::did_you_mean(swapped);
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
             : type.rfind("FLOAT", 0) == 0 ? "; give a number such as 0.5 or 1e-3, without a unit "
                                             "(all values in one system of units, so that 200 GPa "
                                             "are 200e9 in Pa)"
                                           : "";
    }

    std::string explain_missing_command(const CLI::App &app)
    {
      std::string all;
      for (const std::string &name : commands_of(app))
        all += (all.empty() ? "" : ", ") + name;
      const std::vector<std::string> given = app.remaining();
      const std::string first = given.empty() ? "" : given[0];
      return "no known command is given; write plumbline run SCENE, or another command: " + all +
             (first.empty() || first[0] == '-' ? "" : "; '" + first + "' is not a command") +
             (first.empty() ? "" : hint(first, app));
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
