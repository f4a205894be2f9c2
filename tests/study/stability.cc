// The measures tell sound operators from unsound ones, on both sides.
#include "study/stability.h"
#include "analysis/transient.h"
#include "base/symmetric_eigen.h"
#include "meshfree/discretisations.h"
#include "meshfree/lattice/stencil.h"
#include "meshfree/rules/family_statistics.h"
#include "method/lattice_discretisation.h"
#include "scene/problem.h"
#include "tests/study/operators.h"

#include <Eigen/QR>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace plumbline;
using namespace plumbline::study;

namespace
{
  /// A tensor rule with exact moments of degree 2, n_a n_b ξ^α among them, from bonds as given.
  meshfree::NeighbourhoodQuadrature<2>
  tensor_rule(const physics::Kernel<2> &kernel,
              meshfree::Bond<2> (*bond)(const physics::Kernel<2> &, const meshfree::Candidate<2> &))
  {
    // entries C_ab taken at the kernel point q, the field at the node: q_a q_b ξ^α / |q|²
    const std::vector<std::array<int, 4>> which = {
        {0, 0, 2, 0}, {0, 0, 0, 2}, {0, 1, 1, 1}, {1, 1, 2, 0}, {1, 1, 0, 2}};
    return {bond, [=](meshfree::Family<2> &family)
            {
              // min Σ (w - A)²/A: in (w - A)/√A the solution of least norm
              const auto n = static_cast<Eigen::Index>(family.bonds.size());
              Eigen::MatrixXd conditions(which.size(), n);
              Eigen::VectorXd defects(which.size());
              for (std::size_t i = 0; i < which.size(); ++i)
              {
                const auto [a, b, p, q] = which[i];
                defects[i] = kernel.moment({p, q}, a, b);
                for (Eigen::Index k = 0; k < n; ++k)
                {
                  const meshfree::Bond<2> &one = family.bonds[k];
                  const double g = meshfree::kernel_value(kernel, one, a, b) *
                                   std::pow(one.xi[0], p) * std::pow(one.xi[1], q);
                  defects[i] -= one.weight * g;
                  conditions(i, k) = g * std::sqrt(one.area);
                }
              }
              const Eigen::VectorXd change =
                  conditions.completeOrthogonalDecomposition().solve(defects);
              for (Eigen::Index k = 0; k < n; ++k)
                family.bonds[k].weight += change[k] * std::sqrt(family.bonds[k].area);
            }};
  }

  Stability measure_rule(const meshfree::NeighbourhoodQuadrature<2> &rule,
                         const physics::Kernel<2> &kernel, double h)
  {
    const auto bonds = meshfree::lattice_bonds(rule, kernel, h, geometry::Backend::fast);
    const geometry::Lattice lattice({{{{0, 0}, {1, 1}}}, {}}, h);
    const auto nodes = free_nodes(lattice, {{.5, false, 0}}, kernel.n_components());
    Stability found = measure(method::make_discrete_operator(
        lattice, nodes, meshfree::lattice_operator(kernel, bonds), {1}));
    meshfree::describe_weights(bonds.family, bonds.fit, found.diagnostics);
    return found;
  }

  Record level(double m, double h, double smallest, unsigned int n_negative = 0)
  {
    Record record;
    record.key.method = "rule";
    record.key.series = "m = " + std::to_string(m);
    record.key.h = h;
    record.key.horizon = m * h;
    Stability found;
    found.smallest = smallest;
    found.largest = 100;
    found.diagnostics.n_neighbours = 8;
    found.diagnostics.n_negative_weights = n_negative;
    found.diagnostics.smallest_weight_ratio = n_negative > 0 ? -1 : 1;
    return stability_record(record, found, {}, {});
  }
} // namespace

TEST(Stability, of_a_lattice_and_of_its_mesh_agree)
{
  for (const bool is_tensor : {false, true})
    for (const std::string name : {"IPA-AC", "IPA-AC-R2", "Q1", "Q2", "DGQ0", "DGQ1"})
    {
      const problem::Level level{.125, .375};
      const auto a = measure(operator_of(name, make_scene(is_tensor), level)),
                 b = measure(operator_of(name, make_scene(is_tensor, squares), level));
      EXPECT_EQ(a.n_unknowns, b.n_unknowns) << name;
      EXPECT_NEAR(a.smallest, b.smallest, 1e-8 * a.smallest) << name;
      EXPECT_NEAR(a.largest, b.largest, 1e-3 * a.largest) << name;
      EXPECT_NEAR(a.inverse_norm, b.inverse_norm, 1e-6 * a.inverse_norm) << name;
      EXPECT_EQ(a.signs.is_m_matrix(), b.signs.is_m_matrix()) << name;
      EXPECT_LT(a.signs.asymmetry, 1e-12) << name;
      EXPECT_EQ(a.signs.n_parts, 1u) << name;
    }
}

