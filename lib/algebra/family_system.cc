#include "algebra/family_system.h"

#include "algebra/block_sine.h"
#include "algebra/solve.h"

#include <deal.II/lac/vector.h>

#include <utility>

namespace plumbline::algebra
{
  namespace
  {
    /// Set to zero what is not free.
    void restrict_to_free(const geometry::CubeFamilies &nodes, Vector &values)
    {
      auto value = values.begin();
      for (unsigned int c = 0; c < nodes.n_components; ++c)
        for (const char is_free : nodes.is_free)
          *value++ *= is_free != 0 ? 1. : 0.;
    }

    class FamilyOperator : public Operator
    {
    public:
      FamilyOperator(const Stencil &stencil, geometry::CubeFamilies nodes, OperatorBackend backend)
          : nodes_(std::move(nodes)),
            everywhere_(make_operator(stencil, geometry::BoxNodes{nodes_.n}, backend)),
            n_bonds_(stencil.n_entries() * nodes_.n_free() / nodes_.n_families())
      {
      }
      void vmult(Vector &result, const Vector &input) const override
      {
        everywhere_->vmult(result, input);
        restrict_to_free(nodes_, result);
      }
      std::string backend() const override { return everywhere_->backend(); }
      std::uint64_t n_bonds() const override { return n_bonds_; }

    private:
      geometry::CubeFamilies nodes_;
      std::unique_ptr<Operator> everywhere_;
      std::uint64_t n_bonds_;
    };

    SchwarzPreconditioner on_boxes(const Stencil &stencil, const geometry::CubeFamilies &nodes,
                                   const std::vector<geometry::CubeRange> &boxes)
    {
      std::vector<std::unique_ptr<RectangleSolver>> solvers;
      for (const geometry::CubeRange &box : boxes)
        solvers.push_back(make_block_sine_solver(stencil, nodes, box));
      return SchwarzPreconditioner(std::move(solvers));
    }
  } // namespace

  std::unique_ptr<Operator> make_operator(const Stencil &stencil,
                                          const geometry::CubeFamilies &nodes,
                                          OperatorBackend backend)
  {
    return std::make_unique<FamilyOperator>(stencil, nodes, backend);
  }

  Vector collar_action(const Stencil &stencil, const geometry::CubeFamilies &nodes,
                       const std::vector<double> &data)
  {
    Vector result = collar_action(stencil, geometry::BoxNodes{nodes.n}, data);
    restrict_to_free(nodes, result);
    return result;
  }

  FamilySystem::FamilySystem(const Stencil &stencil, const geometry::CubeFamilies &nodes,
                             const std::vector<geometry::CubeRange> &boxes, OperatorBackend backend)
      : operator_(make_operator(stencil, nodes, backend)),
        preconditioner_(on_boxes(symmetric(stencil), nodes, boxes))
  {
  }

  LinearSolve FamilySystem::solve(Vector &x, const Vector &b, const Stopping &stopping) const
  {
    const SolveResult solved = algebra::solve(*operator_, preconditioner_, x, b, stopping.tolerance,
                                              stopping.max_iterations);
    return {solved.n_iterations, solved.relative_residual, operator_->backend(),
            operator_->n_bonds()};
  }
} // namespace plumbline::algebra
