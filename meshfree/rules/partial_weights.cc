#include "meshfree/rules/partial_weights.h"

#include "base/number_text.h"

#include <array>
#include <cmath>
#include <map>

namespace plumbline::meshfree
{
  std::string violation_of_a4(const Bonds<2> &bonds, double horizon)
  {
    constexpr double tolerance = 1e-12;
    const double h = bonds.h;
    std::map<std::array<long, 2>, double> weights; // of all nodes that A4 speaks of
    const long n = std::lround(std::ceil(horizon / h)) + 1;
    for (long j = -n; j <= n; ++j)
      for (long i = -n; i <= n; ++i)
        weights[{i, j}] = 0;
    for (const Bond<2> &bond : bonds.family)
      weights[{std::lround(bond.xi[0] / h), std::lround(bond.xi[1] / h)}] = bond.weight / (h * h);

    struct Worst
    {
      double distance = 0, weight = 0;
      std::array<long, 2> k{};
    };
    std::map<char, Worst> worst;
    for (const auto &[k, w] : weights)
    {
      if (k == std::array<long, 2>{})
        continue;
      const auto mirror = weights.find({-k[0], -k[1]});
      const double opposite = mirror == weights.end() ? 0 : mirror->second,
                   r = std::hypot(k[0], k[1]) * h, half = h / std::sqrt(2.);
      const auto check = [&, here = k, weight = w](char letter, bool applies, double distance)
      {
        if (applies && distance > tolerance && distance > worst[letter].distance)
          worst[letter] = {distance, weight, here};
      };
      check('a', r >= (horizon + half) * (1 - tie_tolerance), std::abs(w));
      check('b', r <= (horizon - half) * (1 + tie_tolerance), std::abs(w - 1));
      check('c', true, std::max(-w, w - 1));
      check('d', true, std::abs(w - opposite));
    }
    std::string text;
    for (const auto &[letter, one] : worst)
      if (one.distance > 0)
        text += (text.empty() ? "(" : ", (") + std::string(1, letter) +
                ") w = " + base::to_text(one.weight, 4) + " at ξ = (" + std::to_string(one.k[0]) +
                ", " + std::to_string(one.k[1]) + ") h";
    return text;
  }
} // namespace plumbline::meshfree
