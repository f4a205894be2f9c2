#include "reference/tetrahedra/mass.h"

#include "geometry/hexahedron.h"

#include <deal.II/base/quadrature_lib.h>

#include <map>
#include <vector>

namespace plumbline::reference
{
  namespace
  {
    using Rows = std::vector<std::map<unsigned int, double>>;

    /// rows of free unknowns += ∫ φ_i φ_j over the tetrahedra.
    void add_tetrahedra(const TetrahedralSpace &space, Rows &rows)
    {
      constexpr double factor = 1. / 120; // of the determinant: ∫ λ_i λ_j = V (1 + δ_ij) / 20
      const TetrahedralMesh &mesh = space.mesh();
      for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
        for (unsigned int i = 0; i < 4; ++i)
          if (const unsigned int row = space.dof(cell, i); row < rows.size())
            for (unsigned int j = 0; j < 4; ++j)
              rows[row][space.dof(cell, j)] += determinant(mesh, cell) * factor * (i == j ? 2 : 1);
    }

    /// The same over the hexahedra, of trilinear functions.
    void add_hexahedra(const TetrahedralSpace &space, Rows &rows)
    {
      using geometry::Hexahedron;
      static const dealii::QGauss<3> rule(3);
      for (std::size_t cell = 0; cell < space.mesh().hexahedra.size(); ++cell)
      {
        const Hexahedron hexahedron(space.mesh(), cell);
        for (unsigned int q = 0; q < rule.size(); ++q)
        {
          const auto &s = rule.point(q);
          const double weight = rule.weight(q) * determinant(hexahedron.jacobian(s));
          const Hexahedron::Values phi = Hexahedron::values(s);
          for (unsigned int i = 0; i < phi.size(); ++i)
            if (const unsigned int row = space.corner_dof(cell, i); row < rows.size())
              for (unsigned int j = 0; j < phi.size(); ++j)
                rows[row][space.corner_dof(cell, j)] += weight * phi[i] * phi[j];
        }
      }
    }
  } // namespace

  algebra::CsrMatrix mass_rows(const TetrahedralSpace &space, unsigned int n_components)
  {
    Rows rows(space.n_free());
    if (space.shapes().is_trilinear())
      add_hexahedra(space, rows);
    else
      add_tetrahedra(space, rows);
    algebra::CsrMatrix matrix;
    matrix.start.push_back(0);
    for (const auto &row : rows)
      for (unsigned int c = 0; c < n_components; ++c)
      {
        for (const auto &[dof, value] : row)
        {
          matrix.column.push_back(dof * n_components + c);
          matrix.value.push_back(value);
        }
        matrix.start.push_back(matrix.column.size());
      }
    return matrix;
  }
} // namespace plumbline::reference
