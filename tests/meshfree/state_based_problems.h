// State-based problems on squares with exact local solutions, for tests.
// Source: Fan et al. 2022, doi:10.1016/j.cma.2022.115340, sections 4.1-4.3, for one value of the
// random variables each.
#pragma once

#include "algebra/sparse_system.h"
#include "meshfree/rules/rules.h"
#include "meshfree/scattered/state_based_operator.h"

#include <cmath>
#include <functional>

namespace plumbline::meshfree
{
  using physics::Lame;

  /// The square |x|, |y| < half_width with its collar of 2 δ, δ = 3 h unless said otherwise.
  struct Square
  {
    double h, horizon;
    geometry::NodeCells<2> cells; ///< squares about lattice nodes

    /// @param offset  of nodes from the multiples of h, in h: 0 on the boundary, ½ in cells
    Square(double h, double half_width, double offset, double m = 3) : h(h), horizon(m * h)
    {
      std::vector<Point<2>> collar;
      const int n = static_cast<int>(std::lround(half_width / h + 2 * m)) + 1;
      for (int j = -n; j <= n; ++j)
        for (int i = -n; i <= n; ++i)
        {
          const Point<2> x((i + offset) * h, (j + offset) * h);
          const double farthest = std::max(std::abs(x[0]), std::abs(x[1]));
          if (farthest < half_width - 1e-9 * h)
            cells.nodes.push_back(x);
          else if (farthest < half_width + 2 * horizon + h)
            collar.push_back(x);
        }
      cells.n_free = cells.nodes.size();
      cells.nodes.insert(cells.nodes.end(), collar.begin(), collar.end());
      cells.area.assign(cells.size(), h * h);
      cells.centroid = cells.nodes;
      cells.first_piece = {0};
      for (std::size_t i = 0; i < cells.size(); ++i)
      {
        const auto corners =
            geometry::square(Point<2>(cells.nodes[i][0] - .5 * h, cells.nodes[i][1] - .5 * h), h);
        cells.pieces.emplace_back(corners.begin(), corners.end());
        cells.first_piece.push_back(i + 1);
        cells.source.push_back(i);
      }
    }
  };

  /// A problem: material, u0 that the collar is given and errors are taken against, load.
  struct StateBasedProblem
  {
    std::function<Lame(const Point<2> &)> material;
    std::function<Point<2>(const Point<2> &)> solution, load;
    Damage damage = {};
    bool is_two_point = true, is_homogeneous = false;
  };

  inline Point<2> no_load(const Point<2> &)
  {
    return {};
  }

  inline Lame plane_strain(double E, double nu)
  {
    return physics::lame_from_young(E, nu, physics::PlaneState::strain);
  }

  /// Section 4.1 where 2 + sin 5ξ = 1: smooth material. (A factor 2 + sin 5ξ of E divides u by
  /// itself.) The load is minus the one printed.
  inline StateBasedProblem smooth_problem(double nu)
  {
    const double C1 = nu / ((1 + nu) * (1 - 2 * nu)), C2 = 1 / (2 * (1 + nu));
    const auto material = [nu](const Point<2> &x)
    { return plane_strain(2 + std::sin(x[0]) * std::sin(x[1]), nu); };
    const auto solution = [](const Point<2> &x)
    { return Point<2>(std::sin(x[0]) * std::sin(x[1]), -std::cos(x[0]) * std::cos(x[1])); };
    const auto load = [=](const Point<2> &p)
    {
      const double x = p[0], y = p[1], s = std::sin(x) * std::sin(y);
      return Point<2>(-(C1 + C2) * (-4 * s + 2 * std::cos(2 * x) * std::sin(y) * std::sin(y)) -
                          C2 * (-4 * s + 2 * std::cos(2 * y) * std::sin(x) * std::sin(x)),
                      -(C1 + 2 * C2) *
                          (4 * std::cos(x) * std::cos(y) + std::sin(2 * x) * std::sin(2 * y)));
    };
    return {material, solution, load};
  }

  /// Section 4.2 at ξ = 0: twice as stiff at x > 0, no load.
  inline StateBasedProblem interface_problem(double nu)
  {
    const auto material = [nu](const Point<2> &x) { return plane_strain(x[0] < 0 ? 3 : 6, nu); };
    const auto solution = [](const Point<2> &x)
    { return (x[0] < 0 ? 1 : .5) * Point<2>(x[0], -x[0] / 3); };
    return {material, solution, no_load};
  }

