#include "physics/chebyshev.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

namespace plumbline::physics
{
  namespace
  {
    using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

    /// Values at the n Chebyshev points cos(π (i + ½) / n) to coefficients.
    Matrix values_to_coefficients(unsigned int n)
    {
      Matrix transform(n, n);
      for (unsigned int k = 0; k < n; ++k)
        for (unsigned int i = 0; i < n; ++i)
          transform(k, i) = (k == 0 ? 1. : 2.) / n * std::cos(M_PI * k * (i + .5) / n);
      return transform;
    }

    /// The number of leading terms that stand above the tolerance.
    unsigned int significant_terms(const Matrix &coefficients, double tolerance)
    {
      Eigen::Index n = coefficients.rows();
      while (n > 1 && coefficients.row(n - 1).cwiseAbs().maxCoeff() <= tolerance &&
             coefficients.col(n - 1).head(n).cwiseAbs().maxCoeff() <= tolerance)
        --n;
      return static_cast<unsigned int>(n);
    }
  } // namespace

  std::optional<ChebyshevField> ChebyshevField::resolve(const Function &f,
                                                        unsigned int n_components,
                                                        const Point<2> &lower,
                                                        const Point<2> &upper, double noise)
  {
    constexpr double relative = 1e-15;
    for (unsigned int n = 9; n <= 129; n = 2 * n - 1)
    {
      ChebyshevField field;
      field.lower_ = lower;
      field.upper_ = upper;
      const Matrix transform = values_to_coefficients(n);
      std::vector<Matrix> coefficients(n_components, Matrix(n, n));
      unsigned int n_significant = 1;
      for (unsigned int c = 0; c < n_components; ++c)
      {
        Matrix values(n, n);
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < n; ++j)
          {
            const double s = std::cos(M_PI * (i + .5) / n), t = std::cos(M_PI * (j + .5) / n);
            values(i, j) = f(Point<2>(lower[0] + .5 * (1 + s) * (upper[0] - lower[0]),
                                      lower[1] + .5 * (1 + t) * (upper[1] - lower[1])),
                             c);
          }
        coefficients[c] = transform * values * transform.transpose();
        const double tolerance = relative * values.cwiseAbs().maxCoeff() + noise;
        n_significant = std::max(n_significant, significant_terms(coefficients[c], tolerance));
      }
      // resolved when at least the last two terms of each axis are round-off
      if (n_significant + 2 > n)
        continue;
      field.n_terms_ = n_significant;
      for (const Matrix &all : coefficients)
      {
        const Matrix kept = all.topLeftCorner(n_significant, n_significant);
        field.coefficients_.emplace_back(kept.data(), kept.data() + kept.size());
      }
      return field;
    }
    return std::nullopt;
  }

  std::vector<double> ChebyshevField::basis(unsigned int axis, double coordinate) const
  {
    const double s = (2 * coordinate - lower_[axis] - upper_[axis]) / (upper_[axis] - lower_[axis]);
    std::vector<double> values(n_terms_);
    for (unsigned int k = 0; k < n_terms_; ++k)
      values[k] = k == 0 ? 1 : k == 1 ? s : 2 * s * values[k - 1] - values[k - 2];
    return values;
  }

  double ChebyshevField::operator()(const Point<2> &x, unsigned int component) const
  {
    return contract(component, basis(0, x[0]), basis(1, x[1]))[0];
  }

  std::vector<double> ChebyshevField::contract(unsigned int component, const std::vector<double> &a,
                                               const std::vector<double> &b) const
  {
    using Map = Eigen::Map<const Matrix>;
    const auto n_a = static_cast<Eigen::Index>(a.size() / n_terms_);
    const auto n_b = static_cast<Eigen::Index>(b.size() / n_terms_);
    std::vector<double> result(n_a * n_b);
    Eigen::Map<Matrix>(result.data(), n_b, n_a) =
        Map(b.data(), n_b, n_terms_) *
        (Map(a.data(), n_a, n_terms_) * Map(coefficients_[component].data(), n_terms_, n_terms_))
            .transpose();
    return result;
  }
} // namespace plumbline::physics
