// Elastic constants of families of scattered nodes.
#include "meshfree/check/elastic_check.h"
#include "meshfree/rules/families.h"
#include "meshfree/rules/rules.h"
#include "meshfree/rules/stiffness.h"
#include "scene/problem.h"

#include <gtest/gtest.h>

using namespace plumbline;
using namespace plumbline::meshfree;

namespace
{
  /// λ = μ = 3κ/5 with κ = 100.
  problem::Problem<2> make_problem(const std::string &mesh, const std::string &kernel)
  {
    const bool is_tensor = kernel != "linear-decay";
    const auto scene = scene::parse_scene(
        "elastic.prm",
        "subsection Domain\n set mesh = " + mesh + "\nend\nsubsection Kernel\n set type = " +
            kernel + (is_tensor ? "\n set limit = Navier\n set bulk modulus = 100" : "") +
            "\nend\nsubsection Problem\n set solution = " + (is_tensor ? "x, y" : "x") +
            "\nend\nsubsection Methods\n set names = FA\nend\n");
    return scene::make_problem(scene, 0, {.125, .125 * 3.015});
  }

  std::vector<Family<2>> families_of(const NeighbourhoodQuadrature<2> &rule,
                                     const problem::Problem<2> &problem)
  {
    const Families<2> families(rule, problem.kernel, *problem.cells(), Backend::fast);
    std::vector<Family<2>> all(families.size());
    for (std::size_t i = 0; i < all.size(); ++i)
      families.make(i, all[i]);
    return all;
  }
} // namespace

TEST(ElasticCheck, exact_moments_give_the_material)
{
  const auto problem = make_problem("triangles", "bond-tensor");
  const auto found =
      elastic_ranges(families_of(recalibrated(problem.kernel, 2), problem), problem.kernel);
  const std::vector<std::pair<std::string, double>> expected = {{"C1111", 180},
                                                                {"C1122", 60},
                                                                {"C1212", 60},
                                                                {"(C1111-C1122)/2", 60},
                                                                {"E, plane stress", 160},
                                                                {"nu, plane stress", 1. / 3},
                                                                {"E, plane strain", 150},
                                                                {"nu, plane strain", .25},
                                                                {"anisotropy", 1}};
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < found.size(); ++k)
  {
    EXPECT_EQ(found[k].name, expected[k].first);
    for (const double value : {found[k].least, found[k].median, found[k].largest, found[k].exact})
      EXPECT_NEAR(value / expected[k].second, 1, 1e-9) << found[k].name;
  }
}

TEST(ElasticCheck, whole_cells_have_the_constants_of_their_lattice)
{
  const auto problem = make_problem("squares", "bond-tensor");
  const auto found =
      elastic_ranges(families_of(full_area(problem.kernel), problem), problem.kernel);
  const auto lattice =
      lattice_bonds(full_area(problem.kernel), problem.kernel, problem.h, Backend::fast);
  const auto expected = stiffness(problem.kernel, lattice.family);
  EXPECT_NEAR(found[0].least, expected.C1111, 1e-10);
  EXPECT_NEAR(found[0].largest, expected.C1111, 1e-10);
  EXPECT_NEAR(found[2].median, expected.C1212, 1e-10);
  // by hand, E = 200 in plane stress: E and the shear moduli along and across the axes
  EXPECT_NEAR(found[4].median / 160, 209.7 / 200, 3e-4);
  EXPECT_NEAR(found[2].median / 160, 74.3 / 200, 3e-4);
  EXPECT_NEAR(found[3].median / 160, 79.5 / 200, 3e-4);
}

TEST(ElasticCheck, scalars_have_none)
{
  const auto problem = make_problem("squares", "linear-decay");
  EXPECT_TRUE(
      elastic_ranges(families_of(full_area(problem.kernel), problem), problem.kernel).empty());
}
