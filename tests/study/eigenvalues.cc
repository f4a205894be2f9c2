// Eigenvalues of operators against closed forms and dense solvers, by every backend.
#include "meshfree/rules/bonds.h"
#include "method/discretisation.h"
#include "reference/lattice/stencil.h"
#include "scene/problem.h"
#include "tests/study/operators.h"

#include <Eigen/Eigenvalues>

#include <cmath>
#include <complex>

using namespace plumbline;
using namespace plumbline::study;

namespace
{
  /// All eigenvalues of M⁻¹A.
  std::vector<std::complex<double>> dense_eigenvalues(const DiscreteOperator &matrix)
  {
    const auto n = static_cast<Eigen::Index>(matrix.size());
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n, n);
    for (Eigen::Index i = 0; i < n; ++i)
      for (std::size_t k = matrix.rows.start[i]; k < matrix.rows.start[i + 1]; ++k)
        dense(i, matrix.rows.column[k]) =
            matrix.rows.value[k] / matrix.mass[i / matrix.n_components];
    const Eigen::VectorXcd values = Eigen::EigenSolver<Eigen::MatrixXd>(dense, false).eigenvalues();
    return {values.begin(), values.end()};
  }

  void expect_as_dense(const DiscreteOperator &matrix)
  {
    const algebra::Eigenvalues found = measure(matrix).eigenvalues;
    double least_real = 1e300, least = 1e300, largest = 0;
    for (const auto &value : dense_eigenvalues(matrix))
    {
      least_real = std::min(least_real, value.real());
      least = std::min(least, std::abs(value));
      largest = std::max(largest, std::abs(value));
    }
    EXPECT_NEAR(found.smallest_real, least_real, 1e-8 * std::abs(least_real));
    EXPECT_NEAR(found.smallest_modulus, least, 1e-8 * least);
    EXPECT_NEAR(found.largest_modulus, largest, 1e-8 * largest);
  }

  /// Extreme eigenvalues of M^(-1/2) A M^(-1/2) with one mass, by A's action and by its rows.
  void expect_ends(const DiscreteOperator &matrix, double smallest, double largest,
                   const std::string &what)
  {
    const algebra::Action by_rows =
        [&rows = matrix.rows](const std::vector<double> &x, std::vector<double> &y)
    {
      for (std::size_t i = 0; i < rows.n_rows(); ++i)
      {
        y[i] = 0;
        for (std::size_t k = rows.start[i]; k < rows.start[i + 1]; ++k)
          y[i] += rows.value[k] * x[rows.column[k]];
      }
    };
    for (const algebra::Action &action : {matrix.action, by_rows})
      if (action)
      {
        const auto found = algebra::spectrum(action, matrix.size(), 1e-9);
        EXPECT_NEAR(found.smallest / matrix.mass[0], smallest, 1e-8 * smallest) << what;
        EXPECT_NEAR(found.largest / matrix.mass[0], largest, 1e-8 * largest) << what;
      }
  }
} // namespace

TEST(OperatorEigenvalues, of_bond_tensors_along_the_axes_is_that_of_second_differences)
{
  // each component in lines of n nodes: c (2 - 2 cos(π p / (n + 1)))
  constexpr int n = 10;
  const problem::Level level{1. / n, 1. / n};
  const auto scene = make_scene(true), mesh = make_scene(true, squares);
  const auto kernel = scene::make_problem(scene, 0, level).kernel;
  const meshfree::Bond<2> bond{{level.h, 0}, level.h * level.h, {level.h, 0}, level.h * level.h};
  const double c = meshfree::kernel_value(kernel, bond, 0, 0) * bond.weight,
               end = std::cos(M_PI / (n + 1));
  for (const auto *one : {&scene, &mesh})
    expect_ends(operator_of("FA", *one, level), c * (2 - 2 * end), c * (2 + 2 * end),
                one->name + (one == &mesh ? " on a mesh" : ""));
}