TEST(Stability, the_largest_eigenvalue_is_one_number_and_never_too_small)
{
  const problem::Level level{.05, .15};
  for (const std::string &mesh : {std::string(), squares})
    for (const std::string name : {"FA", "IPA-AC-R2", "Q1", "DGQ1"})
    {
      const problem::Problem<2> problem = scene::make_problem(make_scene(false, mesh), 0, level);
      const auto discretisation = method_of(name)->discretise(problem);
      const DiscreteOperator matrix = discretisation->matrix();
      const auto n = static_cast<Eigen::Index>(matrix.size());
      Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n, n);
      std::vector<double> x(n), y(n);
      for (Eigen::Index j = 0; j < n; ++j)
      {
        x.assign(n, 0);
        x[j] = 1 / std::sqrt(matrix.mass[j]);
        if (matrix.action)
          matrix.action(x, y);
        else
          for (Eigen::Index i = 0; i < n; ++i)
          {
            y[i] = 0;
            for (std::size_t k = matrix.rows.start[i]; k < matrix.rows.start[i + 1]; ++k)
              y[i] += matrix.rows.value[k] * x[matrix.rows.column[k]];
          }
        for (Eigen::Index i = 0; i < n; ++i)
          dense(i, j) = y[i] / std::sqrt(matrix.mass[i]);
      }
      const double exact = base::symmetric_eigen(dense).values[n - 1];
      const Stability found = measure(matrix);
      EXPECT_GE(found.largest, exact * (1 - 1e-13)) << name;
      EXPECT_LE(found.largest, exact * (1 + 1e-4)) << name;
      const CriticalSteps steps = critical_steps(*discretisation, problem, found, 1);
      EXPECT_EQ(matrix.is_collocated ? steps.largest : steps.largest_lumped, found.largest) << name;
      if (matrix.is_collocated)
        continue;
      const auto equation = discretisation->motion(true);
      const analysis::Transient transient(*equation, analysis::TimeSeries(equation->drive(problem)),
                                          1, 0);
      const double step = transient.critical_step(analysis::scheme("velocity Verlet"));
      EXPECT_NEAR(4 / (step * step), exact, 1e-4 * exact) << name; // the same lumped masses
      EXPECT_GT(steps.largest, steps.largest_lumped) << name;
    }
}

TEST(Stability, the_barrier_bounds_the_inverse_where_the_printed_lemma_does_not)
{
  // Yang & Yin print .247 for δ = .8
  for (const double horizon : {.2, .8, 1.6})
  {
    const auto scene = make_scene(false);
    const problem::Level level{.1, horizon};
    const auto matrix = operator_of("IPA-AC", scene, level);
    const Stability found = measure(matrix);
    const double barrier =
        analysis::check_consistency(matrix, scene::make_problem(scene, 0, level)).barrier;
    EXPECT_TRUE(found.is_norm_exact);
    EXPECT_LT(found.inverse_norm, barrier) << horizon;
    EXPECT_GT(found.inverse_norm, horizon == .8 ? .247 : 0);
    EXPECT_NEAR(barrier, std::pow(.5 - .05 + matrix.reach, 2) / matrix.second_moment, 1e-13);
  }
}

// long horizons couple all nodes: all eigenvalues but few are alike, which takes dense solvers care
TEST(Stability, coercivity_is_found_however_far_bonds_reach)
{
  for (const double horizon : {.2, .4, .8, 1.2, 1.6, 2.4})
    for (const char *name : {"FA", "IPA-AC"})
    {
      const auto matrix = operator_of(name, make_scene(false), {.1, horizon});
      const auto n = static_cast<Eigen::Index>(matrix.size());
      Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n, n);
      for (Eigen::Index i = 0; i < n; ++i)
        for (std::size_t k = matrix.rows.start[i]; k < matrix.rows.start[i + 1]; ++k)
          dense(i, matrix.rows.column[k]) += matrix.rows.value[k];
      const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> factors(dense);
      Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(n, 1, 2);
      for (int iteration = 0; iteration < 200; ++iteration) // inverse iteration
        x = factors.solve(x).normalized();
      const double smallest = x.dot(dense * x) / matrix.mass.front();
      EXPECT_NEAR(measure(matrix).smallest / smallest, 1, 1e-9) << name << ' ' << horizon;
    }
}

