#include "meshfree/scattered/motion.h"

#include <deal.II/lac/vector.h>

#include <utility>

namespace plumbline::meshfree
{
  template <int dim>
  algebra::CsrMatrix by_volumes(algebra::CsrMatrix rows, const geometry::NodeCells<dim> &cells,
                                unsigned int n_components)
  {
    for (std::size_t i = 0; i < rows.n_rows(); ++i)
      for (std::size_t k = rows.start[i]; k < rows.start[i + 1]; ++k)
        rows.value[k] *= cells.area[i / n_components];
    return rows;
  }

  template <int dim>
  std::unique_ptr<method::MotionOf<dim>>
  move_nodes(std::shared_ptr<const geometry::NodeCells<dim>> cells, unsigned int n_components,
             const algebra::CsrMatrix &free, const algebra::CsrMatrix &constrained,
             std::function<std::vector<double>(const problem::Problem<dim> &)> around)
  {
    const auto n = static_cast<std::ptrdiff_t>(cells->n_free);
    method::SparseParts<dim> parts;
    parts.nodes.assign(cells->nodes.begin(), cells->nodes.begin() + n);
    parts.n_components = n_components;
    const auto own = [&](const algebra::CsrMatrix &rows)
    { return std::make_shared<const algebra::CsrMatrix>(by_volumes(rows, *cells, n_components)); };
    parts.stiffness = own(free);
    parts.constrained = own(constrained);
    parts.masses.assign(cells->area.begin(), cells->area.begin() + n);
    parts.load = [cells, n_components](const problem::Problem<dim> &instant)
    {
      method::Vector load(static_cast<unsigned int>(cells->n_free * n_components));
      for (std::size_t i = 0; i < cells->n_free; ++i)
        for (unsigned int c = 0; c < n_components; ++c)
          load[i * n_components + c] = cells->area[i] * instant.load(cells->nodes[i], c);
      return load;
    };
    parts.around = std::move(around);
    return method::move_by_rows<dim>(std::move(parts));
  }

  template algebra::CsrMatrix by_volumes(algebra::CsrMatrix, const geometry::NodeCells<2> &,
                                         unsigned int);
  template algebra::CsrMatrix by_volumes(algebra::CsrMatrix, const geometry::NodeCells<3> &,
                                         unsigned int);
  template std::unique_ptr<method::MotionOf<2>>
  move_nodes(std::shared_ptr<const geometry::NodeCells<2>>, unsigned int,
             const algebra::CsrMatrix &, const algebra::CsrMatrix &,
             std::function<std::vector<double>(const problem::Problem<2> &)>);
  template std::unique_ptr<method::MotionOf<3>>
  move_nodes(std::shared_ptr<const geometry::NodeCells<3>>, unsigned int,
             const algebra::CsrMatrix &, const algebra::CsrMatrix &,
             std::function<std::vector<double>(const problem::Problem<3> &)>);
} // namespace plumbline::meshfree
