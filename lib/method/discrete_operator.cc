#include "method/discrete_operator.h"

#include "base/error.h"

#include <utility>

namespace plumbline::method
{
  template <int dim>
  DiscreteOperatorOf<dim> discrete_operator(LinearEquations<dim> of_unit_load)
  {
    const LinearEquations<dim> &given = of_unit_load;
    const std::size_t n_unknowns = given.n_free * given.n_components;
    DiscreteOperatorOf<dim> result;
    result.n_components = given.n_components;
    result.is_collocated = !given.volumes.empty();
    for (std::size_t i = 0; i < given.n_free; ++i)
    {
      result.mass.push_back(result.is_collocated ? given.volumes[i]
                                                 : given.load[i * given.n_components]);
      if (!(result.mass.back() > 0))
        throw NumericalError("a shape function has an integral that is not positive, so that there "
                             "are no lumped masses to define eigenvalues with");
    }
    algebra::CsrMatrix &rows = result.rows;
    rows.start.assign(1, 0);
    for (std::size_t i = 0; i < n_unknowns; ++i)
    {
      const double scale = result.is_collocated ? result.mass[i / given.n_components] : 1;
      for (std::size_t k = given.rows.start[i]; k < given.rows.start[i + 1]; ++k)
        if (given.rows.column[k] < n_unknowns) // of a free node
        {
          rows.column.push_back(given.rows.column[k]);
          rows.value.push_back(scale * given.rows.value[k]);
        }
      rows.start.push_back(rows.column.size());
    }
    result.nodes = std::move(of_unit_load.nodes);
    result.nodes.resize(given.n_free);
    return result;
  }

  template DiscreteOperatorOf<2> discrete_operator(LinearEquations<2>);
  template DiscreteOperatorOf<3> discrete_operator(LinearEquations<3>);
} // namespace plumbline::method
