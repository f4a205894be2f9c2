#include "algebra/spectrum.h"

#include "algebra/asymmetry.h"
#include "algebra/sparse.h"
#include "base/error.h"
#include "base/symmetric_eigen.h"

#include <deal.II/lac/vector.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

using namespace plumbline;
using namespace plumbline::algebra;

namespace
{
  /// -Δ by five points, h = 1.
  Stencil five_points()
  {
    Stencil stencil(1, 1);
    stencil(0, 0, 0, 0) = 4;
    for (const int k : {-1, 1})
      stencil(0, 0, k, 0) = stencil(0, 0, 0, k) = -1;
    return stencil;
  }

  geometry::NodeSet rectangle(int nx, int ny)
  {
    geometry::NodeSet nodes{{{.5, false, 0}}, 1, {nx, ny}, {}};
    nodes.is_free.assign(nodes.n_positions(), 1);
    return nodes;
  }

  Action action_of(const CsrMatrix &rows)
  {
    return [&rows](const std::vector<double> &x, std::vector<double> &y)
    {
      for (std::size_t i = 0; i < rows.n_rows(); ++i)
      {
        y[i] = 0;
        for (std::size_t k = rows.start[i]; k < rows.start[i + 1]; ++k)
          y[i] += rows.value[k] * x[rows.column[k]];
      }
    };
  }

  CsrMatrix to_rows(const std::vector<std::vector<double>> &dense)
  {
    CsrMatrix rows;
    rows.start.assign(1, 0);
    for (const auto &row : dense)
    {
      for (unsigned int j = 0; j < row.size(); ++j)
        if (row[j] != 0)
        {
          rows.column.push_back(j);
          rows.value.push_back(row[j]);
        }
      rows.start.push_back(rows.column.size());
    }
    return rows;
  }
} // namespace

TEST(Spectrum, of_the_five_point_stencil_is_that_of_sines)
{
  const CsrMatrix rows = assemble(five_points(), rectangle(20, 13));
  const Spectrum found = spectrum(action_of(rows), rows.n_rows(), 1e-9);
  const auto term = [](int p, int n) { return 2 - 2 * std::cos(M_PI * p / (n + 1)); };
  EXPECT_NEAR(found.smallest, term(1, 20) + term(1, 13), 1e-12);
  EXPECT_NEAR(found.largest, term(20, 20) + term(13, 13), 1e-12);
  EXPECT_TRUE(found.zero_modes.empty());
  // its mode has one sign
  for (const double value : found.lowest_mode)
    EXPECT_GT(value * found.lowest_mode[0], 0);
}

TEST(Spectrum, counts_zero_modes_of_a_graph_in_three_parts)
{
  // the Laplacian of three chains of 5, 6 and 7 nodes: one constant each
  std::vector<std::vector<double>> dense(18, std::vector<double>(18));
  for (int i = 0; i + 1 < 18; ++i)
    if (i != 4 && i != 10)
    {
      dense[i][i] += 1;
      dense[i + 1][i + 1] += 1;
      dense[i][i + 1] = dense[i + 1][i] = -1;
    }
  const CsrMatrix rows = to_rows(dense);
  const Spectrum found = spectrum(action_of(rows), rows.n_rows());
  ASSERT_EQ(found.zero_modes.size(), 3u);
  for (const auto &mode : found.zero_modes) // constant in each chain
    for (const auto &[first, last] : {std::pair{0, 4}, {5, 10}, {11, 17}})
      EXPECT_NEAR(mode[first], mode[last], 1e-9);
  EXPECT_NEAR(found.smallest_nonzero, 2 - 2 * std::cos(M_PI / 7), 1e-12);
  const SignCheck signs = check_signs(rows);
  EXPECT_EQ(signs.n_parts, 3u);
  EXPECT_EQ(signs.n_loose, 18u); // nothing is constrained
  EXPECT_FALSE(signs.is_m_matrix());
}

