// What does not fit into the machine is refused before anything of it is begun.
#include "refusals.h"

namespace
{
  using namespace plumbline::app;

  class TooLarge : public Refusals
  {
  protected:
    TooLarge()
        : Refusals("too_large", "subsection Problem\n set solution = x^2 + y^2\nend\n"
                                "subsection Methods\n set names = FA\nend\n"
                                "subsection Study\n set h = 0.1\n set norms = averages L2\n"
                                " set decisive error = averages L2 | exact\nend\n")
    {
    }
  };
} // namespace

TEST_F(TooLarge, lattices_are_refused_with_what_they_need)
{
  const std::string solid = set("Kernel/type", "1/r") + set("Kernel/limit", "Navier") +
                            set("Material/model", "LPS") + set("Material/E", "1") +
                            set("Material/nu", "0.3") + set("Problem/solution", "x*y, x*x");
  const std::string fine = set("Study/h", "0.1, 0.0001");
  expect_refusals(
      {{solid + fine + "--methods DGQ3",
        {"DGQ3 at h = 0.0001, horizon = 0.0003 (10000 x 10000 cells): needs some ",
         "GB of memory, and ", "are available; choose a larger h or a smaller horizon (Study/h",
         "--levels", "--methods"}},
       {fine + set("Reference/method", "Q3"), {"Q3 at h = 0.0001, horizon = 0.0003 (10000"}}});
}

TEST_F(TooLarge, meshes_are_refused_before_they_are_made)
{
  const std::string disk =
      set("Domain/mesh", std::string(PLUMBLINE_SCENES) + "/meshes/disk_in_disk.geo");
  expect_refusals(
      {{set("Domain/mesh", "triangles") + set("Study/h", "0.0001"),
        {"Domain/mesh = triangles at h = 0.0001, horizon = 0.0003 (some 2", "needs some ",
         "choose a larger h"}},
       {disk + set("Study/h", "0.1, 0.00001") + "--methods P1",
        {"P1 at h = 1e-05, horizon = 3e-05 (some ", " cells): needs some ", "GB of memory"}}});
}

TEST_F(TooLarge, matrices_are_refused_before_they_are_assembled)
{
  expect_refusals({{set("Domain/mesh", "squares") + set("Study/h", "0.02") + set("Study/m", "80") +
                        "--methods DGQ3",
                    {"DGQ3 at h = 0.02, horizon = 1.6 (some ", "needs some ", "--methods"}}});
}

TEST_F(TooLarge, levels_that_are_not_run_do_not_count)
{
  const auto outcome = run({{set("Study/h", "0.1, 0.0001") + set("Kernel/type", "constant") +
                                 "--levels 1 --methods DGQ3 --quiet",
                             {}}});
  EXPECT_EQ(outcome[0].exit_code, 0) << outcome[0].err;
}

TEST_F(TooLarge, checks_of_geometry_without_end_are_refused)
{
  expect_refusals({{set("Geometry/checks", "2000000000"),
                    {"Geometry/checks = '2000000000' is not allowed", "100000"}}});
}
