#pragma once

#include "geometry/convex_polyhedron.h"

#include <optional>

namespace plumbline::geometry
{
  /// A convex polyhedron, clipped by one half-space after another.
  class ClippedPolyhedron
  {
  public:
    /// The box [lower, upper].
    ClippedPolyhedron(const dealii::Point<3> &lower, const dealii::Point<3> &upper);

    /// Keep the part where normal · x <= offset. Vertices within 1e-12 of the plane are taken as
    /// lying on it; coordinates should be of order 1.
    /// @param normal  ≠ 0, of any length
    /// @return        whether there is such a part
    /// @throws NumericalError  clipping fails because of rounding
    bool clip(const dealii::Tensor<1, 3> &normal, double offset);

    const std::vector<dealii::Point<3>> &vertices() const { return vertices_; }
    double volume() const;

    /// With vertices where `place` says.
    template <class Place>
    ConvexPolyhedron placed(const Place &place) const
    {
      std::vector<dealii::Point<3>> vertices;
      for (const dealii::Point<3> &x : vertices_)
        vertices.push_back(place(x));
      std::vector<ConvexPolyhedron::Indices> faces;
      std::vector<dealii::Tensor<1, 3>> normals;
      for (const Face &face : faces_)
      {
        faces.push_back(face.vertices);
        normals.push_back(face.normal);
      }
      return {std::move(vertices), std::move(faces), normals};
    }

  private:
    struct Face
    {
      ConvexPolyhedron::Indices vertices; ///< counter-clockwise seen from outside
      dealii::Tensor<1, 3> normal;        ///< outward, of length 1
    };

    /// False: with this tolerance what is cut is no polyhedron.
    bool try_clip(const dealii::Tensor<1, 3> &normal, const std::vector<double> &heights,
                  double tolerance);
    void drop_unused_vertices();

    std::vector<dealii::Point<3>> vertices_;
    std::vector<Face> faces_;
  };
} // namespace plumbline::geometry