// It is a parabola across a strip that holds the nodes: the length of the strip does not count.
TEST(Stability, the_barrier_of_a_rectangle_is_that_of_its_narrow_side)
{
  for (const std::string mesh : {"lattice", "squares"})
  {
    const auto barrier = [&](const std::string &box)
    {
      const auto scene = make_scene(false, "subsection Domain\n set mesh = " + mesh +
                                               "\n set boxes = " + box + "\nend\n");
      const problem::Level level{.125, .25};
      const auto matrix = operator_of("IPA-AC", scene, level);
      const double found =
          analysis::check_consistency(matrix, scene::make_problem(scene, 0, level)).barrier;
      EXPECT_LT(measure(matrix).inverse_norm, found) << mesh << ' ' << box;
      return found;
    };
    const double square = barrier("0, 0 : 1, 1");
    EXPECT_GT(square, 0) << mesh;
    for (const std::string box : {"0, 0 : 2, 1", "0, 0 : 1, 2"})
      EXPECT_NEAR(barrier(box) / square, 1, 1e-12) << mesh << ' ' << box;
  }
}

TEST(Stability, finds_the_degree_that_rules_reproduce)
{
  const auto degree = [](const std::string &name, bool is_tensor, const std::string &more)
  {
    const auto scene = make_scene(is_tensor, more);
    const problem::Level level{.0625, .1875};
    return analysis::check_consistency(operator_of(name, scene, level),
                                       scene::make_problem(scene, 0, level))
        .degree;
  };
  const std::string moved = "subsection Domain\n set mesh = squares\nend\n"
                            "subsection Methods\n set perturbation = 0.3\nend\n";
  EXPECT_EQ(degree("IPA-AC", false, ""), 1u); // symmetry gives it degree 1, moments no more
  EXPECT_EQ(degree("IPA-AC-R2", false, ""), 3u);
  EXPECT_EQ(degree("IPA-AC-R4", false, ""), 4u);
  EXPECT_EQ(degree("IPA-AC-R2", true, ""), 3u);
  EXPECT_EQ(degree("FA", false, moved), 0u);
  EXPECT_EQ(degree("IPA-AC-R2", false, moved), 2u);
  EXPECT_EQ(degree("IPA-AC-R4", true, moved), 4u);
}

TEST(Stability, tells_a_tensor_rule_at_the_centroid_from_one_at_the_node)
{
  const auto kernel = physics::Kernel<2>::with_bulk_modulus({{1, -1}}, .33, 1); // m = 3.3
  const auto centroid = measure_rule(tensor_rule(kernel, meshfree::centroid_bond), kernel, .1),
             node = measure_rule(tensor_rule(kernel, meshfree::partial_area_bond), kernel, .1);
  EXPECT_LT(centroid.diagnostics.smallest_weight_ratio, -.5);
  EXPECT_GT(node.diagnostics.smallest_weight_ratio, .9);
  // a lattice is forgiving: both are coercive
  EXPECT_TRUE(centroid.is_definite());
  EXPECT_TRUE(node.is_definite());
}

TEST(Stability, tells_rules_that_stay_coercive_on_strongly_moved_nodes_from_those_that_do_not)
{
  const auto scene = make_scene(true, "subsection Domain\n set mesh = squares\nend\n"
                                      "subsection Methods\n set perturbation = 0.45\nend\n");
  const problem::Level level{.05, .125};
  const Stability unsound = measure(operator_of("IPA-AC-R4", scene, level)),
                  sound = measure(operator_of("IPA-AC-R2", scene, level));
  EXPECT_LT(unsound.smallest, -100);
  EXPECT_LT(diagnostics_of("IPA-AC-R4", scene, level).smallest_weight_ratio, -10);
  EXPECT_EQ(unsound.inverse_norm, 0); // not known
  EXPECT_TRUE(sound.is_definite());
  EXPECT_GT(sound.inverse_norm, 0);
}

