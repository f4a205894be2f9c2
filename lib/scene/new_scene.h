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

  /// What is written, and the command that runs it.
  struct NewScene
  {
    std::string file, command;
    std::string table; ///< of the kernel's profile, beside the scene; empty: it needs none
    std::string note;  ///< what was found in a mesh file; empty: there is none
  };

  /// Writes a short scene, and a table where its kernel needs one.
  /// @throws InputError  a file is there already, or it would be no valid scene: nothing is left
  NewScene write_new_scene(const NewSceneOptions &options);
} // namespace plumbline::scene
