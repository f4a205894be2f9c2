#include "reference/tetrahedra/space.h"

#include "geometry/tetrahedral_check.h"

#include <algorithm>

namespace plumbline::reference
{
  namespace
  {
    void add_jump(SpaceFace &face, unsigned int dof, double value)
    {
      const auto found =
          std::find_if(face.jumps.begin(), face.jumps.end(),
                       [dof](const SpaceFace::Jump &jump) { return jump.dof == dof; });
      if (found == face.jumps.end())
        face.jumps.push_back({dof, value});
      else
        found->value += value;
    }
  } // namespace

  using dealii::Point;

  TetrahedralSpace::TetrahedralSpace(std::shared_ptr<const TetrahedralMesh> mesh,
                                     TetrahedralShapes shapes)
      : mesh_(std::move(mesh)), shapes_(shapes),
        n_each_(shapes.is_continuous ? 1 : shapes.n_per_cell()),
        n_tetrahedra_(shapes.is_on_hexahedra ? geometry::n_in_hexahedron : 1)
  {
    std::vector<char> is_free;
    if (shapes_.is_continuous)
      is_free = geometry::inner_vertices(*mesh_);
    else
      for (std::size_t cell = 0; cell < mesh_->cells.size(); cell += n_tetrahedra_)
        is_free.push_back(mesh_->is_inside[cell]);
    number_.resize(is_free.size());
    support_.resize(n_each_ * is_free.size());
    n_free_ = static_cast<std::size_t>(std::count(is_free.begin(), is_free.end(), 1));
    unsigned int free = 0, other = static_cast<unsigned int>(n_free_);
    for (std::size_t k = 0; k < is_free.size(); ++k)
    {
      number_[k] = is_free[k] != 0 ? free++ : other++;
      if (shapes_.is_continuous)
      {
        support_[number_[k]] = mesh_->vertices[k];
        continue;
      }
      for (unsigned int corner = 0; corner < shapes_.n_corners(); ++corner)
      {
        const Point<3> &x = mesh_->vertices[shapes_.is_on_hexahedra ? mesh_->hexahedra[k][corner]
                                                                    : mesh_->cells[k][corner]];
        Point<3> &support = support_[n_each_ * number_[k] + corner % n_each_];
        support = n_each_ > 1 ? x : support + x / static_cast<double>(shapes_.n_corners());
      }
    }
    n_free_ *= n_each_;
  }

  std::vector<SpaceFace> make_faces(const TetrahedralSpace &space)
  {
    const std::vector<geometry::TetrahedralSide> sides = geometry::sides_of(space.mesh());
    std::vector<SpaceFace> faces;
    for (std::size_t k = 0; k < sides.size(); ++k)
    {
      const geometry::TetrahedralSide &side = sides[k];
      const auto slopes = gradients(space.mesh(), side.cell);
      const dealii::Tensor<1, 3> outward = -slopes[side.opposite] / slopes[side.opposite].norm();
      if (k == 0 || side.key != sides[k - 1].key)
        faces.push_back({side.key, outward, {}});
      SpaceFace &face = faces.back();
      if (!space.is_continuous())
        add_jump(face, space.dof(side.cell, 0), outward * face.normal > 0 ? 1 : -1);
      else
        for (unsigned int corner = 0; corner < 4; ++corner)
          add_jump(face, space.dof(side.cell, corner), -slopes[corner] * outward);
    }
    // faces within a hexahedron, across which constants do not jump
    if (space.shapes().is_on_hexahedra)
      faces.erase(std::remove_if(faces.begin(), faces.end(),
                                 [](const SpaceFace &face)
                                 { return face.jumps.size() == 1 && face.jumps[0].value == 0; }),
                  faces.end());
    return faces;
  }

  std::array<dealii::Tensor<1, 3>, 4> gradients(const TetrahedralMesh &mesh, std::size_t cell)
  {
    const double volume = determinant(mesh, cell);
    std::array<dealii::Tensor<1, 3>, 4> result;
    for (unsigned int corner = 1; corner < 4; ++corner)
    {
      const auto edge = [&](unsigned int to)
      {
        return mesh.vertices[mesh.cells[cell][(corner - 1 + to) % 3 + 1]] -
               mesh.vertices[mesh.cells[cell][0]];
      };
      result[corner] = cross_product_3d(edge(1), edge(2)) / volume;
      result[0] -= result[corner];
    }
    return result;
  }
} // namespace plumbline::reference
