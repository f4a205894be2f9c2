#include "problem/domain.h"

#include "base/error.h"
#include "base/number_text.h"
#include "geometry/mesh_input.h"

#include <utility>

namespace plumbline::problem
{
  namespace
  {
    /// Of the width that is needed: what rounding may take from it.
    constexpr double rounding = 1e-9;
  } // namespace

  MeshDomain mesh_domain(geometry::Mesh mesh, std::vector<dealii::Point<2>> nodes, double reach)
  {
    geometry::check(mesh);
    if (const double width = geometry::collar_width(mesh); !(width >= reach * (1 - rounding)))
      throw InputError("domain: the interaction domain of the mesh is " + base::to_text(width, 4) +
                       " wide at its thinnest place, but bonds reach " + base::to_text(reach, 4) +
                       "; add cells with is_inside = false around the domain, or choose a smaller "
                       "horizon");
    if (nodes.empty())
      nodes = geometry::centroids(mesh);
    MeshDomain result;
    result.cells =
        std::make_shared<const geometry::NodeCells<2>>(geometry::voronoi_cells(nodes, mesh));
    result.mesh = std::make_shared<const geometry::Mesh>(std::move(mesh));
    result.reach = reach;
    return result;
  }

  MeshDomain mesh_domain(const geometry::Domain &boxes, double h,
                         std::vector<dealii::Point<2>> nodes, double reach)
  {
    return mesh_domain(geometry::lattice_mesh(boxes, h, reach, false), std::move(nodes), reach);
  }

  BodyDomain body_domain(const geometry::Box &box, double h,
                         const std::vector<geometry::Box> &constrained)
  {
    const geometry::VertexCells body =
        geometry::vertex_cells(geometry::Lattice({{box}, {}}, h), constrained);
    BodyDomain result;
    result.mesh = body.mesh;
    result.cells = body.cells;
    result.lattice = body.lattice;
    result.is_floating = constrained.empty();
    return result;
  }
} // namespace plumbline::problem
