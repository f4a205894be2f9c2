#include "meshfree/body/network.h"

#include "base/error.h"
#include "meshfree/fracture/equilibrium.h"

#include <deal.II/lac/vector.h>

#include <cmath>
#include <limits>
#include <sstream>

namespace plumbline::meshfree
{
  namespace
  {
    constexpr double rounding = 1e-9; // of h²
    constexpr auto mechanism =
        "the bond network is a mechanism; choose a larger horizon (Study/m), or fix more nodes "
        "(Domain/fixed)";

    /// Nodes of a body, by their positions in it.
    std::vector<std::size_t> positions_of(const VariationalBody &body)
    {
      std::vector<std::size_t> result;
      for (std::size_t i = 0; i < body.size(); ++i)
        if (body.V[i] > 0)
          result.push_back(i);
      return result;
    }

    std::array<int, 2> steps(const VariationalBody &body, std::size_t i)
    {
      return {static_cast<int>(i % body.n[0]), static_cast<int>(i / body.n[0])};
    }

    /// @throws InputError  fictitious nodes of this body are not known
    void check_box(const VariationalBody &body, int reach)
    {
      for (std::size_t i = 0; i < body.size(); ++i)
      {
        double V = body.h * body.h;
        for (unsigned int d = 0; d < 2; ++d)
          if (steps(body, i)[d] == 0 || steps(body, i)[d] == body.n[d] - 1)
            V /= 2;
        if (std::abs(body.V[i] - V) > rounding * body.h * body.h)
        {
          std::ostringstream message;
          message << "fictitious nodes (methods +mirror) need a body of one box with nodes on its "
                     "sides, but the cell of the node ("
                  << body.node(i) << ") has the area " << body.V[i] << ", not " << V
                  << "; write Domain/mesh = lattice, one box in Domain/boxes and no Domain/holes, "
                     "or take +energy or +volume";
          throw InputError(message.str());
        }
      }
      for (unsigned int d = 0; d < 2; ++d)
        if (reach > body.n[d] - 1)
          throw InputError("fictitious nodes (methods +mirror): the horizon of " +
                           std::to_string(reach) + " h reaches across the box (Domain/boxes), " +
                           std::to_string(body.n[d] - 1) +
                           " h wide; choose a smaller horizon (Study/m, Study/horizon)");
    }

    /// Sums over the family of each node, relative to those of a whole family.
    std::vector<AxisSums> relative_sums(const VariationalBody &body,
                                        const std::vector<Neighbour> &family,
                                        const Kernel<2> &influence, const Bonds<2> &bonds,
                                        const SurfaceCorrection &correction)
    {
      std::vector<AxisSums> sums(body.size());
      if (correction.of_bond == nullptr)
        return sums;
      const double whole = body.h * body.h;
      AxisSums bulk{};
      std::vector<AxisSums> of_bonds;
      for (const Bond<2> &bond : bonds.family)
      {
        of_bonds.push_back(correction.of_bond(bond.xi, bond.weight / whole,
                                              radial_value(influence, bond) * bond.weight / whole));
        for (unsigned int a = 0; a < 2; ++a)
          bulk[a] += whole * of_bonds.back()[a];
      }
      for (unsigned int a = 0; a < 2 && correction.counts_own_volume; ++a)
        bulk[a] += whole;
      for (std::size_t i = 0; i < body.size(); ++i)
      {
        if (correction.counts_own_volume)
          sums[i] = {body.V[i], body.V[i]};
        for (std::size_t b = 0; b < family.size(); ++b)
        {
          const std::array<int, 2> from = steps(body, i), &k = family[b].k;
          const int j0 = from[0] + k[0], j1 = from[1] + k[1];
          if (j0 < 0 || j0 >= body.n[0] || j1 < 0 || j1 >= body.n[1])
            continue;
          const double V = body.V[j0 + static_cast<std::size_t>(body.n[0]) * j1];
          for (unsigned int a = 0; a < 2; ++a)
            sums[i][a] += V * of_bonds[b][a];
        }
        for (unsigned int a = 0; a < 2; ++a)
          sums[i][a] /= bulk[a];
      }
      return sums;
    }

    /// The bonds of a body, from node to node and to fictitious nodes.
    class NetworkMaker
    {
    public:
      NetworkMaker(const VariationalBody &body, const Kernel<2> &influence, const Bonds<2> &bonds,
                   const SurfaceCorrection &correction)
          : body_(body), correction_(correction), number_(body.size(), -1)
      {
        network_.h = body.h;
        network_.horizon = influence.horizon();
        for (const std::size_t i : positions_of(body))
        {
          number_[i] = static_cast<int>(network_.nodes.size());
          network_.nodes.push_back(body.node(i));
          network_.grip.push_back(body.is_fixed[i] != 0 ? 0 : -1);
        }
        network_.constrained.resize(network_.nodes.size());
        family_ = make_family(body, influence, bonds);
        double m = 0;
        for (const Neighbour &other : family_)
          m += body.h * body.h * other.weight * other.d.norm_square();
        alpha_ = body.l[positions_of(body).front()] / m;
        if (correction.is_fictitious)
          check_box(body, reach(family_));
        sums_ = relative_sums(body, family_, influence, bonds, correction);
      }