  /// Section 4.3 with E = 2.7 above and 1.3 below: a crack between both at x < 0, of complex stress
  /// intensity 1, eq. (4.3).
  inline StateBasedProblem interface_crack_problem(double nu)
  {
    const double kappa = 3 - 4 * nu;
    const Lame above = plane_strain(2.7, nu), below = plane_strain(1.3, nu);
    const auto material = [=](const Point<2> &x) { return x[1] > 0 ? above : below; };
    const double epsilon =
        std::log((below.mu * kappa + above.mu) / (above.mu * kappa + below.mu)) / (2 * M_PI);
    const auto solution = [=](const Point<2> &x)
    {
      const double r = x.norm(), psi = std::atan2(x[1], x[0]), jump = x[1] > 0 ? M_PI : -M_PI;
      const double A = std::exp(epsilon * (jump - psi)), B = 1 / A, q = 1 + 4 * epsilon * epsilon;
      const double C = 1 / (2 * material(x).mu * q * std::cosh(M_PI * epsilon));
      const double c = std::cos(psi / 2), s = std::sin(psi / 2), S = q * B * std::sin(psi);
      const Point<2> first(-C * ((A - kappa * B) * c - S * s + 2 * epsilon * (A + kappa * B) * s),
                           C * ((A + kappa * B) * s - S * c - 2 * epsilon * (A - kappa * B) * c));
      const Point<2> second(C * ((A + kappa * B) * s + S * c - 2 * epsilon * (A - kappa * B) * c),
                            C * ((A - kappa * B) * c + S * s + 2 * epsilon * (A + kappa * B) * s));
      const double angle = epsilon * std::log(r);
      return Point<2>(std::sqrt(r / (2 * M_PI)) *
                      (std::cos(angle) * first + std::sin(angle) * second));
    };
    return {material, solution, no_load, {{{Point<2>(-10, 0), Point<2>()}}, {}}};
  }

  struct System
  {
    algebra::CsrMatrix rows;
    std::vector<double> right_hand_side;
    std::vector<TipRows> tips = {};
  };

  /// A problem with a rule on a square.
  struct StateBasedCase
  {
    const StateBasedProblem &problem;
    const Square &square;
    StateBasedBody body;
    Families<2> families;

    StateBasedCase(const StateBasedProblem &problem, const Square &square,
                   const std::function<NeighbourhoodQuadrature<2>(const Kernel<2> &)> &rule =
                       optimisation_based<2>)
        : problem(problem),
          square(square), body{&square.cells,
                               {physics::influence_function<2>({{1, -1}}, square.horizon),
                                problem.material, problem.is_two_point, problem.is_homogeneous},
                               problem.damage},
          families(rule(deviatoric()), deviatoric(), square.cells, Backend::fast)
    {
    }

    Kernel<2> deviatoric() const
    {
      return physics::deviatoric_kernel(body.dilatation.influence, 1);
    }

    System system(bool keeps_dilatation = false) const
    {
      const auto make = [this](std::size_t i, Family<2> &family) { families.make(i, family); };
      const std::size_t n_free = square.cells.n_free;
      auto made = keeps_dilatation ? state_based_system(make, body)
                                   : state_based_operator(make, body, {0, n_free});
      std::vector<double> data;
      for (std::size_t i = n_free; i < square.cells.size(); ++i)
        for (unsigned int c = 0; c < 2; ++c)
          data.push_back(problem.solution(square.cells.nodes[i])[c]);
      method::Vector load(made.rows.free.n_rows());
      for (std::size_t i = 0; i < n_free; ++i)
        for (unsigned int c = 0; c < 2; ++c)
          load[2 * i + c] = problem.load(square.cells.nodes[i])[c];
      method::subtract_constrained(made.rows.constrained, data, load);
      return {std::move(made.rows.free), {load.begin(), load.end()}, std::move(made.tips)};
    }

    /// √(h² Σ |u_i - u0|²); dilatations may come after the displacements.
    double l2_error(const std::vector<double> &values) const
    {
      double sum = 0;
      for (std::size_t i = 0; i < square.cells.n_free; ++i)
        for (unsigned int c = 0; c < 2; ++c)
          sum += std::pow(values[2 * i + c] - problem.solution(square.cells.nodes[i])[c], 2);
      return square.h * std::sqrt(sum);
    }
  };

  inline algebra::SparseSolution solve(const System &system,
                                       algebra::SparseSolver solver = algebra::SparseSolver::direct,
                                       unsigned int n_components = 1)
  {
    algebra::SparseOptions options;
    options.is_symmetric = false;
    options.solver = solver;
    options.n_components = n_components;
    return algebra::solve_sparse(system.rows, system.right_hand_side, options,
                                 base::Communicator::alone());
  }
} // namespace plumbline::meshfree
