// Spectra, signs, moments and time steps of operators in three dimensions, by dense matrices that
// are made of the operators' action.
#include "study/stability.h"

#include "analysis/statics.h"
#include "method/discretisation_in_space.h"
#include "scene/problem.h"
#include "tests/study/space_scene.h"

#include <Eigen/Dense>

#include <cmath>

namespace
{
  using namespace plumbline;
  using namespace plumbline::study;
  using namespace plumbline::study::in_space;

  const Settings small = {{"Study/regime", "m"}, {"Study/horizon", "1/2"}, {"Study/h", "1/4"}};
  const Settings tensor = {{"Kernel/type", "bond-tensor"},
                           {"Kernel/limit", "Navier"},
                           {"Problem/solution", "x^2, y, z"}};
  const Settings solid = {{"Kernel/type", "1/r"},    {"Kernel/limit", "Navier"},
                          {"Material/model", "LPS"}, {"Material/E", "1"},
                          {"Material/nu", "0.4"},    {"Problem/solution", "x^2, y, z"}};

  /// What is measured of a method at the scene's first level.
  Record record_of(const std::string &method, const Settings &settings)
  {
    const auto scene = make_scene(with(settings, {{"Methods/names", method}}));
    const StudyResults results =
        run_study(stability_analysis(), scene, {find_method(available(), method, "test")});
    EXPECT_TRUE(results.records.at(0).failure.empty()) << results.records.at(0).failure;
    return results.records.at(0);
  }

  /// M⁻¹A of nodes that are all alike and free, column by column by the action of A.
  Eigen::MatrixXd dense_of(const std::string &method, const Settings &settings, double mass)
  {
    const auto scene = make_scene(settings);
    const auto problem = make_problem_in_space(scene, 0, scene.study.series.front().levels.front());
    const auto discretisation =
        find_method(available(), method, "test")->discretise_in_space(problem);
    const auto tangent = discretisation->tangent();
    const auto n = static_cast<unsigned int>(discretisation->n_unknowns());
    Eigen::MatrixXd dense(n, n);
    algebra::Vector x(n), y(n);
    for (unsigned int j = 0; j < n; ++j)
    {
      x = 0;
      x[j] = 1;
      tangent->vmult(y, x);
      for (unsigned int i = 0; i < n; ++i)
        dense(i, j) = y[i] / mass;
    }
    return dense;
  }
} // namespace

TEST(StabilityInSpace, is_that_of_dense_matrices)
{
  const double h = .25;
  for (const Settings &model : {Settings{}, tensor, solid})
    for (const auto &[name, mass] : {std::pair("FA", 1.), {"IPA-AC-R2", 1.}, {"Q1", h * h * h}})
    {
      SCOPED_TRACE(name + std::string(model.empty() ? "" : model[0].value));
      const Settings all = with(small, model);
      const Record found = record_of(name, all);
      const Eigen::MatrixXd dense = dense_of(name, all, mass);
      const Eigen::VectorXd eigenvalues =
          Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(dense, Eigen::EigenvaluesOnly)
              .eigenvalues();
      EXPECT_EQ(found.count("unknowns"), static_cast<std::size_t>(dense.rows()));
      EXPECT_NEAR(found["smallest eigenvalue"], eigenvalues.minCoeff(),
                  1e-8 * eigenvalues.minCoeff());
      EXPECT_NEAR(found["largest eigenvalue"], eigenvalues.maxCoeff(),
                  2e-4 * eigenvalues.maxCoeff());
      const double norm = dense.inverse().cwiseAbs().rowwise().sum().maxCoeff();
      EXPECT_LE(found["inverse norm"], norm * (1 + 1e-8));
      EXPECT_GE(found["inverse norm"],
                norm * (found["inverse norm is exact"] == 1 ? 1 - 1e-8 : .8));
      const analysis::PointField &mode = found.fields.at("mode 1");
      EXPECT_EQ(mode.z.size() * mode.n_components, mode.values.size());
    }
}

// The maximum principle of scalar rules with positive weights, its bound, and the degree of
// polynomials that are mapped exactly.
TEST(StabilityInSpace, knows_signs_and_moments)
{
  const Settings wide = {{"Study/regime", "m"}, {"Study/horizon", "1/4"}, {"Study/h", "1/12"}};
  for (const auto &[name, degree] :
       {std::pair("FA", 1u), {"IPA-AC-R2", 3u}, {"IPA-AC-R4", 4u}, {"PA-AC", 1u}})
  {
    const Record found = record_of(name, wide);
    EXPECT_EQ(found.count("exact degree"), degree) << name;
    EXPECT_TRUE(is_m_matrix(found)) << name;
    EXPECT_LE(found["inverse norm"], found["barrier"]) << name;
    EXPECT_EQ(found["inverse norm is exact"], 1) << name;
    EXPECT_GT(found["critical step"], 0) << name;
    EXPECT_NEAR(found["critical step"], 2 / std::sqrt(found["largest eigenvalue"]), 1e-3) << name;
  }
}

// Far from the origin too, where loads could not be manufactured.
TEST(StabilityInSpace, does_not_depend_on_the_origin)
{
  const Settings near = {{"Study/regime", "m"}, {"Study/horizon", "1/4"}, {"Study/h", "1/8"}},
                 far = with(near, {{"Domain/boxes", "10000,0,0 : 10001,1,1"}});
  const Record a = record_of("IPA-AC-R2", near), b = record_of("IPA-AC-R2", far);
  EXPECT_EQ(a.count("exact degree"), 3u);
  EXPECT_EQ(b.count("exact degree"), 3u);
  EXPECT_NEAR(a["smallest eigenvalue"], b["smallest eigenvalue"], 1e-7);
}

// Scattered nodes at the centres of the cells have the lattice's operator, by sparse rows.
TEST(StabilityInSpace, of_scattered_nodes_at_centres_is_the_lattices)
{
  for (const Settings &model : {Settings{}, tensor})
  {
    const Settings on_lattice = with(small, model);
    const Record a = record_of("IPA-AC-R2", on_lattice),
                 b = record_of("IPA-AC-R2", with(on_lattice, {{"Methods/perturbation", "1e-9"}}));
    for (const char *const name :
         {"smallest eigenvalue", "largest eigenvalue", "inverse norm", "critical step"})
      EXPECT_NEAR(a[name], b[name], 2e-4 * a[name]) << name;
    EXPECT_NEAR(a["smallest eigenvalue"], b["smallest eigenvalue"], 1e-6);
  }
}

// Lumped masses of Q1 are up to 27 times those of the mass matrix, for waves two cells long, whose
// eigenvalue is that of the bounded operator: at a fixed horizon these are the smallest.
TEST(StabilityInSpace, of_q1_falls_by_lumped_masses_alone)
{
  const Settings fine = {{"Study/regime", "m"}, {"Study/horizon", "1/4"}, {"Study/h", "1/12"}};
  const Record q1 = record_of("Q1", fine), dgq0 = record_of("DGQ0", fine);
  const double bounded = dgq0["largest eigenvalue"];
  EXPECT_LT(q1["smallest eigenvalue"], .5 * dgq0["smallest eigenvalue"]);
  EXPECT_GT(q1["smallest eigenvalue"], bounded / 27);
  EXPECT_NEAR(q1["largest eigenvalue in motion"], bounded, .05 * bounded);
  EXPECT_GT(q1["critical step, lumped"], q1["critical step"]);
}
