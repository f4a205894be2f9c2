#include "tests/reference/pair_oracle.h"

#include <algorithm>
#include <cmath>

namespace plumbline::tests
{
  namespace
  {
    const Real pi = std::acos(Real(-1));

    Vector operator+(Vector a, Vector b)
    {
      return {a.x + b.x, a.y + b.y};
    }
    Vector operator-(Vector a, Vector b)
    {
      return {a.x - b.x, a.y - b.y};
    }
    Vector operator*(Real f, Vector a)
    {
      return {f * a.x, f * a.y};
    }
    Real dot(Vector a, Vector b)
    {
      return a.x * b.x + a.y * b.y;
    }
    Real cross(Vector a, Vector b)
    {
      return a.x * b.y - a.y * b.x;
    }

    /// Gauss's rule on (0, 1).
    struct Rule
    {
      std::vector<Real> point, weight;
    };

    Rule make_rule(unsigned int n)
    {
      Rule rule;
      for (unsigned int i = 0; i < n; ++i)
      {
        Real x = std::cos(pi * (i + .75L) / (n + .5L)), slope = 0;
        for (unsigned int step = 0; step < 8; ++step) // Newton's: it doubles the digits
        {
          Real before = 1, now = x;
          for (unsigned int k = 2; k <= n; ++k)
          {
            const Real next = ((2 * k - 1) * x * now - (k - 1) * before) / k;
            before = now;
            now = next;
          }
          slope = n * (x * now - before) / (x * x - 1);
          x -= now / slope;
        }
        rule.point.push_back((1 + x) / 2);
        rule.weight.push_back(1 / ((1 - x * x) * slope * slope));
      }
      return rule;
    }

    constexpr unsigned int most_points = 40;

    const Rule &gauss(unsigned int n)
    {
      static const std::vector<Rule> all = []
      {
        std::vector<Rule> rules(1);
        for (unsigned int i = 1; i <= most_points; ++i)
          rules.push_back(make_rule(i));
        return rules;
      }();
      return all.at(n);
    }

    /// Lagrange's functions at a point, vertices first, then the middles of sides.
    class Shapes
    {
    public:
      Shapes(const Triangle &t, unsigned int degree) : t_(t), degree_(degree) {}

      unsigned int size() const { return (degree_ + 1) * (degree_ + 2) / 2; }

      void operator()(Vector x, Real *values) const
      {
        const Real area = cross(t_[1] - t_[0], t_[2] - t_[0]);
        const Real b = cross(x - t_[0], t_[2] - t_[0]) / area,
                   c = cross(t_[1] - t_[0], x - t_[0]) / area;
        const Real l[3] = {1 - b - c, b, c};
        if (degree_ == 0)
          values[0] = 1;
        for (unsigned int k = 0; k < 3 && degree_ > 0; ++k)
          values[k] = degree_ == 1 ? l[k] : l[k] * (2 * l[k] - 1);
        for (unsigned int k = 0; k < 3 && degree_ == 2; ++k)
          values[3 + k] = 4 * l[k] * l[(k + 1) % 3];
      }

    private:
      Triangle t_;
      unsigned int degree_;
    };

    /// What both triangles have in common, convex.
    std::vector<Vector> overlap(const Triangle &t, const Triangle &s, Vector shift)
    {
      std::vector<Vector> polygon(t.begin(), t.end()), next;
      for (unsigned int k = 0; k < 3 && !polygon.empty(); ++k)
      {
        const Vector start = s[k] + shift, along = s[(k + 1) % 3] - s[k];
        next.clear();
        for (std::size_t i = 0; i < polygon.size(); ++i)
        {
          const Vector &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
          const Real of_a = cross(along, a - start), of_b = cross(along, b - start);
          if (of_a >= 0)
            next.push_back(a);
          if ((of_a > 0 && of_b < 0) || (of_a < 0 && of_b > 0))
            next.push_back(a + of_a / (of_a - of_b) * (b - a));
        }
        polygon.swap(next);
      }
      return polygon;
    }

    struct Crease
    {
      Vector start, along;
    };

    std::vector<Crease> find_creases(const Triangle &t, const Triangle &s)
    {
      std::vector<Crease> creases;
      for (unsigned int v = 0; v < 3; ++v)
        for (unsigned int w = 0; w < 3; ++w)
        {
          creases.push_back({s[w] - t[v], s[(w + 1) % 3] - s[w]});
          creases.push_back({s[w] - t[v], t[v] - t[(v + 1) % 3]});
        }
      return creases;
    }

    class Pair
    {
    public:
      Pair(const Triangle &t, const Triangle &s, unsigned int degree, const OracleKernel &kernel)
          : t_(t), s_(s), degree_(degree), kernel_(kernel), p_(t, degree), q_(s, degree),
            creases_(find_creases(t, s))
      {
        const std::size_t n = p_.size() * p_.size() * n_entries();
        blocks_ = {std::vector<Real>(n), std::vector<Real>(n), std::vector<Real>(n)};
      }

      OracleBlocks integrate()
      {
        std::vector<Real> angles;
        for (const auto &[start, along] : creases_)
        {
          angles.push_back(std::atan2(start.y, start.x));
          const Real a = dot(along, along), b = dot(start, along),
                     root = b * b - a * (dot(start, start) - kernel_.horizon * kernel_.horizon);
          for (const Real sign : {-1.L, 1.L})
            if (const Real at = (-b + sign * std::sqrt(std::max(0.L, root))) / a;
                root > 0 && at > 0 && at < 1)
            {
              const Vector z = start + at * along;
              angles.push_back(std::atan2(z.y, z.x));
            }
        }
        std::sort(angles.begin(), angles.end());
        angles.push_back(angles.front() + 2 * pi);
        for (std::size_t k = 0; k + 1 < angles.size(); ++k)
        {
          const Real middle = (angles[k] + angles[k + 1]) / 2;
          std::vector<Real> poles; // of rays parallel to a crease
          find_radii(middle, &poles);
          integrate_angles(angles[k], angles[k + 1], poles);
        }
        return blocks_;
      }

