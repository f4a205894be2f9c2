#pragma once

#include "geometry/mesh.h"

#include <deal.II/fe/fe.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/grid/tria.h>

#include <memory>

namespace plumbline::reference
{
  /// A mesh as deal.II sees it: the cells of Ω only, in the order of the mesh.
  struct DealMesh
  {
    explicit DealMesh(const geometry::Mesh &mesh);

    dealii::Triangulation<2> triangulation;
    std::vector<std::size_t> cell; ///< of the mesh, for each active cell
    std::unique_ptr<dealii::Mapping<2>> mapping;

    /// FE_Q, FE_SimplexP, or their discontinuous forms.
    std::unique_ptr<dealii::FiniteElement<2>> element(bool is_continuous,
                                                      unsigned int degree) const;
  };
} // namespace plumbline::reference
