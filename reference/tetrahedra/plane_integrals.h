#pragma once

#include "reference/tetrahedra/plane_functions.h"

#include <boost/container/small_vector.hpp>

#include <array>
#include <limits>

namespace plumbline::reference
{
  template <class Real>
  struct Vector
  {
    Real x = 0, y = 0, z = 0;

    Vector operator+(const Vector &b) const { return {x + b.x, y + b.y, z + b.z}; }
    Vector operator-(const Vector &b) const { return {x - b.x, y - b.y, z - b.z}; }
    Vector operator*(const Real &a) const { return {x * a, y * a, z * a}; }
    Real dot(const Vector &b) const { return x * b.x + y * b.y + z * b.z; }
    Vector cross(const Vector &b) const
    {
      return {y * b.z - z * b.y, z * b.x - x * b.z, x * b.y - y * b.x};
    }
    Real norm() const
    {
      using std::sqrt;
      return sqrt(dot(*this));
    }
  };

  /// A sum and the sum of its terms' sizes, by which its round-off is measured.
  template <class Real>
  struct Sum
  {
    Real value = 0, size = 0;

    void add(const Real &term)
    {
      using std::abs;
      value += term;
      size += abs(term);
    }
    void add(const Real &factor, const Sum &other)
    {
      using std::abs;
      value += factor * other.value;
      size += abs(factor) * other.size;
    }
  };

  /// Gauss-Legendre rules on [-1, 1] to the precision of Real.
  template <class Real>
  class GaussRules
  {
  public:
    static constexpr unsigned int most_points = 64;
    static constexpr std::size_t n_rules = 14;

    struct Rule
    {
      unsigned int n = 0;
      std::array<Real, most_points> points, weights;
    };

    static const GaussRules &get()
    {
      static const GaussRules rules;
      return rules;
    }

    /// For integrands analytic in the ellipse about the interval whose half axis, in half
    /// lengths, is a; with a zero of order 7 near by, which makes values small.
    /// @param extra  points that the integrand takes besides, as it is multiplied by a polynomial
    /// of twice this degree
    const Rule &for_ellipse(const Real &a, unsigned int extra = 0) const
    {
      return rules_[number_for_ellipse(static_cast<double>(a), extra)];
    }

    std::size_t number_for_ellipse(double axis, unsigned int extra = 0) const
    {
      std::size_t k = 0;
      while (k + 1 < n_rules && axis < least_axis_[k])
        ++k;
      for (const unsigned int n = sizes[k] + extra; k + 1 < n_rules && sizes[k] < n;)
        ++k;
      return k;
    }

    const Rule &rule(std::size_t number) const { return rules_[number]; }

    /// Whether a piece has to be cut: its half axis is small, or no rule has enough points.
    bool must_cut(double axis, unsigned int extra = 0) const
    {
      return !(axis >= std::max(1.44, least_axis_.back())) ||
             (extra > 0 && sizes[number_for_ellipse(axis)] + extra > most_points);
    }

    static Real epsilon() { return std::numeric_limits<Real>::epsilon(); }

  private:
    static constexpr std::array<unsigned int, n_rules> sizes = {6,  7,  8,  10, 12, 14, 16,
                                                                18, 20, 24, 30, 38, 48, 64};

    GaussRules()
    {
      for (std::size_t k = 0; k < sizes.size(); ++k)
      {
        rules_[k] = make(sizes[k]);
        least_axis_[k] = find_least_axis(sizes[k]);
      }
    }

    /// Where n points leave an error a^7 / (a + √(a² - 1))^(2n) of a fiftieth of the round-off.
    static double find_least_axis(unsigned int n)
    {
      static const double digits = -std::log(.02 * static_cast<double>(epsilon()));
      double low = 1, high = 1e4;
      while (high - low > 1e-6 * low)
      {
        const double a = std::sqrt(low * high);
        const bool is_enough =
            2 * n * std::log(a + std::sqrt(a * a - 1)) - 7 * std::log(a) > digits;
        (is_enough ? high : low) = a;
      }
      return high;
    }

