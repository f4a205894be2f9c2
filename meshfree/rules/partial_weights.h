#pragma once

#include "meshfree/rules/bonds.h"

namespace plumbline::meshfree
{
  /// How the weights of a square lattice violate assumption A4 of the convergence proof of Pflug,
  /// Stingl & Zetzmann 2026, with w = weight / h²:
  ///   (a) w = 0 for |ξ| >= δ + h/√2;  (b) w = 1 for |ξ| <= δ - h/√2;
  ///   (c) 0 <= w <= 1;                (d) w(ξ) = w(-ξ).
  /// @return the letters, each with the worst bond; empty: they satisfy it, to 1e-12
  std::string violation_of_a4(const Bonds<2> &bonds, double horizon);
} // namespace plumbline::meshfree
