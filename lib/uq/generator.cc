#include "uq/generator.h"

#include <cmath>

namespace plumbline::uq
{
  namespace
  {
    std::mt19937_64 seeded(std::uint64_t seed, std::uint64_t stream)
    {
      std::seed_seq numbers{
          static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32),
          static_cast<std::uint32_t>(stream), static_cast<std::uint32_t>(stream >> 32)};
      return std::mt19937_64(numbers);
    }
  } // namespace

  Generator::Generator(std::uint64_t seed, std::uint64_t stream) : bits_(seeded(seed, stream)) {}

  double Generator::uniform()
  {
    return static_cast<double>(bits_() >> 11) * 0x1p-53;
  }

  double Generator::normal()
  {
    if (has_spare_)
    {
      has_spare_ = false;
      return spare_;
    }
    const double radius = std::sqrt(-2 * std::log1p(-uniform()));
    const double angle = 2 * M_PI * uniform();
    spare_ = radius * std::sin(angle);
    has_spare_ = true;
    return radius * std::cos(angle);
  }

  unsigned int Generator::poisson(double mean)
  {
    unsigned int n = 0;
    for (double time = -std::log1p(-uniform()); time < mean; time -= std::log1p(-uniform()))
      ++n;
    return n;
  }
} // namespace plumbline::uq