    static Rule make(unsigned int n)
    {
      using std::abs;
      Rule rule;
      rule.n = n;
      for (unsigned int q = 0; q < n; ++q)
      {
        Real x = std::cos(M_PI * (q + .75) / (n + .5)), slope = 1;
        for (unsigned int step = 0; step < 8; ++step)
        {
          Real before = 1, now = x;
          for (unsigned int j = 2; j <= n; ++j)
          {
            const Real next = (x * now * (2 * j - 1) - before * (j - 1)) / j;
            before = now;
            now = next;
          }
          slope = (before - x * now) * n / (1 - x * x);
          const Real change = now / slope;
          x -= change;
          if (abs(change) < 2 * epsilon())
            break;
        }
        rule.points[q] = x;
        rule.weights[q] = 2 / ((1 - x * x) * slope * slope);
      }
      return rule;
    }

    std::array<Rule, sizes.size()> rules_;
    std::array<double, sizes.size()> least_axis_{};
  };

  /// Of all parts: the most.
  template <class Real>
  unsigned int extra_points(const std::vector<PotentialPart<Real>> &parts, const Real &length)
  {
    unsigned int most = 0;
    for (const PotentialPart<Real> &part : parts)
      most = std::max(most, part.extra_points(static_cast<double>(length)));
    return most;
  }

  /// H of r = √(ρ² + d²), ρ a distance in a plane that is d away from the origin.
  template <class Real>
  class RadialFunction
  {
  public:
    RadialFunction(const std::vector<PotentialPart<Real>> &parts, const Real &distance)
        : parts_(parts), d_(distance), square_(distance * distance)
    {
    }

    const std::vector<PotentialPart<Real>> &parts() const { return parts_; }
    const Real &distance() const { return d_; } ///< d

    /// values = H at squares ρ², all on the same sides of the ends as one of them.
    void evaluate(const Real *squares, Real *values, unsigned int n, const Real &sample) const
    {
      using std::sqrt;
      std::array<Real, GaussRules<Real>::most_points> r;
      for (unsigned int q = 0; q < n; ++q)
        r[q] = sqrt(squares[q] + square_);
      for (unsigned int q = 0; q < n; ++q)
        values[q] = 0;
      const Real at = sqrt(sample + square_);
      for (const PotentialPart<Real> &part : parts_)
        part.add_regular(r.data(), values, n, at < part.end());
    }

    Real at_foot() const
    {
      Real value = 0;
      if (d_ > 0)
        for (const PotentialPart<Real> &part : parts_)
          part.add_regular(&d_, &value, 1, d_ < part.end());
      return value;
    }

    /// H'(ρ) / ρ.
    Real density(const Real &square) const
    {
      using std::sqrt;
      Real sum = 0;
      for (const PotentialPart<Real> &part : parts_)
        sum += part.density(sqrt(square + square_));
      return sum;
    }

  private:
    const std::vector<PotentialPart<Real>> &parts_;
    Real d_, square_;
  };

  /// The same of an edge, or a plane, that is parallel to a plane d > 0 away. There
  ///   (ρ H)'' = ρ g₁(r), or (ρ² H)''' = ρ f(r),  r = √(ρ² + d²),
  /// integrated from ρ = 0, so that with W_k = ∫_0^ρ σ^k g₁ dσ, or of f,
  ///   H = W_1 - W_2/ρ, or W_1/2 - W_2/ρ + W_3/(2ρ²).
  template <class Real>
  class ParallelFunction
  {
  public:
    ParallelFunction(const std::vector<PotentialPart<Real>> &parts, const Real &distance,
                     bool is_plane)
        : parts_(parts), d_(distance), square_(distance * distance), is_plane_(is_plane)
    {
    }

    const std::vector<PotentialPart<Real>> &parts() const { return parts_; }
    const Real &distance() const { return d_; }

    void evaluate(const Real *squares, Real *values, unsigned int n, const Real &) const
    {
      using std::sqrt;
      for (unsigned int q = 0; q < n; ++q)
      {
        const Real rho = sqrt(squares[q]);
        const std::array<Real, 3> w = integrals(rho);
        values[q] = is_plane_ ? w[0] / 2 + (w[2] / (2 * rho) - w[1]) / rho : w[0] - w[1] / rho;
      }
    }

    Real at_foot() const { return 0; }

