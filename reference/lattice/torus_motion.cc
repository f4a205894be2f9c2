#include "reference/lattice/torus_motion.h"

#include "base/error.h"
#include "method/nodal_motion.h"
#include "reference/lattice/torus_force.h"

#include <cmath>

namespace plumbline::reference
{
  namespace
  {
    template <int dim>
    class TorusMotion : public method::NodalMotion<method::ContinuousMotion, dim>
    {
      using Nodal = method::NodalMotion<method::ContinuousMotion, dim>;
      using Nodal::nodes_;
      using Nodal::state;

    public:
      using State = typename Nodal::State;

      TorusMotion(const physics::DoubleWell &law, const geometry::Box &torus, unsigned int n)
          : lower_(torus.lower), side_(torus.upper[0] - lower_[0]), n_(n),
            force_(law, n, side_, n_radii, n_angles)
      {
        for (unsigned int j = 0; j < (dim == 1 ? 1 : n); ++j)
          for (unsigned int i = 0; i < n; ++i)
            nodes_.emplace_back(lower_[0] + side_ * i / n, lower_[1] + side_ * j / n);
      }

      std::vector<double> drive(const problem::Problem<2> &instant) const override
      {
        return state(instant.load);
      }
      std::vector<double> inertia(const problem::Problem<2> &instant) const override
      {
        return state(*instant.solution);
      }
      void acceleration(const State &u, const std::vector<double> &g, State &a) const override
      {
        force_.force(u, a);
        for (std::size_t i = 0; i < a.size(); ++i)
          a[i] += g[i];
      }
      void tangent(const State &, const std::vector<double> &, const State &,
                   State &) const override
      {
        throw NumericalError("the torus without a mesh has no tangent; take an explicit scheme");
      }
      bool has_tangent() const override { return false; }
      double product(const State &u, const State &v) const override
      {
        double sum = 0;
        for (std::size_t i = 0; i < u.size(); ++i)
          sum += u[i] * v[i];
        return std::pow(side_, dim) / static_cast<double>(nodes_.size()) * sum;
      }
      double energy(const State &u, const std::vector<double> &) const override
      {
        return force_.energy(u);
      }
      double power(const State &, const State &v, const std::vector<double> &g,
                   const std::vector<double> &) const override
      {
        return product(g, v);
      }
      double value(const State &u, const dealii::Point<2> &x, unsigned int component) const override
      {
        std::array<double, dim> from{};
        for (unsigned int axis = 0; axis < dim; ++axis)
          from[axis] = x[axis] - lower_[axis];
        return force_.interpolate(&u[component * nodes_.size()], from);
      }

    private:
      // enough for fields whose waves are 7 horizons long, see physics::WellForce
      static constexpr unsigned int n_radii = 12, n_angles = 32;
      dealii::Point<2> lower_;
      double side_;
      unsigned int n_;
      TorusForce<dim> force_;
    };
  } // namespace

  std::unique_ptr<method::ContinuousMotion> move_on_torus(const physics::DoubleWell &law,
                                                          const geometry::Box &torus,
                                                          unsigned int dimension, unsigned int n)
  {
    if (dimension == 1)
      return std::make_unique<TorusMotion<1>>(law, torus, n);
    return std::make_unique<TorusMotion<2>>(law, torus, n);
  }
} // namespace plumbline::reference
