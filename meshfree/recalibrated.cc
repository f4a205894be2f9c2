#include "base/error.h"
#include "meshfree/rules.h"

#include <Eigen/QR>

#include <array>
#include <cmath>
#include <sstream>

namespace plumbline::meshfree
{
  namespace
  {
    /// Even exponents of the moments to meet. On a lattice families are symmetric, so odd moments
    /// vanish for A as for w. Scalar: ξ^α, |α| even. Tensor: entries n_a n_b ξ^α are ξ^β / |ξ|²,
    /// |β| = |α| + 2.
    std::vector<std::array<int, 2>> even_exponents(unsigned int degree, bool is_tensor)
    {
      std::vector<std::array<int, 2>> exponents;
      const int raise = is_tensor ? 2 : 0;
      for (int order = 2 + raise; order <= static_cast<int>(degree) + raise; order += 2)
        for (int a = order; a >= 0; a -= 2)
          exponents.push_back({a, order - a});
      return exponents;
    }

    double exact_moment(const Kernel<2> &kernel, std::array<int, 2> exponents)
    {
      if (kernel.n_components() == 1)
        return kernel.moment(exponents);
      const unsigned int component = exponents[0] >= 2 ? 0 : 1;
      exponents[component] -= 2;
      return kernel.moment(exponents, component, component);
    }
  } // namespace

  Bonds recalibrated(const Kernel<2> &kernel, double h, Backend backend, unsigned int degree)
  {
    const bool is_tensor = kernel.n_components() > 1;
    Bonds bonds =
        is_tensor ? partial_area(kernel, h, backend) : improved_partial_area(kernel, h, backend);
    const auto exponents = even_exponents(degree, is_tensor);
    const auto n_rows = static_cast<Eigen::Index>(exponents.size());
    const auto n = static_cast<Eigen::Index>(bonds.family.size());

    // with w = A + √A y: least |y| such that (B √A) y = 1 - B A, each row divided by its exact
    // moment
    Eigen::MatrixXd rows(n_rows, n);
    Eigen::VectorXd defect = Eigen::VectorXd::Ones(n_rows);
    for (Eigen::Index j = 0; j < n; ++j)
    {
      const Bond &bond = bonds.family[j];
      const Point<2> xi(bond.k1 * h, bond.k2 * h);
      const Bond scalar_bond{bond.k1, bond.k2, 1, bond.kernel_point, 1};
      const double radial = is_tensor ? (kernel_value(kernel, scalar_bond, 0, 0) +
                                         kernel_value(kernel, scalar_bond, 1, 1)) /
                                            xi.square()
                                      : kernel_value(kernel, scalar_bond, 0, 0);
      for (Eigen::Index i = 0; i < n_rows; ++i)
      {
        const double entry = radial * std::pow(xi[0], exponents[i][0]) *
                             std::pow(xi[1], exponents[i][1]) / exact_moment(kernel, exponents[i]);
        rows(i, j) = entry * std::sqrt(bond.area);
        defect[i] -= entry * bond.area;
      }
    }
    const Eigen::VectorXd y = rows.completeOrthogonalDecomposition().solve(defect);
    const double residual = (rows * y - defect).cwiseAbs().maxCoeff();
    if (!(residual < 1e-10))
    {
      std::ostringstream message;
      message << "recalibration to degree " << degree
              << " is not possible for m = " << kernel.horizon() / h << ": the moments stay off by "
              << residual << " with " << n << " neighbours; raise m or lower the degree";
      throw NumericalError(message.str());
    }
    for (Eigen::Index j = 0; j < n; ++j)
      bonds.family[j].weight += std::sqrt(bonds.family[j].area) * y[j];
    return bonds;
  }
} // namespace plumbline::meshfree
