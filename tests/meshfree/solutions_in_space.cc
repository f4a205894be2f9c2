// Solutions of rules on lattices of cubes: exact polynomials in the unit cube, given around it. The
// errors are those of an independent program.
#include "algebra/linear_system.h"
#include "meshfree/lattice/stencil.h"
#include "tests/meshfree/lattice_rules.h"

#include <deal.II/lac/vector.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <vector>

using namespace plumbline;
using namespace plumbline::meshfree;

namespace
{
  using FieldInSpace = std::function<double(const Point<3> &x, unsigned int component)>;

  Bonds<3> make(const std::string &name, const Kernel<3> &kernel, double cell)
  {
    const auto all = rules();
    const auto rule =
        std::find_if(all.begin(), all.end(), [&](const Rule &one) { return one.name == name; });
    return lattice_bonds(rule->in_space(kernel), kernel, cell, Backend::fast);
  }

  /// The largest one of the rule's solution on n × n × n cells with the load b of the field u.
  double largest_error(const std::string &rule, const Kernel<3> &kernel, int n,
                       const FieldInSpace &u, const FieldInSpace &b)
  {
    const auto stencil = lattice_operator(kernel, make(rule, kernel, 1. / n));
    const int reach = stencil.reach();
    std::vector<double> around, exact, load;
    for (unsigned int c = 0; c < kernel.n_components(); ++c)
      for (int k = -reach; k < n + reach; ++k)
        for (int j = -reach; j < n + reach; ++j)
          for (int i = -reach; i < n + reach; ++i)
          {
            const Point<3> x((i + .5) / n, (j + .5) / n, (k + .5) / n);
            const bool is_inside = std::min({i, j, k}) >= 0 && std::max({i, j, k}) < n;
            around.push_back(is_inside ? 0 : u(x, c));
            if (!is_inside)
              continue;
            exact.push_back(u(x, c));
            load.push_back(b(x, c));
          }
    const geometry::BoxNodes nodes{{n, n, n}};
    const auto action = algebra::collar_action(stencil, nodes, around);
    algebra::Vector solution(exact.size()), right_hand_side(load.begin(), load.end());
    for (std::size_t i = 0; i < load.size(); ++i)
      right_hand_side[i] -= action[i];
    algebra::StencilSystem(stencil, nodes, algebra::OperatorBackend::automatic)
        .solve(solution, right_hand_side, {1e-13, 200});
    solution -= algebra::Vector(exact.begin(), exact.end());
    return solution.linfty_norm();
  }

  double scalar_error(const std::string &rule, int n)
  {
    const double horizon = 3. / n;
    const auto kernel =
        Kernel<3>::with_diffusion(physics::kernel_type("linear-decay").profile, horizon, .5);
    const double m4 = 9 * horizon * horizon / 28, m22 = 3 * horizon * horizon / 28;
    EXPECT_NEAR(kernel.moment({4, 0, 0}), m4, 1e-14);
    EXPECT_NEAR(kernel.moment({2, 2, 0}), m22, 1e-14);
    return largest_error(
        rule, kernel, n,
        [](const Point<3> &x, unsigned int)
        { return std::pow(x[0], 3) * x[1] * x[1] + std::pow(x[2], 4) + x[0] * x[1] * x[2] * x[2]; },
        [&](const Point<3> &x, unsigned int)
        {
          const double laplacian =
              6 * x[0] * x[1] * x[1] + 2 * std::pow(x[0], 3) + 12 * x[2] * x[2] + 2 * x[0] * x[1];
          return -(laplacian / 2 + m4 + 3 * x[0] * m22);
        });
  }
} // namespace

TEST(SolutionsInSpace, have_the_known_errors)
{
  const std::map<std::string, std::array<double, 2>> known = {{"FA", {2.43e-2, 1.96e-2}},
                                                              {"IPA-AC-R2", {1.26e-3, 2.67e-4}}};
  for (const auto &[rule, row] : known)
    for (const int i : {0, 1})
      EXPECT_NEAR(scalar_error(rule, 8 << i) / row[i], 1, 5e-3) << rule << ", " << i;
  EXPECT_NEAR(scalar_error("IPA-AC", 8) / 6.48e-2, 1, 5e-3);
}

TEST(SolutionsInSpace, are_exact_where_the_rule_meets_all_moments_of_the_field)
{
  for (const int n : {8, 16})
    EXPECT_LT(scalar_error("IPA-AC-R4", n), 7e-13) << n;
}

TEST(SolutionsInSpace, of_bond_tensors_with_right_second_moments_are_exact_for_quadratic_fields)
{
  constexpr int n = 8;
  const auto kernel =
      Kernel<3>::with_bulk_modulus(physics::kernel_type("bond-tensor").profile, 3. / n, 1);
  const double hessian[3][3][3] = {{{2, .5, 0}, {.5, -1, 1}, {0, 1, 3}},
                                   {{0, 1, -2}, {1, 4, 0}, {-2, 0, 1}},
                                   {{1, 0, 1}, {0, -3, .5}, {1, .5, 2}}}; // of each component
  const auto u = [&](const Point<3> &x, unsigned int c)
  {
    double sum = 0;
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        sum += hessian[c][i][j] * x[i] * x[j] / 2;
    return sum;
  };
  const auto b = [&](const Point<3> &, unsigned int c)
  {
    double sum = 0;
    for (unsigned int other = 0; other < 3; ++other)
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
        {
          std::array<int, 3> alpha{};
          ++alpha[i];
          ++alpha[j];
          sum -= kernel.moment(alpha, c, other) * hessian[other][i][j] / 2;
        }
    return sum;
  };
  EXPECT_LT(largest_error("IPA-AC-R2", kernel, n, u, b), 1e-11);
  EXPECT_GT(largest_error("FA", kernel, n, u, b), 1e-3);
}
