#include "meshfree/fracture/equilibrium.h"

#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/solver_gmres.h>
#include <deal.II/lac/vector.h>

namespace plumbline::meshfree
{
  namespace
  {
    using Vector = dealii::Vector<double>;

    NodeField to_field(const Vector &x)
    {
      NodeField field(x.size() / 2);
      for (std::size_t i = 0; i < field.size(); ++i)
        for (unsigned int d = 0; d < 2; ++d)
          field[i][d] = x[2 * i + d];
      return field;
    }

    /// Of free nodes, 0 at grips.
    void put(const NodeField &field, const BondNetwork &network, Vector &x)
    {
      for (std::size_t i = 0; i < field.size(); ++i)
        for (unsigned int d = 0; d < 2; ++d)
          x[2 * i + d] = network.grip[i] < 0 ? field[i][d] : 0;
    }

    /// A linear map of fields, as a solver of deal.II wants it.
    struct Map
    {
      const BondNetwork &network;
      std::function<NodeField(const NodeField &)> action;

      void vmult(Vector &result, const Vector &input) const
      {
        put(action(to_field(input)), network, result);
      }
    };

    struct Singular
    {
    };
  } // namespace

  std::vector<double> dilatations(const BondNetwork &network, const Connections &connections,
                                  const NodeField &u)
  {
    std::vector<double> theta(network.dilatation.size());
    for (std::size_t b = 0; b < network.bonds.size() && !theta.empty(); ++b)
      if (connections.is_whole(b))
      {
        const BondNetwork::Bond &bond = network.bonds[b];
        const double part = bond.share * (bond.xi * (u[bond.to] - u[bond.from]));
        theta[bond.from] += part;
        theta[bond.to] += part;
      }
    return theta;
  }

  Tensor<1, 2> force(const BondNetwork &network, const BondNetwork::Bond &bond, const NodeField &u,
                     const std::vector<double> &theta)
  {
    Tensor<1, 2> f = bond.stiffness * (bond.way * (u[bond.to] - u[bond.from])) * bond.way;
    if (!network.dilatation.empty())
      f += (network.dilatation[bond.from] * theta[bond.from] +
            network.dilatation[bond.to] * theta[bond.to]) *
           bond.share * bond.xi;
    return f;
  }

  NodeField forces(const BondNetwork &network, const Connections &connections, const NodeField &u,
                   const std::vector<double> &theta)
  {
    NodeField result(u.size());
    for (std::size_t b = 0; b < network.bonds.size(); ++b)
      if (connections.is_whole(b))
      {
        const BondNetwork::Bond &bond = network.bonds[b];
        const Tensor<1, 2> f = force(network, bond, u, theta);
        result[bond.from] += f;
        result[bond.to] -= f;
      }
    return result;
  }

  std::optional<unsigned int> equilibrate(const std::function<NodeField(const NodeField &)> &forces,
                                          Iteration iteration, const BondNetwork &network,
                                          const NetworkEquations &equations, NodeField &u)
  {
    constexpr unsigned int most_iterations = 300, most_vectors = 100;
    constexpr double tolerance = 1e-13; // of what the grips do where nothing else moves
    Vector of_grips(2 * u.size()), residual(2 * u.size()), change(2 * u.size());
    put(forces(network.constrained), network, of_grips);
    put(forces(u), network, residual);
    const Map stiffness{network,
                        [&](const NodeField &v)
                        {
                          NodeField f = forces(v);
                          for (Tensor<1, 2> &one : f)
                            one = -one;
                          equations.add_holds(v, f);
                          return f;
                        }},
        flexibility{network, [&](const NodeField &f)
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
    const NodeField step = to_field(change);
    for (std::size_t i = 0; i < u.size(); ++i)
      u[i] += step[i];
    return control.last_step();
  }
} // namespace plumbline::meshfree
