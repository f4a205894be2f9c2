// Error estimates are bounds: smooth and rough solutions, polygons in place of curves, outer
// quadrature; and the norms that they are stated in.
#include "base/error.h"
#include "benchmarks/estimate_audit.h"
#include "reference/method.h"
#include "scene/problem.h"
#include "study/comparison.h"
#include "study/preflight.h"
#include "study/reference_estimate.h"
#include "study/resized.h"

#include <deal.II/base/quadrature_lib.h>

#include "tests/study/given_solutions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>

#include <unistd.h>

using namespace plumbline;
using namespace plumbline::study;

namespace
{
  using Settings = std::vector<scene::Override>;

  std::shared_ptr<const Method> galerkin(const std::string &name)
  {
    return find_method(reference::methods(), name, "test");
  }

  scene::Scene make_scene(Settings settings)
  {
    settings.push_back({"Geometry/checks", "0"});
    settings.push_back({"Methods/names", "all"});
    return scene::parse_scene("test.prm", "", settings);
  }

  scene::Scene disk_load()
  {
    return scene::read_scene(std::string(PLUMBLINE_SCENES) + "/meshes/disk_load.prm",
                             {{"Geometry/checks", "0"}});
  }

  scene::Scene curved_disk()
  {
    return scene::read_scene(std::string(PLUMBLINE_SCENES) + "/meshes/curved_disk.prm",
                             {{"Geometry/checks", "0"}});
  }

  const Settings smooth = {{"Kernel/type", "constant"}, {"Problem/solution", "sin(3*x)*cos(2*y)"}};
  /// u jumps at the boundary: rate 1/2 of continuous methods.
  const Settings rough = {{"Problem/load", "1"},
                          {"Problem/constraint", "0"},
                          {"Problem/local solution", "0"}, // not used
                          {"Study/norms", "averages L2"},
                          {"Study/decisive error", "averages L2 | local"}};

  Settings with(Settings settings, const Settings &more)
  {
    settings.insert(settings.end(), more.begin(), more.end());
    return settings;
  }

  std::vector<audit::Entry> entries(const scene::Scene &scene, const std::string &method,
                                    const problem::Level &level)
  {
    double seconds = 0;
    const auto problem = make_problem(scene, 0, level);
    const unsigned int much_finer = problem.lattice() ? 8 : 4; // meshes are dear
    return audit::audit(make_case(scene, 0, problem), *galerkin(method), much_finer, seconds);
  }

  /// Floor of the digits that an error leaves.
  unsigned int right_digits(double error, double size)
  {
    return static_cast<unsigned int>(std::max(0., std::floor(-std::log10(error / size))));
  }

  void expect_bounds(const std::vector<audit::Entry> &entries)
  {
    ASSERT_FALSE(entries.empty());
    for (const auto &entry : entries)
    {
      EXPECT_LE(entry.truth, entry.estimate)
          << entry.method << ", " << entry.problem << ", " << entry.norm << ", h = " << entry.h;
      if (entry.norm == "averages")
      {
        EXPECT_LE(entry.certified_digits, right_digits(entry.truth, entry.size)) << entry.method;
      }
    }
  }

  /// A method that errs by outer quadrature alone: a part of the solution at every h.
  class QuadratureFault : public GivenSolutions
  {
  public:
    explicit QuadratureFault(double part)
        : GivenSolutions("fault", MethodFamily::reference), part_(part)
    {
    }

  private:
    method::Field field(const problem::Problem<2> &problem) const override
    {
      method::Field solution;
      solution.averages = cell_averages(*problem.solution, problem);
      for (double &average : solution.averages)
        average *= 1 + part_;
      solution.value =
          [u = problem.solution->value, part = part_](const dealii::Point<2> &x, unsigned int c)
      { return (1 + part) * u(x, c); };
      return solution;
    }
    double outer_change() const override { return part_; }

    double part_;
  };
} // namespace

