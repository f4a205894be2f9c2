#include "scene/scene.h"

#include "base/communicator.h"
#include "base/error.h"
#include "base/number_text.h"
#include "base/similar_words.h"
#include "base/text_file.h"
#include "physics/expression.h"
#include "scene/aliases.h"
#include "scene/capabilities.h"
#include "scene/checks.h"
#include "scene/input_files.h"
#include "scene/keys.h"
#include "scene/models/model.h"
#include "scene/on_line.h"
#include "scene/origin.h"
#include "scene/scene_file.h"
#include "scene/scene_keys.h"
#include "scene/unused_keys.h"
#include "scene/values.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <map>

namespace plumbline::scene
{
  namespace
  {
    void declare(Keys &keys, Scene &scene)
    {
      keys.add("Purpose", scene.purpose, "Purpose of the scene, in one line.");
      const auto section = [&](const std::string &name, auto &members)
      {
        keys.enter(name);
        members.declare(keys);
      };
      section("Domain", scene.domain);
      section("Random", scene.random);
      section("Kernel", scene.kernel);
      section("Material", scene.material);
      section("Problem", scene.problem);
      section("Methods", scene.methods);
      section("Study", scene.study);
      section("Sampling", scene.sampling);
      section("Time", scene.time);
      section("Crack", scene.crack);
      section("Fracture", scene.fracture);
      section("Strip", scene.strip);
      section("Reference", scene.reference);
      section("Quadrature", scene.quadrature);
      section("Geometry", scene.geometry);
      section("Solver", scene.solver);
      section("Output", scene.output);
      section("Expected", scene.expected);
    }

    /// Derived values and checks, once all keys are read.
    void complete(Scene &scene)
    {
      move_to_domain(scene);
      scene.random.complete(scene.domain, scene.folder);
      scene.kernel.complete(scene.folder);
      scene.material.names = scene.random.names();
      check_model_of_crack(scene);
      scene.material.complete();
      scene.time.complete();
      scene.crack.complete();
      scene.fracture.complete(scene.material.surface_terms);
      scene.strip.complete();
      if (scene.solver.is_full_model)
        scene = full_model(std::move(scene));
      check_space(scene);
      check_kernel_and_problem(scene);
      scene.methods.complete();
      scene.study.complete();
      check_model(scene);
      check_levels(scene);
      check_norms(scene);
      check_mesh_and_nodes(scene);
      check_solver(scene);
      check_motion(scene);
      check_strip(scene);
      check_sampling(scene);
      scene.expected.complete(scene.problem.case_names());
    }

    /// "Section/key" of a key in any spelling that scenes may have.
    std::string name_of_key(const std::string &path)
    {
      Scene scene;
      Keys keys;
      declare(keys, scene);
      return keys.name_of(path);
    }

    /// Where a file sets the key that a message opens with, as ", line 3"; empty: it does not, or
    /// an override does.
    std::string place_of_key(const std::string &message, const std::vector<Setting> &settings,
                             const std::vector<Override> &overrides)
    {
      if (message.find('/') == std::string::npos)
        return "";
      Scene scene;
      Keys keys;
      declare(keys, scene);
      const auto opens_with = [&](const std::string &key)
      {
        return message.rfind(key, 0) == 0 &&
               (message.size() == key.size() ||
                std::isalnum(static_cast<unsigned char>(message[key.size()])) == 0);
      };
      const auto name_of = [&](const std::string &key) -> std::string
      {
        try
        {
          return keys.name_of(key);
        }
        catch (const InputError &) // a message about it is on its way
        {
          return "";
        }
      };
      std::string place, key; // "Time/final time" is no "Time/final"
      for (const Setting &one : settings)
        if (const std::string name = name_of(one.key);
            name.find('/') != std::string::npos && opens_with(name) && name.size() > key.size())
        {
          key = name;
          place = one.place;
        }
      for (const Override &one : overrides)
        if (const std::string name = name_of(one.key);
            !name.empty() && opens_with(name) && name.size() >= key.size())
          place = "";
      const bool is_line = place.find("line ") != std::string::npos; // in JSON files it is the key
      return is_line ? ", " + place : "";
    }

    struct KeyWithoutEffect : InputError
    {
      using InputError::InputError;
    };

    Scene build(const std::string &file, const std::string &what,
                const std::vector<Setting> &settings, const std::vector<Override> &overrides,
                const std::shared_ptr<const RandomField> &field = {});

