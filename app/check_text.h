#pragma once

#include "requirements.h"

namespace plumbline::app
{
  /// What is found, for people; the answer last.
  std::string check_text(const Findings &found, const Requirements &required,
                         const CheckOptions &options);

  /// The same for programs, a JSON object.
  std::string check_json(const Findings &found, const Requirements &required,
                         const CheckOptions &options, int exit_code);
} // namespace plumbline::app
