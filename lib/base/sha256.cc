#include "base/sha256.h"

#include <openssl/evp.h>

#include <array>
#include <stdexcept>

namespace plumbline::base
{
  std::string sha256(const std::string &text)
  {
    std::array<unsigned char, EVP_MAX_MD_SIZE> bytes{};
    unsigned int n_bytes = 0;
    if (EVP_Digest(text.data(), text.size(), bytes.data(), &n_bytes, EVP_sha256(), nullptr) != 1)
      throw std::runtime_error("OpenSSL has no SHA-256");
    constexpr auto digits = "0123456789abcdef";
    constexpr unsigned int half = 4, low = 15; // of a byte: bits, and the lower ones
    std::string result;
    for (unsigned int i = 0; i < n_bytes; ++i)
    {
      result += digits[bytes[i] >> half];
      result += digits[bytes[i] & low];
    }
    return result;
  }
} // namespace plumbline::base
