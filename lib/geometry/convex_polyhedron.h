#pragma once

#include <deal.II/base/point.h>
#include <deal.II/base/symmetric_tensor.h>

#include <array>
#include <vector>

namespace plumbline::geometry
{
  /// Volume, centroid and second moments of a body in space.
  struct SolidMoments
  {
    double volume = 0; ///< [length^3]
    dealii::Point<3> centroid;
    dealii::SymmetricTensor<2, 3> second; ///< ∫ (x - centroid) ⊗ (x - centroid) [length^5]
  };

  /// A convex polyhedron with plane faces, checked and measured once, for the many balls it may
  /// meet.
  class ConvexPolyhedron
  {
  public:
    using Indices = std::vector<unsigned int>;
    using ExtendedVector = dealii::Tensor<1, 3, long double>;

    /// @param vertices  shape (n_vertices, 3) [length]
    /// @param faces     the vertices of each, counter-clockwise seen from outside
    /// @param normals   outward, of each face, of any length; empty: those of its vertices, which
    /// rounding makes wrong where a face is as narrow as 1e-10 of the diameter
    /// @throws InputError  fewer than 4 vertices or faces, a vertex that is not finite, a face that
    /// is not plane to 1e-10 of the diameter, faces that do not close or that are oriented
    /// inwards, a polyhedron that is not convex or has no volume
    ConvexPolyhedron(std::vector<dealii::Point<3>> vertices, std::vector<Indices> faces,
                     const std::vector<dealii::Tensor<1, 3>> &normals = {});

    /// The box [lower, upper].
    static ConvexPolyhedron box(const dealii::Point<3> &lower, const dealii::Point<3> &upper);

    /// Vertices in either orientation.
    static ConvexPolyhedron tetrahedron(std::array<dealii::Point<3>, 4> vertices);

    /// Where a side of a face is found, and whether the face runs it from first to second.
    struct Side
    {
      unsigned int edge = 0;
      bool is_forward = true;
    };

    struct Face
    {
      Indices vertices;
      std::vector<Side> sides; ///< the k-th runs from vertex k to the next
      ExtendedVector normal;   ///< outward, of length 1
      double diameter = 0;     ///< [length]
    };

    const std::vector<dealii::Point<3>> &vertices() const { return vertices_; }
    const std::vector<std::array<unsigned int, 2>> &edges() const { return edges_; }
    const std::vector<Face> &faces() const { return faces_; }
    const SolidMoments &moments() const { return moments_; } ///< of the whole cell
    bool is_box() const { return is_box_; }                  ///< [lower, upper], with no rounding
    const dealii::Point<3> &lower() const { return lower_; }
    const dealii::Point<3> &upper() const { return upper_; }

  private:
    void find_edges();
    void find_planes(const std::vector<dealii::Tensor<1, 3>> &normals);
    void measure();
    void find_box();

    std::vector<dealii::Point<3>> vertices_;
    std::vector<std::array<unsigned int, 2>> edges_;
    std::vector<Face> faces_;
    SolidMoments moments_;
    dealii::Point<3> lower_, upper_; ///< of the smallest box around it
    bool is_box_ = false;
  };
} // namespace plumbline::geometry
