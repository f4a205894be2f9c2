#include "geometry/ball_polyhedron.h"

#include "base/error.h"
#include "geometry/ball_box.h"
#include "geometry/ball_polyhedron_boundary.h"
#include "geometry/even_rule.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace plumbline::geometry
{
  namespace
  {
    using dealii::Point;
    using dealii::SymmetricTensor;
    using dealii::Tensor;
    using Vector = Tensor<1, 3>;
    using Matrix = SymmetricTensor<2, 3>;

    constexpr double pi = 3.14159265358979323846;

    Matrix symmetric(const Vector &a, const Vector &b)
    {
      return symmetrize(outer_product(a, b));
    }

    /// ∫ 1, r and r ⊗ r about an apex.
    struct Raw
    {
      double zeroth = 0;
      Vector first;
      Matrix second;
    };

    /// About the foot of the apex in the plane of a face.
    struct Moment
    {
      double zeroth = 0;
      Vector first;
      Matrix second;
    };

    /// The part of the sphere inside the cell, seen from a pole outside of the ball's inner half:
    /// ∫ q(r) r·n over it becomes an integral along its boundary. A point of the sphere has the
    /// polar angle γ, the height z = R cos γ - ρ over the apex and the distance σ = R sin γ from
    /// the axis; with v = 1 - cos γ and Z = R - ρ, r·n = Z + ρ v and z = Z - R v. Of f(v) σ^m ê^m
    /// the antiderivative in γ is h(v) y^m, y = σ ê, and what is integrated is h y^m σ^2 dφ.
    class Patch
    {
    public:
      /// @param apex   of the cell nearest to the centre, about the centre [length]
      /// @param power  |apex|^2 - R^2 < 0 [length^2]
      Patch(const Vector &apex, double power, double radius)
          : radius_(radius), distance_(apex.norm()), pole_(apex / distance_),
            rest_(-power / (radius + distance_))
      {
      }

      /// Add what a step dr of the boundary contributes to ∫ q(r) r·n, run with the cell's
      /// inside on the left as seen along the face's normal: backwards, for the patch.
      void add(const Vector &r, const Vector &dr, unsigned int degree, Raw &sum) const
      {
        const Vector y = r - (r * pole_) * pole_;
        const double s = y * y / (radius_ * radius_), v = s / (1 + std::sqrt(1 - s)),
                     step = -pole_ * cross_product_3d(y, dr);
        sum.zeroth += step * (rest_ + .5 * distance_ * v) / (2 - v);
        if (degree == 0)
          return;
        const double h = rest_ * rest_ * (1 - .5 * v) - radius_ * distance_ * v * v / 3;
        const auto [h1, h1z] = antiderivatives(v, degree);
        sum.first += step * (h / (2 - v) * pole_ + h1 * y);
        if (degree == 1)
          return;
        double h0zz = 0, h2 = 0;
        for (const double sign : {-1., 1.}) // Gauss's two points are exact
        {
          const double tau = .5 + sign * .288675134594812882254574390251,
                       z = rest_ - radius_ * v * tau, across = rest_ + distance_ * v * tau;
          h0zz += .5 * z * z * across;
          h2 += .5 * tau * (2 - v * tau) * across;
        }
        sum.second +=
            step * (h0zz / (2 - v) * symmetric(pole_, pole_) + 2 * h1z * symmetric(pole_, y) +
                    h2 / ((2 - v) * (2 - v)) * symmetric(y, y));
      }

    private:
      /// h for σ ê r·n and for z σ ê r·n.
      std::array<double, 2> antiderivatives(double v, unsigned int degree) const
      {
        constexpr double small = .01; // three points leave 1e-17 there
        const EvenRule &rule = v < small ? even_rules::six : even_rules::fourteen;
        std::array<double, 2> h{};
        for (unsigned int k = 0; k < rule.n; ++k)
        {
          const double tau = rule.t[k] * rule.t[k], weight = 2 * rule.weight[k] * tau *
                                                             std::sqrt((2 - v * tau) / (2 - v)) *
                                                             (rest_ + distance_ * v * tau);
          h[0] += weight;
          if (degree > 1)
            h[1] += weight * (rest_ - radius_ * v * tau);
        }
        return {h[0] / (2 - v), h[1] / (2 - v)};
      }

      double radius_, distance_;
      Vector pole_;
      double rest_; ///< Z
    };

    /// Of the region of a face, about the foot of the apex; run along its boundary.
    class Region
    {
    public:
      Region(const Vector &normal, double distance) : normal_(normal), distance_(distance) {}

      void add_segment(const Segment &segment, unsigned int degree)
      {
        const Vector p = segment.from - distance_ * normal_, q = segment.to - distance_ * normal_;
        const double kappa = normal_ * cross_product_3d(p, q);
        sum_.zeroth += .5 * kappa;
        if (degree > 0)
          sum_.first += kappa / 6 * (p + q);
        if (degree > 1)
          sum_.second += kappa / 12 * (symmetric(p, p) + symmetric(q, q) + symmetric(p, q));
      }

      void add_step(const Vector &r, const Vector &dr, unsigned int degree)
      {
        const Vector eta = r - distance_ * normal_;
        const double kappa = normal_ * cross_product_3d(eta, dr);
        sum_.zeroth += .5 * kappa;
        if (degree > 0)
          sum_.first += kappa / 3 * eta;
        if (degree > 1)
          sum_.second += .25 * kappa * symmetric(eta, eta);
      }

      /// Add the cone from the apex over the region, before division by 3 + k.
      void add_cone_to(Raw &sum, unsigned int degree) const
      {
        const Vector foot = distance_ * normal_;
        sum.zeroth += distance_ * sum_.zeroth;
        if (degree > 0)
          sum.first += distance_ * (sum_.zeroth * foot + sum_.first);
        if (degree > 1)
          sum.second += distance_ * (sum_.zeroth * symmetric(foot, foot) +
                                     2 * symmetric(foot, sum_.first) + sum_.second);
      }

    private:
      Vector normal_;
      double distance_; ///< of the plane from the apex
      Moment sum_;
    };

    /// Cones from the cell's point nearest to the centre.
    Raw by_cones(const CutBoundary &boundary, double radius, unsigned int degree)
    {
      const Patch patch(boundary.apex, boundary.apex_power, radius);
      Raw sum;
      for (const CutFace &face : boundary.faces)
      {
        const bool has_cone = face.distance > 0; // else the apex is in its plane
        Region region(face.normal, face.distance);
        for (const Segment &segment : face.segments)
          if (has_cone)
            region.add_segment(segment, degree);
        for (const Arc &arc : face.arcs)
          integrate(arc, face, radius,
                    [&](const Vector &r, const Vector &dr)
                    {
                      if (has_cone)
                        region.add_step(r, dr, degree);
                      patch.add(r, dr, degree, sum);
                    });
        if (has_cone)
          region.add_cone_to(sum, degree);
      }
      sum.zeroth /= 3;
      sum.first /= 4;
      sum.second /= 5;
      return sum;
    }

    /// What the centre's closed forms need of a face: with η from the foot of the centre and
    /// g = (|y|^2 - R^2) / 2, which is 0 on the sphere.
    struct Potential
    {
      double area = 0, g = 0;
      Vector eta_g;
    };

    Potential potential(const CutFace &face)
    {
      const double square = face.circle * face.circle;
      Potential sum;
      for (const Segment &segment : face.segments)
      {
        const Vector foot = face.distance * face.normal, p = segment.from - foot,
                     q = segment.to - foot;
        const double kappa = face.normal * cross_product_3d(p, q);
        sum.area += .5 * kappa;
        for (const double sign : {-1., 1.})
        {
          const Vector eta = p + (.5 + sign * .288675134594812882254574390251) * (q - p);
          sum.g += .25 * kappa * (eta * eta / 4 - square / 2);
          sum.eta_g += .25 * kappa * (eta * eta / 5 - square / 3) * eta;
        }
      }
      for (const Arc &arc : face.arcs)
      {
        sum.area += .5 * square * arc.angle;
        sum.g -= square * square * arc.angle / 8;
        sum.eta_g += square * square / 15 * cross_product_3d(face.normal, arc.to - arc.from);
      }
      return sum;
    }

    /// Closed forms about the centre.
    Raw about_centre(const CutBoundary &boundary, double radius, unsigned int degree)
    {
      const double square = radius * radius,
                   patch = solid_angle(boundary, radius); // on the sphere of radius 1
      Raw sum;
      double radial = square * square * radius * patch; // 5 ∫ |y|^2
      Matrix second;
      sum.zeroth = square * radius * patch / 3;
      for (const CutFace &face : boundary.faces)
      {
        const Potential of = potential(face);
        sum.zeroth += face.distance * of.area / 3;
        if (degree > 0)
          sum.first += of.g * face.normal;
        if (degree > 1)
        {
          second += symmetric(face.normal, face.distance * of.g * face.normal + of.eta_g);
          radial += face.distance * (2 * of.g + square * of.area);
        }
      }
      if (degree > 1)
        sum.second =
            second - .5 * (radial / 5 - square * sum.zeroth) * dealii::unit_symmetric_tensor<3>();
      return sum;
    }

    SolidMoments about_centroid(const Raw &raw, const Point<3> &apex, const ConvexPolyhedron &cell,
                                unsigned int degree)
    {
      SolidMoments result;
      result.centroid = apex;
      result.volume = std::min(raw.zeroth, cell.moments().volume);
      if (!(result.volume > 0))
      {
        result.volume = 0;
        return result;
      }
      const Vector mean = raw.first / raw.zeroth;
      if (degree > 0)
        result.centroid += mean;
      if (degree > 1)
        result.second = raw.second - raw.zeroth * symmetric(mean, mean);
      return result;
    }
    /// The cell, so far from the sphere that no rounding matters.
    bool is_well_inside(const SolidBall &ball, const ConvexPolyhedron &cell)
    {
      constexpr double safe = 1 - 1e-9;
      const double square = safe * ball.radius * ball.radius;
      const auto &vertices = cell.vertices();
      return std::all_of(vertices.begin(), vertices.end(),
                         [&](const Point<3> &x)
                         { return x.distance_square(ball.centre) < square; });
    }
  } // namespace

  SolidMoments intersect(const SolidBall &ball, const ConvexPolyhedron &cell, unsigned int degree)
  {
    const auto &[centre, radius] = ball;
    if (!(radius > 0) || !std::isfinite(radius))
      throw InputError("the radius of a ball is " + std::to_string(radius) + "; give one above 0");
    if (degree < 2 && cell.is_box())
      return intersect_box(ball, cell.lower(), cell.upper(), cell.moments());
    if (is_well_inside(ball, cell)) // most cells of a large ball
      return cell.moments();
    CutBoundary boundary;
    switch (cut(centre, radius, cell, boundary))
    {
    case Overlap::none:
      return about_centroid({}, centre + boundary.apex, cell, degree);
    case Overlap::cell:
      return cell.moments();
    case Overlap::part:
      break;
    }
    const bool is_about_centre = boundary.apex.norm() <= closed_form_within * radius;
    if (!is_about_centre)
      return about_centroid(by_cones(boundary, radius, degree), centre + boundary.apex, cell,
                            degree);
    return about_centroid(about_centre(boundary, radius, degree), centre, cell, degree);
  }
} // namespace plumbline::geometry
