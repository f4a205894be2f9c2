// The rules on lattices of cubes: their second moments decide whether they are asymptotically
// compatible. The numbers are those of an independent program in quadruple precision.
#include "base/error.h"
#include "tests/meshfree/lattice_rules.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

using namespace plumbline;
using namespace plumbline::meshfree;

namespace
{
  Bonds<3> make(const std::string &rule, const Kernel<3> &kernel)
  {
    for (const Rule &one : rules())
      if (one.name == rule)
        return lattice_bonds(one.in_space(kernel), kernel, h, Backend::fast);
    throw InputError("there is no rule " + rule);
  }

  /// Relative to the kernel's own.
  double defect(const std::string &rule, const Kernel<3> &kernel,
                const std::array<int, 3> &alpha = {2, 0, 0})
  {
    return moment(kernel, make(rule, kernel), 0, 0, alpha) / kernel.moment(alpha, 0, 0) - 1;
  }

  double smallest_ratio(const std::string &rule, const Kernel<3> &kernel)
  {
    return smallest_ratio(make(rule, kernel));
  }

  using Row = std::array<double, 4>; // m = 2, 3, 4, 5

  template <class Measure>
  void expect_rows(const std::map<std::string, Row> &rows, double tolerance, const Measure &measure)
  {
    for (const auto &[rule, row] : rows)
      for (int m = 2; m <= 5; ++m)
        EXPECT_NEAR(measure(rule, m), row[m - 2], tolerance) << rule << ", m = " << m;
  }
} // namespace

TEST(RulesInSpace, have_as_many_neighbours_as_nodes_or_cells_are_in_the_ball)
{
  expect_rows({{"FA", {32, 122, 256, 514}}, {"PA-AC", {80, 250, 460, 822}}}, 0,
              [](const std::string &rule, int m)
              { return static_cast<double>(make(rule, scalar_kernel<3>(m)).family.size()); });
}

TEST(RulesInSpace, partial_volumes_add_up_to_the_ball_without_the_nodes_own_cell)
{
  for (const double m : {1.5, 2., 2.7, 4.})
  {
    double volume = 0;
    for (const Bond<3> &bond : make("IPA-AC", scalar_kernel<3>(m)).family)
      volume += bond.weight;
    EXPECT_NEAR(volume / (h * h * h), 4 * M_PI / 3 * m * m * m - 1, 1e-11) << m;
  }
}

TEST(RulesInSpace, have_the_known_defects_for_scalar_kernels)
{
  const auto of_linear_decay = [](const std::string &rule, int m)
  { return defect(rule, scalar_kernel<3>(m)); };
  expect_rows({{"FA", {-.0119, -.0441, .0080, -.0051}},
               {"LAMMPS", {-.0675, -.0618, -.0240, -.0187}},
               {"QWJ", {-.0675, -.0618, -.0240, -.0187}},
               {"PA-AC", {-.0792, -.0684, -.0235, -.0198}}},
              5.1e-5, of_linear_decay);
  expect_rows({{"OPT", {.193, -.070, .044, -.008}}}, 5.1e-4, of_linear_decay);
  expect_rows({{"IPA-AC", {.298701, .137223, .077668, .049662}}}, 5e-7, of_linear_decay);
  expect_rows({{"FA", {-.0302, .1593, -.0721, -.0260}},
               {"LAMMPS", {-.2486, -.1134, -.1667, -.1264}},
               {"QWJ", {.2356, .1042, .0478, .0373}},
               {"PA-AC", {.1133, .0481, .0266, .0169}},
               {"IPA-AC", {.1133, .0481, .0266, .0169}}},
              5.1e-5,
              [](const std::string &rule, int m)
              { return defect(rule, scalar_kernel<3>(m, "constant")); });
}

