#include "base/error.h"
#include "meshfree/method.h"
#include "meshfree/rules/rules.h"
#include "meshfree/scattered/field.h"
#include "meshfree/scattered/operator.h"
#include "scene/problem.h"
#include "study/comparison.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>

using namespace plumbline;
using namespace plumbline::meshfree;

namespace
{
  /// A scene on the centres of squares, moved by up to so many h.
  scene::Scene make_scene(double perturbation, bool is_tensor, const std::string &solution,
                          const std::string &kernel_keys = "", const std::string &rule = "all")
  {
    return scene::parse_scene(
        "scattered.prm",
        "subsection Domain\n set mesh = squares\nend\nsubsection Kernel\n" +
            (is_tensor ? std::string(" set type = bond-tensor\n set limit = Navier\n") : "") +
            kernel_keys + "end\nsubsection Problem\n set solution = " + solution +
            "\nend\nsubsection Methods\n set perturbation = " + std::to_string(perturbation) +
            "\n set names = " + rule + "\nend\nsubsection Study\n set norms = nodal Linf\nend\n");
  }

  problem::Problem<2> make_problem(double perturbation, bool is_tensor, double h, double m,
                                   const std::string &kernel_keys = "")
  {
    return scene::make_problem(
        make_scene(perturbation, is_tensor, is_tensor ? "x, y" : "x", kernel_keys), 0, {h, m * h});
  }

  Families<2> make_families(const std::string &name, const problem::Problem<2> &problem)
  {
    return {find_rule(name, "rule").in_plane(problem.kernel), problem.kernel, *problem.cells(),
            Backend::fast};
  }

  /// The largest |Σ C_ab w ξ^α - ∫ C_ab ξ^α| over all families, |α| <= degree, relative to
  /// ∫ |C| |ξ|^|α|, which δ^(|α| - 2) stands for.
  double moment_defect(const Families<2> &families, int degree)
  {
    const Kernel<2> &kernel = families.kernel();
    double worst = 0;
    Family<2> family;
    for (std::size_t i = 0; i < families.size(); ++i)
    {
      families.make(i, family);
      for (unsigned int a = 0; a < kernel.n_components(); ++a)
        for (unsigned int b = 0; b < kernel.n_components(); ++b)
          for (int order = 1; order <= degree; ++order)
            for (int p = 0; p <= order; ++p)
            {
              double defect = -kernel.moment({p, order - p}, a, b);
              for (const Bond<2> &bond : family.bonds)
                defect += kernel_value(kernel, bond, a, b) * bond.weight * std::pow(bond.xi[0], p) *
                          std::pow(bond.xi[1], order - p);
              worst = std::max(worst, std::abs(defect) / std::pow(kernel.horizon(), order - 2));
            }
    }
    return worst;
  }

  /// L_h u at the free nodes for the u that the constraint is.
  std::vector<double> apply(const Families<2> &families, const problem::Problem<2> &problem)
  {
    const auto matrix = scattered_operator(families, problem, {0, families.size()});
    std::vector<double> result(matrix.rows.free.n_rows());
    const unsigned int nc = problem.n_components;
    const auto multiply = [&](const algebra::CsrMatrix &rows, std::size_t first_node)
    {
      for (std::size_t row = 0; row < rows.n_rows(); ++row)
        for (std::size_t k = rows.start[row]; k < rows.start[row + 1]; ++k)
          result[row] +=
              rows.value[k] *
              problem.constraint.value(problem.cells()->nodes[first_node + rows.column[k] / nc],
                                       rows.column[k] % nc);
    };
    multiply(matrix.rows.free, 0);
    multiply(matrix.rows.constrained, problem.cells()->n_free);
    return result;
  }

  analysis::Solution solve(const std::string &name, const problem::Problem<2> &problem)
  {
    const auto all = methods();
    return analysis::solve(**std::find_if(all.begin(), all.end(),
                                          [&](const auto &method)
                                          { return method->name() == name; }),
                           problem);
  }

  double nodal_error(const std::string &name, const scene::Scene &scene,
                     const problem::Level &level)
  {
    const auto problem = scene::make_problem(scene, 0, level);
    return study::errors(scene.study.norms, problem, solve(name, problem), {})
        .at("nodal Linf | exact");
  }
} // namespace