TEST(Spectrum, deflates_zero_modes_of_many_unknowns)
{
  // three chains of 60, 70 and 80 nodes
  CsrMatrix rows;
  rows.start = {0};
  for (const unsigned int n : {60u, 70u, 80u})
  {
    const auto first = static_cast<unsigned int>(rows.n_rows());
    for (unsigned int i = 0; i < n; ++i)
    {
      double diagonal = 0;
      for (const int step : {-1, 1})
        if (const int j = static_cast<int>(i) + step; j >= 0 && j < static_cast<int>(n))
        {
          rows.column.push_back(first + static_cast<unsigned int>(j));
          rows.value.push_back(-1);
          ++diagonal;
        }
      rows.column.push_back(first + i);
      rows.value.push_back(diagonal);
      rows.start.push_back(rows.column.size());
    }
  }
  const Spectrum found = spectrum(action_of(rows), rows.n_rows());
  ASSERT_EQ(found.zero_modes.size(), 3u);
  for (const auto &mode : found.zero_modes)
    for (const auto &[first, last] : {std::pair{0, 59}, {60, 129}, {130, 209}})
      EXPECT_NEAR(mode[first], mode[last], 1e-7);
  EXPECT_NEAR(found.smallest_nonzero, 2 - 2 * std::cos(M_PI / 80), 1e-12);
  EXPECT_NEAR(found.largest, 4, 4e-3);
}

TEST(Spectrum, refuses_an_operator_that_is_not_symmetric)
{
  for (const std::size_t n : {5u, 150u})
    EXPECT_THROW(spectrum(
                     [n](const std::vector<double> &x, std::vector<double> &y)
                     {
                       for (std::size_t i = 0; i < n; ++i)
                         y[i] = 3 * x[i] - 2 * x[(i + 1) % n];
                     },
                     n),
                 NumericalError)
        << n;
}

TEST(Spectrum, of_an_indefinite_matrix_is_found_as_well)
{
  const CsrMatrix rows = to_rows({{-1, 2, 0}, {2, 0, 0}, {0, 0, 5}});
  const Spectrum found = spectrum(action_of(rows), 3);
  EXPECT_NEAR(found.smallest, -.5 - std::sqrt(4.25), 1e-13);
  EXPECT_NEAR(found.largest, 5, 1e-13);
  EXPECT_TRUE(found.zero_modes.empty());
}

TEST(Spectrum, says_that_an_operator_with_values_that_are_no_numbers_has_none)
{
  const Action nan = [](const std::vector<double> &, std::vector<double> &y)
  { y.assign(y.size(), std::nan("")); };
  EXPECT_THROW(spectrum(nan, 30), NumericalError);
}

TEST(SignCheck, knows_m_matrices)
{
  EXPECT_TRUE(check_signs(assemble(five_points(), rectangle(4, 5))).is_m_matrix());
  // a row that is only weakly dominant, tied through another one to a strict one
  EXPECT_TRUE(check_signs(to_rows({{1, -1, 0}, {0, 1, -1}, {0, 0, 1}})).is_m_matrix());
  // one that is not tied
  EXPECT_EQ(check_signs(to_rows({{1, -1, 0}, {-1, 1, 0}, {0, 0, 1}})).n_loose, 2u);
  EXPECT_EQ(check_signs(to_rows({{2, 1}, {-1, 2}})).n_positive, 1u);
  EXPECT_EQ(check_signs(to_rows({{1, -2}, {-2, 1}})).n_weak, 2u);
  EXPECT_DOUBLE_EQ(check_signs(to_rows({{2, 1}, {-1, 2}})).asymmetry, 1);
}

TEST(SignCheck, finds_the_asymmetry_of_entries_without_partners)
{
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int sample = 0; sample < 50; ++sample)
  {
    constexpr unsigned int n = 6;
    std::vector<std::vector<double>> matrix(n, std::vector<double>(n));
    for (auto &row : matrix)
      for (double &value : row)
        value = uniform(random) < .4 ? uniform(random) : 0;
    double size = 0, difference = 0;
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
      {
        size = std::max(size, std::abs(matrix[i][j]));
        difference = std::max(difference, std::abs(matrix[i][j] - matrix[j][i]));
      }
    EXPECT_EQ(asymmetry(to_rows(matrix)), size > 0 ? difference / size : 0);
  }
}

