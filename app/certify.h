#pragma once

#include "scene/scene.h"

#include <string>
#include <vector>

namespace plumbline::app
{
  struct CertifyOptions
  {
    std::string scene_file, output; ///< output empty: results/NAME of the scene
    std::vector<scene::Override> overrides;
    unsigned int reference_level = 0; ///< from 1, the coarsest; 0: the finest
    bool quiet = false, json = false;
  };

  /// Certify a scene's solution at the points of Output/points and its mean, see study::certify, by
  /// Reference/method and the first meshfree rule of Methods/names; write certificate.json, .csv
  /// and .md, and print the table with the answer last.
  /// @return  exit code: 0; 3: the two ways disagree or a bound is missing, and nothing is written
  /// @throws InputError  as study::check_certifiable; no such method or rule
  int certify(const CertifyOptions &options);
} // namespace plumbline::app