TEST(Families, are_the_lattices_where_nodes_are_not_moved)
{
  const double h = .125;
  for (const bool is_tensor : {false, true})
    for (const double m : {2.5, 3.})
    {
      const auto problem = make_problem(0, is_tensor, h, m);
      for (const Rule &rule : rules())
      {
        const auto lattice =
            lattice_bonds(rule.in_plane(problem.kernel), problem.kernel, h, Backend::fast).family;
        const auto families = make_families(rule.name, problem);
        Family<2> family;
        for (const std::size_t node : {0, 9, 36, 63})
        {
          families.make(node, family);
          EXPECT_EQ(family.bonds.size(), lattice.size()) << rule.name;
          for (const Bond<2> &bond : family.bonds)
          {
            const auto twin = std::find_if(lattice.begin(), lattice.end(),
                                           [&](const Bond<2> &other)
                                           { return bond.xi.distance(other.xi) < 1e-9 * h; });
            ASSERT_NE(twin, lattice.end()) << rule.name;
            EXPECT_NEAR(bond.weight, twin->weight, 1e-12 * h * h) << rule.name << ' ' << m;
            EXPECT_LT(bond.kernel_point.distance(twin->kernel_point) * bond.area,
                      1e-12 * h * h * h);
          }
        }
      }
    }
}

TEST(Families, partial_areas_add_up_to_the_ball_without_the_nodes_own_cell)
{
  const auto problem = make_problem(.3, false, .125, 2.7);
  const auto &cells = *problem.cells();
  const auto families = make_families("PA-AC", problem);
  Family<2> family;
  for (std::size_t i = 0; i < families.size(); ++i)
  {
    const geometry::Ball ball{cells.nodes[i], problem.horizon()};
    double area = 0;
    for (std::size_t p = cells.first_piece[i]; p < cells.first_piece[i + 1]; ++p)
      area += geometry::intersect(ball, cells.pieces[p]).area;
    families.make(i, family);
    for (const Bond<2> &bond : family.bonds)
      area += bond.weight;
    EXPECT_NEAR(area / (M_PI * ball.radius * ball.radius), 1, 1e-12);
  }
}

TEST(Families, recalibrated_meet_all_moments_of_their_degree)
{
  for (const bool is_tensor : {false, true})
  {
    const auto three = make_problem(.3, is_tensor, .125, 3);
    EXPECT_LT(moment_defect(make_families("IPA-AC-R2", three), 2), 1e-12) << is_tensor;
    EXPECT_GT(moment_defect(make_families("IPA-AC", three), 2), .05) << is_tensor;
    EXPECT_GT(moment_defect(make_families("IPA-AC-R2", three), 3), .01) << is_tensor;
    const auto four = make_problem(.3, is_tensor, .125, 4);
    EXPECT_LT(moment_defect(make_families("IPA-AC-R4", four), 4), 1e-12) << is_tensor;
    EXPECT_LT(moment_defect(make_families("OPT", make_problem(.3, true, .125, 3)), 2), 1e-12);
    EXPECT_LT(moment_defect(make_families("GFD", make_problem(.3, is_tensor, .125, 3)), 2), 1e-12);
  }
}

TEST(Families, too_few_neighbours_are_named)
{
  const auto problem = make_problem(.3, false, .125, 1.3);
  const auto families = make_families("IPA-AC-R4", problem);
  Family<2> family;
  try
  {
    for (std::size_t i = 0; i < families.size(); ++i)
      families.make(i, family);
    FAIL();
  }
  catch (const NumericalError &error)
  {
    for (const std::string part : {"at node ", "neighbours", "degree 4", "of 14", "raise m"})
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << part << error.what();
  }
}

// -∫ C (u(x+ξ) - u(x)) of a quadratic is constant: with ½ ∫ C ξ_1² = ½ it is -Δu/2.
TEST(ScatteredOperator, recalibrated_reproduces_quadratics_and_improved_partial_areas_do_not)
{
  const auto scene = make_scene(.3, false, "x^2 + x*y - 2*y^2 + 3*x");
  const auto problem = scene::make_problem(scene, 0, {.125, .375});
  const auto defect = [&](const std::string &name)
  {
    double worst = 0;
    for (const double value : apply(make_families(name, problem), problem))
      worst = std::max(worst, std::abs(value - 1));
    return worst;
  };
  EXPECT_LT(defect("IPA-AC-R2"), 1e-11);
  EXPECT_GT(defect("IPA-AC"), .1);
}