    Real density(const Real &square) const
    {
      using std::sqrt;
      const Real rho = sqrt(square), cube = square * rho;
      const std::array<Real, 3> w = integrals(rho);
      return is_plane_ ? (w[1] - w[2] / rho) / cube : w[1] / cube;
    }

  private:
    /// W_1, W_2, W_3 (of planes).
    std::array<Real, 3> integrals(const Real &rho) const
    {
      using std::sqrt;
      std::array<Real, 3> sum{};
      for (const PotentialPart<Real> &part : parts_)
      {
        const Real end = part.end();
        const Real reach = end > d_ ? sqrt((end - d_) * (end + d_)) : Real(0);
        if (d_ < end)
        {
          const Real upper = std::min(rho, reach);
          constexpr double near = 1.5, far = 3; // pieces are as long as poles at ±i d allow
          if (upper < near * d_)
            add_by_rule(part, 0, upper, sum);
          else if (!part.potential().is_series)
            add_in_closed_form(part, upper, sum);
          else
            for (Real from = 0, to = near * d_; from < upper; from = to, to = far * from)
              add_by_rule(part, from, std::min(to, upper), sum);
        }
        if (!is_plane_ && rho > reach)
          add_beyond(part, reach, rho, sum);
      }
      return sum;
    }

    /// r f, or r g₁.
    const RadialPolynomial<Real> &polynomial(const PotentialPart<Real> &part) const
    {
      return is_plane_ ? part.potential() : part.of_edges();
    }

    /// 1/n.
    static const std::array<Real, 64> &inverses()
    {
      static const std::array<Real, 64> values = []
      {
        std::array<Real, 64> result;
        result[0] = 0;
        for (int n = 1; n < 64; ++n)
          result[static_cast<std::size_t>(n)] = Real(1) / n;
        return result;
      }();
      return values;
    }

    void add_by_rule(const PotentialPart<Real> &part, const Real &from, const Real &to,
                     std::array<Real, 3> &sum) const
    {
      using std::sqrt;
      if (!(to > from))
        return;
      const Real size = to - from;
      const Real axis = (sqrt(from * from + square_) + sqrt(to * to + square_)) / size;
      const unsigned int extra = part.extra_points(static_cast<double>(size));
      if (extra > 0 && GaussRules<Real>::get().must_cut(static_cast<double>(axis), extra))
      {
        const Real cut = (from + to) / 2;
        add_by_rule(part, from, cut, sum);
        add_by_rule(part, cut, to, sum);
        return;
      }
      const auto &rule = GaussRules<Real>::get().for_ellipse(axis, extra);
      const Real half = size / 2;
      // series are evaluated at all points together
      std::array<Real, GaussRules<Real>::most_points> sigma, r, value; // filled up to rule.n
      for (unsigned int q = 0; q < rule.n; ++q)
      {
        sigma[q] = from + half * (1 + rule.points[q]);
        r[q] = sqrt(sigma[q] * sigma[q] + square_);
      }
      polynomial(part).evaluate(r.data(), value.data(), rule.n);
      for (unsigned int q = 0; q < rule.n; ++q)
      {
        const Real term = value[q] * (half * rule.weights[q] / r[q] * sigma[q]);
        sum[0] += term;
        sum[1] += term * sigma[q];
        sum[2] += term * sigma[q] * sigma[q];
      }
    }

