#include "physics/chebyshev.h"

#include "base/control_points.h"
#include "physics/chebyshev_basis.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

namespace plumbline::physics
{
  namespace
  {
    using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

    Matrix values_to_coefficients(unsigned int n)
    {
      const std::vector<double> transform = chebyshev_transform(n);
      return Eigen::Map<const Matrix>(transform.data(), n, n);
    }

    /// Leading rows up to the last one with an entry above the tolerance, at least one.
    unsigned int significant_rows(const Matrix &coefficients, double tolerance)
    {
      Eigen::Index n = coefficients.rows();
      while (n > 1 && coefficients.row(n - 1).cwiseAbs().maxCoeff() <= tolerance)
        --n;
      return static_cast<unsigned int>(n);
    }

    /// A corner of a matrix, made square with zeros.
    std::vector<double> squared_corner(const Matrix &all, const std::array<unsigned int, 2> &n)
    {
      const unsigned int size = std::max(n[0], n[1]);
      Matrix kept = Matrix::Zero(size, size);
      kept.topLeftCorner(n[0], n[1]) = all.topLeftCorner(n[0], n[1]);
      return {kept.data(), kept.data() + kept.size()};
    }

    /// Coefficients of f on a box by its values at n[0] × n[1] Chebyshev points.
    /// @param largest  overwritten: of f
    Matrix coefficients_of(const ChebyshevField::Function &f, unsigned int component,
                           const Point<2> &lower, const Point<2> &upper,
                           const std::array<unsigned int, 2> &n, double &largest)
    {
      Matrix values(n[0], n[1]);
      for (unsigned int i = 0; i < n[0]; ++i)
        for (unsigned int j = 0; j < n[1]; ++j)
        {
          const double s = std::cos(M_PI * (i + .5) / n[0]), t = std::cos(M_PI * (j + .5) / n[1]);
          values(i, j) = f(Point<2>(lower[0] + .5 * (1 + s) * (upper[0] - lower[0]),
                                    lower[1] + .5 * (1 + t) * (upper[1] - lower[1])),
                           component);
        }
      largest = values.cwiseAbs().maxCoeff();
      return values_to_coefficients(n[0]) * values * values_to_coefficients(n[1]).transpose();
    }
  } // namespace

  std::optional<ChebyshevField>
  ChebyshevField::resolve(const Function &f, unsigned int n_components, const Point<2> &lower,
                          const Point<2> &upper, double noise, const Search &search)
  {
    // a layer along one axis needs many points across it, few along it
    for (std::array<unsigned int, 2> n{search.fewest, search.fewest};;)
    {
      std::vector<Matrix> coefficients;
      std::array<unsigned int, 2> n_significant{1, 1};
      for (unsigned int c = 0; c < n_components; ++c)
      {
        double largest = 0;
        coefficients.push_back(coefficients_of(f, c, lower, upper, n, largest));
        const double tolerance = search.digits * largest + noise;
        n_significant[0] = std::max(n_significant[0], significant_rows(coefficients[c], tolerance));
        n_significant[1] =
            std::max(n_significant[1], significant_rows(coefficients[c].transpose(), tolerance));
      }
      // resolved when at least the last two terms of each axis are round-off ...
      std::array<bool, 2> is_short{};
      for (unsigned int d = 0; d < 2; ++d)
        is_short[d] = n_significant[d] + 2 > n[d];
      if (!is_short[0] && !is_short[1])
      {
        ChebyshevField field;
        field.lower_ = lower;
        field.upper_ = upper;
        field.n_terms_ = std::max(n_significant[0], n_significant[1]);
        for (const Matrix &all : coefficients)
          field.coefficients_.push_back(squared_corner(all, n_significant));
        if (field.meets(f, noise, search)) // ... and nothing hid between the points
          return field;
        is_short = {true, true};
      }
      for (unsigned int d = 0; d < 2; ++d)
        if (is_short[d])
        {
          if (2 * n[d] - 1 > search.most)
            return std::nullopt;
          n[d] = 2 * n[d] - 1;
        }
    }
  }

  bool ChebyshevField::meets(const Function &f, double noise, const Search &search) const
  {
    const double relative = 1e3 * search.digits; // there are many coefficients that are cut
    constexpr double n_noises = 100;
    const std::array<std::vector<double>, 2> at = {base::control_points(search.n_control[0]),
                                                   base::control_points(search.n_control[1])};
    std::array<std::vector<double>, 2> place;
    std::vector<double> along;
    for (unsigned int axis = 0; axis < 2; ++axis)
      for (const double s : at[axis])
        place[axis].push_back(lower_[axis] + s * (upper_[axis] - lower_[axis]));
    for (const double x : place[0])
    {
      const auto row = basis(0, x);
      along.insert(along.end(), row.begin(), row.end());
    }
    double largest = 0, worst = 0;
    for (unsigned int c = 0; c < n_components(); ++c)
      for (const double y : place[1])
      {
        const std::vector<double> row = contract(c, along, basis(1, y));
        for (std::size_t i = 0; i < row.size(); ++i)
        {
          const double value = f(Point<2>(place[0][i], y), c);
          largest = std::max(largest, std::abs(value));
          worst = std::max(worst, std::abs(value - row[i]));
        }
      }
    return worst <= relative * largest + n_noises * noise;
  }

  std::vector<double> ChebyshevField::basis(unsigned int axis, double coordinate) const
  {
    const double s = (2 * coordinate - lower_[axis] - upper_[axis]) / (upper_[axis] - lower_[axis]);
    return chebyshev_polynomials(s, n_terms_);
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
    const Map of_a(a.data(), n_a, n_terms_), of_b(b.data(), n_b, n_terms_),
        coefficients(coefficients_[component].data(), n_terms_, n_terms_);
    Eigen::Map<Matrix> product(result.data(), n_b, n_a);
    if (n_b < n_a) // the shorter side first
      product = (of_b * coefficients.transpose()) * of_a.transpose();
    else
      product = of_b * (of_a * coefficients).transpose();
    return result;
  }
} // namespace plumbline::physics
