#pragma once

#include "study/study_results.h"

#include <filesystem>
#include <string>

namespace plumbline::io
{
  /// The number under "schema" of results; it changes when a key changes its meaning or goes away.
  constexpr unsigned int schema = 7;

  /// What a study finds, as results.schema.json describes it. NaN and infinity are null.
  std::string to_json(const study::StudyResults &results);

  /// @param file  for messages
  /// @throws InputError  no JSON, another schema, a key that is missing or of another type
  study::StudyResults from_json(const std::string &text, const std::string &file);
} // namespace plumbline::io