TEST(Stability, of_a_free_body_has_the_three_rigid_modes_and_of_a_held_one_none)
{
  const geometry::Lattice lattice({{{{0, 0}, {1, 1}}}, {}}, .125);
  const physics::Kernel<2> influence(physics::Structure::scalar, {{1, -1}}, .25, 1);
  const auto bonds = meshfree::lattice_bonds(meshfree::partial_area(influence), influence, .125,
                                             geometry::Backend::fast);
  const auto constant = [](double c) { return [c](const dealii::Point<2> &) { return c; }; };
  for (const double l : {4., 8.}) // the second one with τ < 0
    for (const bool is_constrained : {false, true})
    {
      meshfree::Polygons fixed;
      if (is_constrained)
        fixed.push_back({{0, 0}, {.125, 0}, {.125, 1}, {0, 1}});
      const auto body = meshfree::body_on_vertices(lattice, fixed, {constant(1), constant(l)});
      const Stability found = measure(meshfree::make_discrete_operator(
          std::make_shared<meshfree::VariationalOperator>(body, influence, bonds)));
      EXPECT_EQ(found.n_zero, is_constrained ? 0u : 3u);
      EXPECT_EQ(found.modes.values.size(), is_constrained ? 1u : 3u);
      for (const auto &mode : found.modes.values)
        if (!is_constrained)
        {
          // rigid: (u, v) = (a - c y, b + c x), by its values at three nodes far apart
          const auto at = [&](std::size_t i, unsigned int d) { return mode[2 * i + d]; };
          const auto &nodes = found.modes.nodes;
          const std::size_t last = nodes.size() - 1;
          const auto span = nodes[last] - nodes[0];
          const double c =
              (span[0] * (at(last, 1) - at(0, 1)) - span[1] * (at(last, 0) - at(0, 0))) /
              span.norm_square();
          double defect = 0, size = 0;
          for (std::size_t i = 0; i < nodes.size(); ++i)
          {
            const auto x = nodes[i] - nodes[0];
            defect = std::max({defect, std::abs(at(i, 0) - at(0, 0) + c * x[1]),
                               std::abs(at(i, 1) - at(0, 1) - c * x[0])});
            size = std::max({size, std::abs(at(i, 0)), std::abs(at(i, 1))});
          }
          EXPECT_LT(defect, 1e-6 * size);
        }
      EXPECT_EQ(found.is_definite(), is_constrained);
      EXPECT_LT(found.signs.asymmetry, 1e-14);
    }
}

TEST(Stability, of_bond_tensors_with_bonds_along_the_axes_alone_falls_into_lines)
{
  const auto lines = measure(operator_of("FA", make_scene(true), {.1, .1}));
  EXPECT_EQ(lines.signs.n_parts, 20u); // ten lines each way
  EXPECT_EQ(measure(operator_of("FA", make_scene(true), {.1, .15})).signs.n_parts, 1u);
}

namespace
{
  /// An operator of one component from its matrix and the masses of its nodes.
  DiscreteOperator given_operator(const std::vector<std::vector<double>> &matrix,
                                  const std::vector<double> &mass)
  {
    DiscreteOperator result;
    result.mass = mass;
    result.rows.start.assign(1, 0);
    for (unsigned int i = 0; i < matrix.size(); ++i)
    {
      result.nodes.emplace_back(i, 0);
      for (unsigned int j = 0; j < matrix.size(); ++j)
      {
        result.rows.column.push_back(j);
        result.rows.value.push_back(matrix[i][j]);
      }
      result.rows.start.push_back(result.rows.column.size());
    }
    return result;
  }
} // namespace

// Positive entries, so that no one solution gives the norm: it has to be climbed to.
TEST(Stability, inverse_norm_of_no_m_matrix_is_that_of_its_worst_load)
{
  const std::vector<std::vector<double>> matrix = {
      {1, .1, .05, 0}, {.1, 10, .5, .2}, {.05, .5, 12, 1}, {0, .2, 1, 9}};
  for (const std::vector<double> &mass : {std::vector<double>{1, 1, 1, 1}, {2, .5, 1, 3}})
  {
    Eigen::Matrix4d A;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j)
        A(i, j) = matrix[i][j];
    const Eigen::Matrix4d inverse =
        A.completeOrthogonalDecomposition().pseudoInverse() *
        Eigen::Vector4d(mass[0], mass[1], mass[2], mass[3]).asDiagonal();
    const double exact = inverse.cwiseAbs().rowwise().sum().maxCoeff();
    const Stability found = measure(given_operator(matrix, mass));
    EXPECT_FALSE(found.is_norm_exact);
    EXPECT_NEAR(found.inverse_norm, exact, 1e-8 * exact);
  }
}

