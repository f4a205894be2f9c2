#pragma once

namespace plumbline::meshfree
{
  /// Numbers that agree to so many digits count as the same: files are often written with six.
  constexpr double file_tolerance = 2e-5;

  /// How exact the numbers of another code are, by the digits that its files give.
  struct Precision
  {
    double length = 0;              ///< of coordinates [length]
    double weight = file_tolerance; ///< of weights, relative to the volumes of cells
    double volume = file_tolerance; ///< relative
    double moments = 1e-5;          ///< relative, of sums over a family

    /// @param size    of a node's cell, √ of its area [length]
    /// @param weight  largest rounding of weights, relative to the volumes
    /// @param volume  largest rounding of volumes, relative
    static Precision of_files(double length, double weight, double volume, double size,
                              double horizon);
  };
} // namespace plumbline::meshfree
