#include "meshfree/fracture/standing_crack.h"

#include "base/error.h"
#include "meshfree/fracture/breaking_network.h"
#include "physics/crack_field.h"

#include <Eigen/Cholesky>

#include <cmath>

namespace plumbline::meshfree
{
  namespace
  {
    using method::RiceStrip;

    /// The strip with all that is constrained around it, which moves with the nearer grip or the
    /// field.
    BreakingSolid<2> make_solid(const RiceStrip &strip, int reach)
    {
      const double half = .5 * strip.h * strip.n_height, length = strip.h * strip.n_length,
                   out = strip.h * reach;
      BreakingSolid<2> solid;
      solid.domain.include = {{{-out, -half - out}, {length + out, half + out}}};
      solid.grips = {{{-out, half}, {length + out, half + out}},
                     {{-out, -half - out}, {length + out, -half}},
                     {{-out, -half}, {0, half}},
                     {{length, -half}, {length + out, half}}};
      solid.notch = {{{-out - strip.h, 0}, {strip.h * strip.n_crack, 0}}};
      solid.constrained = [strip](const Point<2> &x)
      {
        if (strip.K_tip)
          return physics::crack_field(Point<2>(x[0] - strip.h * *strip.K_tip, x[1]), {1, 1});
        Tensor<1, 2> u;
        u[1] = x[1] > 0 ? 1 : -1;
        return u;
      };
      solid.material = [](const Point<2> &) { return physics::Lame{1, 1}; };
      solid.toughness = [](const Point<2> &) { return 1.; };
      return solid;
    }

    /// The intact strip, where nothing changes along x and only u_y is not zero.
    struct IntactStrip
    {
      Eigen::VectorXd u; ///< of rows, from the lowest that is constrained on
      double energy = 0; ///< of a column
      double at_end = 0; ///< half of its bonds that cross a line
    };

    IntactStrip solve_intact(const RiceStrip &strip, int reach, const BondNetwork<2> &network)
    {
      const int n = strip.n_height + 2 * reach;
      const auto row = [&](unsigned int node) {
        return static_cast<Eigen::Index>(
            std::lround(network.nodes[node][1] / strip.h - .5 + .5 * n));
      };
      const double x = strip.h * (strip.n_length - .5); // of a column whose bonds are all there
      Eigen::MatrixXd all = Eigen::MatrixXd::Zero(n, n), across = all;
      const auto is_constrained = [&](Eigen::Index i) { return i < reach || i >= n - reach; };
      for (const BondNetwork<2>::Bond &bond : network.bonds)
        if (std::abs(network.nodes[bond.from][0] - x) < .5 * strip.h)
        {
          const Eigen::Index i = row(bond.from), j = row(bond.to);
          if (is_constrained(i) && is_constrained(j))
            continue;
          Eigen::Matrix2d form;
          form << 1, -1, -1, 1;
          form *= bond.stiffness * bond.way[1] * bond.way[1];
          const std::vector<Eigen::Index> ends = {i, j};
          all(ends, ends) += form;
          across(ends, ends) += std::abs(bond.xi[0]) / strip.h * form;
        }
      Eigen::VectorXd u = Eigen::VectorXd::Zero(n);
      u.head(reach).setConstant(-1);
      u.tail(reach).setConstant(1);
      const Eigen::VectorXd force = -(all * u).segment(reach, strip.n_height);
      u.segment(reach, strip.n_height) =
          all.block(reach, reach, strip.n_height, strip.n_height).ldlt().solve(force);
      return {u, .5 * u.dot(all * u), .25 * u.dot(across * u)};
    }
  } // namespace

  method::StripState solve_strip(const RiceStrip &strip, const NeighbourhoodQuadrature<2> &rule,
                                 const Kernel<2> &influence)
  {
    // partial areas reach a cell farther
    const int reach = static_cast<int>(std::ceil(influence.horizon() / strip.h - 1e-9)) + 1;
    BondNetwork<2> network =
        make_bond_network(make_solid(strip, reach), rule, influence, strip.h, Backend::fast);
    method::StripState state;
    if (strip.K_tip)
      state.intact = physics::crack_release({1, 1});
    else
    {
      const IntactStrip intact = solve_intact(strip, reach, network);
      state.intact = intact.energy / strip.h;
      state.at_end = intact.at_end;
      const double length = strip.h * strip.n_length, half = .5 * strip.h * strip.n_height;
      for (std::size_t i = 0; i < network.nodes.size(); ++i)
        if (network.grip[i] >= 0 && network.nodes[i][0] > length)
          network.constrained[i][1] =
              intact.u[std::lround((network.nodes[i][1] + half) / strip.h - .5) + reach];
    }
    const BreakingNetwork<2> body(std::move(network), problem::Stretch::linear);
    constexpr double worst_residual = 1e-10;
    if (!(body.response().residual <= worst_residual))
      throw NumericalError("a strip with a crack is solved to a residual of " +
                           std::to_string(body.response().residual) + " only");
    const BondNetwork<2> &solved = body.network();
    const std::vector<Tensor<1, 2>> &u = body.displacements();

    state.n_unknowns = body.n_unknowns();
    for (const BondNetwork<2>::Bond &bond : solved.bonds)
      if (solved.grip[bond.from] < 0 || solved.grip[bond.to] < 0)
      {
        const double pull = bond.way * (u[bond.to] - u[bond.from]);
        state.energy += .5 * bond.stiffness * pull * pull;
      }
    state.opening.resize(static_cast<std::size_t>(strip.n_crack));
    for (std::size_t i = 0; i < solved.nodes.size(); ++i)
    {
      const Point<2> &x = solved.nodes[i];
      const auto column = static_cast<long>(std::floor(x[0] / strip.h));
      if (std::abs(x[1]) < strip.h && column >= 0 && column < strip.n_crack)
        state.opening[static_cast<std::size_t>(column)] += (x[1] > 0 ? 1 : -1) * u[i][1];
    }
    return state;
  }
} // namespace plumbline::meshfree
