#include "study/method_names.h"

#include "base/similar_words.h"

namespace plumbline::study
{
  std::shared_ptr<const method::Method> method_called(const method::Methods &available,
                                                      const std::string &name)
  {
    std::shared_ptr<const method::Method> found;
    bool is_ambiguous = false;
    for (const auto &method : available)
    {
      if (method->name() == name)
        return method;
      if (base::to_lower(method->name()) == base::to_lower(name))
      {
        is_ambiguous = found != nullptr;
        found = method;
      }
    }
    return is_ambiguous ? nullptr : found;
  }

  scene::Scene with_names_of(scene::Scene scene, const method::Methods &available)
  {
    const auto rename = [&](std::string &name)
    {
      if (const auto method = method_called(available, name))
        name = method->name();
    };
    for (std::string &name : scene.methods.names)
      rename(name);
    if (scene.reference.method)
      rename(*scene.reference.method);
    for (scene::Expected &one : scene.expected.all)
      rename(one.method);
    return scene;
  }
} // namespace plumbline::study
