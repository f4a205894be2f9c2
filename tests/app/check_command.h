// `plumbline check` on the example of scenes/check.
#pragma once

#include "command.h"

namespace plumbline::app
{
  inline const fs::path folder = fs::path(PLUMBLINE_SCENES) / "check";
  inline const std::string nodes_file = (folder / "nodes.csv").string(),
                           bonds_file = (folder / "bonds.csv").string(),
                           scene_file = (folder / "check.prm").string();

  inline Outcome check(const std::string &nodes, const std::string &bonds,
                       const std::string &more = "")
  {
    // files go where they are told to, or nowhere
    const bool is_silent =
        more.find("--json") != std::string::npos || more.find("--quiet") != std::string::npos;
    const std::string output = is_silent || more.find("-o ") != std::string::npos
                                   ? ""
                                   : " -o " + temporary("check").string();
    return run("check " + nodes + " " + bonds + " --scene " + scene_file + " " + more + output);
  }
} // namespace plumbline::app