    /// Whether a scene's file has keys without effect even without overrides.
    bool has_unused_keys(const std::string &file, const std::vector<Setting> &settings,
                         const std::shared_ptr<const RandomField> &field)
    try
    {
      (void)build(file, "", settings, {}, field);
      return false;
    }
    catch (const KeyWithoutEffect &)
    {
      return true;
    }
    catch (const InputError &) // the overrides may give the missing keys
    {
      return false;
    }

    /// The scene without a key of its file that an override has made useless.
    /// @throws KeyWithoutEffect  it is one that is overridden, or useless in the file as it stands
    Scene build_without(const UnusedKey &unused, const std::string &by_default,
                        const std::string &file, const std::string &what,
                        const std::vector<Setting> &settings, std::vector<Override> overrides,
                        const std::shared_ptr<const RandomField> &field)
    {
      const bool is_overridden =
          std::any_of(overrides.begin(), overrides.end(),
                      [&](const Override &one) { return name_of_key(one.key) == unused.key; });
      if (overrides.empty() || is_overridden || has_unused_keys(file, settings, field))
        throw KeyWithoutEffect(what + place_of_key(unused.text, settings, overrides) + ": " +
                               unused.text);
      overrides.push_back({unused.key, by_default});
      return build(file, what, settings, overrides, field);
    }

    /// @param what  opens messages
    /// @param field  random field of the same scene if it is known already, else null
    Scene build(const std::string &file, const std::string &what,
                const std::vector<Setting> &settings, const std::vector<Override> &overrides,
                const std::shared_ptr<const RandomField> &field)
    {
      Scene scene;
      scene.random.source = field;
      scene.name = std::filesystem::path(file).stem().string();
      scene.folder = std::filesystem::path(file).parent_path().string();
      Keys keys;
      declare(keys, scene);
      const auto saying = [&](const std::string &place, const auto &act)
      {
        try
        {
          act();
        }
        catch (const InputError &error)
        {
          throw InputError(
              what +
              (place.empty() ? place_of_key(error.what(), settings, overrides) : ", " + place) +
              ": " + error.what());
        }
      };
      std::map<std::string, std::string> places; // of keys in whatever spelling
      for (const Setting &one : settings)
        saying(one.place,
               [&]
               {
                 keys.set(one.key, one.value);
                 const auto [found, is_new] = places.emplace(keys.name_of(one.key), one.place);
                 if (!is_new)
                   throw InputError(one.key + " is given in " + found->second +
                                    " already; remove one of them");
               });
      for (const Override &one : overrides)
        saying("", [&] { keys.set(one.key, one.value); });
      saying("",
             [&]
             {
               for (const auto &[key, value] : scene.random.key_values())
                 keys.set(key, base::to_text(value, 17));
             });
      scene.text = keys.text(false);
      saying("", [&] { complete(scene); });
      saying("",
             [&]
             {
               require(!scene.material.toughness || keys.is_given("Time/density"),
                       "Time/density is not given, but Material/E and toughness have units: speeds "
                       "depend on it; give the density, such as 2450 kg/m^3 with E in Pa");
             });
      if (const auto unused = find_unused_key(keys, scene))
        return build_without(*unused, keys.default_of(unused->key), file, what, settings, overrides,
                             field);
      scene.text += describe_files(scene);
      return scene;
    }

    /// Checks that the scene is valid at all values of Study/variable.
    /// @param what  opens messages
    Scene checked(Scene scene, const std::string &what, const std::vector<Setting> &settings,
                  const std::vector<Override> &overrides)
    try
    {
      if (scene.study.regime == Regime::variable)
        for (const Series &series : scene.study.series)
          for (const Level &level : series.levels)
            (void)at_level(scene, level);
      return scene;
    }
    catch (const InputError &error)
    {
      throw InputError(what + place_of_key(error.what(), settings, overrides) + ": " +
                       error.what());
    }

    std::string opening(const std::string &file)
    {
      return "scene '" + file + "'";
    }

    /// Scene files are a page or two.
    constexpr std::size_t most_bytes = 10'000'000;

    /// The name of a scene that comes from a pipe.
    constexpr auto piped_name = "stdin";
  } // namespace

