#pragma once

#include "driver/scene_input.h"
#include "study/certificate.h"

#include <functional>

namespace plumbline::driver
{
  struct CertifyOptions : SceneOptions
  {
    unsigned int reference_level = 0; ///< from 1, the coarsest; 0: the finest
  };

  /// The result of `certify` for a scene, whether or not it can be certified.
  /// @param reference_level  from 1, the coarsest; 0: the finest
  /// @param begin            called once the scene is known to be suitable, before it is solved
  /// @throws InputError      as study::check_certifiable; no such method or rule
  /// @note Collective.
  study::Certificate certificate_of(
      const scene::Scene &scene, unsigned int reference_level,
      const std::function<void()> &begin = [] {});

  /// @param shows_values     of what is not certain, on standard error
  /// @throws InputError      a point is listed twice
  /// @throws NumericalError  nothing is certified
  void check_certified(const study::Certificate &certificate, bool shows_values);

  /// Certify a scene's solution at the points of Output/points and its mean, see study::certify, by
  /// Reference/method and the first meshfree rule of Methods/names; write certificate.json, .csv
  /// and .md, and print the table with the answer last.
  /// @return  exit code: 0; 3: the two ways disagree or a bound is missing, and nothing is written
  /// @throws InputError  as study::check_certifiable; no such method or rule
  int certify(const CertifyOptions &options);
} // namespace plumbline::driver