TEST(Estimates, bound_errors_of_smooth_and_rough_solutions)
{
  std::vector<audit::Entry> all;
  const auto add = [&](const Settings &settings, const std::vector<std::string> &methods,
                       const problem::Level &level)
  {
    const auto scene = make_scene(settings);
    for (const std::string &method : methods)
      for (const auto &entry : entries(scene, method, level))
        all.push_back(entry);
  };
  add(smooth, {"Q1", "Q2", "Q3", "DGQ0", "DGQ1", "DGQ2"}, {.1, .25});
  add(with(smooth, {{"Methods/nodes", "vertices"}}), {"Q1", "DGQ0"}, {.05, .15});
  add(rough, {"Q1", "Q2", "DGQ0", "DGQ1", "DGQ2"}, {.125, .25});
  const Settings triangles = {{"Domain/mesh", "triangles"}, {"Quadrature/tolerance", "1e-4"}};
  add(with(smooth, triangles), {"P1", "P2", "DGP0", "DGP1"}, {.125, .25});
  add(with(rough, triangles), {"P1"}, {.25, .25});
  // cells enough for the mesh of 4 h to tell a rate
  add(with(smooth, triangles), {"P1", "DGP1"}, {.0625, .125});
  const Settings graded = {{"Domain/mesh", "squares"},
                           {"Domain/map", "x + 0.4*x*abs(x), y + 0.25*y*abs(y)"}};
  add(with(smooth, graded), {"Q1", "Q2", "DGQ0", "DGQ1"}, {.125, .25});
  expect_bounds(all);
  constexpr double useful = 5;
  EXPECT_LE(audit::median_ratio(all), useful);
  EXPECT_GE(all.size(), 50u);
}

TEST(Estimates, see_that_a_polygon_is_no_disk)
{
  const auto scene = disk_load();
  std::vector<audit::Entry> all;
  for (const std::string method : {"P1", "DGP1", "DGP2"})
    for (const auto &entry : entries(scene, method, {.4, .5}))
      all.push_back(entry);
  for (const auto &entry : entries(scene, "DGP1", {.2, .5}))
    all.push_back(entry);
  expect_bounds(all);
  EXPECT_LE(audit::median_ratio(all), 3);
  for (const auto &entry : all)
    EXPECT_FALSE(entry.details.is_of_polygon);
  // the polygon's error is that of every degree
  const auto is_of = [&](const std::string &method)
  {
    return std::find_if(all.begin(), all.end(),
                        [&](const audit::Entry &e) { return e.method == method; });
  };
  EXPECT_NEAR(is_of("DGP2")->truth, 1.165e-2, 2e-5);
  EXPECT_NEAR(is_of("DGP1")->truth, 1.184e-2, 2e-5);
  EXPECT_EQ(is_of("DGP2")->certified_digits, 1u);
}

TEST(Estimates, hold_for_the_disk_itself_where_sides_follow_it)
{
  const auto scene = curved_disk();
  std::vector<audit::Entry> all;
  for (const auto &[method, h] :
       {std::pair("DGP1", .4), std::pair("DGP2", .4), std::pair("DGP2", .2)})
    for (const auto &entry : entries(scene, method, {h, .5}))
      all.push_back(entry);
  expect_bounds(all);
  for (const auto &entry : all)
    EXPECT_FALSE(entry.details.is_of_polygon);
  const auto &finest = *std::find_if(
      all.rbegin(), all.rend(), [](const audit::Entry &entry) { return entry.norm == "averages"; });
  EXPECT_EQ(finest.method, "DGP2");
  EXPECT_LT(finest.truth, 5e-6);          // a polygon's is 3e-3
  EXPECT_GE(finest.certified_digits, 3u); // of a polygon at half of its h 2
}