      BondNetwork<2> make() &&
      {
        for (std::size_t i = 0; i < body_.size(); ++i)
          if (number_[i] >= 0)
            for (const Neighbour &other : family_)
              add(i, other);
        return std::move(network_);
      }

    private:
      void add(std::size_t i, const Neighbour &other)
      {
        const std::array<int, 2> from = steps(body_, i);
        const std::array<int, 2> to = {from[0] + other.k[0], from[1] + other.k[1]};
        const bool is_inside = to[0] >= 0 && to[0] < body_.n[0] && to[1] >= 0 && to[1] < body_.n[1];
        const std::size_t j =
            is_inside ? to[0] + static_cast<std::size_t>(body_.n[0]) * to[1] : body_.size();
        const Tensor<1, 2> way = other.d / other.d.norm();
        const double strength = alpha_ * other.weight, whole = body_.h * body_.h;
        if (!is_inside && correction_.is_fictitious)
          network_.extrapolated.push_back({static_cast<unsigned int>(number_[i]), way,
                                           strength * body_.V[i] * whole, combination(to)});
        if (!is_inside || number_[j] < 0 || j < i)
          return;
        double stiffness = 2 * strength * body_.V[i] * body_.V[j];
        if (correction_.is_fictitious)
          stiffness = strength * (body_.V[i] + body_.V[j]) * whole;
        if (correction_.factor != nullptr)
          stiffness *= correction_.factor(sums_[i], sums_[j], other.d);
        network_.bonds.push_back({static_cast<unsigned int>(number_[i]),
                                  static_cast<unsigned int>(number_[j]), other.d, way, stiffness, 0,
                                  std::numeric_limits<double>::infinity()});
      }

      std::vector<std::pair<unsigned int, double>> combination(const std::array<int, 2> &to) const
      {
        std::vector<std::pair<unsigned int, double>> result;
        for (const auto &[p, a] : odd_extension(to[0], body_.n[0]))
          for (const auto &[q, b] : odd_extension(to[1], body_.n[1]))
            result.emplace_back(number_[p + static_cast<std::size_t>(body_.n[0]) * q], a * b);
        return result;
      }

      const VariationalBody &body_;
      const SurfaceCorrection &correction_;
      std::vector<int> number_; ///< of the nodes of the network, -1: none
      std::vector<Neighbour> family_;
      double alpha_ = 0;
      std::vector<AxisSums> sums_;
      BondNetwork<2> network_;
    };
  } // namespace

  BondNetwork<2> make_body_network(const VariationalBody &body, const Kernel<2> &influence,
                                   const Bonds<2> &bonds, const SurfaceCorrection &correction)
  {
    return NetworkMaker(body, influence, bonds, correction).make();
  }

  NetworkOperator::NetworkOperator(VariationalBody body, const Kernel<2> &influence,
                                   const Bonds<2> &bonds, const SurfaceCorrection &correction)
      : body_(std::move(body)), positions_(positions_of(body_)),
        network_(make_body_network(body_, influence, bonds, correction)), connections_(network_),
        equations_(factored_equations(network_, connections_))
  {
    if (!connections_.holds().empty())
      throw NumericalError(mechanism);
  }

  std::uint64_t NetworkOperator::n_bonds() const
  {
    return 2 * network_.bonds.size() + network_.extrapolated.size();
  }

  NodeField<2> NetworkOperator::at_free(const algebra::Vector &field) const
  {
    NodeField<2> result(positions_.size());
    for (std::size_t i = 0; i < positions_.size(); ++i)
      for (unsigned int d = 0; d < 2 && network_.grip[i] < 0; ++d)
        result[i][d] = field[d * body_.size() + positions_[i]];
    return result;
  }

  void NetworkOperator::put(const NodeField<2> &field, double sign, algebra::Vector &result) const
  {
    result = 0.;
    for (std::size_t i = 0; i < positions_.size(); ++i)
      for (unsigned int d = 0; d < 2 && network_.grip[i] < 0; ++d)
        result[d * body_.size() + positions_[i]] = sign * field[i][d];
  }

  void NetworkOperator::vmult(algebra::Vector &result, const algebra::Vector &input) const
  {
    put(forces(network_, connections_, at_free(input), {}), -1, result);
  }

  algebra::SolveResult NetworkOperator::solve(algebra::Vector &u, const algebra::Vector &f,
                                              double /*tolerance*/,
                                              unsigned int /*max_iterations*/) const
  {
    const auto found = equations_->displacements(at_free(f));
    if (!found)
      throw NumericalError(mechanism);
    put(*found, 1, u);
    algebra::Vector residual(u.size());
    vmult(residual, u);
    residual -= f;
    constexpr double largest_residual = 1e-8;
    const double relative =
        residual.l2_norm() / std::max(f.l2_norm(), std::numeric_limits<double>::min());
    if (!(relative <= largest_residual))
      throw NumericalError(mechanism);
    return {1, relative};
  }
} // namespace plumbline::meshfree