TEST(StabilityVerdict, names_the_condition_it_finds)
{
  EXPECT_EQ(judge_stability({level(2, .1, 9), level(3, .1, 9)}).verdict, "stable");
  EXPECT_EQ(judge_stability({level(2, .1, -9), level(3, .1, -9)}).verdict, "unstable");

  const Verdict bound = judge_stability({level(2, .1, -9), level(2, .05, -9), level(3, .1, 9)});
  EXPECT_EQ(bound.verdict, "conditionally stable");
  EXPECT_EQ(bound.condition, "m >= 3");
  EXPECT_NE(bound.explanation.find("-9"), std::string::npos) << bound.explanation;

  const Verdict doubtful = judge_stability({level(3, .1, 9, 4), level(3, .05, 9)});
  EXPECT_EQ(doubtful.verdict, "conditionally stable");
  EXPECT_NE(doubtful.explanation.find("4 negative weights"), std::string::npos);

  // a level that fails between others that do not
  EXPECT_EQ(judge_stability({level(3, .1, 9), level(3, .05, -9)}).verdict, "unstable");
}

TEST(StabilityVerdict, names_lost_rank_and_separate_parts)
{
  Record lost = level(2, .1, 9), parted = level(2, .1, 9);
  lost.set("moment conditions", 6);
  lost.set("moment rank", 5);
  parted.set("parts", 2);
  for (const auto &[bad, words] : {std::pair{lost, "rank 5 of 6"}, {parted, "2 separate parts"}})
  {
    const Verdict verdict = judge_stability({bad, level(3, .1, 9)});
    EXPECT_EQ(verdict.verdict, "conditionally stable") << words;
    EXPECT_EQ(verdict.condition, "m >= 3") << words;
    EXPECT_NE(verdict.explanation.find(words), std::string::npos) << verdict.explanation;
  }
}

TEST(StabilityVerdict, sees_coercivity_fall)
{
  const Verdict falls = judge_stability({level(3, .1, 4), level(3, .05, 2), level(3, .025, 1)});
  EXPECT_EQ(falls.verdict, "unstable");
  EXPECT_NE(falls.explanation.find("h to the power 1"), std::string::npos) << falls.explanation;
  EXPECT_EQ(judge_stability({level(3, .1, 4), level(3, .05, 3.5), level(3, .025, 3.2)}).verdict,
            "stable");
}

TEST(StabilityTrends, are_the_powers_at_the_finest_three_levels_of_each_series)
{
  Records rows;
  for (const double m : {2., 3.})
    for (const double h : {.4, .2, .1, .05})
    {
      rows.push_back(level(m, h, m == 2 ? 7 * std::pow(h, .5) : 7));
      rows.back().set("largest eigenvalue", 3 * std::pow(h, -2));
      if (h < .15) // not known at the coarse levels
        rows.back().set("inverse norm", 1);
    }
  rows[0].set("smallest eigenvalue", 1e9); // too coarse to count
  const auto trends = stability_powers(rows);
  ASSERT_EQ(trends.size(), 2u);
  EXPECT_EQ(trends[0].axis, study::Axis::mesh_size);
  EXPECT_NEAR(trends[0].of.at("smallest eigenvalue"), .5, 1e-12);
  EXPECT_NEAR(trends[1].of.at("smallest eigenvalue"), 0, 1e-12);
  EXPECT_NEAR(trends[1].of.at("largest eigenvalue"), -2, 1e-12);
  EXPECT_EQ(trends[1].of.count("inverse norm"), 0u);

  // at a fixed h it is the horizon that varies
  const auto of_horizon = stability_powers({level(4, .1, 8), level(2, .1, 4), level(1, .1, 2)});
  EXPECT_EQ(of_horizon.size(), 3u); // series are by m here
  Records one = {level(4, .1, 8), level(2, .1, 4), level(1, .1, 2)};
  for (Record &record : one)
    record.key.series = "h = 0.1";
  EXPECT_EQ(stability_powers(one)[0].axis, study::Axis::horizon);
  EXPECT_NEAR(stability_powers(one)[0].of.at("smallest eigenvalue"), 1, 1e-12);
}
