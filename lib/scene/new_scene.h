#pragma once

#include <string>

namespace plumbline::scene
{
  struct NewSceneOptions
  {
    std::string name; ///< of the file, '.prm' may be left out
    std::string kind = "scalar";
    std::string domain = "square";
    std::string kernel, methods; ///< empty: those of the kind
  };

  /// Writes a short scene. @return its file
  /// @throws InputError  the file is there already, or it would be no valid scene: nothing is left
  std::string write_new_scene(const NewSceneOptions &options);
} // namespace plumbline::scene