    void add_in_closed_form(const PotentialPart<Real> &part, const Real &rho,
                            std::array<Real, 3> &sum) const
    {
      using std::log;
      using std::sqrt;
      const Real r = sqrt(rho * rho + square_);
      // ∫ r^m from m = -1 and 0 by ∫ r^m = (ρ r^m + m d² ∫ r^(m-2)) / (m + 1); ∫σ r^m and ∫σ³ r^m
      // by r dr = σ dσ; ∫σ² r^m = ∫ r^(m+2) - d² ∫ r^m
      const std::vector<Real> &coefficients = polynomial(part).c;
      const std::size_t size = coefficients.size();
      std::array<Real, 64> whole, power, of_d;
      power[0] = 1 / r;
      of_d[0] = 1 / d_;
      for (std::size_t k = 1; k < size + 5; ++k)
      {
        power[k] = power[k - 1] * r;
        of_d[k] = of_d[k - 1] * d_;
      }
      const std::array<Real, 64> &inverse = inverses();
      whole[0] = log((rho + r) / d_);
      whole[1] = rho;
      for (std::size_t k = 2; k < size + 2; ++k) // m = k - 1
        whole[k] = (rho * power[k] + square_ * whole[k - 2] * static_cast<int>(k - 1)) * inverse[k];
      for (std::size_t k = 0; k < size; ++k)
      {
        const Real &factor = coefficients[k];
        if (factor == 0)
          continue;
        const Real first = (power[k + 2] - of_d[k + 2]) * inverse[k + 1];
        sum[0] += factor * first;
        sum[1] += factor * (whole[k + 2] - square_ * whole[k]);
        if (is_plane_)
          sum[2] += factor * ((power[k + 4] - of_d[k + 4]) * inverse[k + 3] - square_ * first);
      }
    }

    /// g₁ = M/r⁴ beyond the end.
    void add_beyond(const PotentialPart<Real> &part, const Real &from, const Real &to,
                    std::array<Real, 3> &sum) const
    {
      using std::atan2;
      const Real first = from * from + square_, last = to * to + square_;
      sum[0] += part.moment(2) / 2 * (1 / first - 1 / last);
      const Real angle = atan2((to - from) * d_, square_ + to * from);
      sum[1] += part.moment(2) / 2 * (angle / d_ - to / last + from / first);
    }

    const std::vector<PotentialPart<Real>> &parts_;
    Real d_, square_;
    bool is_plane_;
  };

  /// A side of a polygon in a plane, seen from the foot of the origin there: it runs from ρ = (κ,
  /// from) to (κ, to), where κ > 0 if the foot is on the inner side.
  template <class Real>
  struct PlaneSide
  {
    Real kappa = 0, from = 0, to = 0;
  };

  /// ∫ g over a convex polygon is a sum over its sides, as g = div (ρ (H(r) - H(d)) / ρ²) with
  /// H' = r g, ρ = 0 at the foot of the origin and d its distance:
  ///   Σ κ ∫ (H(r) - H(d)) / (κ² + τ²) dτ,  r² = κ² + d² + τ².
  template <class Real>
  class PlaneIntegral
  {
  public:
    using Point = Vector<Real>;
    static constexpr unsigned int most_points = GaussRules<Real>::most_points;

    /// @param vertices  3 or 4, counter-clockwise about the normal
    PlaneIntegral(const Point *vertices, unsigned int n, const Point &normal) : n_(n)
    {
      using std::abs;
      distance_ = abs(normal.dot(vertices[0]));
      for (unsigned int k = 0; k < n; ++k)
      {
        const Point side = vertices[(k + 1) % n] - vertices[k];
        const Real length = side.norm();
        const Point along = side * (1 / length);
        sides_[k].from = along.dot(vertices[k]);
        sides_[k].to = sides_[k].from + length;
        sides_[k].kappa = along.cross(normal).dot(vertices[k]);
      }
    }

    PlaneIntegral(const std::array<PlaneSide<Real>, 4> &sides, unsigned int n, const Real &distance)
        : n_(n), distance_(distance), sides_(sides)
    {
    }

    const Real &distance() const { return distance_; }

    /// With a function that is regular at 0.
    template <class Function>
    Sum<Real> regular(const Function &f) const
    {
      Sum<Real> sum;
      const Real foot = f.at_foot();
      for (unsigned int k = 0; k < n_; ++k)
        add_side(f, foot, sides_[k], sum);
      Real growth = 1;
      for (const PotentialPart<Real> &part : f.parts())
        growth = std::max(growth, part.growth());
      sum.size *= growth;
      return sum;
    }

    /// With compact functions. @pre  r > 0 on the polygon, not small compared with the ends
    Sum<Real> compact(const std::vector<PotentialPart<Real>> &parts) const
    {
      Sum<Real> sum;
      for (const PotentialPart<Real> &part : parts)
        if (distance_ < part.end())
          add_compact(part, sum);
      return sum;
    }

