#include "scene/aliases.h"

namespace plumbline::scene
{
  const std::vector<Alias> &aliases()
  {
    static const std::vector<Alias> all = {
        {"Domain/interaction domain", "Domain/collar", "", ""},
        {"Material/dilatation in interaction domain", "Material/collar dilatation", "", ""},
        {"Fracture/bond toughness", "Fracture/toughness of bonds", "", ""},
        {"Fracture/max load", "Fracture/largest load", "", ""},
        {"Fracture/min reaction", "Fracture/least reaction", "", ""},
        {"Fracture/no-fail zones", "Fracture/unbreaking", "", ""},
        {"Expected/wave growth rates", "Expected/strain growth", "", ""},
        {"Fracture/surface terms", "", "yes", "published"},
        {"Fracture/surface terms", "", "no", "uncorrected"},
        {"Sampling/analysis", "", "of the scene", "scene"},
        {"Solver/dilatation", "", "eliminated", "condensed"},
        {"Solver/dilatation", "", "kept", "mixed"},
        {"Expected/growth ends", "", "parted", "separated"}};
    return all;
  }

  std::string current_key(const std::string &path)
  {
    for (const Alias &one : aliases())
      if (one.old_key == path)
        return one.key;
    return path;
  }

  std::string current_value(const std::string &key, const std::string &value)
  {
    for (const Alias &one : aliases())
      if (one.old_key.empty() && one.key == key && one.old_value == value)
        return one.value;
    return value;
  }
} // namespace plumbline::scene