namespace
{
  /// A unit square in n × n squares with a collar of n more around it, as a gmsh file.
  void write_squares(const std::filesystem::path &file, int n)
  {
    std::ofstream out(file);
    const int width = 3 * n;
    out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n2 1 \"omega\"\n2 2 "
           "\"collar\"\n$EndPhysicalNames\n$Nodes\n"
        << (width + 1) * (width + 1) << '\n';
    for (int j = 0; j <= width; ++j)
      for (int i = 0; i <= width; ++i)
        out << j * (width + 1) + i + 1 << ' ' << static_cast<double>(i - n) / n << ' '
            << static_cast<double>(j - n) / n << " 0\n";
    out << "$EndNodes\n$Elements\n" << width * width << '\n';
    for (int j = 0; j < width; ++j)
      for (int i = 0; i < width; ++i)
      {
        const bool is_inside = i >= n && i < 2 * n && j >= n && j < 2 * n;
        const int group = is_inside ? 1 : 2, corner = j * (width + 1) + i + 1;
        out << j * width + i + 1 << " 3 2 " << group << ' ' << group << ' ' << corner << ' '
            << corner + 1 << ' ' << corner + width + 2 << ' ' << corner + width + 1 << '\n';
      }
    out << "$EndElements\n";
  }
} // namespace

// The file is all that is known of the domain: whether a curve was meant nobody can tell.
TEST(Estimates, of_a_mesh_file_hold_for_its_polygon_and_say_so)
{
  const auto file = std::filesystem::temp_directory_path() /
                    ("plumbline_polygon_" + std::to_string(getpid()) + ".msh");
  write_squares(file, 4);
  const Settings settings = {{"Kernel/type", "constant"}, {"Domain/mesh", file.string()}};
  const auto scene = make_scene(with(rough, settings));
  const auto problem = make_problem(scene, 0, {.25, .25});
  const auto method = galerkin("DGQ0");
  const Solution solution = analysis::solve(*method, problem);
  EXPECT_TRUE(estimate_error(make_case(scene, 0, problem), *method, solution, false).is_of_polygon);
  const auto boxes = make_scene(with(rough, {{"Domain/mesh", "squares"}}));
  const auto same = make_problem(boxes, 0, {.25, .25});
  EXPECT_FALSE(
      estimate_error(make_case(boxes, 0, same), *method, analysis::solve(*method, same), false)
          .is_of_polygon);
  std::filesystem::remove(file);
}

namespace
{
  /// The largest defect of a shipped solution of the disk in m u(r) - ∫ K(r, s) u(s) ds = 1, K the
  /// kernel's integral over the part of the circle of radius s that lies in the ball.
  /// @param of_circle  that integral over s, of r, s and half the angle of the part
  double worst_defect(const problem::Problem<2> &problem, double m,
                      const std::function<double(double, double, double)> &of_circle)
  {
    const double delta = problem.horizon(), pi = std::acos(-1.);
    const auto u = [&](double r) { return problem.solution->value({r, 0}, 0); };
    const dealii::QGauss<1> gauss(40);
    const auto half_angle = [&](double r, double s)
    {
      return s + r <= delta
                 ? pi
                 : std::acos(std::clamp((r * r + s * s - delta * delta) / (2 * r * s), -1., 1.));
    };
    double worst = 0;
    for (double r = .02; r < 1; r += .035)
    {
      std::vector<double> cuts = {std::max(0., r - delta), std::abs(delta - r), delta,
                                  std::min(1., r + delta)};
      if (r < delta)
        cuts[0] = 0;
      std::sort(cuts.begin(), cuts.end());
      double sum = 0;
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int q = 0; q < gauss.size(); ++q)
        {
          // both ends may be those of a square root
          const double t = .5 * pi * gauss.point(q)[0], length = cuts[i + 1] - cuts[i];
          const double s = cuts[i] + length * std::pow(std::sin(t), 2);
          if (length > 0)
            sum += gauss.weight(q) * length * pi * std::sin(t) * std::cos(t) * s *
                   of_circle(r, s, half_angle(r, s)) * u(s);
        }
      worst = std::max(worst, std::abs(m * u(r) - sum - 1));
    }
    return worst;
  }
} // namespace