TEST(ScatteredOperator, takes_the_mean_of_the_coefficients_at_both_nodes)
{
  for (const bool is_harmonic : {false, true})
  {
    const auto keys = std::string(" set coefficient = 1 + x\n") +
                      (is_harmonic ? " set symmetrisation = harmonic\n" : "");
    const auto plain = make_problem(0, false, .125, 2),
               varied = make_problem(0, false, .125, 2, keys);
    const auto a = scattered_operator(make_families("FA", plain), plain, {0, 64}).rows.free;
    const auto b = scattered_operator(make_families("FA", varied), varied, {0, 64}).rows.free;
    ASSERT_EQ(a.column, b.column);
    for (unsigned int i = 0; i < 64; ++i)
      for (std::size_t k = a.start[i]; k < a.start[i + 1]; ++k)
        if (const unsigned int j = a.column[k]; j != i)
        {
          const double x = 1 + plain.cells()->nodes[i][0], y = 1 + plain.cells()->nodes[j][0];
          EXPECT_NEAR(b.value[k] / a.value[k], is_harmonic ? 2 * x * y / (x + y) : .5 * (x + y),
                      1e-12);
        }
  }
}

TEST(ScatteredMethods, solve_what_the_lattice_solves_where_nodes_are_not_moved)
{
  for (const bool is_tensor : {false, true})
  {
    const auto scene = make_scene(0, is_tensor, is_tensor ? "x^4, x*y" : "x^4*y");
    scene::Scene lattice_scene = scene;
    lattice_scene.domain.mesh.name = "lattice";
    const auto problem = scene::make_problem(scene, 0, {.125, .375});
    const auto lattice_problem = scene::make_problem(lattice_scene, 0, {.125, .375});
    for (const Rule &rule : rules())
    {
      const auto solution = solve(rule.name, problem);
      const auto expected = solve(rule.name, lattice_problem);
      ASSERT_EQ(solution.nodes.size(), 64u);
      for (std::size_t i = 0; i < 64; ++i)
        for (unsigned int c = 0; c < problem.n_components; ++c)
          EXPECT_NEAR(solution.nodal[i * problem.n_components + c],
                      expected.value(solution.nodes[i], c), 1e-11)
              << rule.name;
      EXPECT_EQ(solution.diagnostics.n_neighbours, expected.diagnostics.n_neighbours);
      EXPECT_NEAR(solution.diagnostics.smallest_weight_ratio,
                  expected.diagnostics.smallest_weight_ratio, 1e-10);
    }
  }
}

TEST(ScatteredMethods, solve_quadratics_exactly_where_the_moments_are)
{
  const auto scalar = make_scene(.3, false, "x^2 - x*y + 2*y^2");
  EXPECT_LT(nodal_error("IPA-AC-R2", scalar, {.1, .3}), 1e-10);
  EXPECT_GT(nodal_error("IPA-AC", scalar, {.1, .3}), 1e-3);
  const auto tensor = make_scene(.3, true, "x^2 + y^2, x*y");
  EXPECT_LT(nodal_error("IPA-AC-R2", tensor, {.1, .3}), 1e-10);
}

TEST(ScatteredMethods, move_two_bodies_with_a_crack_between_them_each_as_its_own)
{
  for (const bool is_tensor : {false, true})
  {
    const std::string zero = is_tensor ? "0, 0" : "0", jump = "0 + (y > 0.5)";
    const auto scene = make_scene(.2, is_tensor, is_tensor ? "0, " + jump : jump,
                                  "end\nsubsection Domain\n set cracks = -2, 0.5 : 3, 0.5\nend\n"
                                  "subsection Problem\n set load = " +
                                      zero + "\n");
    for (const std::string name : {"FA", "PA-AC", "IPA-AC-R2"})
      EXPECT_LT(nodal_error(name, scene, {.125, .5}), 1e-11) << name << is_tensor;
  }
}

