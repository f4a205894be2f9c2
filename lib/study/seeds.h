#pragma once

#include "scene/random_section.h"
#include "scene/scene.h"

#include <cstddef>
#include <string>

namespace plumbline::study
{
  /// "The field is drawn whole: Random/seed = 7, Random/realisation = 3"; empty where nothing was
  /// drawn, as of modes of a covariance.
  /// @param n_samples  each has the realisation of its number, from 1 on; 0: the scene's own one
  std::string seed_words(const scene::RandomSection &random, std::size_t n_samples = 0);
} // namespace plumbline::study
