#include "meshfree/fracture/equilibrium.h"

#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/solver_gmres.h>
#include <deal.II/lac/vector.h>

namespace plumbline::meshfree
{
  namespace
  {
    using Vector = dealii::Vector<double>;

    template <int dim>
    NodeField<dim> to_field(const Vector &x)
    {
      NodeField<dim> field(x.size() / dim);
      for (std::size_t i = 0; i < field.size(); ++i)
        for (unsigned int d = 0; d < dim; ++d)
          field[i][d] = x[dim * i + d];
      return field;
    }

    /// Of free nodes, 0 at grips.
    template <int dim>
    void put(const NodeField<dim> &field, const BondNetwork<dim> &network, Vector &x)
    {
      for (std::size_t i = 0; i < field.size(); ++i)
        for (unsigned int d = 0; d < dim; ++d)
          x[dim * i + d] = network.grip[i] < 0 ? field[i][d] : 0;
    }

    /// A linear map of fields, as a solver of deal.II wants it.
    template <int dim>
    struct Map
    {
      const BondNetwork<dim> &network;
      std::function<NodeField<dim>(const NodeField<dim> &)> action;

      void vmult(Vector &result, const Vector &input) const
      {
        put(action(to_field<dim>(input)), network, result);
      }
    };

    struct Singular
    {
    };
  } // namespace

  template <int dim>
  std::vector<double> dilatations(const BondNetwork<dim> &network,
                                  const Connections<dim> &connections, const NodeField<dim> &u)
  {
    std::vector<double> theta(network.dilatation.size());
    for (std::size_t b = 0; b < network.bonds.size() && !theta.empty(); ++b)
      if (connections.is_whole(b))
      {
        const typename BondNetwork<dim>::Bond &bond = network.bonds[b];
        const double part = bond.share * (bond.xi * (u[bond.to] - u[bond.from]));
        theta[bond.from] += part;
        theta[bond.to] += part;
      }
    return theta;
  }

  template <int dim>
  Tensor<1, dim> force(const BondNetwork<dim> &network, const typename BondNetwork<dim>::Bond &bond,
                       const NodeField<dim> &u, const std::vector<double> &theta)
  {
    Tensor<1, dim> f = bond.stiffness * (bond.way * (u[bond.to] - u[bond.from])) * bond.way;
    if (!network.dilatation.empty())
      f += (network.dilatation[bond.from] * theta[bond.from] +
            network.dilatation[bond.to] * theta[bond.to]) *
           bond.share * bond.xi;
    return f;
  }

  template <int dim>
  NodeField<dim> forces(const BondNetwork<dim> &network, const Connections<dim> &connections,
                        const NodeField<dim> &u, const std::vector<double> &theta)
  {
    NodeField<dim> result(u.size());
    for (std::size_t b = 0; b < network.bonds.size(); ++b)
      if (connections.is_whole(b))
      {
        const typename BondNetwork<dim>::Bond &bond = network.bonds[b];
        const Tensor<1, dim> f = force(network, bond, u, theta);
        result[bond.from] += f;
        result[bond.to] -= f;
      }
    for (const typename BondNetwork<dim>::Extrapolated &bond : network.extrapolated)
    {
      Tensor<1, dim> stretch = -u[bond.from];
      for (const auto &[node, factor] : bond.to)
        stretch += factor * u[node];
      const Tensor<1, dim> f = bond.stiffness * (bond.way * stretch) * bond.way;
      result[bond.from] += f;
      for (const auto &[node, factor] : bond.to)
        result[node] -= factor * f;
    }
    return result;
  }

  template <int dim>
  std::optional<unsigned int>
  equilibrate(const std::function<NodeField<dim>(const NodeField<dim> &)> &forces,
              Iteration iteration, const BondNetwork<dim> &network,
              const NetworkEquations<dim> &equations, NodeField<dim> &u)
  {
    constexpr unsigned int most_iterations = 300, most_vectors = 100;
    constexpr double tolerance = 1e-13; // of what the grips do where nothing else moves
    Vector of_grips(dim * u.size()), residual(dim * u.size()), change(dim * u.size());
    put(forces(network.constrained), network, of_grips);
    put(forces(u), network, residual);
    const Map<dim> stiffness{network,
                             [&](const NodeField<dim> &v)
                             {
                               NodeField<dim> f = forces(v);
                               for (Tensor<1, dim> &one : f)
                                 one = -one;
                               equations.add_holds(v, f);
                               return f;
                             }},
        flexibility{network, [&](const NodeField<dim> &f)
                    {
                      auto v = equations.displacements(f);
                      return v ? std::move(*v) : throw Singular();
                    }};
    dealii::SolverControl control(most_iterations, tolerance * of_grips.l2_norm(), false, false);
    try
    {
      if (iteration == Iteration::gmres)
        dealii::SolverGMRES<Vector>(control,
                                    dealii::SolverGMRES<Vector>::AdditionalData(most_vectors, true))
            .solve(stiffness, change, residual, flexibility);
      else
        dealii::SolverCG<Vector>(control).solve(stiffness, change, residual, flexibility);
    }
    catch (const dealii::SolverControl::NoConvergence &)
    {
      return {};
    }
    catch (const Singular &)
    {
      return {};
    }
    const NodeField<dim> step = to_field<dim>(change);
    for (std::size_t i = 0; i < u.size(); ++i)
      u[i] += step[i];
    return control.last_step();
  }

#define INSTANTIATE(dim)                                                                           \
  template std::vector<double> dilatations(const BondNetwork<dim> &, const Connections<dim> &,     \
                                           const NodeField<dim> &);                                \
  template Tensor<1, dim> force(const BondNetwork<dim> &, const BondNetwork<dim>::Bond &,          \
                                const NodeField<dim> &, const std::vector<double> &);              \
  template NodeField<dim> forces(const BondNetwork<dim> &, const Connections<dim> &,               \
                                 const NodeField<dim> &, const std::vector<double> &);             \
  template std::optional<unsigned int> equilibrate(                                                \
      const std::function<NodeField<dim>(const NodeField<dim> &)> &, Iteration,                    \
      const BondNetwork<dim> &, const NetworkEquations<dim> &, NodeField<dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace plumbline::meshfree
