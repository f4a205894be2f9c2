#include "reference/tetrahedra/pair_lanes.h"

#include <cmath>

namespace plumbline::reference
{
  namespace
  {
    using Wide = algebra::Wide;
#define PLUMBLINE_INLINE [[gnu::always_inline]] inline

    struct Vectors
    {
      Wide x, y, z;
    };

    PLUMBLINE_INLINE Wide all(double value)
    {
      return Wide{} + value;
    }
    PLUMBLINE_INLINE Wide load(const Lanes &from)
    {
      return algebra::load<Wide>(from);
    }
    PLUMBLINE_INLINE void store(const Wide &value, Lanes &to)
    {
      std::memcpy(to, &value, sizeof(value));
    }
    PLUMBLINE_INLINE Vectors load(const Lanes (&from)[3])
    {
      return {load(from[0]), load(from[1]), load(from[2])};
    }
    PLUMBLINE_INLINE Vectors all(const double (&value)[3])
    {
      return {all(value[0]), all(value[1]), all(value[2])};
    }
    PLUMBLINE_INLINE Vectors operator-(const Vectors &a, const Vectors &b)
    {
      return {a.x - b.x, a.y - b.y, a.z - b.z};
    }
    PLUMBLINE_INLINE Vectors operator+(const Vectors &a, const Vectors &b)
    {
      return {a.x + b.x, a.y + b.y, a.z + b.z};
    }
    PLUMBLINE_INLINE Vectors operator*(const Vectors &a, const Wide &b)
    {
      return {a.x * b, a.y * b, a.z * b};
    }
    PLUMBLINE_INLINE Wide dot(const Vectors &a, const Vectors &b)
    {
      return a.x * b.x + a.y * b.y + a.z * b.z;
    }
    PLUMBLINE_INLINE Vectors cross(const Vectors &a, const Vectors &b)
    {
      return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
    }
    PLUMBLINE_INLINE Wide root(const Wide &a)
    {
      Lanes values;
      store(a, values);
      for (double &value : values)
        value = std::sqrt(value);
      return load(values);
    }
    PLUMBLINE_INLINE Wide least(const Wide &a, const Wide &b)
    {
      return a < b ? a : b;
    }
    PLUMBLINE_INLINE Wide most(const Wide &a, const Wide &b)
    {
      return a > b ? a : b;
    }
    PLUMBLINE_INLINE Wide size(const Wide &a)
    {
      return a < 0 ? -a : a;
    }

    constexpr unsigned int next[3] = {1, 2, 0}, last[3] = {2, 0, 1}; // NOLINT

    /// A face as its partner's plane sees it: see FormFace.
    struct Seen
    {
      Wide height[3], rise[3], beta[3], least_rise; // NOLINT
    };

    PLUMBLINE_INLINE Seen look(const Vectors (&x)[3], const Lanes (&is_own)[3],
                               const Vectors &normal, const Vectors &base, const Vectors &axis,
                               const Vectors &middle, double rounding, Lanes (&is_parallel)[3])
    {
      Seen seen;
      Wide along[3]; // NOLINT
#pragma GCC unroll 3
      for (unsigned int k = 0; k < 3; ++k)
      {
        seen.height[k] = dot(normal, x[k] - base) * load(is_own[k]);
        along[k] = dot(axis, x[k] - middle);
      }
      seen.least_rise = all(1);
#pragma GCC unroll 3
      for (unsigned int k = 0; k < 3; ++k)
      {
        const Wide rise = seen.height[next[k]] - seen.height[k];
        const auto parallel = size(rise) <= rounding;
        const Wide slope = (along[next[k]] - along[k]) / rise;
        seen.beta[k] = parallel ? all(0) : along[k] - seen.height[k] * slope;
        seen.rise[k] = parallel ? all(0) : rise;
        seen.least_rise = parallel ? seen.least_rise : least(seen.least_rise, size(rise));
        store(parallel ? all(1) : all(0), is_parallel[k]);
      }
      return seen;
    }

    PLUMBLINE_INLINE Wide separation(const Vectors (&f)[3], const Vectors (&g)[3])
    {
      const Wide third = all(1. / 3);
      const Vectors line = (g[0] + g[1] + g[2] - f[0] - f[1] - f[2]) * third;
      const Wide upper = most(dot(line, f[0]), most(dot(line, f[1]), dot(line, f[2])));
      const Wide lower = least(dot(line, g[0]), least(dot(line, g[1]), dot(line, g[2])));
      return (lower - upper) / root(dot(line, line));
    }
  } // namespace

