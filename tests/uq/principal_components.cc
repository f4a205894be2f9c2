// Principal components against the singular values of all realisations, covariances and samples.
#include "uq/principal_components.h"
#include "base/error.h"
#include "base/symmetric_eigen.h"
#include "refusal.h"
#include "uq/boolean_covariance.h"
#include "uq/generator.h"
#include "uq/karhunen_loeve.h"

#include <deal.II/base/multithread_info.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace plumbline;
using namespace plumbline::uq;

namespace
{
  using Eigen::MatrixXd;

  const Grid grid{{{0, 0}, {3, 1}}, {24, 10}};

  /// Fields with a mean that is large beside the deviation, and a covariance of slow decay.
  const Expansion &rough_field()
  {
    static const Expansion expansion = []
    {
      Covariance covariance;
      covariance.length = {.5, .5};
      return karhunen_loeve(covariance, grid, 240, 100.);
    }();
    return expansion;
  }

  void realise(const Expansion &expansion, std::size_t k, std::vector<double> &values)
  {
    Generator numbers(6, k);
    std::vector<double> xi(expansion.n_modes());
    for (double &x : xi)
      x = numbers.normal();
    values = expansion.realise(xi).values();
  }

  const Realisation rough = [](std::size_t k, std::vector<double> &values)
  { realise(rough_field(), k, values); };

  /// Deviations from the mean of all realisations, one a column, such that the squares of the
  /// singular values are the eigenvalues.
  MatrixXd deviations(const Realisation &realisation, std::size_t n)
  {
    MatrixXd all(grid.size(), n);
    std::vector<double> values(grid.size());
    for (std::size_t k = 0; k < n; ++k)
    {
      realisation(k, values);
      all.col(k) = Eigen::Map<const Eigen::VectorXd>(values.data(), all.rows());
    }
    const Eigen::VectorXd mean = all.rowwise().mean();
    return (all.colwise() - mean) * std::sqrt(grid.cell_area() / double(n - 1));
  }

  void expect_singular_values(std::size_t n_realisations, unsigned int n_modes)
  {
    const MatrixXd all = deviations(rough, n_realisations);
    // squares of singular values; of the first modes they have all digits that are tested
    const base::SymmetricEigen squares = base::symmetric_eigen(all * all.transpose());
    const auto pca =
        principal_components(grid, n_realisations, rough, n_modes, PassLimit{1000, 1e-11});
    EXPECT_TRUE(pca.is_settled);
    const Eigen::Index last = all.rows() - 1;
    const double largest = squares.values[last];
    for (unsigned int k = 0; k < n_modes; ++k)
    {
      EXPECT_NEAR(pca.expansion.eigenvalue[k], squares.values[last - k], 1e-11 * largest) << k;
      const Eigen::Map<const Eigen::VectorXd> mode(pca.expansion.mode[k].data(), all.rows());
      EXPECT_NEAR(std::abs(mode.dot(squares.vectors.col(last - k))) * std::sqrt(grid.cell_area()),
                  1, 1e-8)
          << k;
    }
    EXPECT_NEAR(pca.expansion.total_variance(), all.squaredNorm(), 1e-10 * all.squaredNorm());
    for (std::size_t i = 0; i < grid.size(); ++i)
      EXPECT_NEAR(pca.expansion.variance[i] * grid.cell_area(), all.row(i).squaredNorm(),
                  1e-10 * largest);
  }
} // namespace

TEST(PrincipalComponents, are_the_singular_values_of_all_realisations)
{
  expect_singular_values(150, 12); // in more than one chunk
  expect_singular_values(20, 5);   // few of them
  expect_singular_values(700, 3);  // more than nodes
}

TEST(PrincipalComponents, of_all_ranks_give_each_realisation_back)
{
  const auto pca = principal_components(grid, 9, rough, 8, PassLimit{100, 1e-12});
  EXPECT_NEAR(pca.expansion.variance_kept(), 1, 1e-12);
  std::vector<double> values;
  rough(4, values);
  const std::vector<double> again =
      pca.expansion.realise(pca.expansion.coordinates(values)).values();
  for (std::size_t i = 0; i < values.size(); ++i)
    EXPECT_NEAR(again[i], values[i], 1e-10);
}

TEST(PrincipalComponents, of_few_passes_know_how_far_off_they_are)
{
  // grains much smaller than the box: all eigenvalues are much the same, the worst that can be
  const Box box{{0, 0}, {240, 120}};
  const Grid fine = make_grid(box, 4);
  const Realisation grains = [&](std::size_t k, std::vector<double> &values) {
    values = Ellipses::draw({{12, 7.5}, .2, true}, box, 9, k).at_nodes(fine);
  };
  const auto exact = principal_components(fine, 400, grains, 10, PassLimit{1000, 1e-10});
  double last = 0;
  for (const unsigned int n_passes : {1u, 3u, 6u})
  {
    const auto pca = principal_components(fine, 400, grains, 10, PassLimit{n_passes, 1e-10});
    EXPECT_EQ(pca.n_passes, n_passes);
    EXPECT_FALSE(pca.is_settled);
    for (unsigned int k = 0; k < 10; ++k) // from below
      EXPECT_GE(exact.expansion.eigenvalue[k], pca.expansion.eigenvalue[k] * (1 - 1e-12)) << k;
    ASSERT_EQ(pca.kept.size(), n_passes);
    EXPECT_NEAR(pca.kept.back(), pca.expansion.variance_kept(), 1e-14);
    EXPECT_GT(pca.expansion.variance_kept(), last);
    last = pca.expansion.variance_kept();
    // what is missing is less than the last pass brought
    if (n_passes > 1)
    {
      EXPECT_LT(exact.kept.back() - last, last - pca.kept[n_passes - 2]);
    }
  }
  // what the modes hold together is right after the passes that are taken by default
  EXPECT_NEAR(last / exact.expansion.variance_kept(), 1, .003);
}

