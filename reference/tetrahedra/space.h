#pragma once

#include "geometry/tetrahedral_mesh.h"

#include <boost/container/static_vector.hpp>

#include <memory>

namespace plumbline::reference
{
  using geometry::TetrahedralMesh;

  /// Continuous linear functions or constants on the cells of a mesh. Free unknowns come first:
  /// vertices with all their cells in Ω, or the cells in Ω.
  class TetrahedralSpace
  {
  public:
    TetrahedralSpace(std::shared_ptr<const TetrahedralMesh> mesh, bool is_continuous);

    const TetrahedralMesh &mesh() const { return *mesh_; }
    bool is_continuous() const { return is_continuous_; }
    std::size_t n_dofs() const { return support_.size(); }
    std::size_t n_free() const { return n_free_; }

    /// The vertex, or the centroid of the cell. [length]
    const dealii::Point<3> &support(std::size_t dof) const { return support_[dof]; }

    /// The unknown of corner 0 ... 3 of a cell, in a space of constants the same for all corners.
    unsigned int dof(std::size_t cell, unsigned int corner) const
    {
      return number_[is_continuous_ ? mesh_->cells[cell][corner] : cell];
    }

    /// The same of a vertex of the mesh, or of a cell.
    unsigned int dof_at(std::size_t vertex_or_cell) const { return number_[vertex_or_cell]; }

  private:
    std::shared_ptr<const TetrahedralMesh> mesh_;
    bool is_continuous_;
    std::size_t n_free_ = 0;
    std::vector<unsigned int> number_; ///< of a vertex or a cell: its unknown
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
  std::vector<SpaceFace> make_faces(const TetrahedralSpace &space);

  /// ∇λ of the corners of a tetrahedron. [1 / length]
  std::array<dealii::Tensor<1, 3>, 4> gradients(const TetrahedralMesh &mesh, std::size_t cell);
} // namespace plumbline::reference
