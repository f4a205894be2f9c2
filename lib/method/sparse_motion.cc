#include "method/sparse_motion.h"

#include "algebra/asymmetry.h"
#include "algebra/block_rows.h"

#include <deal.II/base/parallel.h>
#include <deal.II/lac/vector.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace plumbline::method
{
  namespace
  {
    using State = EquationOfMotion::State;

    constexpr unsigned int grain = 512; // rows, worth a thread's while

    algebra::Action action_of(const std::shared_ptr<const algebra::CsrMatrix> &rows,
                              unsigned int n_components)
    {
      if (auto blocks = algebra::BlockRows::make(*rows, n_components))
        return [n_components, by = std::make_shared<const algebra::BlockRows>(std::move(*blocks))](
                   const State &x, State &y)
        {
          y.resize(n_components * by->n_nodes());
          dealii::parallel::apply_to_subranges(
              static_cast<std::size_t>(0), by->n_nodes(),
              [&](std::size_t from, std::size_t to) { by->vmult(x.data(), y.data(), from, to); },
              grain / 2);
        };
      return [rows](const State &x, State &y)
      {
        y.resize(rows->n_rows());
        dealii::parallel::apply_to_subranges(
            static_cast<std::size_t>(0), rows->n_rows(),
            [&](std::size_t from, std::size_t to)
            {
              for (std::size_t i = from; i < to; ++i)
              {
                double sum = 0;
                for (std::size_t k = rows->start[i]; k < rows->start[i + 1]; ++k)
                  sum += rows->value[k] * x[rows->column[k]];
                y[i] = sum;
              }
            },
            grain);
      };
    }

    bool is_symmetric(const algebra::CsrMatrix &rows)
    {
      constexpr double rounding = 1e-12;
      return algebra::asymmetry(rows) <= rounding;
    }

    template <int dim>
    MassRoot mass_root(const SparseParts<dim> &parts)
    {
      if (parts.masses.empty())
        return MassRoot(parts.mass.free);
      std::vector<double> masses;
      for (const double mass : parts.masses)
        masses.insert(masses.end(), parts.n_components, mass);
      return MassRoot(std::move(masses));
    }

    State values(const Vector &x)
    {
      return {x.begin(), x.end()};
    }
  } // namespace

  template <int dim>
  std::unique_ptr<MotionOf<dim>> move_by_rows(SparseParts<dim> given)
  {
    const auto stiffness = std::move(given.stiffness);
    const auto parts = std::make_shared<const SparseParts<dim>>(std::move(given));
    const auto load = [parts](const problem::Problem<dim> &instant)
    {
      Vector load = parts->load(instant);
      subtract_constrained(*parts->constrained, parts->around(instant), load);
      return values(load);
    };
    const auto inertia = [parts](const problem::Problem<dim> &instant)
    {
      problem::Problem<dim> of_solution = instant;
      of_solution.load = *instant.solution;
      Vector load = parts->load(of_solution);
      if (parts->masses.empty())
        subtract_constrained(parts->mass.constrained, parts->around(instant), load);
      return values(load);
    };
    algebra::Action transposed;
    if (!is_symmetric(*stiffness))
      transposed =
          action_of(std::make_shared<const algebra::CsrMatrix>(algebra::transpose(*stiffness)),
                    parts->n_components);
    return move_linear<dim>({parts->nodes,
                             parts->n_components,
                             {},
                             mass_root(*parts),
                             action_of(stiffness, parts->n_components),
                             transposed,
                             load,
                             inertia,
                             1});
  }

  template std::unique_ptr<MotionOf<2>> move_by_rows(SparseParts<2>);
  template std::unique_ptr<MotionOf<3>> move_by_rows(SparseParts<3>);
} // namespace plumbline::method
