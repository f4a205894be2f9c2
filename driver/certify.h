#pragma once

#include "driver/scene_input.h"

namespace plumbline::driver
{
  struct CertifyOptions : SceneOptions
  {
    unsigned int reference_level = 0; ///< from 1, the coarsest; 0: the finest
  };

  /// Certify a scene's solution at the points of Output/points and its mean, see study::certify, by
  /// Reference/method and the first meshfree rule of Methods/names; write certificate.json, .csv
  /// and .md, and print the table with the answer last.
  /// @return  exit code: 0; 3: the two ways disagree or a bound is missing, and nothing is written
  /// @throws InputError  as study::check_certifiable; no such method or rule
  int certify(const CertifyOptions &options);
} // namespace plumbline::driver
