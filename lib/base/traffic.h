#pragma once

#include <cstdint>

namespace plumbline::base
{
  /// Messages that a rank sends to others, and the bytes in them.
  struct Traffic
  {
    std::uint64_t n_messages = 0, n_bytes = 0;

    Traffic &operator+=(const Traffic &other)
    {
      n_messages += other.n_messages;
      n_bytes += other.n_bytes;
      return *this;
    }
    friend Traffic operator*(std::uint64_t n, const Traffic &one)
    {
      return {n * one.n_messages, n * one.n_bytes};
    }
    friend bool operator==(const Traffic &a, const Traffic &b)
    {
      return a.n_messages == b.n_messages && a.n_bytes == b.n_bytes;
    }
  };
} // namespace plumbline::base
