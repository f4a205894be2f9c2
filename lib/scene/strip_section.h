#pragma once

namespace plumbline::scene
{
  class Keys;

  /// A strip between rigid grips with a standing crack, see method::RiceStrip.
  struct StripSection
  {
    double height = 1; ///< between the grips [length]
    double length = 0; ///< 0: there is none [length]
    double crack = 0;  ///< from its left end [length]

    bool is_there() const { return length != 0; }

    void declare(Keys &keys);
    /// @throws InputError  a number that is out of range
    void complete() const;
  };
} // namespace plumbline::scene
