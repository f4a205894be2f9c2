#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>

namespace plumbline::base
{
  /// Tells whether a content is the same as before: FNV-1a of 64 bits. Not for what someone would
  /// forge.
  class ContentHash
  {
  public:
    void add(const char *bytes, std::size_t n)
    {
      constexpr std::uint64_t prime = 0x100000001b3;
      for (std::size_t i = 0; i < n; ++i)
        hash_ = (hash_ ^ static_cast<unsigned char>(bytes[i])) * prime;
    }

    /// 16 digits.
    std::string text() const
    {
      std::array<char, 17> digits{};
      std::snprintf(digits.data(), digits.size(), "%016llx",
                    static_cast<unsigned long long>(hash_));
      return digits.data();
    }

  private:
    std::uint64_t hash_ = 0xcbf29ce484222325;
  };

  inline std::string content_hash(const std::string &text)
  {
    ContentHash hash;
    hash.add(text.data(), text.size());
    return hash.text();
  }
} // namespace plumbline::base
