#pragma once

#include <cstdint>
#include <random>

namespace plumbline::uq
{
  /// Random numbers that are the same with every compiler: 64-bit Mersenne twister and seed
  /// sequence, both specified to the bit by the C++ standard, with transforms of our own in place
  /// of the standard's distributions, which are not. Normal numbers and those of Poisson take sin,
  /// cos and log of the C library, whose last bits may differ.
  /// Source: Nishimura 2000, doi:10.1145/369534.369540.
  class Generator
  {
  public:
    /// @param seed    of a whole study
    /// @param stream  of one sample of it: other streams are independent of it for all that is
    /// known
    explicit Generator(std::uint64_t seed, std::uint64_t stream = 0);

    /// In [0, 1): the upper 53 bits of a 64-bit number, times 2^-53.
    double uniform();

    /// Of mean 0 and variance 1: Box & Muller 1958, doi:10.1214/aoms/1177706645; √(-2 log(1 - u))
    /// cos(2πv), then the one with sin.
    double normal();

    /// The number of arrivals in a time `mean` >= 0, those being -log(1 - u) apart; the time it
    /// takes is proportional to it.
    unsigned int poisson(double mean);

  private:
    std::mt19937_64 bits_;
    double spare_ = 0; ///< the other normal number of a pair
    bool has_spare_ = false;
  };
} // namespace plumbline::uq