  bool is_read_once(const std::string &file)
  {
    std::error_code not_there;
    const auto status = std::filesystem::status(file, not_there);
    return std::filesystem::exists(status) && !std::filesystem::is_regular_file(status) &&
           !std::filesystem::is_directory(status);
  }

  Scene full_model(Scene scene)
  {
    scene.solver.is_full_model = true;
    if (scene.domain.mesh.is_lattice() && !scene.domain.is_free_body)
      scene.domain.mesh.name = "squares";
    return scene;
  }

  bool Scene::is_vector() const
  {
    return kernel.structure == physics::Structure::tensor || material.model->takes_influence();
  }

  bool Scene::has_dilatation() const
  {
    return material.model->has_dilatation(*this);
  }

  physics::Names Scene::names(double horizon, double t) const
  {
    physics::Names names = random.names();
    names.is_in_space = domain.is_in_space();
    names.constants["delta"] = horizon;
    if (time.is_dynamic())
      names.constants["t"] = t;
    return names;
  }

  Scene at_sample(Scene scene, const std::vector<double> &values, unsigned int realisation)
  {
    if (!scene.random.random_keys.empty())
    {
      std::string all;
      for (const double value : values)
        all += (all.empty() ? "" : ", ") + base::to_text(value, 17);
      const std::string file = (std::filesystem::path(scene.folder) / scene.name).string();
      std::vector<Setting> settings = read_settings(file, scene.text, "");
      for (Setting &one : settings)
        one.place.clear(); // lines of the text are not those of the file
      Scene anew = build(file + ".prm", opening(scene.name), settings, {{"Random/values", all}},
                         scene.random.source);
      anew.study = scene.study; // fewer levels, perhaps
      scene = std::move(anew);
    }
    scene.random.values = values;
    scene.random.realisation = realisation;
    scene.random.complete(scene.domain, scene.folder);
    scene.material.names = scene.random.names();
    return scene;
  }

  Scene at_level(const Scene &scene, const Level &level)
  {
    const std::vector<uq::Variable> &variables = scene.random.variables;
    if (scene.study.regime != Regime::variable)
      return scene;
    const auto varying =
        std::find_if(variables.begin(), variables.end(),
                     [&](const uq::Variable &one) { return one.name == scene.study.variable; });
    std::vector<double> values = scene.random.present_values();
    values[static_cast<std::size_t>(varying - variables.begin())] = level.value;
    try
    {
      Scene here = at_sample(scene, values, scene.random.realisation);
      if (is_on_intervals(here)) // is the material valid?
        (void)make_kernel_on_line(here, level.horizon);
      else
        (void)make_kernel(here, level.horizon);
      return here;
    }
    catch (const InputError &error)
    {
      throw InputError("Study/values: at " + scene.study.variable + " = " +
                       base::to_text(level.value, 6) + ": " + error.what());
    }
  }

  bool Scene::is_steady() const
  {
    std::vector<std::string> texts;
    for (const std::vector<NamedExpression> &cases : {problem.solutions, problem.loads})
      for (const NamedExpression &one : cases)
        texts.push_back(one.expression);
    if (problem.constraint)
      texts.push_back(*problem.constraint);
    if (time.is_dynamic() && !problem.local_expression.empty())
      texts.push_back(problem.local_expression);
    try // expressions with t do not parse without it
    {
      for (const std::string &text : texts)
      {
        physics::Names steady = random.names();
        steady.is_in_space = domain.is_in_space();
        steady.constants["delta"] = 1;
        (void)physics::Expression("Problem", text, steady);
      }
      return true;
    }
    catch (const InputError &)
    {
      return false;
    }
  }

  physics::Kernel<2> make_kernel(const Scene &scene, double horizon)
  {
    return scene.material.model->kernel(scene, horizon);
  }

  physics::Kernel<3> make_kernel_in_space(const Scene &scene, double horizon)
  {
    return scene.material.model->kernel_in_space(scene, horizon);
  }

  namespace
  {
    /// The file that gives a scene its name; files named in a piped scene are relative to the
    /// working directory.
    std::string place_of(const std::string &file)
    {
      return is_read_once(file) ? std::string(piped_name) + ".prm" : file;
    }

