#include "physics/well_potential.h"

#include "base/error.h"
#include "physics/taylor_expression.h"
#include "physics/well_tables.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace plumbline::physics
{
  namespace
  {
    [[noreturn]] void refuse(const std::string &key, const std::string &text,
                             const std::string &what, double value, double r,
                             const std::string &remedy)
    {
      std::ostringstream message;
      message << key << " = '" << text << "': " << what << " = " << value << " at r = " << r << "; "
              << remedy;
      throw InputError(message.str());
    }

    constexpr const char *example =
        "a double-well potential f is smooth and concave, f(0) = 0, f'(0) > 0, and has a finite "
        "limit as r grows, for example 1 - exp(-r) or r/(1 + r)";

    /// φ with its derivatives, exact.
    struct Shape
    {
      TaylorExpression f;
      double limit = 0, slope = 0;

      /// φ, φ', φ''/2, φ'''/6 at s = r f'(0)/f_∞.
      Taylor operator()(double s) const
      {
        const double scale = limit / slope;
        Taylor result = f(s * scale);
        double factor = 1 / limit;
        for (double &coefficient : result)
        {
          coefficient *= factor;
          factor *= scale;
        }
        return result;
      }

      double tangent(double s) const
      {
        const Taylor at = (*this)(s);
        return at[1] + 4 * s * at[2];
      }

      /// φ(s)/s; what cancels near 0 is 3e-13 of it at the first point of interpolation, 4e-4.
      double mean_slope(double s) const { return (*this)(s)[0] / s; }

      /// The n-th derivative of φ(x²), n = 1, 2, 3.
      double derivative(unsigned int n, double x) const
      {
        const Taylor at = (*this)(x * x);
        return n == 1   ? 2 * x * at[1]
               : n == 2 ? 2 * at[1] + 8 * x * x * at[2]
                        : 24 * x * at[2] + 48 * x * x * x * at[3];
      }
    };

    /// f_∞, far beyond the length f_∞/f'(0) that f changes on.
    double limit_of(const std::string &key, const std::string &text, const TaylorExpression &f,
                    double slope)
    {
      constexpr double far = 0x1p200, less_far = 0x1p140, rounding = 1e-13;
      constexpr int most_steps = 20;
      double limit = f(0x1p60)[0];
      for (int step = 0; step < most_steps; ++step)
      {
        const double length = limit / slope, next = f(far * length)[0];
        if (std::isinf(next))
          break;
        if (!(next > 0))
          refuse(key, text, "f", next, far * length, example);
        const bool is_settled = std::abs(next - limit) <= rounding * next;
        limit = next;
        if (is_settled && std::abs(f(less_far * length)[0] - limit) <= rounding * limit)
          return limit;
      }
      throw InputError(key + " = '" + text +
                       "' has no finite limit as r grows, or approaches it "
                       "too slowly to be evaluated; " +
                       example);
    }

    void check_shape(const std::string &key, const std::string &text, const Shape &shape)
    {
      constexpr double rounding = 1e-12;
      const double length = shape.limit / shape.slope;
      for (int piece = 0; piece < PiecewisePolynomial::n_pieces; ++piece)
        for (const double x : {-1., 0.})
        {
          const double s = PiecewisePolynomial::place(piece, x), r = s * length;
          const Taylor at = shape(s);
          if (!(at[1] >= -rounding))
            refuse(key, text, "f'", at[1] * shape.slope, r, example);
          if (!(2 * at[2] * (1 + s) <= rounding))
            refuse(key, text, "f''", 2 * at[2] * shape.slope / length, r, example);
        }
    }

    /// Between the points of interpolation.
    void check_accuracy(const std::string &key, const std::string &text, const Shape &shape,
                        const WellTables &tables)
    {
      constexpr double accuracy = 1e-12;
      for (int piece = 0; piece < PiecewisePolynomial::n_pieces; ++piece)
        for (const double x : {-.95, .05, .8})
        {
          const double s = PiecewisePolynomial::place(piece, x);
          const Taylor at = shape(s);
          const double error =
              std::max({std::abs(tables.mean_slope(s) - shape.mean_slope(s)) * (1 + s),
                        std::abs(tables.derivative(s) - at[1]) * std::sqrt(1 + s),
                        std::abs(tables.tangent(s) - shape.tangent(s))});
          if (!(error <= accuracy))
            refuse(key, text, "the relative error of f or its derivatives by polynomials", error,
                   s * shape.limit / shape.slope,
                   "f must be smooth on the scale of f(infinity)/f'(0) + r; take one length in f");
        }
    }

    /// Points of x >= 0, dense near 0 and up to 1e3.
    std::vector<double> grid()
    {
      constexpr int n = 2000;
      std::vector<double> points;
      for (int i = 0; i < n; ++i)
        points.push_back(std::tan(.5 * M_PI * i / n));
      return points;
    }

    double largest_derivative(const Shape &shape, unsigned int n)
    {
      const auto at = [&](double x) { return std::abs(shape.derivative(n, x)); };
      double best = 0, value = at(0), width = 0;
      const auto points = grid();
      for (std::size_t i = 1; i + 1 < points.size(); ++i)
        if (const double other = at(points[i]); other > value)
        {
          best = points[i];
          value = other;
          width = points[i + 1] - points[i - 1];
        }
      constexpr double resolution = 1e-9; // values at maxima change by its square
      for (; width > resolution * best; width /= 2)
        for (const double side : {-width / 2, width / 2})
          if (const double other = at(best + side); other > value)
          {
            value = other;
            best += side;
          }
      return value;
    }

    double first_softening(const Shape &shape)
    {
      const auto points = grid();
      const auto first = std::find_if(points.begin(), points.end(),
                                      [&](double x) { return !(shape.derivative(2, x) > 0); });
      double low = first == points.begin() ? 0 : *(first - 1), high = *first;
      while (true)
      {
        const double middle = .5 * (low + high);
        if (!(middle > low) || !(middle < high))
          return middle * middle;
        (shape.derivative(2, middle) > 0 ? low : high) = middle;
      }
    }
  } // namespace

  // F' = 2x e^(-x²) is largest at x² = ½, F'' = 2 (1 - 2x²) e^(-x²) at 0 and F''' = (8x³ - 12x)
  // e^(-x²) at x² = (3 - √6)/2
  std::array<double, 3> WellPotential::of_exponential()
  {
    const double square = .5 * (3 - std::sqrt(6.)), x = std::sqrt(square);
    return {std::sqrt(2.) * std::exp(-.5), 2, (12 - 8 * square) * x * std::exp(-square)};
  }

  WellPotential::WellPotential(const std::string &key, const std::string &text) : text_(text)
  {
    Shape shape{TaylorExpression(key, text)};
    const Taylor at_zero = shape.f(0);
    slope_ = shape.slope = at_zero[1];
    if (!(slope_ > 0) || !std::isfinite(slope_))
      refuse(key, text, "f'", slope_, 0, example);
    limit_ = shape.limit = limit_of(key, text, shape.f, slope_);
    constexpr double rounding = 1e-14;
    if (!(std::abs(at_zero[0]) <= rounding * limit_))
      refuse(key, text, "f", at_zero[0], 0, example);
    check_shape(key, text, shape);
    const auto tables = std::make_shared<const WellTables>(
        WellTables{PiecewisePolynomial([&](double s) { return shape.mean_slope(s); }),
                   PiecewisePolynomial([&](double s) { return shape(s)[1]; }),
                   PiecewisePolynomial([&](double s) { return shape.tangent(s); })});
    check_accuracy(key, text, shape, *tables);
    softening_ = first_softening(shape);
    for (unsigned int n = 0; n < largest_.size(); ++n)
      largest_[n] = largest_derivative(shape, n + 1);
    tables_ = tables;
  }

  double WellPotential::value(double s) const
  {
    if (is_exponential())
      return -std::expm1(-s);
    const double capped = std::min(s, PiecewisePolynomial::largest);
    return capped * tables_->mean_slope(capped);
  }

  double WellPotential::derivative(double s) const
  {
    return is_exponential() ? std::exp(-s) : tables_->derivative(s);
  }

  double WellPotential::tangent(double s) const
  {
    return is_exponential() ? std::exp(-s) * (1 - 2 * s) : tables_->tangent(s);
  }
} // namespace plumbline::physics
