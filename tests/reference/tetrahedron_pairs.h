// ∬γ over pairs of tetrahedra by edges and vertices, with no integral over faces: a way that shares
// nothing with ExactPairs.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace plumbline::reference
{
  /// Along a ray z = R ω from the origin the correlation of two tetrahedra T and T' is a spline of
  /// degree 3 in R. Its knots are on the planes of the differences e' - e of edges and of G' - v of
  /// a face and a vertex. Beyond a knot at R = 1 it is, near there, a jump of the third derivative
  /// whose factor is a product of the slopes of the barycentric coordinates that vanish there. So
  ///   ∬_{T×T'} r^k [r > 1] = Σ c_Π ∫_Π M(|z|) dA,   M(R) = ∫_{1/R}^1 (λ R)^k λ² (1 - λ)³ dλ,
  /// where, with edges a, b, w from one to the other, V = w·(a×b), the corners k, l of T and k', l'
  /// of T' that are not on the edges,
  ///   c = V⁴ / (216 |T| |T'| (∇λ'_k'·a)(∇λ'_l'·a)(∇λ_k·b)(∇λ_l·b)) / |a×b|,
  /// and with a vertex x_i and the face opposite to corner m of T', μ_j the share of the way from
  /// x_i to x_j where λ'_m vanishes, c = 6 |T| |T'| λ'_m(x_i) Π_j μ_j / (2 |G|). All r: from λ = 0.
  /// Pieces with a vertex that both have vanish. Real has the digits that nearly parallel edges and
  /// faces cost.
  template <class Real>
  class TetrahedronPair
  {
  public:
    using Vector = std::array<Real, 3>;
    using Tetrahedron = std::array<Vector, 4>;

    TetrahedronPair(const Tetrahedron &first, const Tetrahedron &second)
        : cells_{first, second}, volumes_{volume(first), volume(second)}, slopes_{slopes(first),
                                                                                  slopes(second)}
    {
      constexpr int n = 20;
      const Real pi = 4 * atan(Real(1));
      for (int i = 1; i <= n; ++i)
      {
        // Newton's method for zeros of Legendre's polynomial
        Real x = cos(pi * (i - Real(1) / 4) / (n + Real(1) / 2)), slope = 1;
        for (int step = 0; step < 8; ++step)
        {
          Real before = 1, here = x;
          for (int k = 2; k <= n; ++k)
          {
            const Real next = ((2 * k - 1) * x * here - (k - 1) * before) / k;
            before = here;
            here = next;
          }
          slope = n * (x * here - before) / (x * x - 1);
          x -= here / slope;
        }
        points_.push_back(x);
        weights_.push_back(2 / ((1 - x * x) * slope * slope));
      }
    }

    const Real &volume(unsigned int cell) const { return volumes_[cell]; }

    /// ∬ r^k [r < 1], k = -1, 0, 1.
    Real within(int k) const
    {
      return (k == 0 ? volumes_[0] * volumes_[1] : sum(k, true)) - sum(k, false);
    }

  private:
    static Vector minus(const Vector &a, const Vector &b)
    {
      return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    }
    static Vector times(const Real &s, const Vector &a) { return {s * a[0], s * a[1], s * a[2]}; }
    static Real dot(const Vector &a, const Vector &b)
    {
      return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    }
    static Vector cross(const Vector &a, const Vector &b)
    {
      return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    }
    static Real norm(const Vector &a)
    {
      using std::sqrt;
      return sqrt(dot(a, a));
    }
    static Real volume(const Tetrahedron &t)
    {
      using std::abs;
      return abs(dot(minus(t[1], t[0]), cross(minus(t[2], t[0]), minus(t[3], t[0])))) / 6;
    }
    static Tetrahedron slopes(const Tetrahedron &t)
    {
      Tetrahedron result;
      for (unsigned int k = 0; k < 4; ++k)
      {
        const Vector &from = t[(k + 1) % 4];
        const Vector normal = cross(minus(t[(k + 2) % 4], from), minus(t[(k + 3) % 4], from));
        result[k] = times(1 / dot(normal, minus(t[k], from)), normal);
      }
      return result;
    }

    Real sum(int k, bool is_all) const
    {
      Real result = 0;
      constexpr std::array<std::array<unsigned int, 4>, 6> edges = {
          {{0, 1, 2, 3}, {0, 2, 1, 3}, {0, 3, 1, 2}, {1, 2, 0, 3}, {1, 3, 0, 2}, {2, 3, 0, 1}}};
      for (const auto &e : edges)
        for (const auto &f : edges)
          result += edge_pair(e, f, k, is_all);
      for (unsigned int cell = 0; cell < 2; ++cell)
        for (unsigned int vertex = 0; vertex < 4; ++vertex)
          for (unsigned int face = 0; face < 4; ++face)
            result += vertex_and_face(cell, vertex, face, k, is_all);
      return result;
    }

    Real edge_pair(const std::array<unsigned int, 4> &e, const std::array<unsigned int, 4> &f,
                   int k, bool is_all) const
    {
      const auto &[x, y] = cells_;
      for (const unsigned int i : {e[0], e[1]})
        for (const unsigned int j : {f[0], f[1]})
          if (x[i] == y[j])
            return 0;
      const Vector a = minus(x[e[1]], x[e[0]]), b = minus(y[f[1]], y[f[0]]),
                   w = minus(y[f[0]], x[e[0]]), normal = cross(a, b);
      const Real v = dot(w, normal), area = norm(normal);
      const Real factor =
          v * v * v * v /
          (216 * volumes_[0] * volumes_[1] * dot(slopes_[1][f[2]], a) * dot(slopes_[1][f[3]], a) *
           dot(slopes_[0][e[2]], b) * dot(slopes_[0][e[3]], b));
      const Vector wb = minus(y[f[1]], x[e[0]]);
      return factor / area *
             plane({w, wb, minus(wb, a), minus(w, a)}, times(1 / area, normal), k, is_all);
    }

    Real vertex_and_face(unsigned int cell, unsigned int i, unsigned int m, int k,
                         bool is_all) const
    {
      const Tetrahedron &x = cells_[cell], &y = cells_[1 - cell];
      std::vector<Vector> corners;
      for (unsigned int j = 0; j < 4; ++j)
        if (j != m)
        {
          if (y[j] == x[i])
            return 0;
          corners.push_back(minus(y[j], x[i]));
        }
      const Vector &slope = slopes_[1 - cell][m];
      const Real at = -dot(slope, corners[0]); // λ'_m(x_i)
      Real factor = 6 * volumes_[0] * volumes_[1] * at;
      for (unsigned int j = 0; j < 4; ++j)
        if (j != i)
          factor *= -at / dot(slope, minus(x[j], x[i]));
      const Vector normal = cross(minus(corners[1], corners[0]), minus(corners[2], corners[0]));
      const Real area = norm(normal);
      return factor / area * plane(corners, times(1 / area, normal), k, is_all);
    }

    /// H' = R M. [all: from 0; else from R = 1, for R > 1]
    static Real antiderivative(const Real &radius, int k, bool is_all)
    {
      const Real r = radius;
      Real power = 1, sum = 0;
      for (int i = 0; i < k + 2; ++i)
        power *= r;
      constexpr std::array<int, 4> binomial = {1, -3, 3, -1};
      if (is_all)
      {
        for (int j = 0; j < 4; ++j)
          sum += Real(binomial[static_cast<std::size_t>(j)]) / (k + 3 + j);
        return sum * power / (k + 2);
      }
      if (!(r > 1))
        return 0;
      Real x = 1 / r, own = x;
      for (int i = 0; i < k + 2; ++i)
        own *= x;
      Real other = x;
      for (int j = 0; j < 4; ++j)
      {
        sum += Real(binomial[static_cast<std::size_t>(j)]) *
               (power * (1 - own) / (k + 3 + j) - (1 - other) / (j + 1));
        own *= x;
        other *= x;
      }
      return sum / (k + 2);
    }

    Real plane(const std::vector<Vector> &corners, const Vector &normal, int k, bool is_all) const
    {
      using std::abs;
      const Real distance = abs(dot(normal, corners[0])),
                 foot = antiderivative(distance, k, is_all);
      Real result = 0;
      for (std::size_t i = 0; i < corners.size(); ++i)
      {
        const Vector side = minus(corners[(i + 1) % corners.size()], corners[i]);
        const Real length = norm(side);
        const Vector along = times(1 / length, side);
        const Real kappa = dot(cross(along, normal), corners[i]), from = dot(along, corners[i]);
        result += line({kappa, distance, foot, k, is_all}, from, from + length, 0);
      }
      return result;
    }

    struct Line
    {
      Real kappa = 0, distance = 0, foot = 0;
      int k = 0;
      bool is_all = false;
    };

    /// κ ∫ (H(r) - H(d)) / (κ² + τ²) dτ, in pieces where r is analytic and on one side of 1.
    Real line(const Line &line, const Real &from, const Real &to, unsigned int depth) const
    {
      using std::atan2;
      using std::sqrt;
      const Real &kappa = line.kappa;
      const Real eta = kappa * kappa + line.distance * line.distance, size = to - from;
      constexpr unsigned int most_depth = 40;
      constexpr double least_axis = 1.6, least_piece = 1e-18;
      if (!line.is_all && eta < 1 && depth < most_depth)
        for (const Real &root : {Real(sqrt(1 - eta)), Real(-sqrt(1 - eta))})
          if (root - from > least_piece && to - root > least_piece)
            return this->line(line, from, root, depth) + this->line(line, root, to, depth);
      const Real middle = (from + to) / 2;
      if (!line.is_all && eta + middle * middle <= 1)
        return -line.foot * atan2(kappa * size, kappa * kappa + from * to);
      const Real axis = (sqrt(from * from + eta) + sqrt(to * to + eta)) / size;
      if (axis < least_axis && depth < most_depth)
      {
        const Real cut = from < 0 && to > 0 ? Real(0) : middle;
        return this->line(line, from, cut, depth + 1) + this->line(line, cut, to, depth + 1);
      }
      Real sum = 0;
      for (std::size_t q = 0; q < points_.size(); ++q)
      {
        const Real tau = middle + size / 2 * points_[q], square = kappa * kappa + tau * tau;
        const Real radius = sqrt(line.distance * line.distance + square);
        sum += weights_[q] * (antiderivative(radius, line.k, line.is_all) - line.foot) / square;
      }
      return kappa * size / 2 * sum;
    }

    std::array<Tetrahedron, 2> cells_;
    std::array<Real, 2> volumes_;
    std::array<Tetrahedron, 2> slopes_;  ///< ∇λ
    std::vector<Real> points_, weights_; ///< of Gauss's rule on [-1, 1]
  };
} // namespace plumbline::reference