  PLUMBLINE_WIDE_CLONES
  void find_factors(const FirstFace &first, double rounding, PairLanes &pairs)
  {
    const Vectors f[3] = {all(first.x[0]), all(first.x[1]), all(first.x[2])};    // NOLINT
    const Vectors g[3] = {load(pairs.x[0]), load(pairs.x[1]), load(pairs.x[2])}; // NOLINT
    const Vectors normal = all(first.normal), other = load(pairs.normal);
    store(separation(f, g), pairs.separation);
    const Vectors product = cross(normal, other);
    const Wide sine = root(dot(product, product)), inverse = 1 / sine;
    const Vectors axis = product * inverse;
    const Vectors middle = (f[0] + f[1] + f[2] + g[0] + g[1] + g[2]) * all(1. / 6);
    const Seen of_f = look(f, pairs.is_own_first, other, load(pairs.base), axis, middle, rounding,
                           pairs.is_parallel_first);
    const Seen of_g = look(g, pairs.is_own, normal, load(pairs.base_of_first), axis, middle,
                           rounding, pairs.is_parallel);
#pragma GCC unroll 3
    for (unsigned int i = 0; i < 3; ++i)
    {
#pragma GCC unroll 3
      for (unsigned int j = 0; j < 3; ++j)
      {
        const Wide gap = (of_f.beta[i] - of_g.beta[j]) * inverse;
        store(of_f.rise[i] * of_g.rise[j] * gap * gap, pairs.edges[i][j]);
      }
      store(of_f.height[i] * (of_f.beta[i] - of_f.beta[last[i]]) * inverse, pairs.first[i]);
      store(of_g.height[i] * (of_g.beta[last[i]] - of_g.beta[i]) * inverse, pairs.second[i]);
    }
    constexpr double share = 1e-3; // as PairForm's
    const Vectors apart = f[0] - g[0];
    store(1 + share * root(dot(apart, apart)) / least(of_f.least_rise, of_g.least_rise),
          pairs.growth);
  }

  PLUMBLINE_WIDE_CLONES
  void measure_triangles(PlaneLanes &planes)
  {
    const Vectors normal = load(planes.normal);
    const Vectors x[3] = {load(planes.x[0]), load(planes.x[1]), load(planes.x[2])}; // NOLINT
    store(size(dot(normal, x[0])), planes.distance);
#pragma GCC unroll 3
    for (unsigned int k = 0; k < 3; ++k)
    {
      const Vectors side = x[next[k]] - x[k];
      const Wide length = root(dot(side, side));
      const Vectors along = side * (1 / length);
      const Wide from = dot(along, x[k]);
      store(from, planes.from[k]);
      store(from + length, planes.to[k]);
      store(dot(cross(along, normal), x[k]), planes.kappa[k]);
    }
  }

  PLUMBLINE_WIDE_CLONES
  void measure_parallelograms(PlaneLanes &planes)
  {
    const Vectors w = load(planes.x[0]), a = load(planes.x[1]), b = load(planes.x[2]);
    const Vectors product = cross(a, b);
    const Wide area = root(dot(product, product));
    const Vectors normal = product * (1 / area);
    store(area, planes.area);
    store(normal.x, planes.normal[0]);
    store(normal.y, planes.normal[1]);
    store(normal.z, planes.normal[2]);
    store(size(dot(normal, w)), planes.distance);
    const Vectors opposite = w + b - a;
    const Wide of_a = root(dot(a, a)), of_b = root(dot(b, b));
    const auto add = [&](unsigned int k, const Vectors &along, const Vectors &start,
                         const Wide &length) __attribute__((always_inline))
    {
      const Wide from = dot(along, start);
      store(from, planes.from[k]);
      store(from + length, planes.to[k]);
      store(dot(cross(along, normal), start), planes.kappa[k]);
    };
    const Vectors along_a = a * (1 / of_a), along_b = b * (1 / of_b);
    add(0, along_b, w, of_b);
    add(1, along_a * all(-1), w + b, of_a);
    add(2, along_b * all(-1), opposite, of_b);
    add(3, along_a, w - a, of_a);
  }

