#include "problem/inside.h"

#include "geometry/cell_locator.h"
#include "geometry/tetrahedral_domain.h"

#include <cmath>
#include <memory>

namespace plumbline::problem
{
  using dealii::Point;

  std::function<bool(const Point<2> &)> inside(const Problem<2> &problem)
  {
    if (const geometry::Lattice *lattice = problem.lattice())
      return [lattice](const Point<2> &x)
      {
        const auto s = (x - lattice->origin()) / lattice->h();
        const int i = static_cast<int>(std::floor(s[0])), j = static_cast<int>(std::floor(s[1]));
        // the upper sides of cells belong to Ω, too
        return lattice->is_inside(i, j) || (s[0] == i && lattice->is_inside(i - 1, j)) ||
               (s[1] == j && lattice->is_inside(i, j - 1)) ||
               (s[0] == i && s[1] == j && lattice->is_inside(i - 1, j - 1));
      };
    const auto cells = std::make_shared<const geometry::CellLocator>(*problem.mesh());
    return [cells](const Point<2> &x)
    {
      const auto cell = cells->find(x);
      return cell && cells->is_inside(*cell);
    };
  }

  std::function<bool(const Point<3> &)> inside(const Problem<3> &problem)
  {
    if (!problem.mesh)
      return [&problem](const Point<3> &x) { return problem.lattice.cell_at(x).has_value(); };
    const auto cells = std::make_shared<const geometry::TetrahedronSearch>(*problem.mesh);
    return [cells](const Point<3> &x) { return cells->find(x).has_value(); };
  }
} // namespace plumbline::problem
