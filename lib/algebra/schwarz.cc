#include "algebra/schwarz.h"

#include <deal.II/lac/vector.h>

namespace plumbline::algebra
{
  SchwarzPreconditioner::SchwarzPreconditioner(const Stencil &stencil,
                                               const geometry::NodeSet &nodes,
                                               const std::vector<geometry::CellRange> &rectangles)
  {
    for (const geometry::CellRange &cells : rectangles)
      solvers_.push_back(nodes.n_families() == 1
                             ? make_sine_solver(stencil, nodes, cells, {}, Zeros::fast)
                             : make_reflection_solver(stencil, nodes, cells));
  }

  void SchwarzPreconditioner::vmult(Vector &result, const Vector &input) const
  {
    result = 0.;
    for (const auto &solver : solvers_)
      solver->add_inverse(result, input);
  }
} // namespace plumbline::algebra