    private:
      unsigned int n_entries() const { return kernel_.is_tensor ? 3 : 1; }

      /// Where a ray crosses creases, up to the horizon.
      std::vector<Real> find_radii(Real angle, std::vector<Real> *poles) const
      {
        const Vector direction = {std::cos(angle), std::sin(angle)};
        std::vector<Real> radii = {0};
        for (const auto &[start, along] : creases_)
        {
          const Real turn = cross(direction, along);
          const Real at = -cross(direction, start) / turn, r = cross(start, along) / turn;
          if (!(at >= 0 && at <= 1 && r > 0))
            continue;
          radii.push_back(std::min(r, kernel_.horizon));
          if (poles != nullptr && r < kernel_.horizon)
            poles->push_back(std::atan2(along.y, along.x));
        }
        std::sort(radii.begin(), radii.end());
        return radii;
      }

      /// The integrand is analytic up to a pole from the interval.
      void integrate_angles(Real from, Real to, const std::vector<Real> &poles)
      {
        const Real half = (to - from) / 2, middle = (to + from) / 2;
        if (half < 1e-15L)
          return;
        constexpr Real widest = .5L, narrowest = 1e-7L; // the latter: sides that are parallel
        Real nearest = widest;
        for (const Real pole : poles)
        {
          const Real turn = std::remainder(pole - middle, pi);
          nearest = std::min(nearest, std::max(0.L, std::abs(turn) - half));
        }
        const Real x = 1 + nearest / half, ratio = x + std::sqrt(x * x - 1);
        constexpr Real accuracy = 1e-18L;
        const Real n = std::ceil(-std::log(accuracy) / (2 * std::log(ratio))) + degree_ + 2;
        if (!(n <= 26) && half > narrowest)
        {
          integrate_angles(from, middle, poles);
          integrate_angles(middle, to, poles);
          return;
        }
        const Rule &rule = gauss(n <= 26 ? static_cast<unsigned int>(n) : 26);
        for (std::size_t i = 0; i < rule.point.size(); ++i)
          integrate_ray(from + 2 * half * rule.point[i], 2 * half * rule.weight[i]);
      }

      void integrate_ray(Real angle, Real weight)
      {
        const Vector direction = {std::cos(angle), std::sin(angle)};
        const Real of_tensor[3] = {direction.x * direction.x, direction.x * direction.y,
                                   direction.y * direction.y};
        const std::vector<Real> radii = find_radii(angle, nullptr);
        const Rule &rule = gauss((2 * degree_ + 2 + kernel_.degree) / 2 + 1);
        for (std::size_t k = 0; k + 1 < radii.size(); ++k)
          for (std::size_t i = 0; i < rule.point.size() && radii[k + 1] > radii[k]; ++i)
          {
            const Real r = radii[k] + (radii[k + 1] - radii[k]) * rule.point[i];
            const Real value =
                weight * (radii[k + 1] - radii[k]) * rule.weight[i] * r * kernel_.radial(r);
            Real factors[3] = {value, 0, 0};
            for (unsigned int e = 0; e < 3 && kernel_.is_tensor; ++e)
              factors[e] = value * of_tensor[e];
            if (!add_overlap(r * direction, factors))
              break; // T and S - z are apart from here on, or not yet met
          }
      }

      /// Whether there is any.
      bool add_overlap(Vector z, const Real *factors)
      {
        const std::vector<Vector> polygon = overlap(t_, s_, {-z.x, -z.y});
        if (polygon.size() < 3)
          return false;
        const Rule &rule = gauss(degree_ + 1); // of degree 2 p, and the fan's determinant
        for (std::size_t v = 1; v + 1 < polygon.size(); ++v)
        {
          const Vector a = polygon[v] - polygon[0], b = polygon[v + 1] - polygon[v];
          const Real area = cross(a, b);
          for (std::size_t i = 0; i < rule.point.size(); ++i)
            for (std::size_t j = 0; j < rule.point.size(); ++j)
            {
              const Real u = rule.point[i];
              add_point(polygon[0] + u * a + u * rule.point[j] * b, z,
                        area * u * rule.weight[i] * rule.weight[j], factors);
            }
        }
        return true;
      }

      void add_point(Vector x, Vector z, Real weight, const Real *factors)
      {
        Real p[6], q[6];
        p_(x, p);
        q_(x + z, q);
        const unsigned int n = p_.size();
        std::size_t place = 0;
        for (unsigned int a = 0; a < n; ++a)
          for (unsigned int b = 0; b < n; ++b)
            for (unsigned int e = 0; e < n_entries(); ++e, ++place)
            {
              const Real value = weight * factors[e];
              blocks_.outer[place] += value * p[a] * p[b];
              blocks_.cross[place] += value * p[a] * q[b];
              blocks_.inner[place] += value * q[a] * q[b];
            }
      }

      Triangle t_, s_;
      unsigned int degree_;
      OracleKernel kernel_;
      Shapes p_, q_;
      std::vector<Crease> creases_;
      OracleBlocks blocks_;
    };
  } // namespace

  OracleBlocks integrate_pair(const Triangle &t, const Triangle &s, unsigned int degree,
                              const OracleKernel &kernel)
  {
    return Pair(t, s, degree, kernel).integrate();
  }
} // namespace plumbline::tests
