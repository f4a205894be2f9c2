#include "reference/mesh/cell_rules.h"

#include <deal.II/base/quadrature_lib.h>

namespace plumbline::reference
{
  void rule_by_parts(const MeshSpace &space, const MeshCells &cells, std::size_t cell,
                     unsigned int degree, CellRule &rule)
  {
    rule.points.clear();
    rule.weights.clear();
    for (std::size_t part = cells.first_part(cell); part < cells.end_of_parts(cell); ++part)
    {
      const geometry::CutRule of_part = geometry::polygon_rule(cells.part(part).vertices(), degree);
      rule.points.insert(rule.points.end(), of_part.points.begin(), of_part.points.end());
      rule.weights.insert(rule.weights.end(), of_part.weights.begin(), of_part.weights.end());
    }
    const unsigned int n = space.shapes().size();
    rule.phi.resize(rule.points.size() * n);
    for (std::size_t q = 0; q < rule.points.size(); ++q)
      space.shapes().values(space.map(cell).unit(rule.points[q]), &rule.phi[q * n]);
  }

  CellRules::CellRules(const MeshSpace &space, const MeshCells &cells,
                       const dealii::Quadrature<2> &gauss, unsigned int degree)
      : space_(space), cells_(cells), gauss_(gauss), degree_(degree),
        phi_(gauss.size() * space.shapes().size())
  {
    for (unsigned int q = 0; q < gauss.size(); ++q)
      space.shapes().values(gauss.point(q), &phi_[q * space.shapes().size()]);
  }

  void CellRules::find(std::size_t cell, CellRule &rule) const
  {
    const CellMap &map = space_.map(cell);
    if (cells_.is_curved(cell))
    {
      rule_by_parts(space_, cells_, cell, degree_, rule);
      for (std::size_t q = 0; q < rule.points.size(); ++q)
        space_.values(cell, map.unit(rule.points[q]), &rule.phi[q * space_.shapes().size()]);
      return;
    }
    rule.points.clear();
    rule.weights.clear();
    for (unsigned int q = 0; q < gauss_.size(); ++q)
    {
      rule.points.push_back(map.point(gauss_.point(q)));
      rule.weights.push_back(gauss_.weight(q) * map.determinant(gauss_.point(q)));
    }
    rule.phi = phi_;
  }

  CellRules gauss_on_cells(const MeshSpace &space, const MeshCells &cells, unsigned int n)
  {
    dealii::Quadrature<2> gauss = dealii::QGauss<2>(n);
    if (space.shapes().n_vertices() == 3)
      gauss = dealii::QWitherdenVincentSimplex<2>(n);
    return {space, cells, gauss, 2 * n - 1};
  }
} // namespace plumbline::reference