TEST(SignCheck, takes_rounding_for_zero)
{
  const SignCheck check = check_signs(to_rows({{2, -1, 1e-15}, {-1, 2, -1}, {-1e-15, -1, 2}}));
  EXPECT_EQ(check.n_positive, 0u);
  EXPECT_TRUE(check.is_m_matrix());
  EXPECT_EQ(check_signs(to_rows({{2, -1, 1e-9}, {-1, 2, -1}, {0, -1, 2}})).n_positive, 1u);
}

TEST(SignCheck, entries_that_are_zero_join_no_parts)
{
  CsrMatrix rows; // 2, -1; -1, 2 twice, and zeros between, which a sparse matrix may store
  rows.start = {0};
  for (unsigned int i = 0; i < 4; ++i)
  {
    for (unsigned int j = 0; j < 4; ++j)
    {
      rows.column.push_back(j);
      rows.value.push_back(i == j ? 2 : i / 2 == j / 2 ? -1 : 0);
    }
    rows.start.push_back(rows.column.size());
  }
  EXPECT_EQ(check_signs(rows).n_parts, 2u);
  rows.value[2] = rows.value[8] = -.5; // of (0, 2) and (2, 0)
  EXPECT_EQ(check_signs(rows).n_parts, 1u);
}

TEST(Assembly, has_the_eigenvalues_of_the_operator_on_every_road)
{
  Stencil stencil(2, 2); // two coupled components
  for (int k2 = -2; k2 <= 2; ++k2)
    for (int k1 = -2; k1 <= 2; ++k1)
      if (k1 != 0 || k2 != 0)
        for (unsigned int a = 0; a < 2; ++a)
          for (unsigned int b = 0; b < 2; ++b)
          {
            const double entry =
                (a == 0 ? k1 : k2) * (b == 0 ? k1 : k2) / std::pow(std::hypot(k1, k2), 3);
            stencil(a, b, k1, k2) -= entry;
            stencil(a, b, 0, 0) += entry;
          }
  geometry::NodeSet nodes = rectangle(9, 7);
  nodes.n_components = 2;
  nodes.is_free[0] = nodes.is_free[30] = 0; // a corner and a hole
  const CsrMatrix rows = assemble(stencil, nodes);
  const auto n = static_cast<Eigen::Index>(rows.n_rows());
  ASSERT_EQ(rows.n_rows(), nodes.n_unknowns());
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (std::size_t k = rows.start[i]; k < rows.start[i + 1]; ++k)
      dense(i, rows.column[k]) = rows.value[k];
  const Eigen::VectorXd exact = base::symmetric_eigen(dense).values;

  const auto positions = free_positions(nodes);
  for (const OperatorBackend backend :
       {OperatorBackend::fft, OperatorBackend::direct, OperatorBackend::sparse})
  {
    const auto matrix = make_operator(stencil, nodes, backend);
    const Action action = [&](const std::vector<double> &x, std::vector<double> &y)
    {
      Vector in(nodes.size()), out(nodes.size());
      for (std::size_t i = 0; i < positions.size(); ++i)
        in[positions[i]] = x[i];
      matrix->vmult(out, in);
      for (std::size_t i = 0; i < positions.size(); ++i)
        y[i] = out[positions[i]];
    };
    const Spectrum found = spectrum(action, rows.n_rows(), 1e-9);
    EXPECT_NEAR(found.smallest, exact[0], 1e-11) << matrix->backend();
    EXPECT_NEAR(found.largest, exact[n - 1], 1e-11) << matrix->backend();
  }
  EXPECT_NEAR(check_matrix(rows).smallest_eigenvalue, exact[0], 1e-8);
}
