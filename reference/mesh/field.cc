#include "reference/mesh/field.h"

#include "reference/mesh/cell_rules.h"

#include <deal.II/base/parallel.h>

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
    const std::size_t cell = cells->cell_of(cells->locator().at(x));
    double phi[CellShapes::most];
    space->values(cell, space->map(cell).unit(x), phi);
    return on_cell(*this, cell, phi, component);
  }

  dealii::Tensor<1, 2> MeshField::gradient(const Point<2> &x, unsigned int component) const
  {
    const std::size_t cell = cells->cell_of(cells->locator().at(x));
    dealii::Tensor<1, 2> of_shapes[CellShapes::most], sum;
    space->gradients(cell, space->map(cell).unit(x), of_shapes);
    for (unsigned int a = 0; a < space->shapes().size(); ++a)
      sum += values[space->dofs(cell)[a] * n_components + component] * of_shapes[a];
    return sum;
  }

  std::vector<double> MeshField::averages(const geometry::NodeCells<2> &nodes) const
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
          for (const unsigned int one : found)
          {
            const geometry::Polygon part = geometry::overlap(polygon, cells->part(one).vertices());
            if (part.empty())
              continue;
            const std::size_t cell = cells->cell_of(one);
            const unsigned int degree = space->map(cell).is_affine() && shapes.n_vertices() == 3
                                            ? shapes.degree()
                                        : space->map(cell).is_affine() ? 2 * shapes.degree()
                                                                       : 2 * shapes.degree() + 6;
            const geometry::CutRule rule = geometry::polygon_rule(geometry::view(part), degree);
            for (std::size_t q = 0; q < rule.points.size(); ++q)
            {
              space->values(cell, space->map(cell).unit(rule.points[q]), phi);
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
    const CellRules rules = gauss_on_cells(*field.space, *field.cells, shapes.degree() + 1);
    CellRule rule;
    double sum = 0;
    for (std::size_t cell = 0; cell < field.cells->size(); ++cell)
    {
      if (!field.space->mesh().cells[cell].is_inside)
        continue;
      rules.find(cell, rule);
      for (std::size_t q = 0; q < rule.points.size(); ++q)
        for (unsigned int c = 0; c < field.n_components; ++c)
        {
          const double value = on_cell(field, cell, &rule.phi[q * shapes.size()], c);
          sum += rule.weights[q] * value * value;
        }
    }
    return std::sqrt(sum);
  }
} // namespace plumbline::reference
