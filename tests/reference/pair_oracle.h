#pragma once

#include <array>
#include <functional>
#include <vector>

/// Double integrals over a pair of triangles in long double, sharing nothing with the program: in
/// polar coordinates of z = y - x, ∬ C p(x) q(y) = ∫ C(z) ∫_{T ∩ (S - z)} p(x) q(x + z) dx dz.
/// Along a ray the inner integral is a polynomial of |z| between creases, where a vertex of the one
/// triangle meets a side of the other; the angle is cut where the creases that rays cross change.
namespace plumbline::tests
{
  using Real = long double;
  struct Vector
  {
    Real x = 0, y = 0;
  };
  using Triangle = std::array<Vector, 3>; ///< counter-clockwise

  struct OracleKernel
  {
    std::function<Real(Real)> radial; ///< r -> C, times r a polynomial of this degree
    unsigned int degree = 0;
    bool is_tensor = false; ///< C ξ⊗ξ/|ξ|²
    Real horizon = 0;
  };

  /// As PairBlocks, shape (n, n, n_entries): n = 1, 3, 6 shape functions of degree 0, 1, 2.
  struct OracleBlocks
  {
    std::vector<Real> outer, cross, inner;
  };

  /// Accuracy: 1e-17 of C |T| |S|.
  OracleBlocks integrate_pair(const Triangle &t, const Triangle &s, unsigned int degree,
                              const OracleKernel &kernel);
} // namespace plumbline::tests
