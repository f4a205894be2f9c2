#include "scene/required_keys.h"

#include "base/error.h"
#include "scene/scene_keys.h"
#include "scene/values.h"

#include <cstdlib>
#include <functional>
#include <map>

namespace plumbline::scene
{
  namespace
  {
    /// Zero, for lengths and times, is as good as no value.
    bool is_nothing(const std::string &value)
    {
      char *end = nullptr;
      const double number = std::strtod(value.c_str(), &end);
      return end == value.c_str() + value.size() && (value.empty() || number == 0);
    }

    struct RequiredKey
    {
      std::string key, meaning;
      enum class When
      {
        always,
        at_rest,  ///< with Time/final time it may be left out
        in_motion ///< only with Time/final time
      } when = When::always;
    };

    struct Requirement
    {
      std::string subject; ///< what the command needs the keys for
      std::vector<RequiredKey> keys;
      std::string remedy;
      bool has_density = false; ///< with Time/density the material is not c = beta = 1
    };

    using When = RequiredKey::When;

    const std::map<std::string, Requirement> &requirements()
    {
      static const std::map<std::string, Requirement> all = {
          {"crack",
           {"a notched strip of double-well bonds",
            {{"Crack/notch", "the notch's length"},
             {"Kernel/limit", "= Navier"},
             {"Material/model", "= double well"},
             {"Time/final time", "the duration"}},
            "'plumbline new NAME --kind crack' writes a scene that has them",
            true}},
          {"grow",
           {"a body pulled by grips, and bonds that can break",
            {{"Fracture/toughness", "G_c"},
             {"Kernel/limit", "= Navier"},
             {"Material/model", "= LPS"},
             {"Domain/cracks", "the notch", When::in_motion},
             {"Domain/fixed", "the grips", When::at_rest},
             {"Problem/constraint", "the displacement of the grips at load 1", When::at_rest},
             {"Time/density", "the mass per volume, of bodies in motion", When::in_motion}},
            "scenes/fracture/plate.prm ('plumbline list scenes') is a scene that has them"}}};
      return all;
    }

    /// A crack in a material with a density has a toughness: c = beta = 1 are not meant then.
    bool lacks_material(const std::function<std::string(const std::string &)> &value_of)
    {
      if (value_of("Time/density").empty())
        return false;
      for (const char *const key : {"E", "toughness", "c", "beta"})
        if (!value_of(std::string("Material/") + key).empty())
          return false;
      return true;
    }
  } // namespace

  void require_keys(const std::string &analysis, const std::string &file,
                    const std::vector<Override> &overrides)
  {
    const auto found = requirements().find(analysis);
    if (found == requirements().end() || is_read_once(file))
      return;
    const auto value_of = [&](const std::string &key)
    { return value_of_key(file, overrides, key); };
    std::vector<std::string> missing;
    try
    {
      const bool is_moving = !is_nothing(value_of("Time/final time"));
      for (const RequiredKey &one : found->second.keys)
        if (const std::string value = value_of(one.key);
            is_nothing(value) && one.when != (is_moving ? When::at_rest : When::in_motion))
          missing.push_back(one.key +
                            (one.meaning[0] == '=' ? " " + one.meaning : " (" + one.meaning + ")"));
      if (found->second.has_density && lacks_material(value_of))
        missing.emplace_back("Material/E and Material/toughness (G_c), or Material/c and beta");
    }
    catch (const InputError &)
    {
      return; // read_scene() says where and why
    }
    if (!missing.empty())
      throw InputError("scene '" + file + "': 'plumbline " + analysis + "' needs " +
                       found->second.subject + "; " +
                       (missing.size() == 1 ? "this is missing: " : "these are missing: ") +
                       join(missing, ", ") + "; " + found->second.remedy);
  }
} // namespace plumbline::scene
