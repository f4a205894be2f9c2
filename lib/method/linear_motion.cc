#include "method/linear_motion.h"

#include "base/error.h"
#include "method/distributed_motion.h"

#include <cmath>
#include <memory>
#include <utility>

namespace plumbline::method
{
  namespace
  {
    template <int dim>
    class LinearMotion : public MotionOf<dim>
    {
    public:
      using State = SemiDiscreteMotion::State;

      explicit LinearMotion(LinearParts<dim> parts)
          : parts_(std::move(parts)), n_(parts_.nodes.size() * parts_.n_components)
      {
      }

      std::size_t size() const override { return n_; }

      std::vector<double> drive(const problem::Problem<dim> &instant) const override
      {
        return parts_.mass.of_force(parts_.load(instant));
      }

      std::vector<double> inertia(const problem::Problem<dim> &instant) const override
      {
        return parts_.mass.of_force(parts_.inertia(instant));
      }

      State state(const problem::Field<dim> &field) const override
      {
        State u(n_);
        const auto evaluate = [&]
        {
          std::size_t k = 0;
          for (const auto &node : parts_.nodes)
            for (unsigned int c = 0; c < parts_.n_components; ++c, ++k)
              u[place(k)] = field.value(node, c);
        };
        if (parts_.distribution)
          parts_.distribution->slabs.ranks().together(evaluate);
        else
          evaluate();
        return parts_.mass.to_state(u);
      }

      void acceleration(const State &u, const std::vector<double> &g, State &a) const override
      {
        apply(parts_.stiffness, u, a);
        for (std::size_t i = 0; i < a.size(); ++i)
          a[i] = g[i] - a[i];
      }

      void tangent(const State &, const std::vector<double> &, const State &v,
                   State &out) const override
      {
        apply(parts_.stiffness, v, out);
        if (parts_.transposed)
        {
          State other;
          apply(parts_.transposed, v, other);
          for (std::size_t i = 0; i < out.size(); ++i)
            out[i] = .5 * (out[i] + other[i]);
        }
        for (double &value : out)
          value = -value;
      }

      bool is_symmetric() const override { return !parts_.transposed; }

      double product(const State &u, const State &v) const override
      {
        double sum = 0;
        for (std::size_t i = 0; i < u.size(); ++i)
          sum += u[i] * v[i];
        if (parts_.distribution)
          sum = parts_.distribution->slabs.ranks().sum(sum);
        return parts_.unit * sum;
      }

      double energy(const State &u, const std::vector<double> &) const override
      {
        State force;
        apply(parts_.stiffness, u, force);
        return .5 * product(u, force);
      }

      double power(const State &, const State &v, const std::vector<double> &g,
                   const std::vector<double> &) const override
      {
        return product(g, v);
      }

      unsigned int n_components() const override { return parts_.n_components; }
      const std::vector<dealii::Point<dim>> &nodes() const override { return parts_.nodes; }
      std::vector<double> nodal(const State &u) const override
      {
        const State unknowns = parts_.mass.to_unknowns(u);
        if (parts_.place.empty())
          return unknowns;
        std::vector<double> values(n_);
        for (std::size_t k = 0; k < n_; ++k)
          values[k] = unknowns[place(k)];
        return values;
      }

    protected:
      const LinearParts<dim> &parts() const { return parts_; }

    private:
      /// S⁻¹ A S⁻ᵀ x
      void apply(const algebra::Action &action, const State &x, State &out) const
      {
        out.resize(n_);
        if (parts_.mass.is_one())
          return action(x, out);
        State force(n_);
        action(parts_.mass.to_unknowns(x), force);
        out = parts_.mass.of_force(force);
      }

      std::size_t place(std::size_t k) const { return parts_.place.empty() ? k : parts_.place[k]; }

      LinearParts<dim> parts_;
      std::size_t n_;
    };

    /// On slabs of nodes.
    template <int dim>
    class DistributedLinearMotion : public LinearMotion<dim>, public DistributedMotion
    {
    public:
      explicit DistributedLinearMotion(LinearParts<dim> parts) : LinearMotion<dim>(std::move(parts))
      {
      }

      const base::Communicator &ranks() const override { return slabs().ranks(); }

      std::size_t number(std::size_t i) const override
      {
        const std::size_t n_own = this->parts().nodes.size(), of_plane = nodes_of_plane();
        return (i / n_own * slabs().n_planes() + slabs().owned().first) * of_plane + i % n_own;
      }

      std::vector<double> gather(const std::vector<double> &of_nodes,
                                 unsigned int n_per_node) const override
      {
        return slabs().gather(of_nodes, nodes_of_plane() * n_per_node);
      }

    private:
      const base::Slabs &slabs() const { return this->parts().distribution->slabs; }
      std::size_t nodes_of_plane() const { return this->parts().distribution->plane_size; }
    };
  } // namespace

  template <int dim>
  std::unique_ptr<MotionOf<dim>> move_linear(LinearParts<dim> parts)
  {
    if (parts.distribution)
      return std::make_unique<DistributedLinearMotion<dim>>(std::move(parts));
    return std::make_unique<LinearMotion<dim>>(std::move(parts));
  }

  template std::unique_ptr<MotionOf<2>> move_linear(LinearParts<2>);
  template std::unique_ptr<MotionOf<3>> move_linear(LinearParts<3>);
} // namespace plumbline::method
