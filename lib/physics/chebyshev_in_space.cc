#include "physics/chebyshev_in_space.h"

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
    using Point = dealii::Point<3>;
    using Sizes = std::array<unsigned int, 3>;

    /// Σ_k rows(i, k) values(..., k) along the last axis, which comes first in the result: three
    /// times in turn, all axes are done and in their order again.
    /// @param values  shape (n_outer, rows.cols())
    /// @return        shape (rows.rows(), n_outer)
    std::vector<double> turn(const Matrix &rows, const std::vector<double> &values)
    {
      const Eigen::Index n_outer = static_cast<Eigen::Index>(values.size()) / rows.cols();
      const Eigen::Map<const Matrix> from(values.data(), n_outer, rows.cols());
      std::vector<double> result(static_cast<std::size_t>(rows.rows() * n_outer));
      Eigen::Map<Matrix>(result.data(), rows.rows(), n_outer) = rows * from.transpose();
      return result;
    }

    /// x, y, z in turn.
    std::vector<double> turn_all(const std::array<Matrix, 3> &rows, std::vector<double> values)
    {
      for (const Matrix &along : rows)
        values = turn(along, values);
      return values;
    }

    Matrix values_to_coefficients(unsigned int n)
    {
      const std::vector<double> transform = chebyshev_transform(n);
      return Eigen::Map<const Matrix>(transform.data(), n, n);
    }

    /// The part of shape `kept` of values of shape `all`, lowest indices first.
    std::vector<double> corner(const std::vector<double> &values, const Sizes &all,
                               const Sizes &kept)
    {
      std::vector<double> result;
      for (unsigned int k = 0; k < kept[2]; ++k)
        for (unsigned int j = 0; j < kept[1]; ++j)
        {
          const auto row = values.begin() + static_cast<std::ptrdiff_t>((k * all[1] + j) * all[0]);
          result.insert(result.end(), row, row + kept[0]);
        }
      return result;
    }

    /// How many terms along each axis are above the tolerance; raises `n`.
    void count_terms(const std::vector<double> &coefficients, const Sizes &shape, double tolerance,
                     Sizes &n)
    {
      std::size_t place = 0;
      for (unsigned int k = 0; k < shape[2]; ++k)
        for (unsigned int j = 0; j < shape[1]; ++j)
          for (unsigned int i = 0; i < shape[0]; ++i, ++place)
            if (std::abs(coefficients[place]) > tolerance)
              n = {std::max(n[0], i + 1), std::max(n[1], j + 1), std::max(n[2], k + 1)};
    }

    /// Along each axis: places in (0, 1) to coordinates.
    std::array<std::vector<double>, 3> on_box(const std::array<Point, 2> &box,
                                              const std::array<std::vector<double>, 3> &places)
    {
      std::array<std::vector<double>, 3> result;
      for (unsigned int d = 0; d < 3; ++d)
        for (const double s : places[d])
          result[d].push_back(box[0][d] + s * (box[1][d] - box[0][d]));
      return result;
    }

    std::vector<double> values_at(const ChebyshevInSpace::Function &f, unsigned int component,
                                  const std::array<std::vector<double>, 3> &at)
    {
      std::vector<double> values;
      values.reserve(at[0].size() * at[1].size() * at[2].size());
      for (const double z : at[2])
        for (const double y : at[1])
          for (const double x : at[0])
            values.push_back(f(Point(x, y, z), component));
      return values;
    }

    bool are_finite(const std::vector<double> &values)
    {
      return std::all_of(values.begin(), values.end(),
                         [](double value) { return std::isfinite(value); });
    }

    double largest_of(const std::vector<double> &values)
    {
      double largest = 0;
      for (const double value : values)
        largest = std::max(largest, std::abs(value));
      return largest;
    }
  } // namespace

  std::optional<ChebyshevInSpace> ChebyshevInSpace::resolve(const Function &f,
                                                            unsigned int n_components,
                                                            const Point &lower, const Point &upper,
                                                            double noise)
  {
    constexpr unsigned int fewest = 9, most = 65;
    constexpr double digits = 1e-15;
    ChebyshevInSpace field;
    field.box_ = {lower, upper};
    for (Sizes n{fewest, fewest, fewest};;)
    {
      std::array<std::vector<double>, 3> places;
      for (unsigned int d = 0; d < 3; ++d)
        for (unsigned int i = 0; i < n[d]; ++i)
          places[d].push_back(.5 * (1 + std::cos(M_PI * (i + .5) / n[d])));
      const std::array<Matrix, 3> transforms = {
          values_to_coefficients(n[0]), values_to_coefficients(n[1]), values_to_coefficients(n[2])};
      std::vector<std::vector<double>> coefficients;
      field.n_terms_ = {1, 1, 1};
      for (unsigned int c = 0; c < n_components; ++c)
      {
        const auto values = values_at(f, c, on_box(field.box_, places));
        if (!are_finite(values))
          return std::nullopt;
        coefficients.push_back(turn_all(transforms, values));
        count_terms(coefficients[c], n, digits * largest_of(values) + noise, field.n_terms_);
      }
      // resolved when at least the last two terms of each axis are round-off ...
      std::array<bool, 3> is_short{};
      for (unsigned int d = 0; d < 3; ++d)
        is_short[d] = field.n_terms_[d] + 2 > n[d];
      if (!is_short[0] && !is_short[1] && !is_short[2])
      {
        field.coefficients_.clear();
        for (const auto &all : coefficients)
          field.coefficients_.push_back(corner(all, n, field.n_terms_));
        if (field.meets(f, noise)) // ... and nothing hid between the points
          return field;
        is_short = {true, true, true};
      }
      for (unsigned int d = 0; d < 3; ++d)
        if (is_short[d])
        {
          if (2 * n[d] - 1 > most)
            return std::nullopt;
          n[d] = 2 * n[d] - 1;
        }
    }
  }

  bool ChebyshevInSpace::meets(const Function &f, double noise) const
  {
    constexpr unsigned int n_control = 10;
    constexpr double relative = 1e-12, n_noises = 100;
    const auto along = base::control_points(n_control);
    const auto at = on_box(box_, {along, along, along});
    AxisFunctionals points;
    for (unsigned int d = 0; d < 3; ++d)
      for (const double x : at[d])
        points[d].push_back({{x, 1}});
    double largest = 0, worst = 0;
    for (unsigned int c = 0; c < coefficients_.size(); ++c)
    {
      const auto values = values_at(f, c, at), found = apply(c, points);
      if (!are_finite(values))
        return false;
      largest = std::max(largest, largest_of(values));
      for (std::size_t i = 0; i < values.size(); ++i)
        worst = std::max(worst, std::abs(values[i] - found[i]));
    }
    return worst <= relative * largest + n_noises * noise;
  }

  std::vector<double> ChebyshevInSpace::apply(unsigned int component,
                                              const AxisFunctionals &functionals) const
  {
    std::array<Matrix, 3> rows;
    for (unsigned int d = 0; d < 3; ++d)
    {
      const double lower = box_[0][d], upper = box_[1][d];
      rows[d] = Matrix::Zero(static_cast<Eigen::Index>(functionals[d].size()), n_terms_[d]);
      for (std::size_t i = 0; i < functionals[d].size(); ++i)
        for (const auto &[x, weight] : functionals[d][i])
        {
          const auto basis =
              chebyshev_polynomials((2 * x - lower - upper) / (upper - lower), n_terms_[d]);
          for (unsigned int k = 0; k < n_terms_[d]; ++k)
            rows[d](static_cast<Eigen::Index>(i), k) += weight * basis[k];
        }
    }
    return turn_all(rows, coefficients_[component]);
  }
} // namespace plumbline::physics
