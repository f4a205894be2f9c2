#include "arguments.h"

namespace plumbline::app
{
  std::string explain(const CLI::ParseError &error)
  {
    const std::string said = error.what();
    const auto behind = [&](const std::string &mark)
    {
      const std::size_t at = said.find(mark);
      return at == std::string::npos ? said : said.substr(at + mark.size());
    };
    const auto is = [&](const auto *kind)
    { return dynamic_cast<decltype(kind)>(&error) != nullptr; };
    const std::string help = "; 'plumbline COMMAND --help' tells all";
    if (is(static_cast<const CLI::ExtrasError *>(nullptr)))
      return "the argument '" + behind(": ") +
             "' is not known; 'plumbline --help' lists the commands, 'plumbline COMMAND --help' "
             "what they take";
    if (is(static_cast<const CLI::RequiredError *>(nullptr)))
      return said.find("ubcommand") == std::string::npos
                 ? said.substr(0, said.find(' ')) + " is missing" + help
                 : "no command that is known is given; write plumbline run SCENE, or 'plumbline "
                   "--help' for the others";
    if (is(static_cast<const CLI::ConversionError *>(nullptr)))
      return "the value of " + behind(": ") + " is not of the right kind" + help;
    if (is(static_cast<const CLI::ArgumentMismatch *>(nullptr)))
      return said.substr(0, said.find(':')) + " has no value, or too many" + help;
    return "the arguments cannot be used (" + said + ")" + help;
  }
} // namespace plumbline::app
