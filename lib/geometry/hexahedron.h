#pragma once

#include "geometry/tetrahedral_mesh.h"

#include <deal.II/base/tensor.h>

namespace plumbline::geometry
{
  /// The image of the unit cube under the trilinear map that takes its corners to eight vertices,
  /// in the order of Hexahedra.
  class Hexahedron
  {
  public:
    using Values = std::array<double, 8>;
    using Slopes = std::array<dealii::Tensor<1, 3>, 8>;

    explicit Hexahedron(const std::array<dealii::Point<3>, 8> &corners) : corners_(corners) {}
    Hexahedron(const TetrahedralMesh &mesh, std::size_t hexahedron);

    /// The trilinear functions that are 1 at one corner, at s in the unit cube.
    static Values values(const dealii::Point<3> &s);

    dealii::Point<3> at(const dealii::Point<3> &s) const;

    /// ∂x/∂s. [length]
    dealii::Tensor<2, 3> jacobian(const dealii::Point<3> &s) const;

    /// Gradients of the trilinear functions with respect to x. [1 / length]
    Slopes slopes(const dealii::Point<3> &s) const;

    /// s with at(s) = x by Newton's method, for x in the hexahedron or near it.
    /// @throws NumericalError  it does not converge: x is far away
    dealii::Point<3> place(const dealii::Point<3> &x) const;

    /// A bound from below of the determinant of the Jacobian in the hexahedron: the least of its
    /// Bernstein coefficients. [length^3]
    double least_determinant() const;

  private:
    std::array<dealii::Point<3>, 8> corners_;
  };

  /// The mesh whose cells are tetrahedra that fill the hexahedra: six about the vertex of the
  /// smallest number, over the three faces opposite to it. Each face is cut by the diagonal at its
  /// vertex of the smallest number, so that two hexahedra cut a common face alike (Dompierre et al.
  /// 1999, "How to subdivide pyramids, prisms and hexahedra into tetrahedra").
  /// @param is_inside, group  of each hexahedron; no group: there are none
  TetrahedralMesh six_per_hexahedron(std::vector<dealii::Point<3>> vertices, Hexahedra hexahedra,
                                     const std::vector<char> &is_inside,
                                     const std::vector<unsigned int> &group = {});

  /// @throws InputError  a hexahedron that is degenerate or may be inverted in parts, naming its
  /// place
  void check_hexahedra(const TetrahedralMesh &mesh);

  /// Every hexahedron cut into eight by the middles of its edges and faces, the images of those of
  /// the cube. Hexahedron c becomes 8 c ... 8 c + 7, and the vertices keep their numbers.
  TetrahedralMesh refine_hexahedra(const TetrahedralMesh &mesh);
} // namespace plumbline::geometry
