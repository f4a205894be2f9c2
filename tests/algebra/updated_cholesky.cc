// A stale Cholesky factor with Woodbury's formula against dense solutions.

#include "algebra/updated_cholesky.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace
{
  using namespace plumbline::algebra;
  using Dense = Eigen::MatrixXd;
  using Vector = Eigen::VectorXd;

  CsrMatrix to_rows(const Dense &dense)
  {
    CsrMatrix rows;
    rows.start = {0};
    for (Eigen::Index i = 0; i < dense.rows(); ++i)
    {
      for (Eigen::Index j = 0; j < dense.cols(); ++j)
        if (dense(i, j) != 0)
        {
          rows.column.push_back(static_cast<unsigned int>(j));
          rows.value.push_back(dense(i, j));
        }
      rows.start.push_back(rows.column.size());
    }
    return rows;
  }

  std::vector<double> to_vector(const Vector &x)
  {
    return {x.data(), x.data() + x.size()};
  }

  Dense random(Eigen::Index n_rows, Eigen::Index n_columns, unsigned int seed)
  {
    std::mt19937 source(seed);
    std::uniform_real_distribution<double> value(-1, 1);
    return Dense::NullaryExpr(n_rows, n_columns, [&] { return value(source); });
  }

  double distance(const std::vector<double> &x, const Vector &y)
  {
    return (Eigen::Map<const Vector>(x.data(), y.size()) - y).norm() / y.norm();
  }
} // namespace

TEST(CsrMatrix, normal_matrix_is_the_product)
{
  const Eigen::Index n = 7;
  Dense C = random(12, n, 4);
  C = (C.array() > 0).select(C, 0); // sparse
  C.col(3).setZero();               // a column that no row has
  const Vector s = random(12, 1, 5);
  const CsrMatrix rows = normal_matrix(to_rows(C), to_vector(s), n);
  const Dense expected = C.transpose() * s.asDiagonal() * C;
  ASSERT_EQ(rows.n_rows(), 7u);
  Dense found = Dense::Zero(n, n);
  for (std::size_t i = 0; i < 7; ++i)
    for (std::size_t k = rows.start[i]; k < rows.start[i + 1]; ++k)
    {
      EXPECT_TRUE(k == rows.start[i] || rows.column[k] > rows.column[k - 1]);
      found(static_cast<Eigen::Index>(i), rows.column[k]) = rows.value[k];
    }
  EXPECT_LT((found - expected).norm(), 1e-14);
}

TEST(UpdatedCholesky, solutions_are_those_of_the_changed_matrix)
{
  const Eigen::Index n = 40;
  const Dense C = random(90, n, 1);
  const Vector s = random(90, 1, 2).cwiseAbs().array() + .1, b = random(n, 1, 3);
  auto cholesky = UpdatedCholesky::factor(to_rows(C), to_vector(s), n);
  ASSERT_TRUE(cholesky);
  Dense A = C.transpose() * s.asDiagonal() * C;
  const std::vector<double> x0 = cholesky->solve(to_vector(b));
  EXPECT_LT(distance(x0, A.ldlt().solve(b)), 1e-12);
  EXPECT_EQ(*cholesky->updated(x0, {}), x0);
  const Dense U = random(7, n, 4);
  Dense S = .1 * random(7, 7, 5);
  S = Dense(S + S.transpose());
  const Vector o = random(7, 1, 6);
  Eigen::Index rank = 0;
  for (const Eigen::Index part : {3, 4, 0}) // added one after the other, then another S alone
  {
    if (part == 0)
      S *= -.5;
    const Dense rows = U.middleRows(rank, part);
    rank += part;
    const Dense s_now = S.topLeftCorner(rank, rank), u_now = U.topRows(rank);
    const Vector o_now = o.head(rank);
    cholesky->update(to_rows(rows),
                     to_vector(Eigen::Map<const Vector>(s_now.data(), s_now.size())));
    EXPECT_EQ(cholesky->rank(), static_cast<std::size_t>(rank));
    const auto x = cholesky->updated(x0, to_vector(o_now));
    ASSERT_TRUE(x);
    const Vector expected = (A + u_now.transpose() * s_now * u_now)
                                .ldlt()
                                .solve(b - u_now.transpose() * (s_now * o_now));
    EXPECT_LT(distance(*x, expected), 1e-12);
  }
}

TEST(UpdatedCholesky, finds_what_has_become_singular)
{
  // a chain of springs, held at one end
  const Eigen::Index n = 12;
  Dense C = Dense::Identity(n, n);
  for (Eigen::Index i = 1; i < n; ++i)
    C(i, i - 1) = -1;
  const std::vector<double> s(n, 2.);
  auto cholesky = UpdatedCholesky::factor(to_rows(C), s, n);
  ASSERT_TRUE(cholesky);
  const std::vector<double> x0 = cholesky->solve(std::vector<double>(n, 1.));
  cholesky->update(to_rows(C.row(5)), {-1.});
  EXPECT_TRUE(cholesky->updated(x0, {0.}));
  cholesky->update(to_rows(Dense(0, n)), {-2.}); // one of them is taken out
  EXPECT_FALSE(cholesky->updated(x0, {0.}));
  Dense cut = C;
  cut.row(5).setZero();
  EXPECT_FALSE(UpdatedCholesky::factor(to_rows(cut), s, n));
}

TEST(UpdatedCholesky, a_zero_mode_strains_nothing)
{
  const Eigen::Index n = 12;
  Dense C = Dense::Identity(n, n);
  for (Eigen::Index i = 1; i < n; ++i)
    C(i, i - 1) = -1;
  const std::vector<double> s(n, 2.);
  EXPECT_FALSE(zero_mode(to_rows(C), s, n));
  C.row(5).setZero();
  const auto mode = zero_mode(to_rows(C), s, n);
  ASSERT_TRUE(mode);
  for (Eigen::Index i = 0; i < n; ++i)
    EXPECT_NEAR(std::abs((*mode)[static_cast<std::size_t>(i)]), i < 5 ? 0 : 1 / std::sqrt(7.),
                1e-8);
}
