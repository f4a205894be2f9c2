#include "reference/lattice/double_well_motion.h"

#include "base/error.h"
#include "method/nodal_motion.h"
#include "reference/lattice/double_well_galerkin.h"

#include <deal.II/base/quadrature_lib.h>

#include <cmath>
#include <numeric>

namespace plumbline::reference
{
  namespace
  {
    /// States are M^½ u, in which the tangent is symmetric. Nodes are numbered cell by cell.
    template <int dim>
    class GalerkinMotion : public method::NodalMotion<method::EquationOfMotion, dim>
    {
      using Nodal = method::NodalMotion<method::EquationOfMotion, dim>;
      using Nodal::nodes_;
      using Nodal::size;

    public:
      using State = typename Nodal::State;

      /// Forces by degree + 2 points: of Q1 the load is wrong by 1e-6 of itself; with 2 points by
      /// 3e-4, at a fifth of the cost, which errors of h = 1/20 show.
      GalerkinMotion(const problem::Problem<2> &problem, const AxisShapes &shapes, bool is_lumped,
                     std::optional<double> largest_eigenvalue, unsigned int n_more)
          : lattice_(*problem.lattice()), shapes_(shapes),
            space_(*problem.double_well, problem.h, lattice_.n_cells(),
                   shapes.degree() + 2 + n_more, shapes.degree(), is_lumped),
            largest_(largest_eigenvalue)
      {
        const auto n = space_.n_along();
        const int p = degree();
        for (int j = 0; j < n[1]; ++j)
          for (int i = 0; i < n[0]; ++i)
            nodes_.push_back(lattice_.point(i / p + shapes.support_point(i % p),
                                            dim == 1 ? 0 : j / p + shapes.support_point(j % p)));
      }

      std::vector<double> drive(const problem::Problem<2> &instant) const override
      {
        return tested(instant.load);
      }
      std::vector<double> inertia(const problem::Problem<2> &instant) const override
      {
        return tested(*instant.solution);
      }
      State state(const problem::Field<2> &field) const override
      {
        State x = Nodal::state(field);
        space_.apply_mass(x, .5);
        return x;
      }
      std::vector<double> nodal(const State &x) const override
      {
        return Nodal::nodal(over_root(x));
      }
      void acceleration(const State &x, const std::vector<double> &g, State &a) const override
      {
        space_.residual(over_root(x), a);
        a = over_root(std::move(a));
        for (std::size_t i = 0; i < a.size(); ++i)
          a[i] += g[i];
      }
      void tangent(const State &x, const std::vector<double> &, const State &y,
                   State &out) const override
      {
        space_.tangent(over_root(x), over_root(y), out);
        out = over_root(std::move(out));
      }
      std::optional<double> largest_eigenvalue() const override { return largest_; }
      double product(const State &x, const State &y) const override
      {
        return std::inner_product(x.begin(), x.end(), y.begin(), 0.);
      }
      double energy(const State &x, const std::vector<double> &) const override
      {
        return space_.energy(over_root(x));
      }
      double power(const State &, const State &v, const std::vector<double> &g,
                   const std::vector<double> &) const override
      {
        return product(g, v);
      }

    private:
      double cell() const { return std::pow(lattice_.h(), dim); }

      int degree() const { return static_cast<int>(shapes_.degree()); }

      /// M^-½ x.
      State over_root(State x) const
      {
        space_.apply_mass(x, -.5);
        return x;
      }

      /// M^-½ ∫ b φ: in parts of each cell where b may jump.
      State tested(const problem::Field<2> &b) const
      {
        constexpr unsigned int n_parts = 4;
        const dealii::QIterated<dim> gauss(dealii::QGauss<1>(shapes_.degree() + 2),
                                           b.is_smooth() ? 1 : n_parts);
        const auto &n_cells = lattice_.n_cells();
        const auto n = space_.n_along();
        const int p = degree();
        State result(size());
        for (int j = 0; j < n_cells[1]; ++j)
          for (int i = 0; i < n_cells[0]; ++i)
            for (unsigned int q = 0; q < gauss.size(); ++q)
            {
              const double s = gauss.point(q)[0], t = dim == 1 ? 0 : gauss.point(q)[dim - 1];
              const dealii::Point<2> x = lattice_.point(i + s, j + t);
              for (unsigned int c = 0; c < dim; ++c)
              {
                const double value = cell() * gauss.weight(q) * b(x, c);
                for (int l = 0; l <= (dim == 1 ? 0 : p); ++l)
                  for (int k = 0; k <= p; ++k)
                    result[(c * static_cast<std::size_t>(n[1]) + (j * p + l) % n[1]) * n[0] +
                           (i * p + k) % n[0]] +=
                        value * shapes_.value(k, s) * (dim == 1 ? 1 : shapes_.value(l, t));
              }
            }
        return over_root(std::move(result));
      }

      geometry::Lattice lattice_;
      AxisShapes shapes_;
      DoubleWellGalerkin<dim> space_;
      std::optional<double> largest_;
    };
  } // namespace

  std::unique_ptr<method::EquationOfMotion>
  move_galerkin_on_torus(const problem::Problem<2> &problem, const AxisShapes &shapes,
                         bool is_lumped, std::optional<double> largest_eigenvalue,
                         unsigned int n_more)
  {
    if (problem.dimension() == 1)
      return std::make_unique<GalerkinMotion<1>>(problem, shapes, is_lumped, largest_eigenvalue,
                                                 n_more);
    return std::make_unique<GalerkinMotion<2>>(problem, shapes, is_lumped, largest_eigenvalue,
                                               n_more);
  }
} // namespace plumbline::reference