TEST(Estimates, the_shipped_solutions_of_the_disk_solve_their_equations)
{
  const double delta = .5, pi = std::acos(-1.);
  const auto problem = make_problem(disk_load(), 0, {.4, .5});
  const double c = 8 / (pi * std::pow(delta, 4)), m = c * pi * delta * delta;
  constexpr double fitted = 3e-7; // of u, as the scene says; the equation multiplies it by m
  EXPECT_LT(worst_defect(problem, m,
                         [&](double, double, double half_angle) { return 2 * c * half_angle; }),
            2 * fitted * m);
  EXPECT_NEAR(problem.solution->value({0, 0}, 0), .326016, 1e-6);

  const auto curved = make_problem(curved_disk(), 0, {.4, .5});
  const double of_decaying = 3 * c, mass = of_decaying * pi * delta * delta / 2;
  constexpr double fitted_better = 4e-9;
  EXPECT_LT(worst_defect(curved, mass,
                         [&](double r, double s, double half_angle)
                         {
                           return 2 * of_decaying *
                                  (half_angle * (1 - (r * r + s * s) / (delta * delta)) +
                                   2 * r * s * std::sin(half_angle) / (delta * delta));
                         }),
            2 * fitted_better * mass);
  EXPECT_NEAR(curved.solution->value({0, 0}, 0), .312650, 1e-6);
}

TEST(Estimates, include_what_outer_quadrature_errs_whatever_the_size_of_the_solution)
{
  constexpr double part = .01, factor = 5;
  const QuadratureFault method(part);
  for (const std::string size : {"1e-3", "1", "1e3"})
  {
    const auto scene =
        make_scene({{"Problem/solution", size + "*(2 + x*y)"}, {"Problem/load", "1"}});
    const auto problem = make_problem(scene, 0, {.125, .25});
    const Solution solution = analysis::solve(method, problem);
    const auto exact = cell_averages(*problem.solution, problem);
    const double error = averages_l2(problem, solution.averages, exact);
    const auto found = estimate_error(make_case(scene, 0, problem), method, solution, false);
    EXPECT_LE(error * (1 - 1e-10), found.estimate) << size;
    EXPECT_LE(found.estimate, factor * error) << size;
    EXPECT_NEAR(found.outer_change, error, 2 * part * error) << size;
    EXPECT_LE(error * (1 - 1e-10), found.field_estimate) << size;
    EXPECT_LE(found.field_estimate, factor * error) << size;
    EXPECT_EQ(found.certified_digits, 1u) << size; // part / (1 + part) < .01, to the rounding
  }
}

TEST(Estimates, bound_the_errors_at_points)
{
  constexpr double factor = 200; // of the largest error
  std::vector<dealii::Point<2>> points;
  for (unsigned int i = 0; i < 5; ++i)
    for (unsigned int j = 0; j < 5; ++j)
      points.emplace_back(.03 + .23 * i, .06 + .22 * j);
  Settings wave = {{"Problem/solution", "sin(7*x + 5*y)"}},
           tensor = {{"Kernel/type", "bond-tensor"},
                     {"Kernel/limit", "Navier"},
                     {"Problem/solution", "exp(x*y), cos(3*x + y)"}};
  for (const Settings &posed : {smooth, wave, tensor, rough})
    for (const std::string mesh : {"lattice", "triangles"})
      for (const std::string degree : {"1", "2"})
        for (const bool is_cheap : {false, true})
        {
          Settings settings = posed;
          settings.push_back({"Domain/mesh", mesh});
          const auto scene = make_scene(settings);
          const auto method = galerkin((mesh == "lattice" ? "Q" : "P") + degree);
          const auto problem = make_problem(scene, 0, {1. / 16, 1. / 8});
          const Solution solution = analysis::solve(*method, problem);
          study::Values exact;
          std::optional<Solution> fine;
          if (problem.solution)
            exact = problem.solution->value;
          else
          {
            fine = analysis::solve(*method, make_problem(scene, 0, {1. / 64, 1. / 8}));
            exact = fine->value;
          }
          const auto found =
              estimate_error(make_case(scene, 0, problem), *method, solution, is_cheap, points);
          ASSERT_EQ(found.at_points.size(), points.size());
          double largest_error = 0, largest = 0;
          for (std::size_t i = 0; i < points.size(); ++i)
            for (unsigned int c = 0; c < problem.n_components; ++c)
            {
              const double error = std::abs(solution.value(points[i], c) - exact(points[i], c));
              EXPECT_LE(error, found.at_points[i])
                  << posed.back().value << " " << method->name() << " " << is_cheap << " " << i;
              largest_error = std::max(largest_error, error);
              largest = std::max(largest, found.at_points[i]);
            }
          EXPECT_LE(largest, factor * largest_error) << posed.back().value << method->name();
        }
}

