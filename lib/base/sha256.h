#pragma once

#include <string>

namespace plumbline::base
{
  /// SHA-256 of a text, 64 hexadecimal digits in lower case (FIPS 180-4), by OpenSSL.
  std::string sha256(const std::string &text);
} // namespace plumbline::base
