#include "method/limit_proof.h"
#include "physics/gauss.h"
#include "reference/lattice/discretisation.h"
#include "reference/lattice/mass.h"
#include "reference/lattice/solid_stencil.h"

#include <cmath>

namespace plumbline::reference
{
  namespace
  {
    /// Q1 and DGQ0: shape functions of one family, at inner vertices or centres of cells.
    class GalerkinOnBox : public method::BoxDiscretisation
    {
    public:
      GalerkinOnBox(const problem::Problem<3> &problem, const AxisShapes &shapes)
          : BoxDiscretisation(
                problem,
                shapes.is_continuous() ? method::NodePlace::vertices : method::NodePlace::centres,
                galerkin_stencil(problem.kernel, problem.h(), shapes, problem.dilatation)),
            shapes_(shapes),
            limit_(shapes.degree() == 0
                       ? method::prove_by_moments(problem, stencil(), std::pow(problem.h(), 3))
                       : method::prove_galerkin(problem))
      {
      }

      method::Diagnostics diagnostics() const override
      {
        method::Diagnostics result;
        result.n_neighbours =
            static_cast<unsigned int>(stencil().n_entries() / stencil().n_blocks() - 1);
        result.limit = limit_;
        return result;
      }

    private:
      bool is_collocated() const override { return false; }

      algebra::Stencil mass_stencil() const override
      {
        return reference::mass_stencil<3>(shapes_, stencil().n_blocks(), lattice().h());
      }

      /// ∫ φ over the cells of its support, by Gauss's rule.
      physics::AxisFunctional load_functional(double coordinate) const override
      {
        constexpr unsigned int n_points = 6;
        const auto &gauss = physics::gauss(n_points);
        const double h = lattice().h(),
                     first = shapes_.is_continuous() ? coordinate : coordinate - h / 2;
        physics::AxisFunctional tested;
        for (const auto &part : shapes_.restrictions(0))
          for (unsigned int q = 0; q < n_points; ++q)
          {
            const double s = gauss.point(q)[0];
            tested.emplace_back(first + h * (part.cell + s),
                                h * gauss.weight(q) * shapes_.value(part.local, s));
          }
        return tested;
      }

      AxisShapes shapes_;
      method::LimitProof limit_;
    };
  } // namespace

  std::unique_ptr<method::BoxDiscretisation> discretise_on_box(const problem::Problem<3> &problem,
                                                               const AxisShapes &shapes)
  {
    return std::make_unique<GalerkinOnBox>(problem, shapes);
  }
} // namespace plumbline::reference
