#pragma once

#include <string>
#include <vector>

namespace plumbline::scene
{
  /// A name that the literature has for a method; see method_name().
  struct PublishedName
  {
    std::string name;
    std::vector<std::string> ours; ///< our name; several: it stands for any of them, so for none
    std::string source;
  };

  /// All published names that differ from ours by more than case.
  const std::vector<PublishedName> &published_names();

  /// Those that stand for this method alone.
  std::vector<std::string> published_names_of(const std::string &method);
} // namespace plumbline::scene