TEST(PrincipalComponents, of_many_samples_are_the_modes_they_were_drawn_from)
{
  Covariance covariance;
  covariance.shape = CovarianceShape::gaussian;
  covariance.length = {1, .4};
  const Expansion field = karhunen_loeve(covariance, grid, 12);
  constexpr std::size_t n = 4000;
  const auto pca = principal_components(
      grid, n, [&](std::size_t k, std::vector<double> &values) { realise(field, k, values); }, 4);
  for (unsigned int k = 0; k < 4; ++k)
  {
    // the variance of n normal numbers has a standard error of √(2/n) of itself
    EXPECT_LT(std::abs(pca.expansion.eigenvalue[k] / field.eigenvalue[k] - 1),
              4 * std::sqrt(2. / n))
        << k;
    double product = 0;
    for (std::size_t i = 0; i < grid.size(); ++i)
      product += pca.expansion.mode[k][i] * field.mode[k][i];
    EXPECT_GT(product * grid.cell_area(), .99) << k; // its sign is the same
  }
  for (const double mean : pca.expansion.mean)
    EXPECT_LT(std::abs(mean), 5 / std::sqrt(double(n)));
}

TEST(PrincipalComponents,
     of_a_microstructure_hold_no_more_of_new_samples_than_its_covariance_allows)
{
  // the share of the variance that 20 modes hold: in the sample they were made of more than the
  // best 20 of the field, in samples that they have not seen less
  const Box box{{0, 0}, {400, 200}};
  const Grid fine = make_grid(box, 5);
  const EllipseModel model{{12, 7.5}, .4, true};
  const Realisation grains = [&](std::size_t k, std::vector<double> &values)
  { values = Ellipses::draw(model, box, 10, k).at_nodes(fine); };
  const double best = karhunen_loeve(boolean_covariance(model), fine, 20).variance_kept();
  const Expansion e = principal_components(fine, 1000, grains, 20).expansion;
  EXPECT_GT(e.variance_kept(), 1.2 * best);
  double constrained = 0, total = 0;
  std::vector<double> values;
  for (std::size_t k = 1000; k < 1300; ++k)
  {
    grains(k, values);
    for (const double value : values)
      total += (value - .4) * (value - .4) * fine.cell_area();
    const std::vector<double> xi = e.coordinates(values);
    for (unsigned int l = 0; l < 20; ++l)
      constrained += xi[l] * xi[l] * e.eigenvalue[l];
  }
  // 300 samples of 20 numbers: a standard error of √(2/6000) of the share
  EXPECT_LT(constrained / total, best * (1 + 4 * std::sqrt(2 / 6000.)));
  EXPECT_GT(constrained / total, .5 * best);
}

TEST(PrincipalComponents, have_the_same_bits_on_one_thread_and_on_two)
{
  std::vector<std::vector<double>> modes;
  for (const unsigned int n_threads : {1u, 2u})
  {
    dealii::MultithreadInfo::set_thread_limit(n_threads);
    const auto pca = principal_components(grid, 150, rough, 5);
    modes.push_back(pca.expansion.eigenvalue);
    modes.back().insert(modes.back().end(), pca.expansion.mode[4].begin(),
                        pca.expansion.mode[4].end());
  }
  dealii::MultithreadInfo::set_thread_limit();
  EXPECT_EQ(modes[0], modes[1]);
}

TEST(PrincipalComponents, refuse_what_cannot_be_with_numbers_and_remedy)
{
  EXPECT_EQ(refusal([&] { principal_components(grid, 20, rough, 20); }),
            "20 realisations at 240 nodes have 1 to 19 principal components, not 20; ask for "
            "fewer, or give more realisations");
  EXPECT_THROW(principal_components(grid, 1000, rough, 241), InputError);
  EXPECT_THROW(principal_components(grid, 20, rough, 0), InputError);
  EXPECT_THROW(principal_components(grid, 1, rough, 1), InputError);
  const Realisation broken = [](std::size_t k, std::vector<double> &values)
  {
    rough(k, values);
    if (k == 70)
      values[3] = std::numeric_limits<double>::infinity();
  };
  EXPECT_EQ(refusal([&] { principal_components(grid, 100, broken, 3); }),
            "realisation 70 of a random field is not a finite number at each of its 240 nodes");
}
