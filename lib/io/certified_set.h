#pragma once

#include "study/certificate.h"

#include <filesystem>
#include <string>
#include <vector>

// The certified problems that come with the program, NLB-01 and so on.
namespace plumbline::io
{
  /// The prefix under which the running command is installed, if it is.
  std::filesystem::path prefix_of_command();

  /// Folder of the scenes: PREFIX/share/plumbline/scenes, else that of the source tree.
  std::filesystem::path scenes_folder(const std::filesystem::path &prefix);

  /// Names of the set in order, e.g. NLB-01.
  /// @throws InputError  there is no set
  std::vector<std::string> certified_names(const std::filesystem::path &prefix);

  /// A certificate of the set by its name, in any case and with '-' or '_'; or one that 'certify'
  /// has written, by the name of its file. Its hash is checked.
  /// @throws InputError  no such file or problem, with all names; no certificate; a hash that is
  /// not that of the scene's text
  study::Certificate certificate_of(const std::string &problem,
                                    const std::filesystem::path &prefix);
} // namespace plumbline::io