    Sum<Real> compact(const PotentialPart<Real> &part) const
    {
      Sum<Real> sum;
      if (distance_ < part.end())
        add_compact(part, sum);
      return sum;
    }

  private:
    /// Half the axis of the ellipse about a piece, with foci at its ends, through ±i distance.
    static Real half_axis(const Real &from, const Real &to, const Real &square)
    {
      using std::sqrt;
      return (sqrt(from * from + square) + sqrt(to * to + square)) / (to - from);
    }

    static Real middle(const Real &from, const Real &to)
    {
      return from < 0 && to > 0 ? Real(0) : Real((from + to) / 2);
    }

    template <class Function>
    void add_side(const Function &f, const Real &foot, const PlaneSide<Real> &side,
                  Sum<Real> &sum) const
    {
      using std::sqrt;
      if (side.kappa == 0)
        return;
      const Real eta = side.kappa * side.kappa + distance_ * distance_;
      // pieces between the places where r is at an end
      Real from = side.from;
      while (from < side.to)
      {
        Real to = side.to;
        for (const PotentialPart<Real> &part : f.parts())
        {
          const Real square = part.end() * part.end() - eta;
          if (!(square > 0))
            continue;
          const Real root = sqrt(square);
          if (-root > from && -root < to)
            to = -root;
          if (root > from && root < to)
            to = root;
        }
        add_piece(f, foot, side.kappa, from, to, 0, sum);
        from = to;
      }
    }

    template <class Function>
    void add_piece(const Function &f, const Real &foot, const Real &kappa, const Real &from,
                   const Real &to, unsigned int depth, Sum<Real> &sum) const
    {
      const Real square = kappa * kappa, eta = square + distance_ * distance_,
                 axis = half_axis(from, to, eta);
      const unsigned int extra = extra_points(f.parts(), Real(to - from));
      if (GaussRules<Real>::get().must_cut(static_cast<double>(axis), extra) && depth < most_depth)
      {
        const Real cut = middle(from, to);
        add_piece(f, foot, kappa, from, cut, depth + 1, sum);
        add_piece(f, foot, kappa, cut, to, depth + 1, sum);
        return;
      }
      const auto &rule = GaussRules<Real>::get().for_ellipse(axis, extra);
      std::array<Real, most_points> squares, values;
      const Real centre = (from + to) / 2, half = (to - from) / 2;
      for (unsigned int q = 0; q < rule.n; ++q)
      {
        const Real tau = centre + half * rule.points[q];
        squares[q] = square + tau * tau;
      }
      f.evaluate(squares.data(), values.data(), rule.n, square + centre * centre);
      Real total = 0;
      for (unsigned int q = 0; q < rule.n; ++q)
        total += rule.weights[q] * (values[q] - foot) / squares[q];
      sum.add(total * half * kappa);
    }

    void add_compact(const PotentialPart<Real> &part, Sum<Real> &sum) const
    {
      using std::sqrt;
      Real foot = 0;
      const Real square_of_foot = distance_ * distance_;
      part.add_compact(&square_of_foot, Real(0), &foot, distance_ > 0 ? 1 : 0);
      Compact state{part, foot, 0, false, {}};
      bool is_inside = true;
      for (unsigned int k = 0; k < n_; ++k)
      {
        const PlaneSide<Real> &side = sides_[k];
        is_inside = is_inside && side.kappa >= 0;
        state.kappa = side.kappa;
        if (side.kappa == 0) // of which nothing is seen, but the foot may be on it
        {
          state.is_subtracted = state.is_subtracted || is_near_foot(side);
          continue;
        }
        const Real eta = side.kappa * side.kappa + distance_ * distance_;
        const Real square = part.end() * part.end() - eta;
        const Real reach = square > 0 ? sqrt(square) : Real(0),
                   from = std::max(side.from, Real(-reach)), to = std::min(side.to, reach);
        if (!(from < to))
        {
          state.leave(side.from, side.to);
          continue;
        }
        state.leave(side.from, from);
        add_compact_piece(state, from, to, 0, sum);
        state.leave(to, side.to);
      }
      finish(state, is_inside, sum);
    }

