#pragma once

#include "study/certificate.h"

#include <filesystem>
#include <string>

namespace plumbline::io
{
  /// The number under "schema" of certificates; it changes when a key changes its meaning or goes
  /// away.
  constexpr unsigned int certificate_schema = 1;

  /// As certificate.schema.json describes it; the same certificate gives the same bytes.
  std::string to_json(const study::Certificate &certificate);

  /// @param file  for messages
  /// @throws InputError  no JSON, another schema, a key that is missing or of another type, no
  /// points, a bound that is no number; the message names the file, the key and the remedy
  study::Certificate certificate_from_json(const std::string &text, const std::string &file);

  /// @throws InputError  no such file, or as certificate_from_json
  study::Certificate read_certificate(const std::filesystem::path &file);
} // namespace plumbline::io