TEST(OperatorEigenvalues, of_piecewise_constants_with_nearest_neighbours_is_that_of_sines)
{
  // With δ = h cells see their neighbours alone. A sine in each direction is mapped to itself times
  // the symbol a00 + 2 a10 (cos s + cos t) + 4 a11 cos s cos t; of tensors on a strip one cell
  // high, where components are not coupled, a00 + 2 a10 cos s.
  constexpr int n = 10;
  constexpr double h = 1. / n;
  const std::string strip = "subsection Domain\n set boxes = 0, 0 : 1, 0.1\nend\n",
                    mesh_strip = "subsection Domain\n set boxes = 0, 0 : 1, 0.1\n set mesh = "
                                 "squares\nend\n";
  for (const bool is_tensor : {false, true})
    for (const std::string &more :
         {is_tensor ? strip : std::string(), is_tensor ? mesh_strip : squares})
    {
      const auto scene = make_scene(is_tensor, more);
      const auto kernel = scene::make_problem(scene, 0, {h, h}).kernel;
      const auto a = reference::galerkin_stencil(kernel, h, reference::AxisShapes(false, 0),
                                                 geometry::Backend::fast);
      for (int k = -a.reach(); k <= a.reach(); ++k) // no entries beyond
        for (unsigned int s = 0; s < a.n_blocks(); ++s)
          ASSERT_LT(a.reach() < 2 ? 0 : std::abs(a(s, s, 2, k)), 1e-15 * a(s, s, 0, 0));
      std::vector<double> symbol;
      for (unsigned int s = 0; s < a.n_blocks(); ++s)
        for (int p = 1; p <= n; ++p)
          for (int q = 1; q <= (is_tensor ? 1 : n); ++q)
          {
            const double x = std::cos(M_PI * p / (n + 1)),
                         y = is_tensor ? 0 : std::cos(M_PI * q / (n + 1));
            symbol.push_back((a(s, s, 0, 0) + 2 * a(s, s, 1, 0) * x + 2 * a(s, s, 0, 1) * y +
                              4 * a(s, s, 1, 1) * x * y) /
                             (h * h));
          }
      const auto [least, most] = std::minmax_element(symbol.begin(), symbol.end());
      expect_ends(operator_of("DGQ0", scene, {h, h}), *least, *most, more);
    }
}

TEST(OperatorEigenvalues, of_linear_elements_lies_within_the_range_of_the_symbol)
{
  constexpr double h = 1. / 24;
  for (const bool is_tensor : {false, true})
  {
    const auto scene = make_scene(is_tensor);
    const problem::Level level{h, 2 * h};
    const auto a =
        reference::galerkin_stencil(scene::make_problem(scene, 0, level).kernel, h,
                                    reference::AxisShapes(true, 1), geometry::Backend::fast);
    constexpr int n = 64; // angles
    double most = 0;
    const auto nb = static_cast<Eigen::Index>(a.n_blocks());
    for (int p = 0; p <= n; ++p)
      for (int q = 0; q <= n; ++q)
      {
        Eigen::MatrixXd symbol = Eigen::MatrixXd::Zero(nb, nb);
        for (int k2 = -a.reach(); k2 <= a.reach(); ++k2)
          for (int k1 = -a.reach(); k1 <= a.reach(); ++k1)
            for (unsigned int s = 0; s < a.n_blocks(); ++s)
              for (unsigned int t = 0; t < a.n_blocks(); ++t)
                symbol(s, t) += a(s, t, k1, k2) * std::cos(M_PI * (k1 * p + k2 * q) / n);
        most = std::max(
            most, Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symbol).eigenvalues().maxCoeff());
      }
    const Stability found = measure(operator_of("Q1", scene, level));
    EXPECT_GT(found.smallest, 0);
    EXPECT_LT(found.largest, most / (h * h) * (1 + 1e-3)); // of the angles' grid
    EXPECT_GT(found.largest, .97 * most / (h * h));
  }
}

TEST(OperatorEigenvalues, has_the_eigenvalues_of_operators_that_are_not_symmetric)
{
  // two materials with an interface, as in scenes/lps/interface.prm
  const auto solid = scene::parse_scene(
      "test.prm", "subsection Domain\n set boxes = -1, -1 : 1, 1\n set mesh = squares\nend\n"
                  "subsection Kernel\n set type = 1/r\n set limit = Navier\nend\n"
                  "subsection Material\n set model = LPS\n set E = x < 0 ? 3 : 6\n"
                  " set nu = 0.3\nend\n"
                  "subsection Problem\n set load = 0, 0\n set constraint = x, 0\n"
                  " set local solution = x, 0\nend\n"
                  "subsection Study\n set norms = nodal L2\n"
                  " set decisive error = nodal L2 | local\nend\n"
                  "subsection Methods\n set names = OPT\nend\n");
  expect_as_dense(operator_of("OPT", solid, {.25, .75}));
  // an operator with eigenvalues on the wrong side
  const auto moved = make_scene(true, "subsection Domain\n set mesh = squares\nend\n"
                                      "subsection Methods\n set perturbation = 0.45\nend\n");
  const auto wrong = operator_of("IPA-AC-R4", moved, {1. / 12, 2.5 / 12});
  expect_as_dense(wrong);
  const Stability unsound = measure(wrong);
  EXPECT_LT(unsound.eigenvalues.smallest_real, 0);
  EXPECT_LT(unsound.smallest, unsound.eigenvalues.smallest_real);
  // of a symmetric one they are those of the symmetric part
  const Stability symmetric = measure(operator_of("FA", moved, {.1, .3}));
  EXPECT_EQ(symmetric.eigenvalues.smallest_real, symmetric.smallest);
  EXPECT_EQ(symmetric.eigenvalues.largest_modulus, symmetric.largest);
}
