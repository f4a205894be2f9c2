#include "reference/mesh/pair_correlation.h"

#include "physics/gauss.h"
#include "reference/mesh/segment.h"

#include <algorithm>
#include <cmath>

namespace plumbline::reference
{
  namespace
  {
    using geometry::Polygon;

    /// Where a vertex of one triangle meets a side of the other, as z.
    struct Crease
    {
      Vector2 start, along;
    };

    std::vector<Crease> find_creases(const Polygon &t, const Polygon &s)
    {
      std::vector<Crease> creases;
      for (std::size_t v = 0; v < t.size(); ++v)
        for (std::size_t w = 0; w < s.size(); ++w)
        {
          creases.push_back({s[w] - t[v], s[(w + 1) % s.size()] - s[w]});
          creases.push_back({s[w] - t[v], t[v] - t[(v + 1) % t.size()]});
        }
      return creases;
    }

    double angle(const Vector2 &z)
    {
      return std::atan2(z[1], z[0]);
    }

    /// Directions between which the integral along a ray is analytic in the angle.
    std::vector<double> find_angles(const std::vector<Crease> &creases, double horizon)
    {
      std::vector<double> angles;
      for (const auto &[start, along] : creases)
      {
        angles.push_back(angle(start));
        const double a = along.norm_square(), b = start * along,
                     discriminant = b * b - a * (start.norm_square() - horizon * horizon);
        if (discriminant > 0)
          for (const double root : {-std::sqrt(discriminant), std::sqrt(discriminant)})
            if (const double t = (-b + root) / a; t > 0 && t < 1)
              angles.push_back(angle(start + t * along));
      }
      std::sort(angles.begin(), angles.end());
      angles.push_back(angles.front() + 2 * M_PI);
      return angles;
    }

    /// Radii up to the horizon between which the integrand along a ray is smooth.
    std::vector<double> find_radii(const std::vector<Crease> &creases, const Vector2 &direction,
                                   double horizon)
    {
      std::vector<double> radii = {0};
      for (const auto &[start, along] : creases)
        if (const double turn = cross(direction, along); turn != 0)
        {
          const double t = -cross(direction, start) / turn;
          if (const double r = (start + t * along) * direction; t >= 0 && t <= 1 && r > 0)
            radii.push_back(std::min(r, horizon));
        }
      std::sort(radii.begin(), radii.end());
      return radii;
    }

    class Correlation
    {
    public:
      Correlation(const ShapedPolygon &outer, const ShapedPolygon &inner)
          : outer_(outer), inner_(inner), n_(outer.space.shapes().size()), p_(n_), q_(n_)
      {
      }

      /// Add factors of the kernel's entries times the correlations at an offset.
      void add(const Vector2 &z, const std::vector<double> &factors, PairBlocks &blocks)
      {
        Polygon shifted = inner_.polygon;
        for (Point<2> &vertex : shifted)
          vertex -= z;
        const Polygon common =
            geometry::overlap(geometry::view(outer_.polygon), geometry::view(shifted));
        if (common.empty())
          return;
        const CellShapes &shapes = outer_.space.shapes();
        const geometry::CutRule rule = geometry::polygon_rule(
            geometry::view(common), 2 * shapes.degree() * (shapes.n_vertices() - 2));
        for (std::size_t i = 0; i < rule.points.size(); ++i)
        {
          find(outer_, rule.points[i], p_);
          find(inner_, rule.points[i] + z, q_);
          for (std::size_t e = 0; e < factors.size(); ++e)
            for (unsigned int a = 0; a < n_; ++a)
              for (unsigned int b = 0; b < n_; ++b)
              {
                const double weight = rule.weights[i] * factors[e];
                const std::size_t place = (a * n_ + b) * factors.size() + e;
                blocks.outer[place] += weight * p_[a] * p_[b];
                blocks.cross[place] += weight * p_[a] * q_[b];
                blocks.inner[place] += weight * q_[a] * q_[b];
              }
        }
      }

    private:
      static void find(const ShapedPolygon &of, const Point<2> &x, std::vector<double> &phi)
      {
        of.space.values(of.cell, of.space.map(of.cell).unit(x), phi.data());
      }

      const ShapedPolygon &outer_, &inner_;
      unsigned int n_;
      std::vector<double> p_, q_;
    };
  } // namespace

  void integrate_correlation(const MeshSpace &space, std::size_t outer, std::size_t inner,
                             const physics::Kernel<2> &kernel, PairBlocks &blocks)
  {
    const Polygon of_outer = space.mesh().polygon(outer), of_inner = space.mesh().polygon(inner);
    integrate_correlation({space, outer, of_outer}, {space, inner, of_inner}, kernel, blocks);
  }

  void integrate_correlation(const ShapedPolygon &outer, const ShapedPolygon &inner,
                             const physics::Kernel<2> &kernel, PairBlocks &blocks)
  {
    constexpr unsigned int n_angles = 16, n_radii = 8;
    constexpr double widest = .25; // radians
    const auto &rule_of_angles = physics::gauss(n_angles), &rule_of_radii = physics::gauss(n_radii);
    std::vector<double> factors(kernel.n_components() == 1 ? 1 : 3);
    blocks.reset(outer.space.shapes().size(), static_cast<unsigned int>(factors.size()));
    Correlation correlation(outer, inner);
    const auto creases = find_creases(outer.polygon, inner.polygon);
    const std::vector<double> angles = find_angles(creases, kernel.horizon());
    for (std::size_t k = 0; k + 1 < angles.size(); ++k)
    {
      const double between = angles[k + 1] - angles[k];
      const auto n_parts = static_cast<unsigned int>(std::ceil(between / widest));
      const double width = between / n_parts;
      for (unsigned int i = 0; i < n_parts * n_angles; ++i)
      {
        const double theta =
            angles[k] + width * (i / n_angles + rule_of_angles.point(i % n_angles)[0]);
        const Point<2> direction(std::cos(theta), std::sin(theta));
        const std::vector<double> radii = find_radii(creases, direction, kernel.horizon());
        for (std::size_t j = 0; j + 1 < radii.size(); ++j)
          for (unsigned int l = 0; l < n_radii && radii[j + 1] > radii[j]; ++l)
          {
            const double length = radii[j + 1] - radii[j],
                         r = radii[j] + length * rule_of_radii.point(l)[0];
            const double value = width * rule_of_angles.weight(i % n_angles) * length *
                                 rule_of_radii.weight(l) * r * kernel.radial(r);
            for (unsigned int e = 0; e < factors.size(); ++e) // xx, xy, yy
              factors[e] = value * (factors.size() == 1
                                        ? 1
                                        : kernel.direction_factor(e / 2, (e + 1) / 2, direction));
            correlation.add(r * direction, factors, blocks);
          }
      }
    }
  }
} // namespace plumbline::reference
