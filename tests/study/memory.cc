// What methods expect to take, against what they take.
#include "base/error.h"
#include "meshfree/method.h"
#include "reference/method.h"
#include "scene/problem.h"
#include "study/preflight.h"

#include <gtest/gtest.h>

using namespace plumbline;
using namespace plumbline::study;

namespace
{
  scene::Scene parse(const std::string &text, const std::string &methods)
  {
    return scene::parse_scene("memory.prm",
                              text + "subsection Methods\n set names = " + methods + "\nend\n");
  }

  /// Solve the first level of a scene.
  void expect_estimate(const scene::Scene &scene, const Methods &available)
  {
    const problem::Level level = scene.study.series[0].levels[0];
    const problem::Problem<2> problem = make_problem(scene, 0, level);
    method::ProblemSize size;
    size.level = level;
    size.n_components = problem.n_components;
    size.is_body = problem.body() != nullptr;
    size.has_dilatation = problem.dilatation.has_value();
    if (problem.lattice())
      for (unsigned int d = 0; d < 2; ++d)
        size.extents[d] = problem.lattice()->n_cells()[d];
    else
    {
      size.n_cells = static_cast<double>(problem.mesh()->cells.size());
      size.n_free = static_cast<double>(problem.cells()->n_free);
      size.cell_area = level.h * level.h;
    }
    for (const std::string &name : scene.methods.names)
    {
      const auto method = find_method(available, name, "Methods/names");
      (void)analysis::solve(*method, problem); // libraries make their tables
      const analysis::Solution solution = analysis::solve(*method, problem);
      const double ratio =
          method->expected_bytes(size) / static_cast<double>(solution.cost.peak_bytes);
      EXPECT_GT(ratio, .5) << name << ", of " << solution.cost.peak_bytes;
      EXPECT_LT(ratio, 2) << name << ", of " << solution.cost.peak_bytes;
    }
  }

  const std::string scalar = "subsection Problem\n set solution = sin(3*x)*cos(2*y)\nend\n";
  const std::string solid = "subsection Kernel\n set type = 1/r\n set limit = Navier\nend\n"
                            "subsection Material\n set model = LPS\n set E = 1\n set nu = 0.3\n"
                            "end\nsubsection Problem\n set solution = x*(1-x), y*(1-y)\nend\n";

  std::string sizes(const std::string &h, const std::string &m)
  {
    return "subsection Study\n set h = " + h + "\n set m = " + m + "\nend\n";
  }
} // namespace

TEST(CheckMemory, of_triangles_of_their_own_size_is_what_they_take)
{
  const scene::Scene bar = scene::read_scene(
      std::string(PLUMBLINE_SCENES) + "/state_based/notched_bar.prm", {{"Study/h", "0.1, 0.001"}});
  // some 200 triangles at both levels; 10,000 times as many would take more than any machine has
  const Methods available = reference::methods();
  const Methods one = {find_method(available, "DGP3", "Methods/names")};
  EXPECT_NO_THROW(check_memory(bar, one, available, 0));
}

TEST(CheckMemory, of_samples_side_by_side_is_that_of_all_of_them)
{
  const scene::Scene scene = parse(scalar + sizes("0.0078125", "3"), "Q1");
  const Methods available = reference::methods();
  const Methods one = {find_method(available, "Q1", "Methods/names")};
  EXPECT_NO_THROW(check_memory(scene, one, available, 0, 1));
  EXPECT_THROW(check_memory(scene, one, available, 0, 1000000000), InputError);
}

#ifndef __SANITIZE_ADDRESS__ // which has memory of its own
TEST(ExpectedMemory, of_lattices_is_within_a_factor_of_two)
{
  expect_estimate(parse(scalar + sizes("0.00390625", "3"), "Q1, Q2, DGQ1"), reference::methods());
  expect_estimate(parse(scalar + sizes("0.001953125", "30"), "Q1"), reference::methods());
  expect_estimate(parse(scalar + sizes("0.001953125", "3"), "FA"), meshfree::methods());
}

TEST(ExpectedMemory, of_solids_on_lattices_is_within_a_factor_of_two)
{
  expect_estimate(parse(solid + sizes("0.00390625", "3"), "Q1, Q2"), reference::methods());
  expect_estimate(parse(solid + sizes("0.00390625", "3"), "FA"), meshfree::methods());
}

TEST(ExpectedMemory, of_meshes_and_scattered_nodes_is_within_a_factor_of_two)
{
  const std::string squares = "subsection Domain\n set mesh = squares\nend\n";
  expect_estimate(parse(scalar + squares + sizes("0.015625", "3"), "DGQ1"), reference::methods());
  expect_estimate(parse(scalar + squares + sizes("0.0078125", "4"), "IPA-AC"), meshfree::methods());
  const std::string triangles = "subsection Domain\n set mesh = triangles\nend\n";
  expect_estimate(parse(scalar + triangles + sizes("0.015625", "8"), "P1"), reference::methods());
}
#endif
