#include "reference/lattice/double_well_motion.h"

#include "base/error.h"
#include "method/nodal_motion.h"
#include "reference/lattice/double_well_galerkin.h"

#include <deal.II/base/quadrature_lib.h>

namespace plumbline::reference
{
  namespace
  {
    class Q1Motion : public method::NodalMotion<>
    {
    public:
      Q1Motion(const scene::Problem &problem, bool is_lumped, double largest_eigenvalue)
          : lattice_(*problem.lattice),
            space_(*problem.double_well, problem.h, lattice_.n_cells(), n_points),
            is_lumped_(is_lumped), largest_(largest_eigenvalue)
      {
        const auto &n = lattice_.n_cells();
        for (int j = 0; j < n[1]; ++j)
          for (int i = 0; i < n[0]; ++i)
            nodes_.push_back(lattice_.point(i, j));
      }

      std::vector<double> drive(const scene::Problem &instant) const override
      {
        return tested(instant.load);
      }
      std::vector<double> inertia(const scene::Problem &instant) const override
      {
        return tested(*instant.solution);
      }
      void acceleration(const State &u, const std::vector<double> &g, State &a) const override
      {
        space_.residual(u, a);
        over_mass(a);
        for (std::size_t i = 0; i < a.size(); ++i)
          a[i] += g[i];
      }
      void tangent(const State &, const std::vector<double> &, const State &,
                   State &) const override
      {
        throw NumericalError("Q1 of double wells has no tangent; take an explicit scheme");
      }
      bool has_tangent() const override { return false; }
      std::optional<double> largest_eigenvalue() const override { return largest_; }
      double product(const State &u, const State &v) const override
      {
        State mass_v = v;
        if (!is_lumped_)
          space_.apply_mass(mass_v);
        double sum = 0;
        for (std::size_t i = 0; i < u.size(); ++i)
          sum += u[i] * mass_v[i];
        return is_lumped_ ? cell() * sum : sum;
      }
      double energy(const State &u, const std::vector<double> &) const override
      {
        return space_.energy(u);
      }
      double power(const State &, const State &v, const std::vector<double> &g,
                   const std::vector<double> &) const override
      {
        return product(g, v);
      }

    private:
      double cell() const { return lattice_.h() * lattice_.h(); }

      void over_mass(State &x) const
      {
        if (!is_lumped_)
          return space_.apply_inverse_mass(x);
        for (double &value : x)
          value /= cell();
      }

      /// M⁻¹ ∫ b φ.
      State tested(const scene::Field &b) const
      {
        const dealii::QGauss<2> gauss(3);
        const auto &n = lattice_.n_cells();
        State result(size());
        for (int j = 0; j < n[1]; ++j)
          for (int i = 0; i < n[0]; ++i)
            for (unsigned int q = 0; q < gauss.size(); ++q)
            {
              const dealii::Point<2> s = gauss.point(q), x = lattice_.point(i + s[0], j + s[1]);
              for (unsigned int c = 0; c < 2; ++c)
              {
                const double value = cell() * gauss.weight(q) * b(x, c);
                for (int l = 0; l < 2; ++l)
                  for (int k = 0; k < 2; ++k)
                    result[(c * static_cast<std::size_t>(n[1]) + (j + l) % n[1]) * n[0] +
                           (i + k) % n[0]] +=
                        value * (k == 0 ? 1 - s[0] : s[0]) * (l == 0 ? 1 - s[1] : s[1]);
              }
            }
        over_mass(result);
        return result;
      }

      // the load is wrong by 1e-6 of itself; with 2 points by 3e-4, at a fifth of the cost, which
      // errors of h = 1/20 show
      static constexpr unsigned int n_points = 3;
      geometry::Lattice lattice_;
      DoubleWellGalerkin<2> space_;
      bool is_lumped_;
      double largest_;
    };
  } // namespace

  std::unique_ptr<method::EquationOfMotion>
  move_q1_on_torus(const scene::Problem &problem, bool is_lumped, double largest_eigenvalue)
  {
    return std::make_unique<Q1Motion>(problem, is_lumped, largest_eigenvalue);
  }
} // namespace plumbline::reference