    std::vector<Setting> settings_of_file(const std::string &file)
    {
      const std::string what = opening(file);
      const bool is_pipe = is_read_once(file);
      if (is_pipe && base::Communicator::all().n_ranks() > 1)
        throw InputError(what +
                         " is a pipe, which only one of several ranks can read; give a file");
      std::error_code error;
      if (!std::filesystem::exists(file, error))
        throw InputError(what + " is not there: no such file in '" +
                         std::filesystem::absolute(file).parent_path().lexically_normal().string() +
                         "'; give a .prm or .json file");
      const std::string text = base::read_text_file(file, what, most_bytes, "a .prm or .json file");
      const bool is_json = is_pipe ? text.find_first_not_of(" \t\r\n") == text.find('{')
                                   : base::has_ending(file, ".json");
      return is_json ? read_json_settings(text, what) : read_settings(place_of(file), text, what);
    }
  } // namespace

  Scene read_scene(const std::string &file, const std::vector<Override> &overrides)
  {
    const std::string what = opening(file);
    const std::vector<Setting> settings = settings_of_file(file);
    return checked(build(place_of(file), what, settings, overrides), what, settings, overrides);
  }

  std::string with_place(const std::string &message, const std::string &file,
                         const std::vector<Override> &overrides)
  try
  {
    if (is_read_once(file))
      return message;
    const std::string place = place_of_key(message, settings_of_file(file), overrides);
    return place.empty() ? message : opening(file) + place + ": " + message;
  }
  catch (const InputError &) // the file is no longer what it was
  {
    return message;
  }

  std::string value_of_key(const std::string &file, const std::vector<Override> &overrides,
                           const std::string &key)
  {
    Scene scene;
    Keys keys;
    declare(keys, scene);
    std::string value;
    const auto take = [&](const auto &one)
    {
      if (keys.name_of(one.key) == key)
        value = current_value(key, one.value);
    };
    if (!is_read_once(file)) // its text is still to be read
      for (const Setting &one : settings_of_file(file))
        take(one);
    for (const Override &one : overrides)
      take(one);
    return value;
  }

  Scene parse_scene(const std::string &name, const std::string &text,
                    const std::vector<Override> &overrides)
  {
    base::check_text(text, opening(name));
    const std::string what = opening(name);
    const std::vector<Setting> settings = read_settings(name, text, what);
    return checked(build(name, what, settings, overrides), what, settings, overrides);
  }

  namespace
  {
    const Settings first_steps = {
        {"Purpose", "Which rules are asymptotically compatible?"},
        {"Methods/names", "FA, PA-AC, IPA-AC, IPA-AC-R2, Q1, DGQ0"},
    };
  } // namespace

  namespace
  {
    /// The settings of a model's template, in their order.
    Settings template_settings(const std::string &model)
    {
      std::map<std::string, Settings> templates;
      std::vector<std::string> names;
      for (const Model *const one : models())
        for (const auto &[name, settings] : one->templates())
        {
          templates[name] = settings;
          names.push_back(name);
        }
      const auto found = templates.find(model);
      if (found == templates.end())
        throw InputError("template: model '" + base::shown(model) +
                         "' is not known; choose one of " + join(names, ", ") +
                         base::did_you_mean(model, names));
      Settings all = first_steps;
      all.insert(all.end(), found->second.begin(), found->second.end());
      return all;
    }
  } // namespace

  std::string scene_template(const std::string &model)
  {
    Scene scene;
    Keys keys;
    declare(keys, scene);
    for (const auto &[key, value] : template_settings(model))
      keys.set(key, value);
    return keys.text(true);
  }

  std::string short_template(const std::string &model, const std::vector<Override> &changes)
  {
    Scene scene;
    Keys keys;
    declare(keys, scene);
    std::vector<std::string> order;
    const auto set = [&](const std::string &key, const std::string &value)
    {
      keys.set(key, value);
      if (std::find(order.begin(), order.end(), key) == order.end())
        order.push_back(key);
    };
    for (const auto &[key, value] : template_settings(model))
      set(key, value);
    if (!keys.is_given("Study/regime"))
      for (const std::string key : {"Study/m", "Study/h"})
        set(key, keys.value(key));
    for (const Override &one : changes)
      set(one.key, one.value);
    std::string text;
    for (const std::string &key : order)
      text += "set " + key + " = " + keys.value(key) + "\n";
    return text;
  }

  std::string describe(const std::string &key)
  {
    Scene scene;
    Keys keys;
    declare(keys, scene);
    return keys.describe(key);
  }
} // namespace plumbline::scene
