// What following the circle gives: orders of methods on a disk whose solution knows that it is
// round.
#include "reference/method.h"
#include "scene/problem.h"
#include "study/comparison.h"
#include "study/preflight.h"

#include <deal.II/base/quadrature_lib.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace plumbline;
using namespace plumbline::study;

namespace
{
  constexpr double delta = .5;

  problem::Problem<2> disk(const std::string &sides, double h)
  {
    const auto scene = scene::read_scene(std::string(PLUMBLINE_SCENES) + "/meshes/disk_load.prm",
                                         {{"Geometry/checks", "0"}, {"Domain/sides", sides}});
    return make_problem(scene, 0, {h, delta});
  }

  double error(const problem::Problem<2> &problem, const std::string &name)
  {
    const auto method = find_method(reference::methods(), name, "test");
    const auto solution = analysis::solve(*method, problem);
    return averages_l2(problem, solution.averages, cell_averages(*problem.solution, problem));
  }

  /// L u of u = 1 - r² within the disk and 0 beyond, c = 8/(π δ⁴).
  double load_of_cap(double r)
  {
    const double pi = std::acos(-1.), c = 8 / (pi * std::pow(delta, 4));
    if (r <= 1 - delta)
      return 4;
    static const dealii::QGauss<1> gauss(24);
    double sum = 0;
    for (unsigned int q = 0; q < gauss.size(); ++q)
    {
      // the angle of the part of a circle in the ball is like a square root at its ends
      const double t = .5 * pi * gauss.point(q)[0], length = 1 - (r - delta),
                   s = r - delta + length * std::pow(std::sin(t), 2);
      const double cosine = (r * r + s * s - delta * delta) / (2 * r * s);
      const double half = std::acos(std::clamp(cosine, -1., 1.));
      sum += gauss.weight(q) * pi * length * std::sin(t) * std::cos(t) * 2 * half * s * (1 - s * s);
    }
    return c * (pi * delta * delta * (1 - r * r) - sum);
  }

  problem::Problem<2> cap(const std::string &sides, double h)
  {
    problem::Problem<2> problem = disk(sides, h);
    problem.solution = problem::Field<2>{[](const dealii::Point<2> &x, unsigned int)
                                         { return std::max(0., 1 - x.norm_square()); },
                                         std::nullopt};
    problem.load = {[](const dealii::Point<2> &x, unsigned int)
                    { return load_of_cap(std::min(1., x.norm())); },
                    std::nullopt};
    return problem;
  }
} // namespace

// Solutions jump at the boundary where the load does not vanish there: continuous functions cannot
TEST(CurvedDisk, gives_discontinuous_methods_what_a_polygon_takes)
{
  constexpr double coarse = .2, fine = .1;
  const double of_polygon = error(disk("straight", fine), "DGP2"),
               of_disk = error(disk("curved", fine), "DGP2");
  EXPECT_NEAR(std::log2(error(disk("straight", coarse), "DGP2") / of_polygon), 2, .1);
  EXPECT_LT(of_disk, of_polygon / 100);
}

TEST(CurvedDisk, gives_quadratic_functions_their_order_where_the_solution_vanishes_on_the_circle)
{
  constexpr double coarse = .2, fine = .1;
  for (const auto &[method, order] :
       {std::pair("P1", 2.), std::pair("P2", 2.8), std::pair("DGP2", 2.8)})
  {
    const double of_coarse = error(cap("curved", coarse), method),
                 of_fine = error(cap("curved", fine), method);
    EXPECT_GT(std::log2(of_coarse / of_fine), order)
        << method << ' ' << of_coarse << ' ' << of_fine;
    if (order > 2)
    {
      EXPECT_LT(of_fine, error(cap("straight", fine), method) / 10) << method << ' ' << of_fine;
    }
  }
}
