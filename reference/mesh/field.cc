#include "reference/mesh/field.h"

#include <deal.II/base/parallel.h>
#include <deal.II/base/quadrature_lib.h>

#include <cmath>

namespace plumbline::reference
{
  namespace
  {
    double on_cell(const MeshField &field, std::size_t cell, const double *phi,
                   unsigned int component)
    {
      double value = 0;
      for (unsigned int a = 0; a < field.space->shapes().size(); ++a)
        value += phi[a] * field.values[field.space->dofs(cell)[a] * field.n_components + component];
      return value;
    }
  } // namespace

  double MeshField::value(const Point<2> &x, unsigned int component) const
  {
    const std::size_t cell = cells->locator().at(x);
    double phi[CellShapes::most];
    space->shapes().values(space->map(cell).unit(x), phi);
    return on_cell(*this, cell, phi, component);
  }

  std::vector<double> MeshField::averages(const geometry::NodeCells &nodes) const
  {
    const CellShapes &shapes = space->shapes();
    std::vector<double> result(nodes.n_free * n_components);
    const auto average = [&](std::size_t first, std::size_t last)
    {
      std::vector<unsigned int> found;
      double phi[CellShapes::most];
      for (std::size_t node = first; node < last; ++node)
        for (std::size_t piece = nodes.first_piece[node]; piece < nodes.first_piece[node + 1];
             ++piece)
        {
          const auto polygon = geometry::view(nodes.pieces[piece]);
          cells->locator().find(geometry::bounding_box(polygon), found);
          for (const unsigned int cell : found)
          {
            const geometry::Polygon part = geometry::overlap(polygon, (*cells)[cell].vertices());
            if (part.empty())
              continue;
            const unsigned int degree = space->map(cell).is_affine() && shapes.n_vertices() == 3
                                            ? shapes.degree()
                                        : space->map(cell).is_affine() ? 2 * shapes.degree()
                                                                       : 2 * shapes.degree() + 6;
            const geometry::CutRule rule = geometry::polygon_rule(geometry::view(part), degree);
            for (std::size_t q = 0; q < rule.points.size(); ++q)
            {
              shapes.values(space->map(cell).unit(rule.points[q]), phi);
              for (unsigned int c = 0; c < n_components; ++c)
                result[node * n_components + c] +=
                    rule.weights[q] / nodes.area[node] * on_cell(*this, cell, phi, c);
            }
          }
        }
    };
    constexpr unsigned int grain = 256;
    dealii::parallel::apply_to_subranges(static_cast<std::size_t>(0), nodes.n_free, average, grain);
    return result;
  }

  double l2_norm(const MeshField &field)
  {
    const CellShapes &shapes = field.space->shapes();
    dealii::Quadrature<2> gauss = dealii::QGauss<2>(shapes.degree() + 1);
    if (shapes.n_vertices() == 3)
      gauss = dealii::QWitherdenVincentSimplex<2>(shapes.degree() + 1);
    double sum = 0, phi[CellShapes::most];
    for (std::size_t cell = 0; cell < field.cells->size(); ++cell)
      for (unsigned int q = 0; q < gauss.size() && field.space->mesh().cells[cell].is_inside; ++q)
      {
        shapes.values(gauss.point(q), phi);
        for (unsigned int c = 0; c < field.n_components; ++c)
        {
          const double value = on_cell(field, cell, phi, c);
          sum +=
              gauss.weight(q) * field.space->map(cell).determinant(gauss.point(q)) * value * value;
        }
      }
    return std::sqrt(sum);
  }
} // namespace plumbline::reference
