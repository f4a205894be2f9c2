#pragma once

#include <string>

namespace plumbline::app
{
  struct NewSceneOptions
  {
    std::string name; ///< of the file, '.prm' may be left out
    std::string kind = "scalar";
    std::string domain = "square";
    std::string kernel, methods; ///< empty: those of the kind
  };

  /// Writes a short scene. @return the exit code
  /// @throws InputError  the file is there already, or it would be no valid scene: nothing is left
  int write_new_scene(const NewSceneOptions &options);
} // namespace plumbline::app
