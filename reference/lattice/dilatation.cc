#include "reference/lattice/dilatation.h"

#include "base/error.h"
#include "physics/chebyshev_basis.h"

#include <deal.II/base/quadrature_lib.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

namespace plumbline::reference
{
  namespace
  {
    using Matrix = Eigen::MatrixXd;

    /// A rule on [0, 1].
    struct Rule
    {
      explicit Rule(unsigned int n)
      {
        const dealii::QGauss<1> gauss(n);
        for (unsigned int q = 0; q < n; ++q)
        {
          at.push_back(gauss.point(q)[0]);
          weight.push_back(gauss.weight(q));
        }
      }
      std::vector<double> at, weight;
    };

    /// Gauss points gathered at both ends by t = s³ (10 - 15 s + 6 s²), for functions with factors
    /// d^(3/2) or d² log d of the distance d from an end.
    Rule gathered_rule(unsigned int n)
    {
      Rule rule(n);
      for (unsigned int q = 0; q < n; ++q)
      {
        const double s = rule.at[q];
        rule.at[q] = s * s * s * (10 + s * (6 * s - 15));
        rule.weight[q] *= 30 * s * s * (1 - s) * (1 - s);
      }
      return rule;
    }

    /// Calls f(t, weight) for a rule on [0, length] that is halved into parts of at most `widest`.
    template <class Function>
    void integrate(const Rule &rule, double length, double widest, const Function &f)
    {
      const auto n_parts = static_cast<unsigned int>(std::ceil(length / widest));
      const double part = length / n_parts;
      for (unsigned int k = 0; k < n_parts; ++k)
        for (std::size_t q = 0; q < rule.at.size(); ++q)
          f(part * (k + rule.at[q]), part * rule.weight[q]);
    }

    /// C for a horizon 1 by elliptic coordinates with the foci 0 and w, r_1,2 = w/2 (cosh s ± cos
    /// t), where the area element r_1 r_2 ds dt makes the integrand a polynomial of cosh s and cos
    /// t. One quarter of the lens, r_2 <= r_1 <= 1: sinh²(s/2) <= sin²(t/2) - (1 - 1/w). The root
    /// of the right-hand side, real for w > 1 and imaginary for w < 1, is removed by t = root cosh
    /// u and root sinh u.
    /// @param value  K r, smooth in [0, 1]
    template <class Function>
    DilatationKernel::Value convolve(const Function &value, double w, const Rule &rule)
    {
      const double least = 1 - 1 / w, end = M_PI / 2;
      const bool is_cut = least > 0; // the lens does not reach the foci
      const double root =
          2 * (is_cut ? std::asin(std::sqrt(least)) : std::asinh(std::sqrt(-least)));
      const double length = is_cut ? std::acosh(std::max(1., end / root)) : std::asinh(end / root);
      DilatationKernel::Value sum{0, 0};
      integrate(rule, length, 1.5,
                [&](double u, double weight_u)
                {
                  const double t = root * (is_cut ? std::cosh(u) : std::sinh(u));
                  const double weight_t = weight_u * root * (is_cut ? std::sinh(u) : std::cosh(u));
                  const double cos_t = std::cos(t), sin_t = std::sin(t), half = std::sin(.5 * t);
                  const double farthest =
                      2 * std::asinh(std::sqrt(std::max(0., half * half - least)));
                  integrate(rule, farthest, 2.5,
                            [&](double s, double weight_s)
                            {
                              const double e = std::exp(s);
                              const double cosh_s = .5 * (e + 1 / e), sinh_s = .5 * (e - 1 / e);
                              const double factor = weight_t * weight_s * w * w *
                                                    value(.5 * w * (cosh_s + cos_t)) *
                                                    value(.5 * w * (cosh_s - cos_t));
                              const double x = cosh_s * cos_t, y = sinh_s * sin_t;
                              sum.along += factor * (1 - x) * (1 + x);
                              sum.across -= factor * y * y;
                            });
                });
      return sum;
    }

    /// ∫ over one cell of C_ab(z) P_p(x) P_q(y) dz as matrices (p, q), x and y the cell's own
    /// coordinates in [-1, 1], all lengths in units of h, for ab = xx, xy, yy.
    using CellMoments = std::array<Matrix, 3>;

