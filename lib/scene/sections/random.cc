#include "base/error.h"
#include "base/text_file.h"
#include "scene/keys.h"
#include "scene/problem_sections.h"
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
  using uq::Law;
  using uq::Variable;

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
                         "' is not a name; write a letter, then letters, digits and '_'");
      return variable;
    }

    /// "Section/key: expression"
    RandomKey to_random_key(const std::string &text)
    {
      const auto colon = text.find(':'), slash = text.find('/');
      if (colon == std::string::npos || slash > colon)
        throw InputError("'" + text + "' is not understood; write 'Section/key: expression'");
      RandomKey one{trim(text.substr(0, colon)), trim(text.substr(colon + 1))};
      const std::string section = one.key.substr(0, slash);
      for (const char *const fixed :
           {"Random", "Sampling", "Study", "Methods", "Reference", "Output", "Expected"})
        if (section == fixed)
          throw InputError("'" + one.key +
                           "' is the same for all samples; name a number of the model, e.g. "
                           "Crack/load or Time/damping");
      return one;
    }

    /// One number for both, or two.
    std::array<double, 2> to_pair(const std::string &text)
    {
      std::vector<double> numbers;
      for (const std::string &name : to_names(text))
        numbers.push_back(to_number(name));
      if (numbers.empty() || numbers.size() > 2)
        throw InputError("'" + text + "' must be one number, or two separated by ','");
      return {numbers.front(), numbers.back()};
    }

    geometry::Box bounding_box(const geometry::Domain &domain)
    {
      geometry::Box box = domain.include.front();
      for (const geometry::Box &one : domain.include)
        for (unsigned int d = 0; d < 2; ++d)
        {
          box.lower[d] = std::min(box.lower[d], one.lower[d]);
          box.upper[d] = std::max(box.upper[d], one.upper[d]);
        }
      return box;
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
        "may use: 'name: normal MEAN DEVIATION' (0 and 1 if left out) or 'name: uniform LOWEST "
        "HIGHEST' (-1 and 1), separated by ';'.");
    keys.add(
        "keys", "", any_text(),
        [this](const std::string &text)
        {
          random_keys.clear();
          for (const std::string &part : split_outside_brackets(text, ';'))
            if (!part.empty())
              random_keys.push_back(to_random_key(part));
        },
        "Further keys with random numbers: 'Section/key: expression' in the variables, separated "
        "by ';', e.g. 'Crack/load: 1 + 0.05*a'. The values are read as if the scene gave them.");
    keys.add("values", values, numbers(),
             "Values of the random variables, one for each variable, then one for each mode; "
             "'plumbline sample' varies them. Empty: their means.");
    keys.add("field", field,
             "A random field, called R in these expressions. exponential, separable exponential, "
             "Gaussian, Matern: truncated Karhunen-Loeve expansion of the covariance. ellipses: 1 "
             "in randomly placed ellipses, else 0; complete realisations, or, with Random/modes, "
             "an expansion in the principal components of many. files: the fields of Random/files, "
             "as complete realisations or expanded in their principal components.");
    keys.add("modes", n_modes, count(0, 10000),
             "Of the field, each a standard normal variable after Random/variables; 0: it is drawn "
             "whole (ellipses, files). Of n files n - 1 at most.");
    keys.add(
        "files", "", any_text(), [this](const std::string &text) { files = to_names(text); },
        "Of the field files: names of CSV files from the scene's folder, separated by ','. Each is "
        "a grid of numbers that fills the field's box, a line for each row of cells, the first one "
        "along the upper side, all of one size; R is the number of the cell. Realisations 1, 2, "
        "... take them in this order, and again from the first one after the last.");
    keys.add(
        "box", "", boxes(), [this](const std::string &text) { box = to_boxes(text); },
        "That the field fills, written like Domain/boxes; beyond it the field is what it is at "
        "the nearest point. Empty: the box about Domain/boxes. [length]");
    keys.add("cell", cell, any_number(),
             "Mesh size of the lattice over the field's box that modes are found on; files bring "
             "theirs. [length]");
    keys.add("mean", mean, any_number(), "Of a field of a covariance.");
    keys.add("deviation", deviation, any_number(), "Of a field of a covariance, > 0.");
    keys.add(
        "length", "1", any_text(), [this](const std::string &text) { length = to_pair(text); },
        "Correlation length > 0, or two, along x and y, separated by ','. [length]");
    keys.add(
        "smoothness", smoothness, any_number(),
        "nu > 0 of the Matern covariance: 0.5 is exponential, the limit of large nu is Gaussian.");
    keys.add("fraction", fraction, between(0, 1), "Expected area fraction of the ellipses.");
    keys.add(
        "semi-axes", "1, 1", any_text(),
        [this](const std::string &text) { semi_axes = to_pair(text); },
        "Semi-axes of the ellipses, two numbers > 0 separated by ','. [length]");
    keys.add("overlap", may_overlap, "no", "yes", "Whether ellipses may overlap.");
    keys.add("realisation", realisation, count(0),
             "Number of the realisation of ellipses or files; 'plumbline sample' draws many.");
    keys.add(
        "realisations", n_realisations, count(2, 1000000),
        "Number of realisations of ellipses from which the principal components are computed.");
    keys.add("seed", seed, count(0), "Seed of random fields.");
  }

  std::vector<Law> RandomSection::laws() const
  {
    std::vector<Law> laws;
    for (const Variable &variable : variables)
      laws.push_back(variable.law);
    laws.resize(laws.size() + n_modes, Law::normal);
    return laws;
  }

  std::vector<double> RandomSection::present_values() const
  {
    if (!values.empty())
      return values;
    std::vector<double> means;
    for (const Variable &variable : variables)
      means.push_back(variable.centre);
    means.resize(means.size() + n_modes, 0);
    return means;
  }

  physics::Names RandomSection::names() const
  {
    physics::Names names;
    names.origin = origin;
    const std::vector<double> present = present_values();
    for (std::size_t i = 0; i < variables.size(); ++i)
      names.constants[variables[i].name] = present[i];
    if (place)
      names.fields["R"] = place;
    return names;
  }

  void RandomSection::check_variables() const
  {
    std::set<std::string> taken = {"x", "y", "t", "h", "pi", "delta", "R"};
    for (const Variable &variable : variables)
      require(taken.insert(variable.name).second,
              "Random/variables: '" + variable.name +
                  "' is a reserved or repeated name; choose another");
    const std::size_t n = variables.size() + n_modes;
    require(values.empty() || values.size() == n,
            "Random/values has " + std::to_string(values.size()) + " numbers for " +
                std::to_string(n) + " variables; give one for each, or none");
  }

  std::vector<std::pair<std::string, double>> RandomSection::key_values() const
  {
    check_variables();
    std::vector<std::pair<std::string, double>> result;
    physics::Names of_variables;
    of_variables.constants = names().constants;
    for (const RandomKey &one : random_keys)
    {
      const physics::Expression number("Random/keys: " + one.key, one.expression, of_variables);
      require(number.n_components() == 1 && number.is_constant(),
              "Random/keys: " + one.key + " = '" + one.expression +
                  "' is not a number; use only constants and Random/variables");
      result.emplace_back(one.key, number({}));
    }
    return result;
  }

  void RandomSection::complete(const DomainSection &domain, const std::string &folder)
  {
    check_variables();
    require(files.empty() || field == FieldKind::files,
            "Random/files = " + base::shown(join(files, ", ")) +
                " is for Random/field = files, but Random/field = " + base::word(field) +
                "; clear it, or write files");
    require(!files.empty() || field != FieldKind::files,
            "Random/field = files needs Random/files, which is empty; give names of CSV files, "
            "separated by ','");
    if (field == FieldKind::none)
    {
      require(n_modes == 0, "Random/modes = " + std::to_string(n_modes) +
                                " needs a field; give Random/field, or write 0");
      return;
    }
    require(box.size() <= 1,
            "Random/box has " + std::to_string(box.size()) +
                " boxes; give one that covers the domain and its interaction domain");
    require(!box.empty() || (domain.mesh.is_of_boxes() && domain.mesh.map.empty()),
            "Random/field = " + base::word(field) + " with Domain/mesh = " + domain.mesh.name +
                (domain.mesh.map.empty() ? "" : " and Domain/map") +
                " needs a box, which is not known before the mesh is made; give Random/box = 'x0, "
                "y0 : x1, y1'");
    if (!source)
      source = std::make_shared<const RandomField>(
          *this, box.empty() ? bounding_box(domain.boxes) : box.front(), folder);
    std::vector<double> modes(n_modes, 0);
    if (!values.empty())
      modes.assign(values.end() - n_modes, values.end());
    place = source->at(modes, realisation);
  }
} // namespace plumbline::scene
