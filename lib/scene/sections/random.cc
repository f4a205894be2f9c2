#include "base/error.h"
#include "scene/keys.h"
#include "scene/random_section.h"
#include "scene/values.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>
#include <sstream>

namespace plumbline::scene
{
  using physics::split_outside_brackets;
  using random::Law;
  using random::Variable;

  namespace
  {
    /// "name: normal MEAN DEVIATION" or "name: uniform LOWEST HIGHEST"; the numbers may be left
    /// out.
    Variable to_variable(const std::string &text)
    {
      const auto colon = text.find(':');
      const std::string form = "write 'name: normal MEAN DEVIATION' or 'name: uniform LOWEST "
                               "HIGHEST', the numbers or none";
      if (colon == std::string::npos)
        throw InputError("'" + text + "' has no ':'; " + form);
      Variable variable;
      variable.name = trim(text.substr(0, colon));
      std::istringstream words(text.substr(colon + 1));
      std::string law, rest;
      words >> law;
      std::getline(words, rest);
      const auto found = base::from_word<Law>(law);
      const std::vector<double> numbers = to_numbers(rest);
      if (!found || (!numbers.empty() && numbers.size() != 2))
        throw InputError("'" + text + "' is not understood; " + form);
      variable.law = *found;
      if (!numbers.empty())
      {
        const bool is_normal = variable.law == Law::normal;
        variable.centre = is_normal ? numbers[0] : .5 * (numbers[0] + numbers[1]);
        variable.scale = is_normal ? numbers[1] : .5 * (numbers[1] - numbers[0]);
        if (!(variable.scale > 0) || !std::isfinite(variable.centre + variable.scale))
          throw InputError("'" + text + "': " +
                           (is_normal ? "a deviation must be positive"
                                      : "the lowest value must be below the highest"));
      }
      const bool is_name =
          !variable.name.empty() && std::isalpha(static_cast<unsigned char>(variable.name[0])) &&
          std::all_of(variable.name.begin(), variable.name.end(),
                      [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; });
      if (!is_name)
        throw InputError("'" + variable.name +
                         "' is no name; write a letter, then letters, digits and '_'");
      return variable;
    }
  } // namespace

  void RandomSection::declare(Keys &keys)
  {
    keys.add(
        "variables", "", any_text(),
        [this](const std::string &text)
        {
          variables.clear();
          for (const std::string &part : split_outside_brackets(text, ';'))
            if (!part.empty())
              variables.push_back(to_variable(part));
        },
        "Independent random variables that expressions of Material, Kernel, Problem and Fracture "
        "may name: 'name: normal MEAN DEVIATION' (0 and 1 if left out) or 'name: uniform LOWEST "
        "HIGHEST' (-1 and 1), separated by ';'.");
    keys.add(
        "values", values, numbers(),
        "At which the scene is taken, one for each variable, then one for each mode; 'plumbline "
        "sample' takes many. Empty: their means.");
  }

  std::vector<Law> RandomSection::laws() const
  {
    std::vector<Law> laws;
    for (const Variable &variable : variables)
      laws.push_back(variable.law);
    laws.resize(laws.size() + n_modes, Law::normal);
    return laws;
  }

  physics::Names RandomSection::names() const
  {
    physics::Names names;
    for (std::size_t i = 0; i < variables.size(); ++i)
      names.constants[variables[i].name] = values.empty() ? variables[i].centre : values[i];
    return names;
  }

  void RandomSection::complete() const
  {
    std::set<std::string> taken = {"x", "y", "t", "h", "pi", "delta", "R"};
    for (const Variable &variable : variables)
      require(taken.insert(variable.name).second,
              "Random/variables: '" + variable.name +
                  "' means something already; take a name of its own");
    const std::size_t n = variables.size() + n_modes;
    require(values.empty() || values.size() == n,
            "Random/values has " + std::to_string(values.size()) + " numbers for " +
                std::to_string(n) + " variables; give one for each, or none");
  }
} // namespace plumbline::scene