    /// For the cell [i, i+1] × [j, j+1], i, j >= 0.
    CellMoments cell_moments(const DilatationKernel &kernel, double h, int i, int j,
                             unsigned int n_modes, const Rule &rule)
    {
      const double horizon = .5 * kernel.radius() / h;
      // corners, and crossings of the sides' lines with the circles where C is not smooth
      const double first = std::atan2(j, i + 1), last = std::atan2(j + 1, i);
      std::vector<double> angles = {first, std::atan2(j, i), std::atan2(j + 1, i + 1), last};
      for (const double radius : {horizon, 2 * horizon})
        for (const int side : {0, 1})
        {
          angles.push_back(std::acos(std::min(1., (i + side) / radius)));
          angles.push_back(std::asin(std::min(1., (j + side) / radius)));
        }
      for (double &angle : angles)
        angle = std::clamp(angle, first, last);
      std::sort(angles.begin(), angles.end());

      CellMoments moments;
      moments.fill(Matrix::Zero(n_modes, n_modes));
      Eigen::VectorXd x(n_modes), y(n_modes);
      const auto add_point = [&](double r, double c, double s, double weight)
      {
        legendre(2 * (r * c - i) - 1, n_modes, x.data());
        legendre(2 * (r * s - j) - 1, n_modes, y.data());
        const DilatationKernel::Value value = kernel(h * r);
        const double excess = value.along - value.across;
        const std::array<double, 3> entries = {value.across + excess * c * c, excess * c * s,
                                               value.across + excess * s * s};
        for (unsigned int ab = 0; ab < 3; ++ab)
          moments[ab].noalias() += (weight * entries[ab]) * x * y.transpose();
      };
      for (std::size_t k = 0; k + 1 < angles.size(); ++k)
      {
        const double width = angles[k + 1] - angles[k];
        for (std::size_t p = 0; p < rule.at.size() && width > 0; ++p)
        {
          const double angle = angles[k] + width * rule.at[p];
          const double c = std::cos(angle), s = std::sin(angle);
          const double near = std::max(i / c, j / s), far = std::min((i + 1) / c, (j + 1) / s);
          for (const double inner : {0., horizon})
          {
            const double from = std::max(near, inner), to = std::min(far, inner + horizon);
            for (std::size_t q = 0; q < rule.at.size() && from < to; ++q)
            {
              const double r = from + (to - from) * rule.at[q];
              add_point(r, c, s, width * rule.weight[p] * (to - from) * rule.weight[q] * r);
            }
          }
        }
      }
      return moments;
    }

    /// The correlations along an axis, interval by interval where they do not vanish.
    struct Pieces
    {
      explicit Pieces(const Correlations &r, unsigned int n_families)
      {
        for (unsigned int s = 0; s < n_families; ++s)
          for (unsigned int t = 0; t < n_families; ++t)
            for (int d = Correlations::first_interval; d < -Correlations::first_interval; ++d)
              if (r.coefficients(s, t, d) != nullptr)
                list.push_back({s, t, d});
        plain = mirrored = Matrix(list.size(), r.n_modes());
        for (std::size_t k = 0; k < list.size(); ++k)
          for (unsigned int p = 0; p < r.n_modes(); ++p)
          {
            plain(k, p) = r.coefficients(list[k].s, list[k].t, list[k].interval)[p];
            mirrored(k, p) = p % 2 == 0 ? plain(k, p) : -plain(k, p);
          }
      }

      struct Piece
      {
        unsigned int s, t;
        int interval;
      };
      std::vector<Piece> list;
      Matrix plain, mirrored; ///< Legendre coefficients, shape (list.size(), n_modes)
    };

    /// What the cell (i, j), 0 <= j <= i, and its images by reflection and exchange of the axes add
    /// to the stencil.
    void subtract_images(algebra::Stencil &stencil, const CellMoments &moments, int i, int j,
                         const Pieces &pieces, unsigned int n_axis)
    {
      const unsigned int n_families = n_axis * n_axis;
      for (unsigned int image = 0; image < (i == j ? 4u : 8u); ++image)
      {
        const bool is_left = image & 1, is_below = image & 2, is_swapped = image & 4;
        const int x = is_swapped ? j : i, y = is_swapped ? i : j;
        const int cell_x = is_left ? -x - 1 : x, cell_y = is_below ? -y - 1 : y;
        const Matrix &along_x = is_left ? pieces.mirrored : pieces.plain;
        const Matrix &along_y = is_below ? pieces.mirrored : pieces.plain;
        for (unsigned int a = 0; a < 2; ++a)
          for (unsigned int b = 0; b < 2; ++b)
          {
            const Matrix moment =
                is_swapped ? Matrix(moments[2 - a - b].transpose()) : moments[a + b];
            const double sign = a != b && is_left != is_below ? -1 : 1;
            const Matrix entries = sign * along_x * moment * along_y.transpose();
            for (std::size_t k = 0; k < pieces.list.size(); ++k)
              for (std::size_t l = 0; l < pieces.list.size(); ++l)
              {
                const auto &px = pieces.list[k], &py = pieces.list[l];
                stencil(a * n_families + px.s + py.s * n_axis,
                        b * n_families + px.t + py.t * n_axis, cell_x - px.interval,
                        cell_y - py.interval) -= entries(k, l);
              }
          }
      }
    }
  } // namespace