    /// Of a side in line with the foot, whether it is no farther from the foot than the origin is.
    /// If it is farther, the foot is outside the polygon for sure, and H(d) must not be subtracted:
    /// where d is 0 but for round-off, H(d) is huge, and so is its product with the round-off of
    /// angles, which add up to 0.
    bool is_near_foot(const PlaneSide<Real> &side) const
    {
      return side.from <= distance_ && side.to >= -distance_;
    }

    struct Compact
    {
      const PotentialPart<Real> &part;
      Real foot = 0, kappa = 0;
      bool is_subtracted = false;
      /// Pieces from which H(d) is not subtracted.
      boost::container::small_vector<PlaneSide<Real>, 16> left;

      void leave(const Real &from, const Real &to)
      {
        if (!(from < to))
          return;
        if (!left.empty() && left.back().kappa == kappa && left.back().to == from)
          left.back().to = to;
        else
          left.push_back({kappa, from, to});
      }

      Real angle() const
      {
        using std::abs;
        using std::atan2;
        Real sum = 0;
        for (const PlaneSide<Real> &piece : left)
        {
          const Real size = abs(piece.kappa);
          const Real angle = atan2(piece.to, size) - atan2(piece.from, size);
          sum += piece.kappa < 0 ? Real(-angle) : angle;
        }
        return sum;
      }
    };

    /// H(d) is subtracted where the pole at ±i κ is near; else it is counted by the angle.
    void add_compact_piece(Compact &state, const Real &from, const Real &to, unsigned int depth,
                           Sum<Real> &sum) const
    {
      using std::abs;
      const Real square = state.kappa * state.kappa, height = distance_ * distance_;
      Real axis = half_axis(from, to, square);
      const GaussRules<Real> &rules = GaussRules<Real>::get();
      const unsigned int extra = state.part.extra_points(static_cast<double>(to - from));
      bool is_subtracted = false;
      if (rules.must_cut(static_cast<double>(axis), extra))
      {
        const Real far = std::max(Real(from * from), Real(to * to));
        Real value = 0;
        state.part.add_compact(&far, square + height, &value, 1);
        axis = half_axis(from, to, square + height);
        is_subtracted =
            !rules.must_cut(static_cast<double>(axis), extra) && abs(value) > abs(state.foot) / 5;
        if (!is_subtracted && depth < most_depth)
        {
          const Real cut = middle(from, to);
          add_compact_piece(state, from, cut, depth + 1, sum);
          add_compact_piece(state, cut, to, depth + 1, sum);
          return;
        }
      }
      const auto &rule = rules.for_ellipse(axis, extra);
      std::array<Real, most_points> squares, values; // filled up to rule.n
      squares[0] = 0;
      const Real centre = (from + to) / 2, half = (to - from) / 2;
      for (unsigned int q = 0; q < rule.n; ++q)
      {
        const Real tau = centre + half * rule.points[q];
        squares[q] = square + tau * tau;
        values[q] = is_subtracted ? Real(-state.foot) : Real(0);
      }
      state.part.add_compact(squares.data(), height, values.data(), rule.n);
      Real total = 0;
      for (unsigned int q = 0; q < rule.n; ++q)
        total += rule.weights[q] * values[q] / squares[q];
      sum.add(total * half * state.kappa);
      sum.size += state.part.size_of_piece(state.kappa, from, to, height);
      if (is_subtracted)
        state.is_subtracted = true;
      else
        state.leave(from, to);
    }

    /// Subtracts H(d) times the angle that is left. The whole is 2π or 0, but neither is known if
    /// the foot is on a side; then H(d) is subtracted there.
    void finish(const Compact &state, bool is_inside, Sum<Real> &sum) const
    {
      using std::abs;
      using std::atan2;
      static const Real turn = 8 * atan2(Real(1), Real(1));
      const Real angle = state.is_subtracted ? state.angle() : is_inside ? turn : Real(0);
      if (angle == 0)
        return;
      sum.add(-state.foot * angle);
      sum.size += abs(angle) * state.part.size_of_compact(distance_);
    }

    static constexpr unsigned int most_depth = 60;

    unsigned int n_;
    Real distance_ = 0;
    std::array<PlaneSide<Real>, 4> sides_{};
  };
} // namespace plumbline::reference
