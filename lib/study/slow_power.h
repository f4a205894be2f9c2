#pragma once

#include <vector>

namespace plumbline::study
{
  /// How errors that flatten go on below the levels that were run.
  struct Approach
  {
    enum class Kind
    {
      plateau,    ///< to a limit above 0
      slow_power, ///< to 0 like x^power
      undecided   ///< the levels fit both
    };
    Kind kind = Kind::undecided;
    double power = 0;         ///< of the slow power that fits best
    double low = 0, high = 0; ///< powers that fit as well, by the same test as below
  };

  /// Tells a plateau from a slow power, such as the √δ of a force at a crack tip or of a jump in
  /// L2. Both are sums of two fields: one that is constant or falls like x^s, .4 <= s <= .7, and
  /// one that falls like x^p, p >= 3/4 and p >= s + 1/4. The norm of a sum is c x^s + b x^p where
  /// the fields are parallel and √(c² x^2s + b² x^2p) where they are orthogonal; c, b >= 0, and
  /// both norms are tried. A law is chosen where its squared residuals (relative) are smaller than
  /// those of the other one by the factor that an F test of two three-parameter fits asks for at 5
  /// %: 161 for four levels, 19 for five, 9.3 for six. The exponent of a slow power is a fourth
  /// parameter, which four levels cannot test. Where the last two errors fall slower than x^.4,
  /// no slow power is possible.
  /// @pre at least four levels, x decreasing, e > 0
  Approach find_approach(const std::vector<double> &x, const std::vector<double> &e);
} // namespace plumbline::study