  DilatationKernel::DilatationKernel(const physics::Kernel<2> &influence)
      : horizon_(influence.horizon())
  {
    const physics::RadialProfile &profile = influence.profile();
    if (!profile.breaks().empty())
      throw InputError("the dilatation of a solid on a lattice needs an influence function without "
                       "breaks, but its table has " +
                       std::to_string(profile.breaks().size()) + "; write Domain/mesh = squares");
    std::vector<double> powers; // of δ K r
    for (const physics::PowerTerm &term :
         profile.is_function() ? physics::RadialProfile::Powers() : profile.powers())
    {
      powers.resize(std::max<std::size_t>(powers.size(), term.exponent + 2));
      powers[term.exponent + 1] += influence.constant() * horizon_ * horizon_ * term.coefficient;
    }
    const auto moment = [&](double r) // K r
    {
      if (profile.is_function())
        return influence.constant() * horizon_ * horizon_ * profile(r) * r;
      double sum = 0;
      for (auto c = powers.rbegin(); c != powers.rend(); ++c)
        sum = sum * r + *c;
      return sum;
    };
    const auto n_powers =
        static_cast<unsigned int>(profile.is_function() ? profile.degree() / 2 + 2 : powers.size());
    const Rule rule(14 + 2 * n_powers);
    for (const double sign : {1., -1., 1., -1.})
    {
      const double end = static_cast<double>((series_.size() / n_levels + 1) / 2);
      for (unsigned int level = 0; level < n_levels; ++level)
      {
        const double to = std::ldexp(.5, -static_cast<int>(level));
        const double from = level + 1 < n_levels ? .5 * to : 0;
        Series series{};
        for (unsigned int i = 0; i < n_terms; ++i)
        {
          const double angle = M_PI * (i + .5) / n_terms;
          const double distance = from + .5 * (to - from) * (1 + std::cos(angle));
          const Value value = convolve(moment, end + sign * distance, rule);
          for (unsigned int k = 0; k < n_terms; ++k)
          {
            const double factor = (k == 0 ? 1. : 2.) / n_terms * std::cos(k * angle);
            series[k].along += factor * value.along;
            series[k].across += factor * value.across;
          }
        }
        series_.push_back(series);
      }
    }
  }

  DilatationKernel::Value DilatationKernel::operator()(double w) const
  {
    const double t = w / horizon_;
    const unsigned int part = std::min(3u, static_cast<unsigned int>(2 * t));
    const double distance = std::abs(t - (part + 1) / 2);
    const unsigned int level =
        distance > 0 ? std::clamp(-2 - std::ilogb(distance), 0, static_cast<int>(n_levels) - 1)
                     : n_levels - 1;
    const double to = std::ldexp(.5, -static_cast<int>(level));
    const double from = level + 1 < n_levels ? .5 * to : 0;
    const double x = (2 * distance - from - to) / (to - from);
    const Series &series = series_[part * n_levels + level];
    return {physics::chebyshev_sum(series, &Value::along, x),
            physics::chebyshev_sum(series, &Value::across, x)};
  }

  algebra::Stencil dilatation_stencil(const physics::Kernel<2> &influence, double factor, double h,
                                      const AxisShapes &shapes)
  {
    const DilatationKernel kernel(influence);
    const Correlations r(shapes);
    const auto n_axis = static_cast<unsigned int>(shapes.families().size());
    const unsigned int n_families = n_axis * n_axis;
    const Pieces pieces(r, n_axis);
    const Rule rule = gathered_rule(r.n_modes() + 20);
    const int n = static_cast<int>(std::ceil(kernel.radius() / h * (1 - 1e-14)));

    algebra::Stencil stencil(2 * n_families, n + 1);
    double mass = 0; // ∫ C_aa, zero but for rounding
    for (int i = 0; i < n; ++i)
      for (int j = 0; j <= i && h * std::hypot(i, j) < kernel.radius(); ++j)
      {
        CellMoments moments = cell_moments(kernel, h, i, j, r.n_modes(), rule);
        for (Matrix &moment : moments)
          moment *= factor * h * h * h * h;
        mass += (i == j ? 2 : 4) * (moments[0](0, 0) + moments[2](0, 0));
        subtract_images(stencil, moments, i, j, pieces, n_axis);
      }
    for (unsigned int a = 0; a < 2; ++a)
      for (unsigned int s = 0; s < n_families; ++s)
        for (unsigned int t = 0; t < n_families; ++t)
          for (int k2 = -1; k2 <= 1; ++k2)
            for (int k1 = -1; k1 <= 1; ++k1)
              stencil(a * n_families + s, a * n_families + t, k1, k2) +=
                  mass * r(s % n_axis, t % n_axis, -k1) * r(s / n_axis, t / n_axis, -k2);
    return stencil;
  }
} // namespace plumbline::reference
