// Conditioning of families, against singular values by brute force.
#include "meshfree/rules/moments.h"
#include "meshfree/rules/rules.h"

#include <Eigen/SVD>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

using namespace plumbline;

TEST(Families, have_the_smallest_singular_value_of_their_moment_matrix)
{
  constexpr double horizon = .3;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (const unsigned int n_bonds : {30u, 26u, 14u}) // the last one too few for 14 + 1 moments
  {
    meshfree::Family<2> family;
    for (unsigned int j = 0; j < n_bonds; ++j)
    {
      const dealii::Point<2> xi(horizon * uniform(random), horizon * uniform(random));
      const double area = .01 * (1.5 + uniform(random));
      family.bonds.push_back({xi, area, xi, area});
    }
    meshfree::MomentConditions<2> conditions;
    conditions.degree = 4;
    conditions.horizon = horizon;
    conditions.exponents = meshfree::exponents<2>(0, 4);
    conditions.moments.assign(conditions.exponents.size(), 1);
    conditions.factor = [](const meshfree::Bond<2> &bond) { return 1 / bond.xi.norm(); };
    conditions.scale = [](const meshfree::Bond<2> &bond) { return bond.area; };
    Eigen::MatrixXd matrix(conditions.exponents.size(), n_bonds);
    for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    {
      for (unsigned int j = 0; j < n_bonds; ++j)
      {
        const meshfree::Bond<2> &bond = family.bonds[j];
        matrix(i, j) = std::pow(bond.xi[0] / horizon, conditions.exponents[i][0]) *
                       std::pow(bond.xi[1] / horizon, conditions.exponents[i][1]) / bond.xi.norm() *
                       std::sqrt(bond.area);
      }
      matrix.row(i).normalize();
    }
    const double exact = Eigen::JacobiSVD<Eigen::MatrixXd>(matrix.transpose())
                             .singularValues()[static_cast<Eigen::Index>(std::min<std::size_t>(
                                                   n_bonds, conditions.exponents.size())) -
                                               1];
    meshfree::meet(conditions, family);
    if (n_bonds < conditions.exponents.size()) // dependent
    {
      EXPECT_LT(family.fit.smallest_singular_value, 1e-14);
      EXPECT_EQ(family.fit.rank, n_bonds);
    }
    else
      EXPECT_NEAR(family.fit.smallest_singular_value, exact, .01 * exact);
  }
}

TEST(Families, of_the_optimised_rule_lose_rank_at_ratio_two_but_not_beyond)
{
  const auto value = [](double m)
  {
    const auto kernel = physics::Kernel<2>::with_bulk_modulus({{1, -1}}, .1 * m, 1);
    return meshfree::lattice_bonds(meshfree::optimisation_based(kernel), kernel, .1,
                                   geometry::Backend::fast)
        .fit.smallest_singular_value;
  };
  EXPECT_LT(value(2), 1e-14);
  EXPECT_GT(value(2.24), .1);
  EXPECT_GT(value(3), .1);
}