TEST(Estimates, leave_no_digit_certain_that_they_reach)
{
  EXPECT_EQ(certified_digits(9e-4, 1), 3u);
  EXPECT_EQ(certified_digits(1.1e-3, 1), 2u);
  EXPECT_EQ(certified_digits(.9, 1), 0u);
  EXPECT_EQ(certified_digits(2, 1), 0u);
  EXPECT_EQ(certified_digits(1.1, 1e3), 2u);
  EXPECT_EQ(certified_digits(0, 1), 0u); // no estimate
  EXPECT_EQ(certified_digits(1e-30, 1), 15u);
}

TEST(Norms, weigh_cell_averages_by_the_cells_areas)
{
  // lines of the grid at map(k/4): the cells with x < map(1/2) = .6 fill a rectangle of height 1.25
  const auto scene = make_scene({{"Domain/mesh", "squares"},
                                 {"Domain/map", "x + 0.4*x*abs(x), y + 0.25*y*abs(y)"},
                                 {"Methods/nodes", "mesh"},
                                 {"Problem/solution", "x"}});
  const auto problem = make_problem(scene, 0, {.25, .25});
  std::vector<double> zero, step;
  for (std::size_t i = 0; i < problem.cells()->n_free; ++i)
  {
    zero.push_back(0);
    step.push_back(problem.cells()->nodes[i][0] < .6 ? 2 : 0);
  }
  // Voronoi cells of unequal rectangles' centres: the line between columns is in the middle
  const double centre_below = (.25 + .4 * .0625 + .6) / 2;
  const double centre_above = (.6 + .75 + .4 * .5625) / 2;
  const double width = (centre_below + centre_above) / 2;
  EXPECT_NEAR(averages_l2(problem, step, zero), 2 * std::sqrt(width * 1.25), 1e-12);
}

TEST(Norms, of_fields_are_exact_for_quartics_on_a_mesh)
{
  const auto scene = make_scene({{"Domain/mesh", "triangles"},
                                 {"Problem/solution", "x*y"},
                                 {"Study/norms", "field L2"},
                                 {"Study/decisive error", "field L2 | exact"}});
  const auto problem = make_problem(scene, 0, {.5, .5});
  Solution solution;
  solution.value = [&](const dealii::Point<2> &x, unsigned int c)
  { return problem.solution->value(x, c) + std::pow(x[0], 4); };
  constexpr double rounding = 1e-12;
  EXPECT_NEAR(errors(scene.study.norms, problem, solution, {}).at("field L2 | exact"), 1. / 3,
              rounding);
}

TEST(Estimates, of_the_reference_are_held_to_a_tolerance_relative_to_the_solution)
{
  const auto solve = [](const std::string &load, const std::string &tolerance)
  {
    const auto scene = make_scene(with(rough, {{"Problem/load", load},
                                               {"Reference/method", "DGQ1"},
                                               {"Reference/tolerance", tolerance}}));
    const auto problem = make_problem(scene, 0, {.125, .25});
    return solve_reference(make_case(scene, 0, problem), *galerkin("DGQ1"), scene.reference);
  };
  EXPECT_NO_THROW(solve("1e6", "0.5")); // whatever the unit of u
  EXPECT_THROW(solve("1e6", "1e-9"), NumericalError);
  EXPECT_THROW(solve("1e-6", "1e-9"), NumericalError);
}