TEST(ScatteredMethods, are_asymptotically_compatible_where_the_moments_are_exact)
{
  for (const std::string coefficient : {"", " set coefficient = 1 + x*y\n"})
  {
    const auto scene = make_scene(.3, false, "sin(3*x)*cos(2*y)", coefficient);
    // between h = 1/8 and 1/32, with m = 3
    const auto rate = [&](const std::string &name)
    {
      const double coarse = 1. / 8, fine = 1. / 32;
      return .5 * std::log2(nodal_error(name, scene, {coarse, 3 * coarse}) /
                            nodal_error(name, scene, {fine, 3 * fine}));
    };
    EXPECT_NEAR(rate("IPA-AC-R2"), 2, .3) << coefficient;
    EXPECT_LT(rate("IPA-AC"), .3) << coefficient;
    if (coefficient.empty())
    {
      EXPECT_NEAR(rate("IPA-AC-R4"), 4, .6);
    }
  }
}

TEST(ScatteredMethods, say_how_many_weights_are_negative)
{
  const auto scene = make_scene(.3, true, "x, y");
  const auto problem = scene::make_problem(scene, 0, {.125, .375});
  const auto diagnostics = solve("IPA-AC-R4", problem).diagnostics;
  EXPECT_LT(diagnostics.smallest_weight_ratio, 0);
  EXPECT_GT(diagnostics.n_negative_weights, 0u);
  ASSERT_EQ(diagnostics.notes.size(), 2u);
  EXPECT_NE(diagnostics.notes[0].find("of 64 families"), std::string::npos);
  EXPECT_NE(diagnostics.notes[1].find("no M-matrix"), std::string::npos);
  EXPECT_EQ(diagnostics.operator_backend, "sparse, direct");
  EXPECT_TRUE(solve("IPA-AC-R2", problem).diagnostics.notes.empty());
}

TEST(ScatteredMethods, fields_take_the_value_of_the_nearest_node)
{
  const auto scene = make_scene(.3, true, "x, y");
  const auto problem = scene::make_problem(scene, 0, {.125, .375});
  const auto solution = solve("IPA-AC-R2", problem);
  ASSERT_EQ(solution.nodes.size(), 64u);
  for (double x = 0; x <= 1; x += .0625)
    for (double y = 0; y <= 1; y += .0625)
    {
      const Point<2> at(x, y);
      const auto nearest = std::min_element(solution.nodes.begin(), solution.nodes.end(),
                                            [&](auto &a, auto &b) {
                                              return at.distance_square(a) < at.distance_square(b);
                                            }) -
                           solution.nodes.begin();
      EXPECT_EQ(solution.value(at, 0), solution.nodal[2 * nearest]);
      EXPECT_NEAR(solution.value(at, 1), solution.nodes[nearest][1], 1e-10);
    }

  const std::string file = ::testing::TempDir() + "scattered.vtu";
  solution.write_vtu(file);
  std::size_t n_triangles = 0;
  for (std::size_t p = 0; p < problem.cells()->first_piece[64]; ++p)
    n_triangles += problem.cells()->pieces[p].size() - 2;
  std::stringstream text;
  text << std::ifstream(file).rdbuf();
  EXPECT_NE(text.str().find("NumberOfCells=\"" + std::to_string(n_triangles) + '"'),
            std::string::npos);
  std::remove(file.c_str());
  EXPECT_THROW(solution.write_vtu("/nowhere/scattered.vtu"), InputError);
}

TEST(ScatteredField, averages_of_linear_fields_are_their_values_at_the_centroids)
{
  const auto problem = make_problem(.3, false, .125, 3);
  const geometry::NodeCells<2> &cells = *problem.cells();
  const auto field = [](const Point<2> &x) { return 1 + 2 * x[0] - 5 * x[1]; };
  std::vector<double> values;
  double farthest = 0;
  for (std::size_t i = 0; i < cells.n_free; ++i)
  {
    values.push_back(field(cells.nodes[i]));
    farthest = std::max(farthest, cells.nodes[i].distance(cells.centroid[i]));
  }
  EXPECT_GT(farthest, .01);
  const auto averages = cell_averages(cells, values, 1);
  for (std::size_t i = 0; i < cells.n_free; ++i)
    EXPECT_NEAR(averages[i], field(cells.centroid[i]), 1e-12) << i;
}
