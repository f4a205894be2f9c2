// Static problems in space for tests: a scene of a few settings, and its results.
#pragma once

#include "base/error.h"
#include "study/preflight.h"
#include "study/statics.h"
#include "tests/study/operators.h"

#include <algorithm>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace plumbline::study::in_space
{
  using Settings = std::vector<scene::Override>;

  inline const std::string polynomial = "x^3*y^2 + z^4 + x*y*z^2";

  inline Settings with(Settings settings, const Settings &more)
  {
    settings.insert(settings.end(), more.begin(), more.end());
    return settings;
  }

  /// The last of one key holds.
  inline Settings last_of_each(const Settings &settings)
  {
    Settings last;
    for (const auto &one : settings)
    {
      last.erase(std::remove_if(last.begin(), last.end(),
                                [&](const auto &other) { return other.key == one.key; }),
                 last.end());
      last.push_back(one);
    }
    return last;
  }

  inline scene::Scene make_scene(Settings settings)
  {
    settings.insert(settings.begin(),
                    {{"Domain/dimension", "3"}, {"Domain/boxes", "0,0,0 : 1,1,1"}});
    const auto is_given = [&](const std::string &key)
    {
      return std::any_of(settings.begin(), settings.end(),
                         [&](const auto &one) { return one.key == key; });
    };
    for (const auto &[key, value] :
         std::map<std::string, std::string>{{"Problem/solution", polynomial},
                                            {"Methods/names", "FA"},
                                            {"Study/h", "1/8, 1/16"},
                                            {"Study/norms", "nodal Linf, averages L2"},
                                            {"Study/decisive error", "nodal Linf | exact"}})
      if (!is_given(key))
        settings.push_back({key, value});
    return scene::parse_scene("space.prm", "", last_of_each(settings));
  }

  inline Methods available()
  {
    Methods all = meshfree::methods();
    for (const auto &method : reference::methods())
      all.push_back(method);
    return all;
  }

  inline StudyResults run(const scene::Scene &scene, const StaticsOptions &options = {})
  {
    const Methods all = available();
    return run_study(statics_analysis(all, options), scene, choose_methods(scene, all));
  }

  inline std::string message_of(const Settings &settings)
  {
    try
    {
      (void)choose_methods(make_scene(settings), available());
    }
    catch (const InputError &error)
    {
      return error.what();
    }
    return "";
  }

  /// What refuses a scene as it is made, its methods, or its data.
  inline std::string refusal_of(const std::function<scene::Scene()> &make)
  {
    try
    {
      const scene::Scene scene = make();
      (void)choose_methods(scene, available());
      check_data(scene);
    }
    catch (const InputError &error)
    {
      return error.what();
    }
    return "";
  }
} // namespace plumbline::study::in_space
