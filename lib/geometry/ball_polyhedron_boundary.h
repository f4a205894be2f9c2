#pragma once

#include "geometry/convex_polyhedron.h"

#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <array>
#include <cmath>

// The boundary of ball ∩ convex polyhedron: parts of faces between segments and arcs of circles.
namespace plumbline::geometry
{
  /// Where the cell is within this share of the radius, lengths are of the size of the radius, and
  /// closed forms about the centre lose nothing.
  constexpr double closed_form_within = .5;

  /// Without memory of its own where a cell has few vertices.
  template <class T>
  using Few = boost::container::small_vector<T, 8>;

  struct Segment
  {
    dealii::Tensor<1, 3> from, to; ///< about the apex [length]
  };

  /// Run counter-clockwise about the normal of the face.
  struct Arc
  {
    dealii::Tensor<1, 3> from, to; ///< about the apex [length]
    double angle = 0; ///< in [0, 2π]; 0 where round-off leaves a gap between segments [rad]
  };

  /// What the ball leaves of a face.
  struct CutFace
  {
    dealii::Tensor<1, 3> normal;
    double distance = 0; ///< of the plane from the apex, against the normal: >= 0 inside [length]
    double circle = 0;   ///< radius in which the plane cuts the sphere [length]
    dealii::Tensor<1, 3> middle; ///< of that circle, about the apex [length]
    Few<Segment> segments;
    Few<Arc> arcs;
  };

  struct CutBoundary
  {
    /// The point that all else is about: the ball's centre where closed forms hold about it, else
    /// the cell's nearest to it; about the centre [length].
    dealii::Tensor<1, 3> apex;
    double apex_power = 0; ///< |apex|^2 - radius^2 [length^2]
    Few<CutFace> faces;
  };

  enum class Overlap
  {
    none,
    part,
    cell ///< the whole cell lies in the ball
  };

  /// @param boundary  filled where the overlap is a part; where there is none, its apex alone
  Overlap cut(const dealii::Point<3> &centre, double radius, const ConvexPolyhedron &cell,
              CutBoundary &boundary);

  /// Of the part of the sphere inside the cell, seen from its centre, which is the apex [sr].
  double solid_angle(const CutBoundary &boundary, double radius);

  /// An arc of less than a straight angle by its chord: no digits are lost where it is flat.
  template <class Use>
  void integrate_short(const dealii::Tensor<1, 3> &from, const dealii::Tensor<1, 3> &to,
                       const CutFace &face, double radius, const Use &use)
  {
    // Gauss's rules with 5 and 10 points over [-1, 1], the half with t >= 0
    static constexpr std::array<double, 3> t5 = {0, .538469310105683091036314420700,
                                                 .906179845938663992797626878299},
                                           w5 = {.568888888888888888888888888889,
                                                 .478628670499366468041291514836,
                                                 .236926885056189087514264040720};
    static constexpr std::array<double, 5> t10 = {.148874338981631210884826001130,
                                                  .433395394129247190799265943166,
                                                  .679409568299024406234327365115,
                                                  .865063366688984510732096688423,
                                                  .973906528517171720077964012084},
                                           w10 = {.295524224714752870173815619189,
                                                  .269266719309996355091226921569,
                                                  .219086362515982043995534934228,
                                                  .149451349150580593145863396958,
                                                  .066671344308688137593568809893};
    const dealii::Tensor<1, 3> chord = to - from, middle = .5 * (from + to);
    const double length = chord.norm();
    if (!(length > 0))
      return;
    const dealii::Tensor<1, 3> along = chord / length, side = cross_product_3d(along, face.normal);
    const double sine = std::min(1., length / (2 * face.circle)),
                 most = sine / (1 + std::sqrt(1 - sine * sine)); // tan β/2
    const auto step = [&](double t, double weight)
    {
      // x = R sin τ, height R (cos τ - cos β), t = tan τ/2, R = length (1 + T^2) / (4 T)
      const double u = t * most, below = 1 + u * u, scale = .5 * length * (1 + most * most);
      const double x = scale * t / below, height = .5 * length * most * (1 - t * t) / below;
      const double rate = scale * weight / (below * below); // dx = R cos τ dτ, dτ = 2 dt / (1 + t²)
      use(middle + x * along + height * side, rate * ((1 - u * u) * along - 2 * u * side));
    };
    constexpr double flat = .04; // five points leave 1e-17
    if (most < flat && length < flat * radius)
      for (unsigned int k = 0; k < t5.size(); ++k)
      {
        step(t5[k], w5[k]);
        if (k > 0)
          step(-t5[k], w5[k]);
      }
    else
      for (unsigned int k = 0; k < t10.size(); ++k)
      {
        step(t10[k], w10[k]);
        step(-t10[k], w10[k]);
      }
  }

  /// Calls use(r, dr) at points of a quadrature along the arc, dr with its weight.
  template <class Use>
  void integrate(const Arc &arc, const CutFace &face, double radius, const Use &use)
  {
    constexpr double longest = .8; // [rad], where ten points leave round-off
    const auto n = std::max(1u, static_cast<unsigned int>(std::ceil(arc.angle / longest)));
    dealii::Tensor<1, 3> from = arc.from;
    for (unsigned int k = 1; k <= n; ++k)
    {
      dealii::Tensor<1, 3> to = arc.to;
      if (k < n)
      {
        const dealii::Tensor<1, 3> x = arc.from - face.middle, y = cross_product_3d(face.normal, x);
        const double angle = arc.angle * k / n;
        to = face.middle + std::cos(angle) * x + std::sin(angle) * y;
      }
      integrate_short(from, to, face, radius, use);
      from = to;
    }
  }
} // namespace plumbline::geometry
