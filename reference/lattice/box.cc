#include "base/error.h"
#include "method/limit_proof.h"
#include "physics/gauss.h"
#include "reference/lattice/discretisation.h"
#include "reference/lattice/solid_stencil.h"

#include <cmath>

namespace plumbline::reference
{
  namespace
  {
    /// One node of the box for each free family: a cell, or an inner vertex.
    method::BoxNodes nodes_of(const problem::Problem<3> &problem, const AxisShapes &shapes)
    {
      method::BoxNodes nodes{problem.lattice.n_cells(), .5};
      if (shapes.is_continuous())
      {
        for (int &n : nodes.n)
          if (--n == 0)
            throw NumericalError("the box is one cell thick, so that no vertex is free; choose a "
                                 "smaller h (Study/h)");
        nodes.offset = 1;
      }
      return nodes;
    }

    /// Q1 and DGQ0: shape functions of one family.
    class GalerkinOnBox : public method::BoxDiscretisation
    {
    public:
      GalerkinOnBox(const problem::Problem<3> &problem, const AxisShapes &shapes)
          : BoxDiscretisation(problem, nodes_of(problem, shapes),
                              galerkin_stencil(problem.kernel, problem.h(), shapes)),
            shapes_(shapes), n_components_(problem.n_components)
      {
        limit_ = shapes.degree() == 0
                     ? method::prove_by_moments(problem, stencil(), std::pow(problem.h(), 3))
                     : method::prove_galerkin(problem);
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
      /// ∫ φ_i over the cells of its support, by Gauss's rule.
      std::vector<physics::AxisFunctional> load_functionals(unsigned int axis) const override
      {
        constexpr unsigned int n_points = 6;
        const auto &gauss = physics::gauss(n_points);
        const int first = shapes_.is_continuous() ? 1 : 0;
        std::vector<physics::AxisFunctional> functionals;
        for (int i = 0; i < nodes().n[axis]; ++i)
        {
          physics::AxisFunctional tested;
          for (const auto &part : shapes_.restrictions(0))
            for (unsigned int q = 0; q < n_points; ++q)
            {
              const double s = gauss.point(q)[0];
              tested.emplace_back(lattice().coordinate(axis, i + first + part.cell + s),
                                  lattice().h() * gauss.weight(q) * shapes_.value(part.local, s));
            }
          functionals.push_back(std::move(tested));
        }
        return functionals;
      }

      /// The mean of what spans a cell: its vertices, or itself.
      std::vector<double> averages(const std::vector<double> &values) const override
      {
        const auto &n = nodes().n;
        const std::size_t row = n[0] + 2, layer = row * (n[1] + 2), block = layer * (n[2] + 2);
        const bool has_vertices = shapes_.is_continuous();
        const std::size_t n_corners = has_vertices ? 2 : 1, first = has_vertices ? 0 : 1;
        const double weight = 1. / static_cast<double>(n_corners * n_corners * n_corners);
        const auto &cells = lattice().n_cells();
        std::vector<double> result;
        for (int k = 0; k < cells[2]; ++k)
          for (int j = 0; j < cells[1]; ++j)
            for (int i = 0; i < cells[0]; ++i)
              for (unsigned int c = 0; c < n_components_; ++c)
              {
                double sum = 0;
                for (std::size_t r = first; r < first + n_corners; ++r)
                  for (std::size_t t = first; t < first + n_corners; ++t)
                    for (std::size_t s = first; s < first + n_corners; ++s)
                      sum += values[c * block + (k + r) * layer + (j + t) * row + i + s];
                result.push_back(weight * sum);
              }
        return result;
      }

      AxisShapes shapes_;
      unsigned int n_components_;
      method::LimitProof limit_;
    };
  } // namespace

  std::unique_ptr<method::BoxDiscretisation> discretise_on_box(const problem::Problem<3> &problem,
                                                               const AxisShapes &shapes)
  {
    return std::make_unique<GalerkinOnBox>(problem, shapes);
  }
} // namespace plumbline::reference