  PLUMBLINE_WIDE_CLONES
  void clip(PlaneLanes &planes, unsigned int n, double end)
  {
    const Wide distance = load(planes.distance), height = distance * distance;
    for (unsigned int k = 0; k < n; ++k)
    {
      const Wide kappa = load(planes.kappa[k]), square = kappa * kappa;
      const Wide reach = root(most(all(0), end * end - (square + height)));
      const Wide low = most(load(planes.from[k]), -reach), high = least(load(planes.to[k]), reach);
      store(low, planes.low[k]);
      store(high, planes.high[k]);
      const Wide inverse = 1 / (high - low), low2 = low * low + square,
                 high2 = high * high + square;
      store((root(low2) + root(high2)) * inverse, planes.axis[k]);
      store((root(low2 + height) + root(high2 + height)) * inverse, planes.axis_in_space[k]);
    }
  }

  namespace
  {
    struct WidePieces
    {
      Wide square, height, centre, half, foot;
    };

    /// @param size  coefficients; 0: of a series
    template <std::size_t size>
    PLUMBLINE_INLINE Wide polynomial(const PieceForm &form, const Wide &r)
    {
      if constexpr (size > 0)
      {
        Wide sum = all(form.c[size - 1]);
        for (std::size_t j = size - 1; j-- > 0;)
          sum = sum * r + form.c[j];
        return sum;
      }
      const Wide x = 4 * r - 2;
      Wide sum = all(0), before = all(0);
      for (std::size_t j = form.n - 1; j > 0; --j)
      {
        const Wide now = x * sum + (form.c[j] - before);
        before = sum;
        sum = now;
      }
      return x * sum * .5 + (form.c[0] - before);
    }

    /// (H - foot) / ρ² at one point.
    template <PieceForm::Kind kind, std::size_t size>
    PLUMBLINE_INLINE Wide term(const PieceForm &form, const WidePieces &pieces, double point)
    {
      const Wide tau = pieces.centre + pieces.half * point;
      const Wide s = pieces.square + tau * tau, r2 = s + pieces.height, r = root(r2);
      const Wide sum = polynomial<size>(form, r);
      if constexpr (kind == PieceForm::Kind::inside)
        return (sum * r - pieces.foot) / s;
      if constexpr (kind == PieceForm::Kind::outside)
        return (sum - pieces.foot * r2) / (s * r2);
      const Wide x = most(all(0), form.end - r), x2 = x * x;
      const Wide power = form.power == 7 ? x2 * x2 * x2 * x : x2 * x2 * x; // NOLINT
      return -(power * sum + pieces.foot * r2) / (s * r2);
    }

    template <PieceForm::Kind kind, std::size_t size>
    PLUMBLINE_INLINE void sum(const PieceForm &form, const double *points, const double *weights,
                              unsigned int n, PieceLanes &lanes)
    {
      const WidePieces pieces{load(lanes.square), load(lanes.height), load(lanes.centre),
                              load(lanes.half), load(lanes.foot)};
      Wide total = all(0);
      for (unsigned int q = 0; q < n; ++q)
        total += weights[q] * term<kind, size>(form, pieces, points[q]);
      store(total, lanes.total);
    }

    /// Coefficients beyond the form's are 0.
    template <PieceForm::Kind kind>
    PLUMBLINE_INLINE void sum_by_size(const PieceForm &form, const double *points,
                                      const double *weights, unsigned int n, PieceLanes &lanes)
    {
      constexpr std::size_t few = 2, some = 3, more = 6, many = 8, most = 64;
      if (form.is_series)
        sum<kind, 0>(form, points, weights, n, lanes);
      else if (form.n <= few)
        sum<kind, few>(form, points, weights, n, lanes);
      else if (form.n <= some)
        sum<kind, some>(form, points, weights, n, lanes);
      else if (form.n <= more)
        sum<kind, more>(form, points, weights, n, lanes);
      else if (form.n <= many)
        sum<kind, many>(form, points, weights, n, lanes);
      else if (form.n <= 2 * many)
        sum<kind, 2 * many>(form, points, weights, n, lanes);
      else
        sum<kind, most>(form, points, weights, n, lanes);
    }
  } // namespace

  PLUMBLINE_WIDE_CLONES
  void sum_pieces(const PieceForm &form, const double *points, const double *weights,
                  unsigned int n, PieceLanes &pieces)
  {
    if (form.kind == PieceForm::Kind::compact)
      sum_by_size<PieceForm::Kind::compact>(form, points, weights, n, pieces);
    else if (form.kind == PieceForm::Kind::inside)
      sum_by_size<PieceForm::Kind::inside>(form, points, weights, n, pieces);
    else
      sum<PieceForm::Kind::outside, 3>(form, points, weights, n, pieces);
  }
#undef PLUMBLINE_INLINE
} // namespace plumbline::reference
