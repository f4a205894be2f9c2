#pragma once

#include "geometry/tetrahedral_mesh.h"

#include <boost/container/static_vector.hpp>

#include <memory>

namespace plumbline::reference
{
  using geometry::TetrahedralMesh;

  /// Functions on the cells of a mesh.
  struct TetrahedralShapes
  {
    /// Continuous linear functions, or constants on cells.
    TetrahedralShapes(bool continuous) // NOLINT: the two that need no degree
        : is_continuous(continuous), degree(continuous ? 1 : 0)
    {
    }
    static TetrahedralShapes discontinuous_linear()
    {
      TetrahedralShapes shapes(false);
      shapes.degree = 1;
      return shapes;
    }

    /// Trilinear functions instead of linear ones, or constants, on hexahedra.
    TetrahedralShapes on_hexahedra() const
    {
      TetrahedralShapes shapes = *this;
      shapes.is_on_hexahedra = true;
      return shapes;
    }

    unsigned int n_corners() const { return is_on_hexahedra ? 8 : 4; }
    unsigned int n_per_cell() const { return degree == 0 ? 1 : n_corners(); }
    bool is_trilinear() const { return is_on_hexahedra && degree > 0; }

    bool is_continuous = true;
    unsigned int degree = 1;
    bool is_on_hexahedra = false;
  };

  /// Linear functions, continuous or not, or constants on the cells of a mesh; trilinear ones or
  /// constants on its hexahedra. Free unknowns come first: vertices with all their cells in Ω, or
  /// those of the cells in Ω, of one cell together.
  class TetrahedralSpace
  {
  public:
    TetrahedralSpace(std::shared_ptr<const TetrahedralMesh> mesh, TetrahedralShapes shapes);

    const TetrahedralMesh &mesh() const { return *mesh_; }
    const TetrahedralShapes &shapes() const { return shapes_; }
    bool is_continuous() const { return shapes_.is_continuous; }
    unsigned int degree() const { return shapes_.degree; }
    std::size_t n_dofs() const { return support_.size(); }
    std::size_t n_free() const { return n_free_; }

    /// The vertex, or the centroid of a cell with constants. [length]
    const dealii::Point<3> &support(std::size_t dof) const { return support_[dof]; }

    /// The unknown of corner 0 ... 3 of a tetrahedron, in a space of constants the same for all
    /// corners, and for all tetrahedra of a hexahedron.
    /// @pre  continuous or constant functions on hexahedra
    unsigned int dof(std::size_t cell, unsigned int corner) const
    {
      return shapes_.is_continuous ? number_[mesh_->cells[cell][corner]]
                                   : n_each_ * number_[cell / n_tetrahedra_] + corner % n_each_;
    }

    /// The unknown of corner 0 ... 7 of a hexahedron.
    unsigned int corner_dof(std::size_t hexahedron, unsigned int corner) const
    {
      return shapes_.is_continuous ? number_[mesh_->hexahedra[hexahedron][corner]]
                                   : n_each_ * number_[hexahedron] + corner % n_each_;
    }

    /// The same of a vertex of the mesh, or of a cell, or of corner number % 4 of cell number / 4.
    unsigned int dof_at(std::size_t number) const
    {
      return n_each_ * number_[number / n_each_] + static_cast<unsigned int>(number % n_each_);
    }

  private:
    std::shared_ptr<const TetrahedralMesh> mesh_;
    TetrahedralShapes shapes_;
    unsigned int n_each_;      ///< unknowns of a vertex or a cell
    std::size_t n_tetrahedra_; ///< of a cell
    std::size_t n_free_ = 0;
    std::vector<unsigned int> number_; ///< number of each vertex or cell, free ones first
    std::vector<dealii::Point<3>> support_;
  };

  /// A face of the mesh and what shape functions do there.
  struct SpaceFace
  {
    struct Jump
    {
      unsigned int dof = 0;
      /// Of continuous functions φ: the layer that Δφ has on the face [1 / length]. Of constants
      /// on cells: 1 if the normal points out of the cell, else -1.
      double value = 0;
    };

    std::array<unsigned int, 3> vertices{};
    dealii::Tensor<1, 3> normal; ///< of length 1
    boost::container::static_vector<Jump, 5> jumps;
  };

  /// All faces of the mesh, each once.
  /// @pre  continuous functions or constants
  std::vector<SpaceFace> make_faces(const TetrahedralSpace &space);

  /// ∇λ of the corners of a tetrahedron. [1 / length]
  std::array<dealii::Tensor<1, 3>, 4> gradients(const TetrahedralMesh &mesh, std::size_t cell);
} // namespace plumbline::reference