TEST(RulesInSpace, have_the_known_defects_for_bond_tensors)
{
  expect_rows({{"FA", {-.119, .218, -.043, .001}},
               {"LAMMPS", {-.225, -.047, -.123, -.090}},
               {"QWJ", {.074, .050, .026, .023}},
               {"PA-AC", {.0054, .0109, .0080, .0058}},
               {"IPA-AC", {.082, .048, .029, .019}},
               {"OPT", {0, 0, 0, 0}}},
              5.1e-4,
              [](const std::string &rule, int m) {
                return defect(rule, tensor_kernel<3>(m), {0, 2, 0});
              });
  expect_rows({{"FA", {.031, .056, -.066, -.036}},
               {"LAMMPS", {-.203, -.135, -.146, -.113}},
               {"QWJ", {.165, .070, .027, .023}},
               {"PA-AC", {.0589, .0224, .0117, .0071}},
               {"IPA-AC", {.172, .066, .035, .022}},
               {"OPT", {0, 0, 0, 0}}},
              5.1e-4,
              [](const std::string &rule, int m) { return defect(rule, tensor_kernel<3>(m)); });
}

TEST(RulesInSpace, recalibrated_weights_meet_all_second_moments_and_stay_positive)
{
  for (const double m : {1.5, 2., 3., 4.3})
    for (const auto &kernel : {scalar_kernel<3>(m), tensor_kernel<3>(m)})
    {
      const Bonds<3> bonds = make("IPA-AC-R2", kernel);
      for (unsigned int a = 0; a < kernel.n_components(); ++a)
        for (unsigned int b = 0; b < kernel.n_components(); ++b)
          for (const std::array<int, 3> &alpha :
               {std::array<int, 3>{2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {1, 1, 0}, {0, 1, 1}})
            EXPECT_NEAR(moment(kernel, bonds, a, b, alpha), kernel.moment(alpha, a, b), 1e-12);
      EXPECT_GT(smallest_ratio("IPA-AC-R2", kernel), .5) << m;
    }
  expect_rows(
      {{"IPA-AC-R2", {.748, .853, .911, .940}}, {"IPA-AC-R4", {.274, .588, .770, .847}}}, 5.1e-4,
      [](const std::string &rule, int m) { return smallest_ratio(rule, scalar_kernel<3>(m)); });
  expect_rows(
      {{"IPA-AC-R2", {.847, .940, .974, .987}}, {"IPA-AC-R4", {-.010, .217, .604, .729}}}, 5.1e-4,
      [](const std::string &rule, int m) { return smallest_ratio(rule, tensor_kernel<3>(m)); });
}

TEST(RulesInSpace, of_higher_degree_need_more_neighbours)
{
  EXPECT_THROW((void)make("IPA-AC-R4", scalar_kernel<3>(1.5)), NumericalError);
  EXPECT_THROW((void)make("OPT", scalar_kernel<3>(1.5)), NumericalError);
  EXPECT_THROW((void)make("OPT", tensor_kernel<3>(1.75)), NumericalError);
  EXPECT_EQ(make("OPT", tensor_kernel<3>(3)).fit.n_conditions, 52u);
}

TEST(RulesInSpace, have_the_symmetry_of_the_cube)
{
  for (const Rule &rule : rules())
  {
    const Kernel<3> kernel = tensor_kernel<3>(2.6);
    const Bonds<3> bonds = lattice_bonds(rule.in_space(kernel), kernel, h, Backend::fast);
    std::map<std::array<long, 3>, double> weights; // by sorted sizes of the coordinates
    for (const Bond<3> &bond : bonds.family)
    {
      std::array<long, 3> key{};
      for (unsigned int d = 0; d < 3; ++d)
        key[d] = std::labs(std::lround(bond.xi[d] / h));
      std::sort(key.begin(), key.end());
      const double weight = bond.weight / (h * h * h);
      const auto [place, is_new] = weights.emplace(key, weight);
      EXPECT_NEAR(weight, place->second, 1e-11) << rule.name;
    }
  }
}
